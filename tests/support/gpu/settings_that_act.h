// For each row of the settings table a small scene in which it acts, and another value that it goes to there.
#pragma once
#include <string>
#include <string_view>

#include "app/settings.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape::test {

// Another value that the row allows, as text.
std::string another(const Settings& settings, const Setting& row);
ShotOptions where_it_acts(std::string_view key);
// One that is seen in where_it_acts().
std::string value_in(const Settings& settings, const Setting& row);

}  // namespace seascape::test
