#include "engine/stages.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace seascape {
namespace {

void rest(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

// Controls seen: a time that replaces the one before; names told apart by where they lie.
TEST(Stages, TimesOfANameAddUp) {
  Stages stages;
  const std::string sea = "sea", also_sea = "sea";
  stages.time(sea.c_str(), [] { rest(3); });
  stages.time("waves", [] { rest(2); });
  stages.time(also_sea.c_str(), [] { rest(3); });
  ASSERT_EQ(stages.times().size(), 2u);
  EXPECT_STREQ(stages.times()[0].name, "sea");
  EXPECT_GE(stages.times()[0].ms, 6.0);
  EXPECT_GE(stages.times()[1].ms, 2.0);
  stages.clear();
  EXPECT_TRUE(stages.times().empty());
}

TEST(Stages, TooManyAreRefused) {
  Stages stages;
  std::array<std::string, Stages::most + 1> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = std::to_string(i);
  for (std::size_t i = 0; i < Stages::most; ++i) stages.time(names[i].c_str(), [] {});
  EXPECT_THROW(stages.time(names.back().c_str(), [] {}), std::length_error);
}

}  // namespace
}  // namespace seascape
