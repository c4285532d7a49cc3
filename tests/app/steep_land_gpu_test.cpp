// Land that rises steeply out of deep water: what is seen through the water before it, from every side and height.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/sky.h"
#include "ocean/inputs/soft_edge.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

namespace {

using test::pose;
using test::SeaShot;

class SteepLand : public test::GpuTest {};

struct Wall {
  double depth_m, top_m, feather_m;
};
constexpr double half_m = 30.0;  // of the land's side
constexpr int width = 60, height = 40;

// The bed's height: a square of land in water of one depth (ocean/inputs/areas.cpp).
double bed_m(const Wall& wall, glm::dvec2 at) {
  const auto share = [&](double along) { return soft_share(half_m - std::abs(along), wall.feather_m, 0.0); };
  return std::lerp(-wall.depth_m, wall.top_m, share(at.x) * share(at.y));
}

// How deep below a level sea a line of sight meets the bed, m; less than 0 where it meets land before the water, or no
// water at all.
double way_m(const Wall& wall, const glm::dvec3& eye, const glm::dvec3& ray) {
  if (ray.y > -0.02) return -1.0;
  for (double t = 0.0; t < -eye.y / ray.y; t += 0.1) {
    const glm::dvec3 at = eye + t * ray;
    if (bed_m(wall, {at.x, at.z}) > at.y) return -1.0;
  }
  const glm::dvec3 at = eye - eye.y / ray.y * ray;
  glm::dvec3 inside = glm::dvec3(ray.x, 0.0, ray.z) / 1.333;
  inside.y = -std::sqrt(1.0 - glm::dot(inside, inside));
  for (double y = 0.0; y < wall.depth_m; y += 0.05) {
    const glm::dvec3 below = at + inside * (y / -inside.y);
    if (bed_m(wall, {below.x, below.z}) > -y) return y;
  }
  return wall.depth_m;
}

test::ShotOptions options(const Wall& wall, bool land) {
  test::ShotOptions o{.scene = "open_sea",
                      .preset = "medium",
                      .width = width,
                      .height = height,
                      .set = {{"waves.wind_speed_mps", "0"},
                              {"waves.swell_height_m", "0"},
                              {"waves.depth_m", std::to_string(wall.depth_m)},
                              {"msaa", "1"}},
                      .effects = {{"waves", "sea_depth"}}};
  InputSpec spec;
  spec.to = InputTarget::sea_depth;
  spec.blend = InputBlend::replace;
  spec.value.x = float(land ? wall.top_m : -wall.depth_m);
  spec.feather_m = float(wall.feather_m);
  spec.shape = AreaInput{.round = false, .size_m = glm::dvec2(2.0 * half_m)};
  o.inputs = {spec};
  return o;
}

// Where a line of sight meets deep water, or the land 6 m and more below it, the picture is that of the sea without
// land to a hundredth, but for one pixel in 200 (a triangle of land reaches beyond it); where it meets the land at less
// than 2 m, the land is seen. Controls seen: the bed read where the level bed would be met, land or not (sand of 0.2
// and more on deep water); all water before land taken for deep.
TEST_F(SteepLand, LaysNoSandOnDeepWater) {
  int shallow = 0, shown = 0;
  for (const Wall& wall : {Wall{20.0, 3.0, 0.5}, Wall{20.0, 3.0, 6.0}, Wall{20.0, 3.0, 15.0}, Wall{6.0, 2.0, 2.0}}) {
    SeaShot with(options(wall, true)), without(options(wall, false));
    int deep = 0, sandy = 0;
    double worst = 0.0;
    for (const double high : {2.0, 8.0, 25.0})
      for (const double yaw : {0.0, 70.0, 180.0, 250.0}) {
        const double turn = glm::radians(yaw), far = half_m + 2.0 + 1.5 * high;
        const Pose head = pose({-std::sin(turn) * far, high, std::cos(turn) * far}, yaw, -20.0 - 10.0 * (high > 5.0));
        const Viewpoint seen = with.viewpoint(head);
        const Image8 a = with.picture(head, 3.0), b = without.picture(head, 3.0);
        const View& eye = seen.eyes.front();
        for (int j = 1; j + 1 < height; ++j)
          for (int i = 1; i + 1 < width; ++i) {
            double least = 1e9, most = -1e9;  // over the pixel and its neighbours
            for (const double dj : {-0.5, 0.5, 1.5})
              for (const double di : {-0.5, 0.5, 1.5}) {
                const glm::dvec3 local(std::lerp(eye.fov.left, eye.fov.right, (i + di) / width),
                                       std::lerp(eye.fov.up, eye.fov.down, (j + dj) / height), -1.0);
                const double way = way_m(wall, eye.pose.position_m, glm::normalize(eye.pose.orientation * local));
                least = std::min(least, way), most = std::max(most, way);
              }
            const std::size_t at = std::size_t(j) * width + std::size_t(i);
            const glm::dvec3 d = test::light_at(a, at) - test::light_at(b, at);
            if (least >= std::min(6.0, 0.98 * wall.depth_m)) {
              ++deep;
              sandy += d.x > 0.01;
              worst = std::max(worst, d.x);
            } else if (least > 0.2 && most < 2.0) {
              ++shallow;
              shown += glm::length(d) > 0.02;
            }
          }
        if (sandy > 0)
          test::leave(a, "steep_land_" + std::to_string(int(wall.feather_m)) + "_" + std::to_string(int(high)) + "_" +
                             std::to_string(int(yaw)));
      }
    const std::string name = std::to_string(wall.depth_m) + " m deep, feather " + std::to_string(wall.feather_m);
    EXPECT_GT(deep, 1000) << name;
    EXPECT_LT(sandy, deep / 200) << name << ": of " << deep << ", worst " << worst;
  }
  EXPECT_GT(shallow, 50);
  EXPECT_GT(shown, shallow / 2) << "of " << shallow;
}

// Of the pixels that look at the wall before them, `away` metres off, between two heights: how many show stone in the
// sun, and how many of them water.
struct WallSeen {
  int stone = 0, of_water = 0;
  void count(const Image8& picture, const View& eye, double away, double from_m, double to_m) {
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i) {
        const glm::dvec3 local(std::lerp(eye.fov.left, eye.fov.right, (i + 0.5) / width),
                               std::lerp(eye.fov.up, eye.fov.down, (j + 0.5) / height), -1.0);
        const glm::dvec3 ray = eye.pose.orientation * local, met = eye.pose.position_m + ray * (away / std::abs(ray.z));
        if (std::abs(met.x) > half_m - 6.0 || met.y < from_m || met.y > to_m) continue;
        const glm::dvec3 light = test::light_at(picture, std::size_t(j) * width + std::size_t(i));
        ++stone;
        of_water += light.z > light.x;
      }
  }
};

