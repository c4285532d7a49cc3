// Rays meet the surface where they first come to it.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/scene.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {

// Rays from above and from below, steep and grazing, against a walk in steps of a centimetre. Controls seen: steps that
// reckon with a slope of 0.1 (storm: crests missed); clipped water that is met (harbour_clip); a walk that begins where
// the highest crest would be with the sign of the direction turned (all).
TEST(SeaRay, MeetsTheSurfaceFirst) {
  for (const char* name : {"open_sea", "storm", "lagoon", "harbour_clip", "rain_pool"}) {
    const Scene scene = load_scene(name, "medium");
    Sea sea(sea_spec(scene));
    sea.advance(4.2, scene.start.position_m);
    const SeaView view = sea.view_at(4.2, SeaDetail::felt);
    std::mt19937 random(3);
    const auto within = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    const int rays = test::sanitized ? 4 : 60;
    int hits = 0;
    for (int i = 0; i < rays; ++i) {
      glm::dvec3 origin = scene.start.position_m + glm::dvec3(within(-40.0, 40.0), 0.0, within(-40.0, 40.0));
      const double surface = view.query({origin.x, origin.z}).height_m;
      origin.y = surface + (i % 4 == 3 ? -within(0.2, 3.0) : within(0.05, 8.0));
      const glm::dvec3 direction(within(-1.0, 1.0), (i % 4 == 3 ? 1.0 : -1.0) * within(0.05, 1.0), within(-1.0, 1.0));
      const RayAnswer answer = view.ray(origin, direction, {.most_m = 60.0});
      hits += answer.hit;
      const glm::dvec3 along = glm::normalize(direction);
      const auto above = [&](double distance, bool* clipped) {
        const glm::dvec3 at = origin + distance * along;
        const QueryAnswer water = view.query({at.x, at.z});
        *clipped = water.clipped;
        return at.y - water.height_m;
      };
      bool clipped = false;
      const bool begins_above = above(0.0, &clipped) > 0.0;
      if (answer.hit) {
        EXPECT_LE(std::abs(above(answer.distance_m, &clipped)), 2e-3) << name << " " << i;
        EXPECT_FALSE(clipped) << name << " " << i;
      }
      int crossings = 0;
      bool side = begins_above;
      for (double distance = 0.0; distance < answer.distance_m - 0.01; distance += 0.01) {
        const bool now = above(distance, &clipped) > 0.0;
        crossings += now != side && !clipped;
        side = now;
      }
      EXPECT_EQ(crossings, 0) << name << " " << i << " before " << answer.distance_m;
    }
    EXPECT_GT(hits, rays / 3) << name;
  }
}

TEST(SeaRay, MissesWhatItCannotMeet) {
  const Scene scene = load_scene("open_sea", "medium");
  Sea sea(sea_spec(scene));
  const SeaView view = sea.view_at(0.0, SeaDetail::felt);
  const RayAnswer up = view.ray({0.0, 30.0, 0.0}, {0.1, 1.0, 0.0}, {.most_m = 500.0});
  EXPECT_FALSE(up.hit);
  EXPECT_EQ(up.distance_m, 500.0);
  EXPECT_FALSE(view.ray({0.0, 30.0, 0.0}, {0.0, 0.0, 0.0}).hit);
  EXPECT_FALSE(view.ray({0.0, std::nan(""), 0.0}, {0.0, -1.0, 0.0}).hit);
  EXPECT_FALSE(view.ray({0.0, 30.0, 0.0}, {0.0, -1.0, 0.0}, {.most_m = 5.0}).hit) << "too short";
  const RayAnswer far = view.ray({0.0, 30.0, 0.0}, {1.0, -0.01, 0.0});
  EXPECT_TRUE(far.hit);
  EXPECT_NEAR(far.distance_m, 3000.0, 300.0);
}

// What bounds say of the water is so, and not by far too much.
TEST(SeaRay, BoundsHoldTheWater) {
  for (const char* name : {"open_sea", "storm", "gerstner", "rain_pool", "baked"}) {
    const Scene scene = load_scene(name, "medium");
    Sea sea(sea_spec(scene));
    sea.advance(9.0, scene.start.position_m);
    const SeaView view = sea.view_at(9.0, SeaDetail::felt);
    const SeaBounds bounds = view.bounds();
    double highest = 0.0, farthest = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const double reach = std::string(name) == "rain_pool" ? 3.0 : 400.0;
      const SeaSample at = view.at({reach * std::sin(i * 1.7), reach * std::sin(i * 0.61)}, 0.0);
      highest = std::max(highest, std::abs(at.displacement.y));
      farthest = std::max(farthest, std::hypot(at.displacement.x, at.displacement.z));
    }
    EXPECT_LE(highest, bounds.height_m) << name;
    EXPECT_LE(farthest, bounds.shift_m) << name;
    EXPECT_GE(highest, 0.2 * bounds.height_m) << name;
  }
}

}  // namespace
}  // namespace seascape
