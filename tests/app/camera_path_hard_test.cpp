// Hard cases of camera paths: keys as near in time as doubles are, at one place, turned by exactly half a turn, and
// times that are none.
#include "app/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace seascape {
namespace {

PathKey key(double time_s, glm::dvec3 at, double yaw_deg, double scene_time_s) {
  return {time_s, {at, orientation_from_angles({yaw_deg, 0.0, 0.0})}, scene_time_s};
}

bool sound(const PathSample& s) {
  return std::isfinite(s.pose.position_m.x + s.pose.position_m.y + s.pose.position_m.z + s.scene_time_s) &&
         std::abs(glm::length(s.pose.orientation) - 1.0) < 1e-9;
}

// Hard 77: Keys the least step of a double apart, 10,000 km in that step, half a turn exactly, one rotation by both of
// its quaternions, and times that are none: every pose finite, its rotation a unit (1e-9), its height between the
// keys'. Control: the code as it was (speeds without bound between keys at 0 and 5e-324 s: NaN).
TEST(CameraPathHard, hard_77_keys_a_last_place_apart) {
  for (const double start : {0.0, 1.0, 1e9}) {
    const double next = std::nextafter(start, 1e300), last = next + 5.0;
    CameraPath path;
    path.keys = {key(start, {0, 2, 0}, 0.0, 1.0), key(next, {1e7, 3, 0}, 180.0, 1.0),
                 key(next + 2.0, {1e7, 3, 0}, -180.0, 1.0), key(last, {-1e7, 4, 1}, 90.0, 9.0)};
    path.keys[2].pose.orientation = -path.keys[2].pose.orientation;
    for (double t = start - 1.0; t < last + 1.0; t += 0.01) {
      const PathSample s = path.at(t);
      ASSERT_TRUE(sound(s)) << t;
      ASSERT_GE(s.pose.position_m.y, 2.0 - 1e-9);
      ASSERT_LE(s.pose.position_m.y, 4.0 + 1e-9);
    }
    for (const PathKey& k : path.keys) EXPECT_EQ(path.at(k.time_s).pose.position_m, k.pose.position_m);
    // Between the keys of one rotation nothing turns.
    const glm::dquat between = path.at(next + 1.0).pose.orientation;
    EXPECT_NEAR(std::abs(glm::dot(between, path.keys[1].pose.orientation)), 1.0, 1e-6);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(), 1e308, -1e308})
      EXPECT_TRUE(sound(path.at(bad)));
  }
  EXPECT_TRUE(std::isfinite(CameraPath{}.at(1.0).scene_time_s));
  const ViewAngles half = angles_from_orientation(orientation_from_angles({180.0, 90.0, 0.0}));
  EXPECT_TRUE(std::isfinite(half.yaw_deg + half.pitch_deg + half.roll_deg));
}

}  // namespace
}  // namespace seascape