test::ShotOptions windy(const Wall& wall, const char* preset, const char* sun_to_deg) {
  test::ShotOptions of = options(wall, true);
  of.preset = preset;
  of.set.front().second = "9";  // the wind
  of.set.emplace_back("sky.sun_to_deg", sun_to_deg);
  return of;
}

// Before a quay of 8 m in deep water triangles reach from the water to its top. Where the line of sight meets the quay
// in the sun the picture shows it, and no water, but for one pixel in 20. Control seen: such triangles lit as water
// (1,628 of 2,752).
TEST_F(SteepLand, ShowsAWallAndNoRampOfWater) {
  const Wall wall{20.0, 8.0, 0.5};
  WallSeen seen;
  for (const char* preset : {"low", "medium", "high", "ultra"}) {
    SeaShot shot(windy(wall, preset, "180"));
    for (const double away : {20.0, 45.0}) {
      const Pose head = pose({0.0, 6.0, half_m + away}, 0.0, -6.0);
      const Image8 picture = shot.picture(head, 3.0);
      seen.count(picture, shot.viewpoint(head).eyes.front(), away, 1.5, wall.top_m - 1.0);
      test::leave(picture, std::string("wall_") + preset + "_" + std::to_string(int(away)));
    }
  }
  EXPECT_GT(seen.stone, 300);
  EXPECT_LT(seen.of_water, seen.stone / 20) << "of " << seen.stone;
}

