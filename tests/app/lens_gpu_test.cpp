// Water on the eyes' lenses: the meniscus along the waterline, and drops. Controls are named beside each test; each was
// seen to fail.
#include <gtest/gtest.h>

#include <cmath>

#include "app/program.h"
#include "shaders/shared/fresnel.h"
#include "shaders/shared/meniscus.h"
#include "tests/support/gpu/frame_shapes.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/gpu/waterline.h"

namespace seascape {
namespace {

using test::DrawnMesh;
using test::NearMesh;
using test::pose;
using test::SeaShot;
using test::Set;

class Lens : public test::GpuTest {};

constexpr std::uint32_t width = 120, height = 90;

test::ShotOptions options(const test::FrameLook& look, const Set& set, const char* fov_deg = "40") {
  test::ShotOptions result{
      .scene = "waterline", .preset = "low", .width = width, .height = height, .probe = true, .set = look.set};
  result.set.insert(result.set.end(), set.begin(), set.end());
  for (const auto& [key, value] : {std::pair("camera.vertical_fov_deg", fov_deg), {"waves.where", "cpu"}})
    result.set.emplace_back(key, value);
  result.effects = {{"waves", "underwater"}};
  return result;
}

void clear_lens(SeaShot& shot, bool clear) { shot.set("comfort.clear_lens", clear ? "true" : "false"); }

// A sea of wind: the meniscus changes pixels in no other place than from the drawn surface up to as far as it rises,
// within a pixel, and there it changes them without a gap; the sides of pixels are the same to the bit, where they can
// be read. Both in the tile with four samples and lit later. Controls: the pixel's side not asked, of a ribbon that
// begins 3 mm lower (994 strays); a line 2 mm higher.
TEST_F(Lens, TheMeniscusStandsOnTheWaterlineAndChangesNoSide) {
  for (const test::FrameLook& look : {test::frame_looks[0], test::frame_looks[3]}) {
    SCOPED_TRACE(look.name);
    SeaShot shot(options(look, {{"waves.wind_speed_mps", "9"}}));
    int changed = 0, missing = 0, stray = 0, within = 0;
    for (int n = 0; n < 4; ++n) {
      const glm::dvec2 at(9.0 * n, -5.0 * n);
      const double time_s = 12.0 + 2.0 * n;  // a jump, after which no drop is left of the pose before
      const QueryAnswer water = test::drawn_water(shot, at, time_s);
      if (!water.converged) continue;
      const Viewpoint viewpoint =
          shot.viewpoint(pose({at.x, water.height_m + 0.004 * (n - 2), at.y}, 70.0 * n, 4.0 * (n - 1), 12.0 * (n - 1)));
      clear_lens(shot, true);
      const Image8 without = shot.picture(viewpoint, time_s);
      EXPECT_EQ(shot.experience().lens()->patches(), 0u);
      std::vector<bool> sides;
      if (shot.experience().deferred()) sides = test::wet_pixels(shot, 0);
      clear_lens(shot, false);
      const Image8 with = shot.picture(viewpoint, time_s);
      EXPECT_GT(shot.experience().lens()->patches(), 0u);
      if (shot.experience().deferred()) {
        EXPECT_EQ(test::wet_pixels(shot, 0), sides);
      }
      const DrawnMesh mesh(shot, viewpoint);
      const View& eye = viewpoint.eyes[0];
      const NearMesh near(mesh, {at.x - water.displacement.x, at.y - water.displacement.z}, 0.4);
      const double near_m = shot.scene().settings.render.near_m,
                   pixel_m = 1.5 * near_m * (eye.fov.up - eye.fov.down) / height;
      // Upwards along the near plane, and how far it rises there; waves lean the water's plane by less than 0.5.
      const glm::dvec3 ahead = eye.pose.orientation * glm::dvec3(0.0, 0.0, -1.0);
      for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
          const glm::dvec3 from = test::on_near_plane(eye, x + 0.5, y + 0.5, width, height, near_m);
          const double over_m = -near.over(from);  // above the water
          const std::size_t at_pixel = 4 * (std::size_t(y) * width + x);
          const bool differs =
              !std::equal(&with.pixels[at_pixel], &with.pixels[at_pixel] + 3, &without.pixels[at_pixel]);
          changed += differs;
          const double most_m = 0.0027 * 2.0 / std::sqrt(1.0 - std::abs(ahead.y) - 0.3);
          if (differs && (over_m < -pixel_m || over_m > most_m + pixel_m)) ++stray;
          // Its lower half mirrors the water.
          if (over_m > pixel_m && over_m < 0.0015) ++within, missing += !differs;
        }
    }
    EXPECT_EQ(stray, 0) << "of " << changed;
    EXPECT_GT(within, 150);
    EXPECT_LE(missing, within / 50) << "of " << within;
  }
}

// Still water, a level line of sight. Where the surface leans by less than 41.39 degrees (90 less Snell's 48.607) it
// mirrors the water back, which is black here; that is up to 2 sin(20.70 degrees) capillary lengths, 1.909 mm. Above it
// the sky that was bent is seen, and from 3.82 mm on the picture as it is without: within a pixel, 0.12 mm. Control:
// the capillary length a tenth longer.
TEST_F(Lens, TheMeniscusMirrorsAndRisesAsHighAsItDoes) {
  const Set still{{"waves.wind_speed_mps", "0"}, {"waves.swell_height_m", "0"}, {"water.type", "colour"},
                  {"water.red", "0.0001"},       {"water.green", "0.0001"},     {"water.blue", "0.0001"},
                  {"water.sight_m", "0.5"},      {"sky.sun_to_deg", "180"},     {"lod.earth_curvature", "false"}};
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]}) {
    SCOPED_TRACE(look.name);
    SeaShot shot(options(look, still, "6.8"));
    for (const double looks_at_m : {0.001909, 0.00382}) {
      const auto lit = [&](bool clear) {
        clear_lens(shot, clear);
        shot.draw(pose({0.0, looks_at_m, 0.0}, 0.0, 0.0), 1.0);
        return linear_picture_of(shot.device(), shot.experience(), 0);
      };
      const ImageF a = lit(false), b = lit(true);
      const double pixel_m = 0.1 * 2.0 * std::tan(glm::radians(3.4)) / height;
      const auto light = [&](const ImageF& picture, std::uint32_t y) {
        return picture.pixels[4 * (std::size_t(y) * width + width / 2) + 1];
      };
      double dark_m = 0.0, rises_m = 0.0;
      for (std::uint32_t y = 0; y < height; ++y) {
        const double up_m = looks_at_m + (0.5 * height - y - 0.5) * pixel_m;
        if (up_m < pixel_m) continue;
        if (light(a, y) < 0.003f) dark_m = std::max(dark_m, up_m);
        if (light(a, y) != light(b, y)) rises_m = std::max(rises_m, up_m);
      }
      if (looks_at_m < 0.003) {
        EXPECT_NEAR(dark_m, 0.001909, 1.5 * pixel_m);
      } else {
        // The last it bends light so little that nothing is seen of it.
        EXPECT_LT(rises_m, 0.00382 + pixel_m);
        EXPECT_GT(rises_m, 0.0033);
      }
    }
  }
}

