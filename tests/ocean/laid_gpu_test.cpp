// What lies on the water as it is drawn: colour and shadow where the inputs lie, still or with the waves.
#include <cmath>

#include "tests/support/gpu/drawn_mesh.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

InputSpec area(InputTarget to, glm::vec4 value, glm::dvec2 at, glm::dvec2 size, double feather) {
  InputSpec spec;
  spec.to = to;
  spec.value = value;
  spec.feather_m = feather;
  spec.shape = AreaInput{.round = true, .at_m = at, .size_m = size};
  return spec;
}

class DrawnLaid : public test::GpuTest {};

// A colour laid on the water makes it as bright as that, and a shadow takes the sun's glitter and light from it, within
// the input and nowhere else. Controls seen: what lies beneath the colour left as bright; a shadow that leaves the
// glitter.
TEST_F(DrawnLaid, ColourAndShadeOnlyWhatLiesWithinTheInput) {
  constexpr int width = 160, height = 120;
  const Viewpoint view = SeaShot({.scene = "calm", .preset = "high", .width = width, .height = height})
                             .viewpoint(pose({0.0, 30.0, 0.0}, 0.0, -90.0));
  const auto picture = [&](std::vector<std::string> effects, const std::vector<InputSpec>& inputs) {
    SeaShot shot({.scene = "calm",
                  .preset = "high",
                  .width = width,
                  .height = height,
                  .set = {{"sky.sun_elevation_deg", "80"}},
                  .effects = std::move(effects),
                  .inputs = inputs});
    return shot.picture(view, 2.0);
  };
  const glm::dvec2 middle(0.0), size(16.0);
  const Image8 plain = picture({"waves"}, {});
  const Image8 red =
      picture({"waves", "albedo"}, {area(InputTarget::albedo, {0.5f, 0.0f, 0.0f, 1.0f}, middle, size, 0.0)});
  const Image8 dark =
      picture({"waves", "shadow"}, {area(InputTarget::shadow, {1.0f, 1.0f, 0.0f, 0.0f}, middle, size, 0.0)});
  const auto within = [&](int x, int y) { return std::hypot(x - width / 2 + 0.5, y - height / 2 + 0.5) < 20.0; };
  const auto beyond = [&](int x, int y) { return std::hypot(x - width / 2 + 0.5, y - height / 2 + 0.5) > 45.0; };
  glm::dvec3 in_plain(0.0), in_red(0.0), in_dark(0.0);
  int differ = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto i = std::size_t(y * width + x);
      const glm::dvec3 p = test::light_at(plain, i), r = test::light_at(red, i), d = test::light_at(dark, i);
      if (within(x, y)) in_plain += p, in_red += r, in_dark += d;
      if (beyond(x, y)) differ += r != p || d != p;
    }
  EXPECT_EQ(differ, 0);
  EXPECT_GT(in_red.x, 2.0 * in_plain.x) << test::leave(red, "albedo");
  EXPECT_LT(in_red.y, 0.3 * in_plain.y) << "the colour covers what is beneath";
  EXPECT_LT(in_dark.y, 0.8 * in_plain.y) << test::leave(dark, "shadow");
}

