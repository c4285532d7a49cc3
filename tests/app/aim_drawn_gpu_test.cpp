// The mark where a teleport aims, in the picture: where it is, behind what is nearer, by day and by night, in each
// shape of the frame. Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "app/frame.h"
#include "engine/multiview_check.h"
#include "tests/support/gpu/frame_shapes.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using test::ShotOptions;

class AimDrawn : public test::GpuTest {};

constexpr int width = 160, height = 160;
constexpr double time_s = 4.0;
const Pose head = pose({0.0, 2.0, 0.0}, 0.0, -25.0);

ShotOptions options(const test::FrameLook& shape, bool hands = true) {
  ShotOptions o{.scene = "calm", .preset = "low", .width = width, .height = height, .views = 2};
  o.hands = hands;
  o.per_eye = !multiview_works(test::device(), test::shaders());
  o.set = shape.set;
  for (const auto& [key, value] : {std::pair("waves.resolution", "32"), {"waves.cascades", "2"}})
    o.set.emplace_back(key, value);
  return o;
}

Viewpoint eyes() {
  Viewpoint viewpoint{head, stereo_views(head, {-0.6, 0.6, 0.6, -0.6}, 0.2), 0.0};
  viewpoint.pixels_per_radian = pixels_per_radian(viewpoint.eyes, height);
  return viewpoint;
}

// On the water of that moment, so far ahead.
ShownAim aim_at(SeaShot& shot, double ahead_m, double raised_m = 0.0) {
  shot.draw(eyes(), time_s);
  const SeaView water = shot.experience().sea()->view_at(time_s, SeaDetail::felt);
  ShownAim aim;
  aim.from_m = glm::dvec3(0.25, 1.5, -0.4);
  aim.found = true;
  aim.to_m = {0.0, water.query({0.0, -ahead_m}).height_m + raised_m, -ahead_m};
  for (std::size_t i = 0; i < ShownAim::sides; ++i)
    aim.water_m[i] = water.query(aim_corner(aim.to_m, i)).height_m + 1.5 * water.left_out_m() + raised_m;
  return aim;
}

// Where a place of the world lies in an eye's picture.
glm::dvec2 pixel_of(const View& eye, const glm::dvec3& place_m) {
  const glm::dvec3 at = glm::conjugate(eye.pose.orientation) * (place_m - eye.pose.position_m);
  return {width * (at.x / -at.z - eye.fov.left) / (eye.fov.right - eye.fov.left),
          height * (eye.fov.up - at.y / -at.z) / (eye.fov.up - eye.fov.down)};
}

bool differs(const Image8& a, const Image8& b, int x, int y) {
  const std::size_t i = std::size_t(y * a.width + x) * 4;
  return std::abs(a.pixels[i] - b.pixels[i]) + std::abs(a.pixels[i + 1] - b.pixels[i + 1]) +
             std::abs(a.pixels[i + 2] - b.pixels[i + 2]) >=
         40;
}

// The share of the ring's corners about which a picture differs from one without.
double corners_seen(const std::vector<Image8>& with, const std::vector<Image8>& without, std::size_t eye,
                    const ShownAim& aim) {
  int seen = 0;
  for (std::size_t i = 0; i < ShownAim::sides; ++i) {
    const glm::dvec2 place = aim_corner(aim.to_m, i),
                     at = pixel_of(eyes().eyes[eye], {place.x, aim.water_m[i] + 0.02, place.y});
    bool differing = false;
    for (int y = int(at.y) - 1; y <= int(at.y) + 1; ++y)
      for (int x = int(at.x) - 1; x <= int(at.x) + 1; ++x)
        differing = differing || differs(with[eye], without[eye], x, y);
    seen += differing;
  }
  return double(seen) / ShownAim::sides;
}

