// Levers of adaptive quality as they are drawn: what a move makes, what the eye sees of it, and what bodies feel.
#include "app/adaptive/live_levers.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "app/frame.h"
#include "app/lab/flip.h"
#include "app/lab/screen_error.h"
#include "tests/support/allocations.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"

namespace seascape {

namespace {

using test::AllocationCounter;
using test::SeaShot;

class LiveLeversDrawn : public test::GpuTest {};

void take(SeaShot& shot, glm::uvec2 size, const DrawnQuality& quality) {
  const auto scaled = [&](std::uint32_t side) { return std::uint32_t(std::lround(side * quality.scale)); };
  shot.experience().resize(scaled(size.x), scaled(size.y), size);
  shot.experience().draw_at(quality);
}

LeverLevels random_levels(std::span<const Lever> levers, std::mt19937& random) {
  LeverLevels chosen{};
  for (std::size_t i = 0; i < levers.size(); ++i) chosen[i] = std::uint8_t(random() % levers[i].steps.size());
  return chosen;
}

// 10,000 moves of all levers at once (a sample of them, without --long), in both shapes of the frame: no object of the
// GPU is made, pipelines among them, none is left over, and at the finest levels the picture is what it was, to the
// bit. Control seen: room for the picture that follows its size.
TEST_F(LiveLeversDrawn, MovesMakeNothingAndLeaveNothing) {
  constexpr glm::uvec2 size{48, 40};
  const std::vector<Lever> levers = live_levers({.models = true, .spray = true});
  for (const char* preset : {"low", "high"}) {
    SeaShot shot({.scene = "storm",
                  .preset = preset,
                  .width = size.x,
                  .height = size.y,
                  .views = 2,
                  .most_width = size.x,
                  .most_height = size.y,
                  .set = {{"waves.resolution", "32"}, {"lod.patch_quads", "16"}}});
    const Pose head = shot.scene().start;
    const std::vector<Image8> before = shot.pictures(head, 14.0);
    const std::uint64_t made = test::device().objects_made();
    const std::size_t objects = test::device().objects().size();
    std::mt19937 random(3);
    const int moves = test::long_run() ? 5000 : 400;
    for (int i = 0; i < moves; ++i) {
      take(shot, size, drawn_quality(levers, random_levels(levers, random)));
      Frame& frame = shot.experience().frame();
      frame.begin();
      draw_frame(shot.experience(), frame, shot.viewpoint(head), 14.0);
      frame.submit();
    }
    EXPECT_EQ(test::device().objects_made(), made) << preset;
    take(shot, size, {});
    const std::vector<Image8> after = shot.pictures(head, 14.0);
    test::device().wait_idle();
    EXPECT_EQ(test::device().objects().size(), objects) << preset;
    for (std::size_t eye = 0; eye < 2; ++eye) EXPECT_EQ(before[eye].pixels, after[eye].pixels) << preset << " " << eye;
  }
}

// Of the heap neither, once every level was there. Control seen: a vector made in Ocean::select() for each lever.
TEST(LiveLeversHeap, MovesAllocateNothing) {
  constexpr glm::uvec2 size{48, 40};
  Device device{DeviceOptions{}};
  const std::vector<Lever> levers = live_levers({.models = true, .spray = true});
  SeaShot shot(device, {.scene = "storm",
                        .preset = "medium",
                        .width = size.x,
                        .height = size.y,
                        .views = 2,
                        .most_width = size.x,
                        .most_height = size.y,
                        .set = {{"waves.resolution", "32"}, {"lod.patch_quads", "16"}}});
  const Viewpoint viewpoint = shot.viewpoint(shot.scene().start);
  std::mt19937 random(4);
  Frame& frame = shot.experience().frame();
  for (int i = 0; i < 140; ++i) {
    const DrawnQuality quality = i < 8 ? DrawnQuality{} : drawn_quality(levers, random_levels(levers, random));
    const AllocationCounter counter;
    take(shot, size, quality);
    frame.begin();
    draw_frame(shot.experience(), frame, viewpoint, 14.0);
    frame.submit();
    if (i < 20) continue;
    EXPECT_EQ(counter.ours(), 0u) << i;
  }
  frame.finish();
  device.wait_idle();
}

// Pictures of a headset's pixels, before and after a move: they differ less than when the head turns by 0.2 degrees, in
// the mean of all pixels and in the worst of them. Moves of one step, at both ends of each lever, or all of them with
// --long; and no more than twice as much where all levers go through their whole range in one frame. Control seen: a
// turn of 0.002 degrees.
TEST_F(LiveLeversDrawn, AMoveIsSeenLessThanATurnOfTheHead) {
  constexpr std::uint32_t side = 192;
  const double pixels_a_degree =
      glm::radians(1.0) * 0.5 * headset_height_px / std::tan(0.5 * glm::radians(headset_fov_deg));
  const double fov_deg =
      glm::degrees(2.0 * std::atan(side / headset_height_px * std::tan(0.5 * glm::radians(headset_fov_deg))));
  for (const char* name : {"open_sea", "storm", "harbour"}) {
    SeaShot shot({.scene = name,
                  .preset = "medium",
                  .width = side,
                  .height = side,
                  .most_width = side,
                  .most_height = side,
                  .set = {{"camera.vertical_fov_deg", std::to_string(fov_deg)}, {"msaa", "1"}}});
    const Pose head = shot.scene().start;
    Pose turned = head;
    turned.orientation = glm::angleAxis(glm::radians(0.2), glm::dvec3(0.0, 1.0, 0.0)) * head.orientation;
    const auto picture = [&](const Pose& from, const DrawnQuality& quality) {
      take(shot, {side, side}, quality);
      return stretched(shot.picture(from, 14.0), side, side);
    };
    const FlipError turn = flip_error(picture(turned, {}), picture(head, {}), pixels_a_degree);
    const std::vector<Lever> levers =
        live_levers({.models = shot.experience().solids() != nullptr, .spray = shot.experience().spray() != nullptr});
    LeverLevels last{};
    const auto compare = [&](const LeverLevels& from, const LeverLevels& to, const std::string& what) {
      const FlipError move = flip_error(picture(head, drawn_quality(levers, to)),
                                        picture(head, drawn_quality(levers, from)), pixels_a_degree);
      EXPECT_LE(move.mean, turn.mean) << name << ", " << what;
      EXPECT_LE(move.worst, turn.worst) << name << ", " << what;
      std::printf("%s, %s: mean %.4f, worst %.3f; a turn of 0.2 degrees: %.4f, %.3f\n", name, what.c_str(), move.mean,
                  move.worst, turn.mean, turn.worst);
    };
    for (std::size_t i = 0; i < levers.size(); ++i) {
      const auto steps = std::uint8_t(levers[i].steps.size());
      last[i] = std::uint8_t(steps - 1);
      for (std::uint8_t to = 1; to < steps; to = std::uint8_t(test::long_run() || to == 1 ? to + 1 : steps - 1)) {
        LeverLevels a{}, b{};
        a[i] = std::uint8_t(to - 1), b[i] = to;
        compare(a, b, std::string(levers[i].name) + " " + std::to_string(to));
        if (to == steps - 1) break;
      }
    }
    // A jump of the load moves all of them at once, for a late frame is worse: 1.1 degrees at 100 degrees a second.
    const FlipError jump = flip_error(picture(head, drawn_quality(levers, last)), picture(head, {}), pixels_a_degree);
    EXPECT_LE(jump.mean, 2.0 * turn.mean) << name;
    std::printf("%s, all levers: mean %.4f\n", name, jump.mean);
  }
}

// What bodies do is the same to the bit, whatever the picture is drawn at. Control seen: the sea advanced further the
// coarser the mesh.
TEST_F(LiveLeversDrawn, BodiesFeelNothing) {
  constexpr glm::uvec2 size{48, 40};
  const auto shot_of = [&] {
    return SeaShot({.scene = "harbour",
                    .preset = "low",
                    .width = size.x,
                    .height = size.y,
                    .most_width = size.x,
                    .most_height = size.y,
                    .set = {{"waves.resolution", "64"}, {"lod.patch_quads", "16"}, {"models.shadow_texels", "0"}}});
  };
  SeaShot held = shot_of(), moved = shot_of();
  const std::vector<Lever> levers = live_levers({.models = true});
  std::mt19937 random(5);
  const Pose head = held.scene().start;
  ASSERT_NE(held.experience().bodies(), nullptr);
  ASSERT_GT(held.experience().bodies()->size(), 1u);
  for (int i = 0; i < (test::long_run() ? 40 : 16); ++i) {
    const double time_s = 10.0 + i / 20.0;
    held.draw(head, time_s);
    take(moved, size, drawn_quality(levers, random_levels(levers, random)));
    moved.draw(head, time_s);
    for (std::size_t body = 0; body < held.experience().bodies()->size(); ++body) {
      const Pose a = held.experience().bodies()->pose_at(body, time_s),
                 b = moved.experience().bodies()->pose_at(body, time_s);
      ASSERT_EQ(a.position_m, b.position_m) << body << " in frame " << i;
      ASSERT_EQ(a.orientation, b.orientation) << body << " in frame " << i;
    }
  }
}

}  // namespace

}  // namespace seascape