// So it is down to the water: in the lee of the quay, where the waves are low, from 0.5 m up. Lit once a pixel (low)
// and by triangles (medium, of several samples). Control seen: walls looked for only in what is drawn higher than half
// the significant height.
TEST_F(SteepLand, ShowsAWallDownToTheWater) {
  const Wall wall{20.0, 8.0, 0.5};
  for (const std::string samples : {"1", "4"}) {
    test::ShotOptions of = windy(wall, "low", "0");
    for (auto& [key, value] : of.set)
      if (key == "msaa") value = samples;
    SeaShot shot(of);
    WallSeen seen;
    for (const double away : {12.0, 20.0}) {
      const Pose head = pose({0.0, 6.0, -half_m - away}, 180.0, -12.0);
      const Image8 picture = shot.picture(head, 3.0);
      seen.count(picture, shot.viewpoint(head).eyes.front(), away, 0.5, 1.5);
      test::leave(picture, "wall_in_lee_" + samples + "_" + std::to_string(int(away)));
    }
    EXPECT_GT(seen.stone, 100) << samples;
    EXPECT_LT(seen.of_water, seen.stone / 10) << samples << " samples, of " << seen.stone;
    RecordProperty("of_" + std::to_string(seen.stone) + "_with_" + samples, seen.of_water);
  }
}

// A bar whose bed lies at the still level is wet land: no run-up comes and goes on it in sheets, for it has no slope to
// run up. From a moment to the next its light stays as it is. Control seen: the run-up as on a beach (154
// of 210 pixels).
TEST_F(SteepLand, StandsStillAtTheStillLevel) {
  test::ShotOptions of = windy({6.0, 0.0, 10.0}, "medium", "180");
  of.set.front().second = "7";
  SeaShot shot(of);
  const Pose head = pose({0.0, 25.0, half_m + 20.0}, 0.0, -30.0);
  const View eye = shot.viewpoint(head).eyes.front();
  const Image8 before = shot.picture(head, 3.0), after = shot.picture(head, 5.0);
  int all = 0, changed = 0;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const glm::dvec3 ray =
          eye.pose.orientation * glm::dvec3(std::lerp(eye.fov.left, eye.fov.right, (i + 0.5) / width),
                                            std::lerp(eye.fov.up, eye.fov.down, (j + 0.5) / height), -1.0);
      const glm::dvec3 met = eye.pose.position_m - ray * (eye.pose.position_m.y / ray.y);
      if (ray.y > -0.05 || std::abs(met.x) > 16.0 || std::abs(met.z) > 16.0) continue;
      const std::size_t at = std::size_t(j) * width + std::size_t(i);
      const double was = test::light_at(before, at).y, is = test::light_at(after, at).y;
      ++all;
      changed += std::abs(is - was) > 0.05 * was;
    }
  EXPECT_GT(all, 150);
  EXPECT_LT(changed, all / 10) << "of " << all << test::leave(after, "bar");
  RecordProperty("changed_of_" + std::to_string(all), changed);
}