// Controls: limbs relative to the world's origin; both eyes drawn from the left one; the ring at the height of the
// still sea in a swell is AimShape's.
TEST_F(AimDrawn, LiesOnTheWaterInBothEyes) {
  for (const test::FrameLook& shape : test::sampled_looks()) {
    SCOPED_TRACE(shape.name);
    SeaShot shot(options(shape));
    const std::vector<Image8> without = shot.pictures(eyes(), time_s);
    const ShownAim aim = aim_at(shot, 5.0);
    shot.experience().show_aim(aim);
    const std::vector<Image8> with = shot.pictures(eyes(), time_s);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      EXPECT_GT(corners_seen(with, without, eye, aim), 0.9) << eye;
      int all = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) all += differs(with[eye], without[eye], x, y);
      EXPECT_LT(all, 900) << eye;  // a ring and a line, and nothing else
    }
  }
}

// Seen against the sea by noon, with a low sun and at night. Control: lit as a glove is.
TEST_F(AimDrawn, IsSeenWhateverTheLight) {
  for (const char* elevation : {"70", "4", "-5"}) {
    SCOPED_TRACE(elevation);
    ShotOptions lit = options(test::frame_looks[0]);
    lit.set.emplace_back("sky.sun_elevation_deg", elevation);
    SeaShot shot(lit);
    const std::vector<Image8> without = shot.pictures(eyes(), time_s);
    const ShownAim aim = aim_at(shot, 5.0);
    shot.experience().show_aim(aim);
    EXPECT_GT(corners_seen(shot.pictures(eyes(), time_s), without, 0, aim), 0.9);
  }
}

// Controls: without the question of the sea's depth; without the pass's own.
TEST_F(AimDrawn, IsHiddenByTheSea) {
  for (const test::FrameLook& shape : test::sampled_looks()) {
    SCOPED_TRACE(shape.name);
    SeaShot shot(options(shape));
    const std::vector<Image8> without = shot.pictures(eyes(), time_s);
    ShownAim aim = aim_at(shot, 5.0, -0.8);  // under water
    aim.from_m.reset();
    shot.experience().show_aim(aim);
    EXPECT_EQ(shot.pictures(eyes(), time_s)[1].pixels, without[1].pixels);
  }
}

// Controls: limbs kept from the frame before; a draw of no limbs.
TEST_F(AimDrawn, CostsNothingWhereNobodyAims) {
  SeaShot with(options(test::frame_looks[0])), without(options(test::frame_looks[0], false));
  without.draw(eyes(), time_s);
  with.experience().show_aim(aim_at(with, 5.0));
  with.draw(eyes(), time_s);
  const std::uint64_t passes = with.experience().options().per_eye ? 2 : 1;
  EXPECT_EQ(with.counts().draws, without.counts().draws + passes);
  with.experience().show_aim(std::nullopt);
  with.draw(eyes(), time_s);
  for (int n = 0; n < 2; ++n) without.draw(eyes(), time_s);
  EXPECT_EQ(with.counts().hash, without.counts().hash);
}

// Control: the view of gl_ViewIndex in a pass an eye.
TEST_F(AimDrawn, IsTheSameInOnePassAndInTwo) {
  if (!multiview_works(test::device(), test::shaders())) GTEST_SKIP() << "the driver draws multiview wrongly";
  for (const test::FrameLook& shape : test::sampled_looks()) {
    SCOPED_TRACE(shape.name);
    ShotOptions two = options(shape);
    two.per_eye = true;
    SeaShot one_pass(options(shape)), two_passes(two);
    std::array<std::vector<Image8>, 2> drawn;
    for (SeaShot* shot : {&one_pass, &two_passes}) {
      shot->experience().show_aim(aim_at(*shot, 5.0));
      drawn[shot == &two_passes] = shot->pictures(eyes(), time_s);
    }
    for (std::size_t eye = 0; eye < 2; ++eye) EXPECT_EQ(drawn[0][eye].pixels, drawn[1][eye].pixels) << eye;
  }
}

}  // namespace
}  // namespace seascape