// Out of the water: drops for some seconds, on both lenses, each its own; a later start sees
// the same picture to the bit; a clear lens has none, and later nothing is drawn. Control: the left eye's
// drops drawn for both.
TEST_F(Lens, DropsRunOffForSomeSeconds) {
  for (const test::FrameLook& look : {test::frame_looks[0], test::frame_looks[3]}) {
    SCOPED_TRACE(look.name);
    test::ShotOptions made = options(look, {{"waves.wind_speed_mps", "0"}, {"waves.swell_height_m", "0"}});
    made.views = 2;
    SeaShot shot(made);
    const Pose under = pose({0.0, -0.4, 0.0}, 0.0, 0.0), over = pose({0.0, 0.5, 0.0}, 0.0, 0.0);
    const auto comes_out = [&](double begin_s) {
      for (const double after_s : {0.0, 0.2}) shot.draw(under, begin_s + after_s);
      shot.draw(over, begin_s + 0.4);
      return shot.pictures(over, begin_s + 0.6);
    };
    clear_lens(shot, true);
    const std::vector<Image8> none = comes_out(1.0);
    EXPECT_EQ(shot.experience().lens()->drops(), 0u);
    const std::uint64_t draws = shot.counts().draws;
    clear_lens(shot, false);
    const std::vector<Image8> seen = comes_out(1.0);
    EXPECT_EQ(shot.experience().lens()->drops(), 2u * LensDrops::most);
    // Seen anew from when it was under water last.
    shot.draw(over, 60.0);
    EXPECT_EQ(shot.experience().lens()->drops(), 0u);
    shot.experience().wet_lenses(shot.viewpoint(under), 1.2);
    shot.experience().wet_lenses(shot.viewpoint(over), 1.4);
    const std::vector<Image8> again = shot.pictures(over, 1.6);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      EXPECT_GT(test::differing_pixels(seen[eye], none[eye]), 30) << eye;
      EXPECT_EQ(test::differing_pixels(seen[eye], again[eye]), 0) << eye;
    }
    EXPECT_GT(test::differing_pixels(seen[0], seen[1]), 30);
    for (double time_s = 2.0; time_s < 6.6; time_s += 0.9) shot.draw(over, time_s);
    shot.draw(over, 6.8);
    EXPECT_EQ(shot.counts().draws, draws);
    EXPECT_EQ(shot.experience().lens()->drops(), 0u);
  }
}

}  // namespace
}  // namespace seascape