// A bank that turns away from the sun has the light of the sky and of the ground around it: it is 2.0 times as
// blue as in the sun, and not black. Control seen: the sky's light alone (3.0 times).
TEST_F(SteepLand, IsLitByTheGroundAroundIt) {
  const Wall wall{6.0, 5.0, 5.0};
  SeaShot shot(options(wall, true));
  const glm::dvec3 sun = sun_direction(shot.scene().settings.sky);
  glm::dvec3 shaded(0.0), sunny(0.0);
  int of_shaded = 0, of_sunny = 0;
  for (const double yaw : {0.0, 90.0, 180.0, 270.0}) {
    const double turn = glm::radians(yaw);
    const Pose head = pose({-std::sin(turn) * 50.0, 4.0, std::cos(turn) * 50.0}, yaw, -8.0);
    const View eye = shot.viewpoint(head).eyes.front();
    const Image8 picture = shot.picture(head, 3.0);
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i) {
        const glm::dvec3 ray = glm::normalize(
            eye.pose.orientation * glm::dvec3(std::lerp(eye.fov.left, eye.fov.right, (i + 0.5) / width),
                                              std::lerp(eye.fov.up, eye.fov.down, (j + 0.5) / height), -1.0));
        glm::dvec3 at = eye.pose.position_m;
        while (glm::length(at - eye.pose.position_m) < 60.0 && bed_m(wall, {at.x, at.z}) < at.y) at += 0.05 * ray;
        if (at.y < 1.5 || at.y > 4.0 || glm::length(at - eye.pose.position_m) >= 60.0) continue;
        const auto rise = [&](glm::dvec2 way) {
          return bed_m(wall, glm::dvec2(at.x, at.z) + way) - bed_m(wall, glm::dvec2(at.x, at.z) - way);
        };
        const glm::dvec3 normal = glm::normalize(glm::dvec3(-rise({0.05, 0.0}), 0.1, -rise({0.0, 0.05})));
        const glm::dvec3 light = test::light_at(picture, std::size_t(j) * width + std::size_t(i));
        if (normal.y > 0.6) continue;
        if (glm::dot(normal, sun) < -0.05) shaded += light, ++of_shaded;
        if (glm::dot(normal, sun) > 0.4) sunny += light, ++of_sunny;
      }
  }
  ASSERT_GT(of_shaded, 20);
  ASSERT_GT(of_sunny, 20);
  shaded /= of_shaded, sunny /= of_sunny;
  EXPECT_LT(shaded.z / shaded.x, 2.4 * sunny.z / sunny.x);
  EXPECT_GT(shaded.y, 0.15 * sunny.y);
  RecordProperty("bluer_per_cent", int(100.0 * (shaded.z / shaded.x) / (sunny.z / sunny.x)));
  RecordProperty("light_per_cent", int(100.0 * shaded.y / sunny.y));
}

// From the floor of a dry dock the edge of the sea beyond its mouth is a wall of stone and not of water. Control seen:
// wet walls that mirror the sky in rays that go down.
TEST_F(SteepLand, EndsTheSeaAtADockInAWall) {
  SeaShot shot({.scene = "harbour_clip", .preset = "high", .width = 240, .height = 160, .set = {{"msaa", "1"}}});
  const Pose head = pose({40.0, 1.0, -300.0}, 180.0, -5.0);
  const View eye = shot.viewpoint(head).eyes.front();
  const Image8 picture = shot.picture(head, 3.0);
  int points = 0, of_water = 0;
  for (double x = 30.0; x <= 50.0; x += 2.0)
    for (const double y : {-4.5, -3.5, -2.5, -1.5}) {
      const glm::dvec3 local = glm::inverse(eye.pose.orientation) * (glm::dvec3(x, y, -260.5) - eye.pose.position_m);
      const double across = (local.x / -local.z - eye.fov.left) / (eye.fov.right - eye.fov.left),
                   down = (local.y / -local.z - eye.fov.up) / (eye.fov.down - eye.fov.up);
      const glm::dvec3 light = test::light_at(picture, std::size_t(down * 160) * 240 + std::size_t(across * 240));
      ++points;
      of_water += light.z > 1.2 * light.x;
    }
  EXPECT_EQ(points, 44);
  EXPECT_LE(of_water, 4) << test::leave(picture, "dock");
}

}  // namespace

}  // namespace seascape