// The two numbers of a shadow, one at a time: the first keeps light away from within the water, so that without glitter
// the water is darker and a shadow on the surface alone changes nothing; the second takes the glitter, all of it, and
// leaves the light within. Control seen: the two changed about, in the shader (the planted fault shadow_channels).
TEST_F(DrawnLaid, AShadowsNumbersAreOfTheWaterAndOfItsSurface) {
  constexpr int width = 80, height = 60;
  struct Shade {
    double within = 1.0, surface = 1.0;  // the sunlight that is left
  };
  const auto picture = [&](const Shade& left, const char* glitter) {
    SeaShot shot({.scene = "calm",
                  .preset = "medium",
                  .width = width,
                  .height = height,
                  .set = {{"sky.sun_elevation_deg", "80"},
                          {"sky.exposure_ev", "-1"},
                          {"water.chlorophyll_mg_m3", "5"},
                          {"water.glitter", glitter}},
                  .effects = std::vector<std::string>{"waves", "shadow"},
                  .inputs = {area(InputTarget::shadow, {1.0 - left.within, 1.0 - left.surface, 0.0, 0.0}, {0.0, 0.0},
                                  {400.0, 400.0}, 0.0)}});
    return shot.picture(pose({0.0, 30.0, 0.0}, 0.0, -90.0), 2.0);
  };
  const auto green = [](const Image8& image) {
    double sum = 0.0;
    for (std::size_t i = 0; i < std::size_t(width * height); ++i) sum += test::light_at(image, i).y;
    return sum / (width * height);
  };
  // Without glitter: the light from within alone.
  const Image8 dull = picture({}, "0"), dull_within = picture({.within = 0.0}, "0");
  EXPECT_EQ(test::differing_pixels(dull, picture({.surface = 0.0}, "0")), 0)
      << "a shadow on the surface dims the water";
  EXPECT_LT(green(dull_within), 0.7 * green(dull)) << test::leave(dull_within, "shadow_within");
  // With it.
  const Image8 bright = picture({}, "1"), bright_within = picture({.within = 0.0}, "1");
  EXPECT_GT(green(bright), 1.2 * green(dull)) << test::leave(bright, "shadow_none");
  EXPECT_EQ(test::differing_pixels(dull, picture({.surface = 0.0}, "1")), 0) << "glitter is left in a shadow";
  EXPECT_GT(green(bright_within) - green(dull_within), 0.7 * (green(bright) - green(dull)))
      << "a shadow within the water takes the glitter " << test::leave(bright_within, "shadow_within_bright");
}

// In a storm a red disc that stays in its place and a green one that goes with the waves lie on the water, of which
// each pixel shows where it stands and where it rests: the green over the red. Controls seen: the two layers of a slice
// changed about; both asked for at the rest position.
TEST_F(DrawnLaid, ColoursStayOrGoWithTheWaves) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  constexpr int width = 160, height = 120;
  const glm::dvec2 middle(0.0), size(16.0);
  std::vector<InputSpec> discs{area(InputTarget::albedo, {0.9f, 0.0f, 0.0f, 1.0f}, middle, size, 0.0),
                               area(InputTarget::albedo, {0.0f, 0.9f, 0.0f, 1.0f}, middle, size, 0.0)};
  discs[1].follow_waves = true;
  for (const bool both : {true, false}) {
    if (!both) discs.erase(discs.begin());
    SeaShot shot({.scene = "storm",
                  .preset = "high",
                  .width = width,
                  .height = height,
                  .probe = true,
                  .set = {{"foam.simulated", "false"}, {"water.whitecaps", "0"}},
                  .effects = std::vector<std::string>{"waves", "albedo"},
                  .inputs = discs});
    const Viewpoint view = shot.viewpoint(pose({0.0, 30.0, 0.0}, 0.0, -90.0));
    int told = 0, wrong = 0, apart = 0;
    Image8 picture;
    for (int i = 0, moment = 0; moment < 6; i = 0, ++moment) {
      picture = shot.picture(view, 4.0 + 2.3 * moment);
      for (const test::DrawnMesh::Shown& shown : test::DrawnMesh(shot, view).shown(width, height)) {
        const auto pixel = std::size_t(i++);
        if (!shown.any) continue;
        const double rest = glm::length(shown.point.rest), stands = std::hypot(shown.point.at.x, shown.point.at.z);
        if (std::abs(rest - 8.0) < 1.0 || std::abs(stands - 8.0) < 1.0)
          continue;  // from 30 m up texels are up to a metre wide
        const glm::dvec3 light = test::light_at(picture, pixel);
        const bool green = light.y > 2.0 * light.x && light.y > 2.0 * light.z,
                   red = light.x > 2.0 * light.y && light.x > 2.0 * light.z;
        ++told;
        wrong += green != (rest < 8.0) || red != (both && rest > 8.0 && stands < 8.0);
        apart += (rest < 8.0) != (stands < 8.0);
      }
    }
    EXPECT_GT(told, 3 * width * height);
    EXPECT_GT(apart, 100) << "waves move the water away from its rest";
    EXPECT_LE(wrong, apart / 10) << apart << ' ' << both << ' ' << test::leave(picture, "laid");
  }
}

}  // namespace
}  // namespace seascape
