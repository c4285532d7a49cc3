// The camera of explore and the recording of its path. Controls are named beside each test; each was seen to fail.
#include "app/explore_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/camera_path.h"
#include "app/path_recorder.h"

namespace seascape {
namespace {

Pose pose_at(double height_m, const ViewAngles& angles = {}) {
  return {{0.0, height_m, 0.0}, orientation_from_angles(angles)};
}

CameraWish push(double right, double up, double forward) {
  CameraWish wish;
  wish.move = {right, up, forward};
  return wish;
}

glm::dvec3 after(int steps, double seconds, const CameraWish& wish, Travel travel = Travel::fly,
                 double height_m = 50.0) {
  ExploreCamera camera(pose_at(height_m, {30.0, -10.0, 0.0}));
  camera.set_travel(travel);
  for (int i = 0; i < steps; ++i) camera.step(wish, seconds / steps, 0.4);
  return camera.pose().position_m;
}

// Control: a velocity that decays by 1 - response * dt instead of the exponential fails here.
TEST(ExploreCamera, MovementDoesNotDependOnTheFrameRate) {
  for (const Travel travel : {Travel::fly, Travel::walk, Travel::ride}) {
    const CameraWish wish = push(0.5, 0.3, 1.0);
    const glm::dvec3 slow = after(4, 2.0, wish, travel), fast = after(288, 2.0, wish, travel);
    EXPECT_LT(glm::length(slow - fast), 1e-9) << travel_name(travel);
    EXPECT_GT(glm::length(glm::dvec2(slow.x, slow.z)), 1.0);
  }
}

// Control: without the division by the push's length the diagonal is farther.
TEST(ExploreCamera, TwoKeysAreNoFasterThanOne) {
  const glm::dvec3 start(0.0, 50.0, 0.0);
  const double one = glm::length(after(60, 3.0, push(0, 0, 1)) - start),
               three = glm::length(after(60, 3.0, push(1, 1, 1)) - start);
  EXPECT_NEAR(one, three, 1e-9);
  EXPECT_NEAR(one, 12.0 * (3.0 - 1.0 / 8.0), 0.01);  // 12 m/s, less the lag of the start
}

// Controls: the velocity kept; the height of what it left.
TEST(ExploreCamera, JumpsToStandAsItTravels) {
  for (const Travel travel : {Travel::fly, Travel::walk, Travel::ride}) {
    ExploreCamera camera(pose_at(50.0, {30.0, -10.0, 0.0}));
    camera.set_travel(travel);
    camera.step(push(0, 0, 1), 1.0, 0.4);
    camera.jump({100.0, -20.0}, 0.4);
    const double height_m = travel == Travel::fly    ? 0.4 + ExploreCamera::deck_height_m
                            : travel == Travel::walk ? ExploreCamera::deck_height_m
                                                     : 0.4 + ExploreCamera::ride_height_m;
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(glm::length(camera.pose().position_m - glm::dvec3(100.0, height_m, -20.0)), 1e-12);
      camera.step({}, 0.1, 0.4);
    }
    EXPECT_NEAR(camera.yaw_deg(), 30.0, 1e-9);
  }
}

// Control: a push along +z for W fails here.
TEST(ExploreCamera, KeysPushWhereTheViewLooks) {
  ExploreCamera camera(pose_at(50.0, {90.0, 30.0, 0.0}));  // to +x and up
  camera.step(push(0, 0, 1), 1.0, 0.0);
  const glm::dvec3 gone = camera.pose().position_m - glm::dvec3(0.0, 50.0, 0.0);
  EXPECT_GT(gone.x, 5.0);
  EXPECT_NEAR(gone.y / gone.x, std::tan(glm::radians(30.0)), 1e-9);
  EXPECT_NEAR(gone.z, 0.0, 1e-9);
  ExploreCamera sideways(pose_at(50.0));
  sideways.step(push(1, 0, 0), 1.0, 0.0);
  EXPECT_GT(sideways.pose().position_m.x, 5.0);
}

// Control: without the clamp the view turns over.
TEST(ExploreCamera, LooksNeitherOverTheTopNorBeyond) {
  ExploreCamera camera(pose_at(5.0));
  CameraWish wish;
  wish.turn_deg = {0.0, 400.0};
  camera.step(wish, 0.01, 0.0);
  EXPECT_DOUBLE_EQ(camera.pitch_deg(), 89.0);
  wish.turn_deg = {0.0, -1000.0};
  camera.step(wish, 0.01, 0.0);
  EXPECT_DOUBLE_EQ(camera.pitch_deg(), -89.0);
  wish.turn_deg = {350.0, 0.0};
  camera.step(wish, 0.01, 0.0);
  EXPECT_NEAR(camera.yaw_deg(), -10.0, 1e-9);
}

// Control: a pose whose roll takes a ten thousandth of each turn fails here.
TEST(ExploreCamera, TheHorizonStaysLevel) {
  ExploreCamera camera(pose_at(5.0, {10.0, 5.0, 20.0}));  // a rolled start is put right
  std::mt19937 random(7);
  std::uniform_real_distribution<double> turn(-15.0, 15.0);
  for (int i = 0; i < 100'000; ++i) {
    CameraWish wish;
    wish.turn_deg = {turn(random), turn(random)};
    camera.step(wish, 0.01, 0.0);
    ASSERT_NEAR((camera.pose().orientation * glm::dvec3(1, 0, 0)).y, 0.0, 1e-12);
    ASSERT_GT((camera.pose().orientation * glm::dvec3(0, 1, 0)).y, 0.0);
  }
}

// Controls: a ride without the water's height and a walk with it each fail here.
TEST(ExploreCamera, WalkStaysOnDeckAndRideFollowsTheWater) {
  ExploreCamera camera(pose_at(20.0));
  camera.set_travel(Travel::walk);
  camera.step({}, 0.01, 0.0);
  EXPECT_GT(camera.pose().position_m.y, 15.0);  // no jump
  for (int i = 0; i < 600; ++i) camera.step(push(0, 1, 0), 0.01, 0.5 * std::sin(0.01 * i));
  EXPECT_NEAR(camera.pose().position_m.y, 1.7, 1e-6);
  camera.set_travel(Travel::ride);
  for (int i = 0; i < 600; ++i) camera.step({}, 0.01, 2.0);
  EXPECT_NEAR(camera.pose().position_m.y, 3.2, 1e-6);
  camera.step({}, 0.01, 2.5);
  EXPECT_NEAR(camera.pose().position_m.y, 3.7, 1e-6);
}

CameraWish swimming(const glm::dvec2& mps, double dt_s, std::optional<double> head_m = std::nullopt) {
  CameraWish wish;
  const glm::dvec3 along(mps.x, 0.0, mps.y);
  wish.swum = CameraWish::Swum{along * dt_s, along};
  if (head_m) wish.head = Pose{{0.1, *head_m, 0.2}};
  return wish;
}

// The eyes come down to just above the waves and follow them, and afterwards go back to where one travels: who flies to
// the height that he had, however time is cut and while he flies on. Controls: who flies left at the water; the climb
// not times the frame's length; the water's height of the first frame kept.
TEST(ExploreCamera, ASwimmerFollowsTheWavesAndClimbsBack) {
  for (const Travel travel : {Travel::fly, Travel::walk, Travel::ride}) {
    SCOPED_TRACE(travel_name(travel));
    ExploreCamera camera(pose_at(20.0));
    camera.set_travel(travel);
    for (int i = 0; i < 500; ++i) camera.step({}, 0.01, 0.4);
    const double before_m = camera.pose().position_m.y;
    camera.step(swimming({0.0, 0.0}, 0.01), 0.01, 0.4);
    EXPECT_LT(std::abs(camera.pose().position_m.y - before_m), 1.0);  // no jump
    for (int i = 0; i < 600; ++i) camera.step(swimming({1.0, -2.0}, 0.01), 0.01, 0.4 + 0.3 * std::sin(0.02 * i));
    const double water_m = 0.4 + 0.3 * std::sin(0.02 * 599);
    EXPECT_NEAR(camera.pose().position_m.y, water_m + ExploreCamera::swim_height_m, 1e-6);
    EXPECT_NEAR(camera.pose().position_m.x, 6.0, 1e-9);
    EXPECT_NEAR(camera.pose().position_m.z, -12.0, 1e-9);
    EXPECT_EQ(camera.velocity_mps(), glm::dvec3(1.0, 0.0, -2.0));
    for (int i = 0; i < 500; ++i) camera.step({}, 0.01, 0.4);
    EXPECT_NEAR(camera.pose().position_m.y, before_m, 1e-3);
  }
  const auto height_after = [](int steps) {
    ExploreCamera camera(pose_at(20.0));
    for (int i = 0; i < 1000; ++i) camera.step(swimming({0.0, 0.0}, 0.01), 0.01, 0.0);
    for (int i = 0; i < steps; ++i) camera.step(push(0, 1, 0), 0.5 / steps, 0.0);
    return camera.pose().position_m.y;
  };
  EXPECT_NEAR(height_after(2), height_after(100), 1e-9);
  EXPECT_GT(height_after(2), 15.0);
}

// The head that is worn may be raised, and lowered to the water and no further, wherever it was as one began.
// Controls: the height over the floor taken for that of a person who stands; without swim_clearance_m.
TEST(ExploreCamera, ASwimmersHeadMovesAndStaysDry) {
  for (const double began_m : {1.1, 1.7, 1.9}) {
    ExploreCamera camera(pose_at(3.0));
    const auto eyes_m = [&](double head_m) {
      return composed(camera.carrier(), Pose{{0.1, head_m, 0.2}}).position_m.y;
    };
    for (int i = 0; i < 600; ++i) camera.step(swimming({0.0, 0.0}, 0.01, began_m), 0.01, 0.4);
    EXPECT_NEAR(eyes_m(began_m), 0.4 + ExploreCamera::swim_height_m, 1e-6) << began_m;
    camera.step(swimming({0.0, 0.0}, 0.01, began_m + 0.2), 0.01, 0.4);
    EXPECT_NEAR(eyes_m(began_m + 0.2), 0.4 + ExploreCamera::swim_height_m + 0.2, 1e-6) << began_m;
    camera.step(swimming({0.0, 0.0}, 0.01, began_m - 0.5), 0.01, 0.4);
    EXPECT_NEAR(eyes_m(began_m - 0.5), 0.4 + ExploreCamera::swim_clearance_m, 1e-6) << began_m;
  }
}

// Control: the flight's height of before the jump kept.
TEST(ExploreCamera, ASwimmerWhoJumpsStaysThere) {
  ExploreCamera camera(pose_at(30.0));
  for (int i = 0; i < 600; ++i) camera.step(swimming({0.0, 0.0}, 0.01), 0.01, 0.4);
  camera.jump({50.0, 60.0}, 0.4);
  for (int i = 0; i < 600; ++i) camera.step(swimming({0.0, 0.0}, 0.01), 0.01, 0.4);
  EXPECT_NEAR(camera.pose().position_m.y, 0.4 + ExploreCamera::swim_height_m, 1e-6);
  for (int i = 0; i < 600; ++i) camera.step({}, 0.01, 0.4);
  EXPECT_NEAR(camera.pose().position_m.y, 0.4 + ExploreCamera::deck_height_m, 1e-6);
}

// Control: without the clearance the fall goes on below the water.
TEST(ExploreCamera, StaysAboveTheWater) {
  ExploreCamera camera(pose_at(5.0));
  for (int i = 0; i < 300; ++i) camera.step(push(0, -1, 0), 0.01, 1.5);
  EXPECT_NEAR(camera.pose().position_m.y, 1.8, 1e-9);
  camera.set_travel(Travel::walk);
  for (int i = 0; i < 300; ++i) camera.step({}, 0.01, 6.0);  // a crest over the deck
  EXPECT_NEAR(camera.pose().position_m.y, 6.3, 1e-9);
}

// Control: without the limits it fails here.
TEST(ExploreCamera, TheWheelChangesTheSpeedWithinLimits) {
  ExploreCamera camera(pose_at(5.0));
  CameraWish wish;
  wish.faster_notches = 3.0;
  camera.step(wish, 0.0, 0.0);
  EXPECT_NEAR(camera.speed_mps(), 12.0 * 1.2 * 1.2 * 1.2, 1e-9);
  wish.faster_notches = 1e3;
  camera.step(wish, 0.0, 0.0);
  EXPECT_NEAR(camera.speed_mps(), 2400.0, 1e-9);
  wish.faster_notches = -1e3;
  camera.step(wish, 0.0, 0.0);
  EXPECT_NEAR(camera.speed_mps(), 0.6, 1e-9);
}

// Who flies may dive to the ground where the scene lets him, and is held above the water where it does not; who walks
// or rides stays where he is carried.
TEST(ExploreCamera, DivesToTheGroundWhereItMay) {
  CameraWish down;
  down.move.y = -1.0;
  ExploreCamera dry(Pose{{0.0, 3.0, 0.0}}), diver(Pose{{0.0, 3.0, 0.0}}), rider(Pose{{0.0, 3.0, 0.0}});
  CameraWish dive = down;
  dive.dives_to_m = -6.0;
  rider.set_travel(Travel::ride);
  for (int i = 0; i < 400; ++i) {
    dry.step(down, 0.01, 0.2);
    diver.step(dive, 0.01, 0.2);
    rider.step(dive, 0.01, 0.2);
  }
  EXPECT_NEAR(dry.pose().position_m.y, 0.2 + ExploreCamera::clearance_m, 1e-9);
  EXPECT_TRUE(dry.held());
  EXPECT_NEAR(diver.pose().position_m.y, -6.0 + ExploreCamera::clearance_m, 1e-9);
  EXPECT_TRUE(diver.held());
  EXPECT_NEAR(rider.pose().position_m.y, 0.2 + ExploreCamera::ride_height_m, 1e-3);
  EXPECT_FALSE(rider.held());
  CameraWish up = dive;
  up.move.y = 1.0;
  diver.step(up, 0.5, 0.2);
  EXPECT_FALSE(diver.held());
}

// Under water who flies swims: at 1.5 m/s where he looks, and at a flight's speed again above it. Controls
// seen: the flight's speed under water; the view's pitch left out.
TEST(ExploreCamera, WhoFliesSwimsUnderWater) {
  CameraWish ahead;
  ahead.move.z = 1.0;
  ahead.dives_to_m = -60.0;
  ExploreCamera diver(Pose{{0.0, -5.0, 0.0}, orientation_from_angles({0.0, -30.0, 0.0})});
  for (int i = 0; i < 600; ++i) diver.step(ahead, 0.01, 0.0);
  const glm::dvec3 before_m = diver.pose().position_m;
  for (int i = 0; i < 100; ++i) diver.step(ahead, 0.01, 0.0);
  const glm::dvec3 moved_m = diver.pose().position_m - before_m;
  EXPECT_NEAR(glm::length(moved_m), ExploreCamera::under_water_mps, 1e-3);
  EXPECT_NEAR(moved_m.y, -0.5 * ExploreCamera::under_water_mps, 1e-3);
  ExploreCamera flier(Pose{{0.0, 50.0, 0.0}});
  for (int i = 0; i < 300; ++i) flier.step(ahead, 0.01, 0.0);
  EXPECT_NEAR(glm::length(flier.velocity_mps()), 12.0, 1e-3);
}

// A swimmer floats with his eyes 0.15 m above the felt water until he dives; then he swims as he is moved, rises and
// dives by keys, comes no lower than the ground, stays there when he lets go, and floats again once he is up. Where a
// scene has no water to dive into he floats on. Controls seen: a dive without a key; the way down left out;
// a climb to where he had flown.
TEST(ExploreCamera, ASwimmerFloatsUntilHeDives) {
  ExploreCamera camera(Pose{{0.0, 4.0, 0.0}});
  CameraWish wish = swimming({0.0, -1.0}, 0.01);
  wish.dives_to_m = -6.0;
  const auto swim = [&](double up, int steps, double water_m = 0.3) {
    wish.move.y = up;
    for (int i = 0; i < steps; ++i) camera.step(wish, 0.01, water_m);
    return camera.pose().position_m.y;
  };
  EXPECT_NEAR(swim(0.0, 500), 0.45, 1e-6);
  EXPECT_NEAR(swim(0.0, 200, 0.6), 0.75, 1e-3);
  EXPECT_FALSE(camera.dived());
  const double begins_m = swim(0.0, 500);
  EXPECT_NEAR(swim(-1.0, 200), begins_m - 2.0 * ExploreCamera::dives_mps, 1e-2);
  EXPECT_TRUE(camera.dived());
  const double deep_m = camera.pose().position_m.y;
  EXPECT_NEAR(swim(0.0, 100), deep_m, 1e-9) << "he stays as deep as he is";
  wish.swum = CameraWish::Swum{{0.0, -0.005, -0.005}, {0.0, -0.5, -0.5}};
  EXPECT_NEAR(swim(0.0, 100), deep_m - 0.5, 1e-9) << "he goes where he looks";
  wish.swum = CameraWish::Swum{};
  EXPECT_NEAR(swim(-1.0, 2000), -6.0 + ExploreCamera::clearance_m, 1e-9);
  CameraWish lets_go;
  lets_go.dives_to_m = -6.0;
  for (int i = 0; i < 300; ++i) camera.step(lets_go, 0.01, 0.3);
  EXPECT_NEAR(camera.pose().position_m.y, -6.0 + ExploreCamera::clearance_m, 0.2);
  EXPECT_NEAR(swim(1.0, 2000), 0.45, 1e-3) << "up again";
  EXPECT_FALSE(camera.dived());
  wish.dives_to_m.reset();
  EXPECT_NEAR(swim(-1.0, 500), 0.45, 1e-3) << "there is no diving here";
}

// Controls: keys with the clock's time instead of the path's, and no last key, each fail here.
TEST(PathRecorder, TakesAKeyEveryHalfSecondAndTheLastPose) {
  PathRecorder recorder;
  EXPECT_FALSE(recorder.recording());
  recorder.start(100.0, pose_at(0.0), 7.0);
  for (int i = 1; i <= 130; ++i) recorder.sample(100.0 + i / 100.0, pose_at(i), 7.0 + i / 50.0);
  EXPECT_TRUE(recorder.recording());
  const CameraPath path = recorder.stop(101.3, pose_at(130.0), 9.6, "walk");
  EXPECT_FALSE(recorder.recording());
  EXPECT_EQ(path.name, "walk");
  ASSERT_EQ(path.keys.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(path.keys[i].time_s, 0.5 * double(i), 0.011);
  EXPECT_NEAR(path.keys[3].time_s, 1.3, 1e-9);
  EXPECT_DOUBLE_EQ(path.keys[3].pose.position_m.y, 130.0);
  EXPECT_DOUBLE_EQ(path.keys[0].scene_time_s, 7.0);
  EXPECT_DOUBLE_EQ(path.keys[3].scene_time_s, 9.6);
  EXPECT_NO_THROW(parse_camera_path(camera_path_text(path), "recorded"));
}

// A path must have a key, and rising times, however short the recording was. Control: without the removal of a key just
// before the end there are two keys 1 ms apart.
TEST(PathRecorder, ShortRecordingsAreWhole) {
  PathRecorder recorder;
  recorder.start(5.0, pose_at(1.0), 0.0);
  EXPECT_EQ(recorder.stop(5.0, pose_at(1.0), 0.0, "moment").keys.size(), 1u);
  recorder.start(5.0, pose_at(1.0), 0.0);
  recorder.sample(5.5, pose_at(2.0), 0.5);
  const CameraPath path = recorder.stop(5.501, pose_at(3.0), 0.501, "half");
  ASSERT_EQ(path.keys.size(), 2u);
  EXPECT_DOUBLE_EQ(path.keys[1].pose.position_m.y, 3.0);
}

}  // namespace
}  // namespace seascape
