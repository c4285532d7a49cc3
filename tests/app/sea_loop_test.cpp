// With waves.loop_s all that has a period comes again with the waves.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/sea_remarks.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"

namespace seascape {
namespace {

// How far heights are apart at most, `after_s` later.
double apart_m(const Scene& scene, double after_s) {
  Sea sea(sea_spec(scene));
  std::vector<glm::dvec2> places;
  for (int i = 0; i < 400; ++i) places.push_back({3.7 * (i % 20) - 35.0, 3.1 * (i / 20) - 90.0});
  const auto heights = [&](double time_s) {
    std::vector<QueryAnswer> answers(places.size());
    sea.view_at(time_s, SeaDetail::drawn).query(places, answers, {.history = false});
    return answers;
  };
  const std::vector<QueryAnswer> now = heights(5.3), later = heights(5.3 + after_s);
  double apart = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) apart = std::max(apart, std::abs(now[i].height_m - later[i].height_m));
  return apart;
}

// Controls seen: a current's patterns in their own time (0.4 m apart), a baked loop in its own (1.6 m).
TEST(SeaLoop, CurrentsAndBakedLoopsComeAgainWithTheWaves) {
  for (const char* name : {"whirlpool", "rivers", "baked", "open_sea"}) {
    SCOPED_TRACE(name);
    Scene scene = load_scene(name, "low");
    if (scene.name == "open_sea") {
      scene.effects.push_back("flow");
      scene.settings.place.flow_mps = 1.5;
    }
    for (const double loop_s : {37.0, 4.1}) {
      scene.settings.sea.loop_s = loop_s;
      EXPECT_LE(apart_m(scene, loop_s), 1e-4) << loop_s;
    }
    EXPECT_GT(apart_m(scene, 3.3), 0.01);
  }
}

// Periods are those nearest to their own that the loop has a whole number of, and their own without a loop.
TEST(SeaLoop, PeriodsAreRoundedToIt) {
  EXPECT_EQ(period_in_loop(2.0, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(period_in_loop(2.0, 37.0), 37.0 / 19.0);
  EXPECT_EQ(period_in_loop(60.0, 37.0), 37.0);
}

// Control seen: nothing said.
TEST(SeaLoop, WhatKeepsItsOwnTimeIsSaid) {
  Scene scene = load_scene("storm", "low");
  EXPECT_THAT(remarks_of(scene), testing::IsEmpty());
  scene.settings.sea.loop_s = 37.0;
  EXPECT_THAT(remarks_of(scene),
              testing::ElementsAre("waves.loop_s: what keeps its own time does not repeat after 37 s: foam and spray; "
                                   "leave it out where all of the sea has to repeat"));
  Scene open = load_scene("open_sea", "low");
  open.settings.sea.loop_s = 37.0;
  EXPECT_THAT(remarks_of(open), testing::IsEmpty());
}

// A loop shorter than the longest waves makes them run too fast, which is said. Control seen: nothing said of 0.5 s, in
// which open_sea's water moves at 28 m/s.
TEST(SeaLoop, OneShorterThanTheWavesIsSaid) {
  Scene scene = load_scene("open_sea", "low");
  for (const double loop_s : {1e-300, 0.5, 10.9}) {
    scene.settings.sea.loop_s = loop_s;
    EXPECT_THAT(remarks_of(scene),
                testing::ElementsAre(testing::HasSubstr("is shorter than the 11 s of the longest waves, which")));
  }
  scene.settings.sea.loop_s = 11.1;
  EXPECT_THAT(remarks_of(scene), testing::IsEmpty());
  scene.settings.sea.loop_s = 0.5;
  scene.settings.sea.wind_speed_mps = scene.settings.sea.swell_height_m = 0.0;
  EXPECT_THAT(remarks_of(scene), testing::IsEmpty()) << "there are no waves";
}

}  // namespace
}  // namespace seascape
