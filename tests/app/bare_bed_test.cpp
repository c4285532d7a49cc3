// The effect sea_depth without inputs: the bed lies at waves.depth_m everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "app/place_inputs.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"
#include "ocean/waves/sea_limits.h"

namespace seascape {
namespace {

Scene over_bed(double depth_m) {
  Scene scene;
  scene.effects = {"waves", "sea_depth"};
  scene.settings.sea.depth_m = depth_m;
  scene.settings.sea.wind_speed_mps = 15.0;
  scene.settings.waves.resolution = 128;
  return scene;
}

std::vector<QueryAnswer> answers_of(const Scene& scene) {
  Sea sea(sea_spec(scene));
  std::vector<glm::dvec2> places;
  for (int i = 0; i < 2500; ++i) places.push_back({71.3 * (i % 50) - 1700.0, 67.9 * (i / 50) - 1700.0});
  std::vector<QueryAnswer> answers(places.size());
  sea.view_at(12.0, SeaDetail::drawn).query(places, answers);
  return answers;
}

// Control seen: a bed left out where nothing gives one (heights 1.1 m apart, before waves were limited by depth too).
TEST(BareBed, WavesBreakOverIt) {
  const std::vector<QueryAnswer> bare = answers_of(over_bed(1.0));
  Scene given = over_bed(1.0);
  InputSpec bed;
  bed.to = InputTarget::sea_depth;
  bed.blend = InputBlend::replace;
  bed.value = {-1.0f, 0.0f, 0.0f, 0.0f};
  bed.shape = AreaInput{.round = false, .at_m = {0.0, 0.0}, .size_m = {20000.0, 20000.0}};
  given.inputs.push_back(bed);
  const std::vector<QueryAnswer> over_input = answers_of(given);
  double squares = 0.0, converged = 0.0;
  for (std::size_t i = 0; i < bare.size(); ++i) {
    EXPECT_NEAR(bare[i].depth_m, 1.0, 1e-6);
    ASSERT_NEAR(bare[i].height_m, over_input[i].height_m, 1e-3) << i;
    squares += bare[i].height_m * bare[i].height_m;
    converged += bare[i].converged;
  }
  const double height_m = 4.0 * std::sqrt(squares / double(bare.size()));
  EXPECT_LE(height_m, most_height_of_depth);
  EXPECT_GE(height_m, 0.8 * most_height_of_depth);
  EXPECT_GE(converged, 0.99 * double(bare.size()));
}

// Control seen: as above: the water's mirror at 0.
TEST(BareBed, LandIsLand) {
  for (const double height_m : {2.0, 0.0})
    for (const QueryAnswer& a : answers_of(over_bed(-height_m))) {
      ASSERT_EQ(a.height_m, height_m);
      ASSERT_EQ(a.depth_m, -height_m);
      ASSERT_EQ(a.orbital_velocity_mps, glm::dvec3(0.0));
      ASSERT_EQ(a.normal.y, 1.0);
      ASSERT_TRUE(a.converged);
    }
}

// What gives nothing is not there. Control seen: a bed at any depth.
TEST(BareBed, OneTooDeepToBeFeltIsNotThere) {
  EXPECT_TRUE(place_inputs(over_bed(deep_water_m)).empty());
  EXPECT_FALSE(place_inputs(over_bed(100.0)).empty());
}

}  // namespace
}  // namespace seascape
