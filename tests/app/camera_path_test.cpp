// Camera paths: the curve, and the file.
#include "app/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>

#include "engine/error.h"

namespace seascape {
namespace {

PathKey key(double time_s, const glm::dvec3& position_m, const ViewAngles& angles = {}) {
  return {time_s, {position_m, orientation_from_angles(angles)}, time_s};
}

CameraPath winding() {
  CameraPath path;
  path.keys = {key(0, {0, 2, 0}), key(1, {3, 4, -8}, {40, -10, 5}), key(2.5, {10, 30, -20}, {170, -60, 0}),
               key(3, {11, 30, -21}, {-170, -88, 0}), key(7, {40, 3, -90}, {-100, 0, -20})};
  return path;
}

double angle_between(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat d = glm::conjugate(a) * b;
  return 2.0 * std::atan2(glm::length(glm::dvec3(d.x, d.y, d.z)), std::abs(d.w));
}

// rad/s about the world's axes.
glm::dvec3 turn_rate(const CameraPath& path, double from_s, double to_s) {
  glm::dquat d = path.at(to_s).pose.orientation * glm::conjugate(path.at(from_s).pose.orientation);
  if (d.w < 0.0) d = -d;
  return glm::dvec3(d.x, d.y, d.z) * (2.0 / (to_s - from_s));
}

// Control: an error of 1e-9 in position at the key (adding it in at()) fails here.
TEST(CameraPath, PassesThroughEveryKeyExactly) {
  const CameraPath path = winding();
  for (const PathKey& one : path.keys) {
    const PathSample sample = path.at(one.time_s);
    EXPECT_EQ(sample.pose.position_m, one.pose.position_m);
    EXPECT_EQ(sample.pose.orientation, one.pose.orientation);
    EXPECT_EQ(sample.scene_time_s, one.scene_time_s);
    for (const double near : {-1e-7, 1e-7}) {
      EXPECT_LT(glm::length(path.at(one.time_s + near).pose.position_m - one.pose.position_m), 1e-4);
      EXPECT_LT(angle_between(path.at(one.time_s + near).pose.orientation, one.pose.orientation), 1e-5);
    }
  }
}

// Control: velocities that differ on the two sides of a key (0.9 x velocity1 in at()) fail here.
TEST(CameraPath, VelocityAndTurnRateAreContinuous) {
  const CameraPath path = winding();
  const double h = 1e-5;
  for (const PathKey& one : path.keys) {
    const glm::dvec3 before = (path.at(one.time_s).pose.position_m - path.at(one.time_s - h).pose.position_m) / h;
    const glm::dvec3 after = (path.at(one.time_s + h).pose.position_m - path.at(one.time_s).pose.position_m) / h;
    EXPECT_LT(glm::length(before - after), 2e-2) << one.time_s;
    EXPECT_LT(glm::length(turn_rate(path, one.time_s - h, one.time_s) - turn_rate(path, one.time_s, one.time_s + h)),
              2e-3)
        << one.time_s;
  }
  glm::dvec3 last = (path.at(h).pose.position_m - path.at(0.0).pose.position_m) / h;
  for (double t = 1e-3; t < 7.0; t += 1e-3) {
    const glm::dvec3 velocity = (path.at(t + h).pose.position_m - path.at(t).pose.position_m) / h;
    ASSERT_LT(glm::length(velocity - last), 0.5) << t;
    last = velocity;
  }
}

// Control: extrapolating past the last key (dropping its early return) fails here.
TEST(CameraPath, BothEndsAreHeld) {
  const CameraPath path = winding();
  EXPECT_EQ(path.at(-5.0).pose.position_m, path.keys.front().pose.position_m);
  EXPECT_EQ(path.at(1e9).pose.position_m, path.keys.back().pose.position_m);
  EXPECT_EQ(path.at(7.5).pose.position_m, path.keys.back().pose.position_m);
  EXPECT_EQ(path.at(1e9).scene_time_s, 7.0);
  EXPECT_EQ(path.at(std::nan("")).pose.position_m, path.keys.front().pose.position_m);
  EXPECT_EQ(path.duration_s(), 7.0);
}

TEST(CameraPath, OneKeyIsAPlace) {
  CameraPath path;
  path.keys = {key(2.0, {1, 2, 3}, {10, 20, 30})};
  for (const double t : {-1.0, 2.0, 9.0}) {
    EXPECT_EQ(path.at(t).pose.position_m, glm::dvec3(1, 2, 3));
    EXPECT_EQ(path.at(t).pose.orientation, path.keys[0].pose.orientation);
  }
}

// Control: plain Catmull-Rom velocities (no bound in key_velocity) move on during the hold.
TEST(CameraPath, AHoldStaysStill) {
  CameraPath path;
  path.keys = {key(0, {0, 2, 0}), key(1, {10, 2, 0}, {90, 0, 0}), key(4, {10, 2, 0}, {90, 0, 0}), key(5, {10, 2, -9})};
  for (double t = 1.0; t <= 4.0; t += 0.01) {
    EXPECT_LT(glm::length(path.at(t).pose.position_m - glm::dvec3(10, 2, 0)), 1e-12) << t;
    EXPECT_LT(angle_between(path.at(t).pose.orientation, path.keys[1].pose.orientation), 1e-7) << t;
  }
}

// Control: key_velocity for the height as well dips to 4.7 m under the still sea here.
TEST(CameraPath, TheHeightStaysBetweenTheKeysHeights) {
  CameraPath path;
  path.keys = {key(0, {0, 3, 0}),    key(2, {8, 2, 0}),      key(4, {9, 2, -9}),    key(7, {0, 30, -20}),
               key(8, {0, 30, -30}), key(10, {4, 2.5, -60}), key(15, {4, 2.6, -90})};
  for (std::size_t i = 0; i + 1 < path.keys.size(); ++i) {
    const auto [low, high] = std::minmax(path.keys[i].pose.position_m.y, path.keys[i + 1].pose.position_m.y);
    for (double s = 0.0; s <= 1.0; s += 0.01) {
      const double t = path.keys[i].time_s + s * (path.keys[i + 1].time_s - path.keys[i].time_s);
      EXPECT_GE(path.at(t).pose.position_m.y, low - 1e-12) << t;
      EXPECT_LE(path.at(t).pose.position_m.y, high + 1e-12) << t;
    }
  }
}

// Control: velocities a segment instead of a second (v0 = velocity0 in at()) bend this line.
TEST(CameraPath, ASteadyFlightWithUnevenKeysIsSteadyBetweenItsEnds) {
  CameraPath path;
  for (const double t : {0.0, 1.0, 1.5, 4.0, 4.2, 9.0}) path.keys.push_back(key(t, {3.0 * t, 2, -t}, {10.0 * t, 0, 0}));
  for (double t = 1.0; t <= 4.2; t += 0.01) {
    EXPECT_LT(glm::length(path.at(t).pose.position_m - glm::dvec3(3.0 * t, 2, -t)), 1e-12);
    EXPECT_LT(angle_between(path.at(t).pose.orientation, orientation_from_angles({10.0 * t, 0, 0})), 1e-7);
  }
}

// Control: averaging two mean velocities without their durations in key_velocity misses this by half a metre.
TEST(CameraPath, AnEvenAccelerationIsReproducedBetweenItsEnds) {
  CameraPath path;
  for (const double t : {0.0, 3.0, 4.0, 7.0, 9.0, 10.0}) path.keys.push_back(key(t, {t * t, 2, 0}));
  for (double t = 3.0; t <= 9.0; t += 0.01)
    EXPECT_LT(glm::length(path.at(t).pose.position_m - glm::dvec3(t * t, 2, 0)), 1e-11) << t;
}

// Control: the long way round (no sign test in rotation_vector) turns through 0 here.
TEST(CameraPath, TurnsGoTheShortWay) {
  CameraPath path;
  path.keys = {key(0, {0, 2, 0}, {170, 0, 0}), key(1, {0, 2, 0}, {-170, 0, 0})};
  EXPECT_NEAR(std::abs(angles_from_orientation(path.at(0.5).pose.orientation).yaw_deg), 180.0, 1e-6);
}

// Control: keys' rates of plain Catmull-Rom run backwards in the slow segment.
TEST(CameraPath, SceneTimeIsMonotoneAndASteadyClockExact) {
  CameraPath path = winding();
  for (double t = 0.0; t <= 7.0; t += 0.003) EXPECT_NEAR(path.at(t).scene_time_s, t, 1e-12);
  const double scene_times[] = {0.0, 50.0, 50.1, 50.1, 51.0};
  for (std::size_t i = 0; i < 5; ++i) path.keys[i].scene_time_s = scene_times[i];
  double last = 0.0;
  for (double t = 0.0; t <= 7.0; t += 0.003) {
    const double now = path.at(t).scene_time_s;
    EXPECT_GE(now, last - 1e-12) << t;
    last = now;
  }
}

TEST(CameraPath, FarAndLateIsAsGoodAsNearAndEarly) {
  CameraPath near = winding(), far = winding();
  for (PathKey& one : far.keys) {
    one.time_s += 1e6;
    one.pose.position_m += glm::dvec3(1e6, 0, -1e6);
  }
  for (double t = 0.0; t <= 7.0; t += 0.125)
    EXPECT_LT(glm::length(far.at(1e6 + t).pose.position_m - glm::dvec3(1e6, 0, -1e6) - near.at(t).pose.position_m),
              1e-8);
}

TEST(CameraPath, AnglesAreClockwiseFromAboveAndReadBack) {
  const glm::dvec3 forward(0, 0, -1);
  EXPECT_LT(glm::length(orientation_from_angles({90, 0, 0}) * forward - glm::dvec3(1, 0, 0)), 1e-12);
  EXPECT_LT(glm::length(orientation_from_angles({0, 90, 0}) * forward - glm::dvec3(0, 1, 0)), 1e-12);
  EXPECT_GT((orientation_from_angles({0, 0, 90}) * glm::dvec3(0, 1, 0)).x, 0.999);  // the head's top goes to its right
  for (const double yaw : {-179.0, -30.0, 0.0, 95.0, 179.0})
    for (const double pitch : {-89.0, -20.0, 0.0, 60.0})
      for (const double roll : {-120.0, 0.0, 45.0}) {
        const ViewAngles back = angles_from_orientation(orientation_from_angles({yaw, pitch, roll}));
        EXPECT_NEAR(back.yaw_deg, yaw, 1e-9);
        EXPECT_NEAR(back.pitch_deg, pitch, 1e-9);
        EXPECT_NEAR(back.roll_deg, roll, 1e-9);
      }
  EXPECT_NEAR(angles_from_orientation(orientation_from_angles({35, -90, 0})).yaw_deg, 35.0, 1e-6);
}

// Control: writing six digits instead of the shortest exact text fails here.
TEST(CameraPathFile, ASavedPathReadsBackToTheBit) {
  CameraPath path = winding();
  path.keys[2].scene_time_s = 100.0 / 3.0;
  path.keys[3].pose.position_m = {1.0 / 3.0, 1e-7, 123456.789};
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "walk.json";
  save_camera_path(path, file);
  const CameraPath back = load_camera_path(file.string());
  EXPECT_EQ(back.name, "walk");
  ASSERT_EQ(back.keys.size(), path.keys.size());
  for (std::size_t i = 0; i < path.keys.size(); ++i) {
    EXPECT_EQ(back.keys[i].time_s, path.keys[i].time_s);
    EXPECT_EQ(back.keys[i].scene_time_s, path.keys[i].scene_time_s);
    EXPECT_EQ(back.keys[i].pose.position_m, path.keys[i].pose.position_m);
    EXPECT_EQ(back.keys[i].pose.orientation, path.keys[i].pose.orientation);
  }
}

// Control seen: a key that takes the place of one whose time is out of range, as 0, is told not to come after it.
TEST(CameraPathFile, ATimeOutOfRangeIsOneFault) {
  const std::string keys = R"({"time_s": 5, "position_m": [0, 1, 0]}, {"time_s": -5, "position_m": [0, 1, 0]},
    {"time_s": "x", "position_m": [0, 1, 0]}, {"time_s": 1e10, "position_m": [0, 1, 0]},
    {"time_s": 6, "position_m": [0, 1, 0]}, {"time_s": 6, "position_m": [0, 1, 0]})";
  Faults faults(true);
  (void)parse_camera_path(R"({"version": 1, "keys": [)" + keys + "]}", "p.json", faults);
  std::vector<std::string> told;
  for (const Error& fault : faults.list()) told.push_back(fault.fault());
  EXPECT_EQ(told, (std::vector<std::string>{"keys[1].time_s: -5 is out of range", "keys[2].time_s: 'x' is not a number",
                                            "keys[3].time_s: 10000000000 is out of range",
                                            "keys[5].time_s: 6 does not come after 6 of the key before"}));
}

TEST(CameraPathFile, FaultsNamePlaceKeyValueAndRemedy) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"version": 1})",
       "p.json:1: the key 'keys' is missing; add "
       "\"keys\": [{\"time_s\": 0, \"position_m\": [0, 1.7, 0]}, ...]"},
      {R"({"version": 1, "keys": []})", "p.json:1: keys: a list of 0; give a list of 1 to 100000 keys"},
      {"{\"version\": 1, \"keys\": [\n{\"position_m\": [0, 1, 0]}]}",
       "p.json:2: the key 'keys[0].time_s' is missing; add \"time_s\": a number from 0 to 1000000000 s"},
      {"{\"version\": 1, \"keys\": [\n{\"time_s\": 1, \"position_m\": [0, 1, 0]},\n{\"time_s\": 1, \"position_m\": [0, "
       "1, 0]}]}",
       "p.json:3: keys[1].time_s: 1 does not come after 1 of the key before; order the keys by rising time_s"},
      {R"({"version": 1, "keys": [{"time_s": 0, "position_m": [0, 1, 0], "orientation": [0, 0, 0, 0.5]}]})",
       "p.json:1: keys[0].orientation: its length is 0.5, not 1; give a unit quaternion [x, y, z, w]"},
      {R"({"version": 1, "keys": [{"time_s": 0, "position_m": [0, 1, 0], "orientation": [0, 0, 0, 1], "yaw_deg": 3}]})",
       "p.json:1: keys[0].yaw_deg and keys[0].orientation are both given; keep one of the two"},
      {R"({"version": 1, "keys": [{"time_s": 0, "position_m": [0, 1, 0], "yaw": 3}]})",
       "p.json:1: unknown key 'keys[0].yaw' (did you mean 'yaw_deg'?); remove it, or take one of: time_s, "
       "scene_time_s, "
       "position_m, orientation, yaw_deg, pitch_deg and roll_deg"},
      {R"({"version": 1, "keys": [{"time_s": -1, "position_m": [0, 1, 0]}]})",
       "p.json:1: keys[0].time_s: -1 is out of range; give a number from 0 to 1000000000 s"},
  };
  for (const auto& [text, message] : cases) {
    try {
      parse_camera_path(text, "p.json");
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), message);
    }
  }
}

}  // namespace
}  // namespace seascape
