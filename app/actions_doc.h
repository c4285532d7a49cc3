// docs/actions.md, written from the tables of actions and of what asks for them.
#pragma once
#include <string>

namespace seascape {

std::string actions_document();

}  // namespace seascape
