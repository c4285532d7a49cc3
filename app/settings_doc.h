// docs/settings.md, written from the tables of settings, presets and effects.
#pragma once
#include <string>

namespace seascape {

std::string settings_document();

}  // namespace seascape
