// Seas that no water bears are drawn as high as it does, and said.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "app/sea_remarks.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"
#include "ocean/waves/wave_particles.h"

namespace seascape {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Scene scene_of(double depth_m, double wind_mps, double swell_m = 0.0, double particles_m = 0.0) {
  Scene scene;
  if (particles_m > 0.0) scene.effects.push_back("wave_particles");
  SeaState& sea = scene.settings.sea;
  sea.depth_m = depth_m;
  sea.wind_speed_mps = wind_mps;
  sea.swell_height_m = swell_m;
  sea.swell_period_s = 4.0;
  scene.settings.wave_particles.height_m = particles_m;
  scene.settings.waves.resolution = 128;
  return scene;
}

struct Asked {
  double height_m, converged;
};
Asked ask(const Scene& scene) {
  Sea sea(sea_spec(scene));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-2000.0, 2000.0);
  std::vector<glm::dvec2> places(3000);
  for (glm::dvec2& place : places) place = {anywhere(random), anywhere(random)};
  std::vector<QueryAnswer> answers(places.size());
  sea.view_at(40.0, SeaDetail::drawn).query(places, answers);
  double sum = 0.0, squares = 0.0, converged = 0.0;
  for (const QueryAnswer& a : answers) sum += a.height_m, squares += a.height_m * a.height_m, converged += a.converged;
  const double n = double(answers.size()), mean = sum / n;
  return {4.0 * std::sqrt(squares / n - mean * mean), converged / n};
}

// Controls seen: a sea_spec() that takes the settings' own state (1.1 m over 1 cm, 0.2 % converged) or the particles'
// own height (42 m).
TEST(SeaLimitsHard, SeasOfShallowWaterAreAsHighAsItBearsAndHardlyFold) {
  for (const double depth : {0.01, 0.3, 2.0})
    for (const double wind : {3.0, 30.0})
      for (const double swell : {0.0, 15.0})
        for (const double particles : {0.0, 20.0}) {
          SCOPED_TRACE(testing::Message()
                       << depth << " m, wind " << wind << ", swell " << swell << ", particles " << particles);
          const Asked sea = ask(scene_of(depth, wind, swell, particles));
          EXPECT_LE(sea.height_m, 1.1 * most_height_of_depth * depth) << "a tile's own height is random";
          EXPECT_GE(sea.converged, 0.99);
        }
}

// Controls as above: of 15 m of swell 4 % converge.
TEST(SeaLimitsHard, SteepSwellAndParticlesOfTheDeepHardlyFold) {
  for (const double wind : {3.0, 10.0}) {
    SCOPED_TRACE(wind);
    const double alone = ask(scene_of(deep_water_m, wind)).height_m;
    const Asked swell = ask(scene_of(deep_water_m, wind, 15.0)), both = ask(scene_of(deep_water_m, wind, 15.0, 20.0)),
                particles = ask(scene_of(deep_water_m, wind, 0.0, 20.0));
    for (const Asked& one : {swell, particles, both}) EXPECT_GE(one.converged, 0.99);
    EXPECT_GT(swell.height_m, 1.05 * alone);
    EXPECT_LT(swell.height_m, std::hypot(alone, 1.8));
  }
}

// A wind sea of the deep, and all that ships, is not touched. Control seen: wind seas held to the same steepness.
TEST(SeaLimits, WhatWaterBearsStaysToTheBit) {
  for (const char* name : {"open_sea", "calm", "storm", "swell", "rain_pool", "gerstner", "baked", "whirlpool",
                           "lagoon", "rivers", "harbour_clip", "harbour", "still_life"}) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(name, "low");
    const LimitedSea limited = limited_sea(scene);
    EXPECT_EQ(limited.sea, scene.settings.sea);
    if (limited.particles) {
      EXPECT_EQ(limited.particles->height_m, scene.settings.wave_particles.height_m);
    }
    EXPECT_THAT(remarks_of(scene), IsEmpty());
  }
  for (const double wind : {1.0, 64.0})
    for (const double fetch : {10.0, 1e6}) {
      Scene scene = scene_of(deep_water_m, wind);
      scene.settings.sea.fetch_m = fetch;
      EXPECT_EQ(limited_sea(scene).sea, scene.settings.sea);
    }
  Scene defaults;
  defaults.effects = {"waves", "wave_particles"};
  EXPECT_THAT(remarks_of(defaults), IsEmpty());
}

// One line for what is wrong, with the key, its value and what is drawn. Control seen: a limit that says nothing.
TEST(SeaLimits, WhatIsDrawnLowerIsSaidOnce) {
  EXPECT_THAT(remarks_of(scene_of(deep_water_m, 10.0, 15.0)),
              ElementsAre("waves.swell_height_m: 15 m is steeper than water bears beside the other waves and is drawn "
                          "with 1.17 m; give lower or longer waves"));
  EXPECT_THAT(remarks_of(scene_of(deep_water_m, 10.0, 0.0, 20.0)),
              ElementsAre("wave_particles.height_m: 20 m is steeper than water bears beside the other waves and is "
                          "drawn with 0.0224 m; give lower or longer waves"));
  EXPECT_THAT(
      remarks_of(scene_of(0.01, 10.0)),
      ElementsAre("waves.depth_m: 0.01 m of water bears waves of 0.00594 m in all: the wind sea 2.24 m is drawn "
                  "with 0.00594 m; deepen it or give lower waves"));
  EXPECT_THAT(remarks_of(scene_of(0.5, 10.0, 15.0, 20.0)),
              ElementsAre(AllOf(HasSubstr("the wind sea"), HasSubstr("waves.swell_height_m 15 m is drawn with 0.197 m"),
                                HasSubstr("wave_particles.height_m 20 m is drawn with 0.0122 m"))));
  EXPECT_THAT(remarks_of(scene_of(-2.0, 10.0)),
              ElementsAre("waves.depth_m: -2 m is dry land, which is drawn as flat water without the effect sea_depth; "
                          "add it to the scene's effects or deepen the water"));
}

// As the sea runs: lower waves leave room for others. Controls seen: a source kept though its limit is another; the
// settings' own state in place of the limited one.
TEST(SeaLimits, HoldWhileTheSeaRuns) {
  Scene scene = scene_of(0.5, 10.0, 0.0, 0.02);
  scene.settings.wave_particles.tile_m = 40.0;
  scene.settings.wave_particles.radius_m = 2.0;
  scene.settings.wave_particles.height_m = 0.1;
  const SeaSpec spec = sea_spec(scene);
  const auto particles = [](const SeaSpec& of) {
    return std::dynamic_pointer_cast<const WaveParticles>(of.sources.at(0))->height_m();
  };
  EXPECT_LT(particles(spec), 0.1);
  const Settings before = scene.settings;
  scene.settings.sea.wind_speed_mps = 0.5;
  const MadeBefore made{before, spec};
  const SeaSpec calm = sea_spec(scene, &made);
  EXPECT_EQ(particles(calm), 0.1);
  EXPECT_EQ(calm.state, scene.settings.sea);
  const MadeBefore again{scene.settings, calm};
  EXPECT_EQ(sea_spec(scene, &again).sources, calm.sources);
}

}  // namespace
}  // namespace seascape
