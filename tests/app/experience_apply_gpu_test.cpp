// Settings taken while the program runs draw what a fresh start with them draws: what explore's panel promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "engine/text.h"
#include "ocean/effects.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

namespace {

class ExperienceApply : public test::GpuTest {};

// Another value that the row allows, as text.
std::string another(const Settings& settings, const Setting& row) {
  if (std::holds_alternative<FlagMember>(row.member)) return value_text(settings, row) == "true" ? "false" : "true";
  if (!row.choices.empty()) return std::string(row.choices[value_text(settings, row) == row.choices[0] ? 1 : 0]);
  const double now = std::get<double>(value_of(settings, row));
  const double wanted = now == 0.0 ? std::min(2.0, row.most) : now * 0.5 >= row.least ? now * 0.5 : now * 2.0;
  const double value = std::clamp(wanted, row.least, row.most);
  return text_from(std::holds_alternative<RealMember>(row.member) ? value : std::floor(value));
}

// What such a setting does is nothing, as the proofs of effects have it.
bool of_an_absent_effect(const Scene& scene, std::string_view key) {
  const std::string_view group = key.substr(0, key.find('.'));
  const auto names = effect_names();
  return std::find(names.begin(), names.end(), group) != names.end() && !calls_for(scene.effects, group);
}

// Each setting (those of effects that the scene does not have with SEASCAPE_LONG=1) goes to another value and back.
// Controls: waves.wind_speed_mps without `rebuild` in the table, and an apply that forgets Ocean::apply, each fail
// here.
TEST_F(ExperienceApply, DrawsWhatAFreshStartDraws) {
  const test::ShotOptions common{.scene = "storm",
                                 .preset = "low",
                                 .width = 64,
                                 .height = 48,
                                 .set = {{"waves.resolution", "32"},
                                         {"waves.cascades", "2"},
                                         {"waves.change_s", "0"},
                                         {"msaa", "1"},
                                         {"foam.settle_s", "0.5"}}};
  const Pose head = test::pose({0.0, 9.0, 0.0}, 20.0, -12.0);
  constexpr double time_s = 2.0;
  test::SeaShot live(common);  // goes to each setting and back
  const Image8 plain = live.picture(head, time_s);
  int changed_pictures = 0;
  for (const Setting& row : settings_table()) {
    SCOPED_TRACE(row.key);
    if (std::holds_alternative<TextMember>(row.member)) continue;  // a name has to be of something
    if (std::getenv("SEASCAPE_LONG") == nullptr && of_an_absent_effect(live.scene(), row.key)) continue;
    const std::string before = value_text(live.scene().settings, row), value = another(live.scene().settings, row);
    live.set(std::string(row.key), value);
    test::ShotOptions options = common;
    options.set.emplace_back(std::string(row.key), value);
    test::SeaShot fresh(options);
    const Image8 picture = fresh.picture(head, time_s);
    EXPECT_EQ(test::differing_pixels(live.picture(head, time_s), picture), 0) << value;
    live.set(std::string(row.key), before);
    EXPECT_EQ(test::differing_pixels(live.picture(head, time_s), plain), 0) << "and back";
    changed_pictures += test::differing_pixels(picture, plain) > 0;
  }
  EXPECT_GE(changed_pictures, 25);  // else nothing was compared
}

}  // namespace

}  // namespace seascape
