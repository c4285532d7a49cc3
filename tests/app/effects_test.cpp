// The closure of effects.
#include "ocean/effects.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace seascape {
namespace {

std::vector<std::pair<std::string, std::string>> entries(const std::vector<std::string>& named) {
  std::vector<std::pair<std::string, std::string>> result;
  for (const EffectEntry& entry : closure(named)) result.emplace_back(entry.name, entry.because);
  return result;
}

using Entries = std::vector<std::pair<std::string, std::string>>;

// Control: clearing what foam needs in effects.cpp fails here.
TEST(Effects, TheClosureAddsWhatIsNeededAndSaysWhy) {
  EXPECT_EQ(entries({"foam"}), (Entries{{"waves", "foam needs it"}, {"foam", "the scene names it"}}));
  EXPECT_EQ(entries({"wave_particles"}),
            (Entries{{"waves", "wave_particles needs it"}, {"wave_particles", "the scene names it"}}));
  EXPECT_EQ(entries({"gerstner"}), (Entries{{"waves", "gerstner needs it"}, {"gerstner", "the scene names it"}}));
  EXPECT_EQ(entries({"spray"}), (Entries{{"waves", "spray needs it"}, {"spray", "the scene names it"}}));
  EXPECT_EQ(entries({"wakes"}),
            (Entries{{"models", "boats needs it"}, {"boats", "wakes needs it"}, {"wakes", "the scene names it"}}));
  EXPECT_EQ(entries({"foam", "waves"}), (Entries{{"waves", "the scene names it"}, {"foam", "the scene names it"}}));
}

// Control: a closure that starts with waves fails here.
TEST(Effects, NothingIsThereThatNobodyAskedFor) {
  EXPECT_EQ(entries({}), Entries{});
  EXPECT_EQ(entries({"waves"}), (Entries{{"waves", "the scene names it"}}));
}

TEST(Effects, TheNamesAreThoseOfTheDesign) {
  EXPECT_EQ(effect_names().size(), 24u);
  EXPECT_TRUE(effect_is_built("waves"));
  EXPECT_TRUE(effect_is_built("foam"));
  EXPECT_TRUE(effect_is_built("spray"));
  EXPECT_TRUE(effect_is_built("models"));
  EXPECT_TRUE(effect_is_built("baked"));
  EXPECT_TRUE(effect_is_built("gerstner"));
  EXPECT_TRUE(effect_is_built("wave_particles"));
  EXPECT_TRUE(effect_is_built("boats"));
  EXPECT_TRUE(effect_is_built("wakes"));
  EXPECT_TRUE(effect_is_built("portals"));
  EXPECT_TRUE(effect_is_known("clouds"));
  EXPECT_FALSE(effect_is_built("clouds"));
  EXPECT_FALSE(effect_is_known("boat"));
}

}  // namespace
}  // namespace seascape
