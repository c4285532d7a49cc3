// Hands in the picture: where they are, behind what is nearer, in each shape of the frame. Controls are named beside
// each test; each was seen to fail.
#include <gtest/gtest.h>

#include <string>

#include "engine/multiview_check.h"
#include "tests/support/gpu/frame_shapes.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using test::ShotOptions;

class HandsDrawn : public test::GpuTest {};

constexpr int width = 120, height = 120;
constexpr double time_s = 4.0;
const Pose head = pose({0.0, 3.0, 0.0}, 0.0, -30.0);

using Shape = test::FrameLook;
const auto& shapes = test::frame_looks;

ShotOptions options(const Shape& shape, bool hands = true) {
  ShotOptions o{.scene = "calm", .preset = "low", .width = width, .height = height, .views = 2};
  o.hands = hands;
  o.per_eye = !multiview_works(test::device(), test::shaders());
  o.set = shape.set;
  for (const auto& [key, value] : {std::pair("waves.resolution", "32"), {"waves.cascades", "2"}})
    o.set.emplace_back(key, value);
  return o;
}

Viewpoint eyes(const Pose& of = head) {
  Viewpoint viewpoint{of, stereo_views(of, {-1.0, 1.0, 1.0, -1.0}, 0.2), 0.0};
  viewpoint.pixels_per_radian = pixels_per_radian(viewpoint.eyes, height);
  return viewpoint;
}

// A hand so far before a head and below its line of sight.
ShownHand hand(double ahead_m, double below_m = 0.0, const Pose& of = head) {
  return {
      {of.position_m + of.orientation * glm::dvec3(0.0, 0.0, -ahead_m) - glm::dvec3(0.0, below_m, 0.0), of.orientation},
      true,
      0.3};
}

// Where a place of the world lies in an eye's picture.
glm::dvec2 pixel_of(const View& eye, const glm::dvec3& place_m) {
  const glm::dvec3 at = glm::conjugate(eye.pose.orientation) * (place_m - eye.pose.position_m);
  return {width * (at.x / -at.z - eye.fov.left) / (eye.fov.right - eye.fov.left),
          height * (eye.fov.up - at.y / -at.z) / (eye.fov.up - eye.fov.down)};
}

struct Changed {
  int pixels = 0;
  glm::dvec2 middle{0.0};
};
Changed changed(const Image8& a, const Image8& b) {
  Changed found;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::size_t i = std::size_t(y * a.width + x) * 4;
      if (std::abs(a.pixels[i] - b.pixels[i]) + std::abs(a.pixels[i + 2] - b.pixels[i + 2]) < 12) continue;
      ++found.pixels;
      found.middle += glm::dvec2(x + 0.5, y + 0.5);
    }
  found.middle /= std::max(found.pixels, 1);
  return found;
}

// Controls: limbs relative to the world's origin; both eyes drawn from the left one.
TEST_F(HandsDrawn, StandWhereTheyAreInBothEyes) {
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.name);
    SeaShot shot(options(shape));
    const std::vector<Image8> without = shot.pictures(eyes(), time_s);
    const ShownHand shown = hand(0.5);
    shot.experience().show_hands({shown});
    const std::vector<Image8> with = shot.pictures(eyes(), time_s);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const Changed found = changed(with[eye], without[eye]);
      EXPECT_GT(found.pixels, 100) << eye;
      EXPECT_LT(found.pixels, 1200) << eye;
      EXPECT_LT(glm::distance(found.middle, pixel_of(eyes().eyes[eye], shown.pose.position_m)), 8.0) << eye;
    }
  }
}

// Control: without the question of the sea's depth; without the pass's own.
TEST_F(HandsDrawn, AreHiddenByTheSea) {
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.name);
    SeaShot shot(options(shape));
    const Pose low = pose({0.0, 0.8, 0.0}, 0.0, -30.0);
    const std::vector<Image8> without = shot.pictures(eyes(low), time_s);
    shot.experience().show_hands({hand(1.4, 0.5, low)});  // well under water
    EXPECT_EQ(shot.pictures(eyes(low), time_s)[0].pixels, without[0].pixels);
    shot.experience().show_hands({hand(1.4, -0.1, low)});  // over it
    EXPECT_GT(changed(shot.pictures(eyes(low), time_s)[0], without[0]).pixels, 10);
  }
}

// Control: a draw of no limbs.
TEST_F(HandsDrawn, CostNothingWhereThereIsNone) {
  SeaShot with(options(shapes[0])), without(options(shapes[0], false));
  with.draw(eyes(), time_s);
  without.draw(eyes(), time_s);
  EXPECT_EQ(with.counts().hash, without.counts().hash);
  with.experience().show_hands({hand(0.5)});
  with.draw(eyes(), time_s);
  const std::uint64_t passes = with.experience().options().per_eye ? 2 : 1;
  EXPECT_EQ(with.counts().draws, without.counts().draws + passes);
}

// Control: the view of gl_ViewIndex in a pass an eye.
TEST_F(HandsDrawn, AreTheSameInOnePassAndInTwo) {
  if (!multiview_works(test::device(), test::shaders())) GTEST_SKIP() << "the driver draws multiview wrongly";
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.name);
    ShotOptions two = options(shape);
    two.per_eye = true;
    SeaShot one_pass(options(shape)), two_passes(two);
    for (SeaShot* shot : {&one_pass, &two_passes}) shot->experience().show_hands({hand(0.5), hand(0.7, 0.1)});
    const auto a = one_pass.pictures(eyes(), time_s), b = two_passes.pictures(eyes(), time_s);
    for (std::size_t eye = 0; eye < 2; ++eye) EXPECT_EQ(a[eye].pixels, b[eye].pixels) << eye;
  }
}

}  // namespace
}  // namespace seascape
