// Pockets of air under water and portals, as they are drawn.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "app/frame.h"
#include "app/program.h"
#include "app/water_shapes.h"
#include "shaders/shared/fresnel.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/portal_pixels.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using test::Set;
using test::Through;

class WaterShapesDrawn : public test::GpuTest {};

constexpr std::uint32_t width = 96, height = 72;
constexpr double pi = 3.14159265358979323846, n = gpu::water_index;

PlacedShape box(const glm::dvec3& sides_m, const glm::dvec3& at_m) {
  PlacedShape shape;
  shape.form = gpu::shape_box;
  shape.half_m = 0.5 * sides_m;
  shape.radius_m = glm::length(shape.half_m);
  shape.pose.position_m = at_m;
  return shape;
}
PlacedShape disc(double radius_m, const glm::dvec3& at_m) {
  PlacedShape shape = box({2.0 * radius_m, 2.0 * radius_m, 2.0}, at_m);
  shape.form = gpu::shape_disc;
  shape.radius_m = radius_m;
  return shape;
}

Set with(Set set, const Set& more) {
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

// Water that sends next to nothing back, which is seen through so far.
Set black_water(const std::string& sight_m) {
  return {{"water.type", "colour"}, {"water.red", "0.0001"},    {"water.green", "0.0001"},
          {"water.blue", "0.0001"}, {"water.sight_m", sight_m}, {"water.crest_light", "0"}};
}

test::ShotOptions options(const test::FrameLook& look, const Set& set, const SceneShapes& shapes) {
  test::ShotOptions options = test::solid_options(look, {}, width, height, with(test::flat_water, set));
  options.set.insert(options.set.end(),
                     {{"waves.resolution", "32"}, {"waves.cascades", "2"}, {"water.adaptation", "0"}});
  options.effects = {{"waves", "models", "underwater", "portals"}};
  options.shapes = shapes;
  return options;
}

struct Lit {
  ImageF picture;
  gpu::SkyLight light;
  gpu::FrameData data;
  glm::dvec3 at(std::uint32_t x, std::uint32_t y) const {
    const float* p = &picture.pixels[4 * (std::size_t(y) * width + x)];
    return glm::dvec3(p[0], p[1], p[2]) / double(light.exposure.x);
  }
  glm::dvec3 middle() const { return at(width / 2, height / 2); }
};
Lit lit(SeaShot& shot, const Viewpoint& viewpoint) {
  shot.draw(viewpoint, 1.0);
  Lit result{
      linear_picture_of(shot.device(), shot.experience(), 0), {}, frame_data(shot.scene().settings, viewpoint, height)};
  shot.experience().ocean().describe(result.data, viewpoint);
  const std::vector<std::uint8_t> bytes = read_buffer(shot.device(), shot.experience().sky().light());
  std::memcpy(&result.light, bytes.data(), sizeof result.light);
  return result;
}
const test::FrameLook lit_looks[] = {test::frame_looks[2], test::frame_looks[3]};

// A ball that shines by itself, white, within a pocket deep in black water is white from 12 poses in it: no water is
// before it. Control: without the pocket it is not seen.
TEST_F(WaterShapesDrawn, APocketIsDry) {
  for (const test::FrameLook& look : lit_looks) {
    SceneShapes shapes, none;
    shapes.air.push_back(box({6.0, 6.0, 6.0}, {0.0, -9.0, 0.0}));
    none.air.push_back(box({1.0, 1.0, 1.0}, {0.0, -200.0, 0.0}));
    for (const bool there : {true, false}) {
      test::ShotOptions made = options(look, black_water("0.5"), there ? shapes : none);
      test::stand(
          made.objects,
          test::solid_model(
              test::solid_sphere(0.6f, 16),
              R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1]},"extensions":{"KHR_materials_unlit":{}}})"),
          Pose{{0.0, -9.0, 0.0}});
      SeaShot shot(made);
      for (int i = 0; i < (there ? 12 : 1); ++i) {
        const double yaw = 30.0 * i, pitch = 20.0 * (i % 3 - 1);
        const glm::dquat turned = pose({}, yaw, pitch).orientation;
        const glm::dvec3 from = glm::dvec3(0.0, -9.0, 0.0) + turned * glm::dvec3(0.0, 0.0, 2.4);
        const Lit seen = lit(shot, shot.viewpoint(pose(from, yaw, pitch)));
        const double shines = 1.0 / double(seen.light.exposure.x), shown = seen.middle().y;
        if (there)
          EXPECT_NEAR(shown, shines, 0.01 * shines) << look.name << " " << i;
        else
          EXPECT_LT(shown, 0.1 * shines) << look.name;
      }
    }
  }
}

// A plate that shines by itself, seen from a pocket through a second one: what is left of its light is that of the
// water's two parts together, over the square of the index, 1 %. Control seen: the second pocket left out of the line.
TEST_F(WaterShapesDrawn, WaterIsSummedBetweenPockets) {
  for (const test::FrameLook& look : lit_looks) {
    SceneShapes shapes;
    shapes.air.push_back(box({2.0, 2.0, 2.0}, {0.0, -9.0, 0.0}));
    shapes.air.push_back(box({4.0, 4.0, 1.5}, {0.0, -9.0, -4.0}));
    test::ShotOptions made = options(look, with(black_water("20"), {{"camera.vertical_fov_deg", "2"}}), shapes);
    test::stand(
        made.objects,
        test::solid_model(
            test::solid_box({3.0f, 3.0f, 0.1f}),
            R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1]},"extensions":{"KHR_materials_unlit":{}}})"),
        Pose{{0.0, -9.0, -8.1}});
    SeaShot shot(made);
    const Lit seen = lit(shot, shot.viewpoint(pose({0.0, -9.0, 0.3}, 0.0, 0.0)));
    const double wet_m = (3.25 - 1.0) + (8.0 - 4.75);
    for (int c = 0; c < 3; ++c) {
      const double a = seen.data.water_absorption[c], b = seen.data.water_backscatter[c], u = b / (a + b);
      const double left = std::exp(-1.04 * std::sqrt(1.0 + 5.4 * u) * (a + b) * wet_m);
      const double expected = left / (n * n) / double(seen.light.exposure.x);
      EXPECT_NEAR(seen.middle()[c], expected, 0.01 * expected) << look.name << " channel " << c;
    }
  }
}

// The water in a bell, at 70 degrees from straight down: it mirrors grey walls by Fresnel's law, and black water is
// under it, 2 %. From below, outside of Snell's cone, it mirrors the deep and shows nothing of a plate that shines in
// the bell; straight from below it shows that. Controls seen: no reflectance; the cone's edge at 90 degrees.
TEST_F(WaterShapesDrawn, TheWaterInABellIsASurface) {
  for (const test::FrameLook& look : lit_looks) {
    SceneShapes shapes;
    shapes.air.push_back(box({8.0, 3.0, 8.0}, {0.0, -3.5, 0.0}));
    shapes.air.back().level_m = -0.5;
    test::ShotOptions made = options(look, with(black_water("3"), {{"camera.vertical_fov_deg", "2"}}), shapes);
    test::stand(
        made.objects,
        test::solid_model(
            test::solid_box({4.0f, 0.05f, 4.0f}),
            R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1]},"extensions":{"KHR_materials_unlit":{}}})"),
        Pose{{0.0, -2.1, 0.0}});
    SeaShot shot(made);
    const Lit down = lit(shot, shot.viewpoint(pose({0.0, -3.0, 0.0}, 100.0, -20.0)));
    const glm::dvec3 sun(down.data.sun);
    const double up = std::sqrt(1.0 - (1.0 - sun.y * sun.y) / (n * n)),
                 mirrored = double(gpu::fresnel(float(std::sin(glm::radians(20.0)))));
    for (int c = 0; c < 3; ++c) {
      const double fading = (double(down.data.water_absorption[c]) + double(down.data.water_backscatter[c])) / up,
                   comes = 0.93 * double(down.light.sky_irradiance[c]) +
                           double(down.light.sun_irradiance[c]) * double(down.data.water_reflectance.w),
                   expected = mirrored * 0.3 / pi * comes * std::exp(-fading * 4.0);
      EXPECT_NEAR(down.middle()[c], expected, 0.02 * expected) << look.name << " channel " << c;
    }
    const double shines = 1.0 / double(down.light.exposure.x);
    const Lit under = lit(shot, shot.viewpoint(pose({0.0, -4.1, 0.0}, 100.0, 89.0))),
              aside = lit(shot, shot.viewpoint(pose({0.0, -4.1, 0.0}, 100.0, 30.0)));
    EXPECT_GT(under.middle().y, 0.8 * shines) << look.name;
    EXPECT_LT(aside.middle().y, 0.1 * shines) << look.name;
  }
}

// In a pocket that reaches out of the sea there is no surface: an eye in it below the sea sees the sky as from the air.
// Control: the same eye without it.
TEST_F(WaterShapesDrawn, ThePocketCutsTheSurface) {
  for (const test::FrameLook& look : lit_looks) {
    SceneShapes shapes, none;
    shapes.air.push_back(box({3.0, 6.0, 3.0}, {0.0, 0.0, 0.0}));
    none.air.push_back(box({1.0, 1.0, 1.0}, {0.0, -200.0, 0.0}));
    const Set set = with(black_water("5"), {{"camera.vertical_fov_deg", "20"}});
    SeaShot within(options(look, set, shapes)), without(options(look, set, none));
    const Pose head = pose({0.0, -0.8, 0.0}, 200.0, 60.0);
    const Lit seen = lit(within, within.viewpoint(head)),
              sky = lit(without, without.viewpoint(pose({0.0, 3.0, 0.0}, 200.0, 60.0))),
              sunk = lit(without, without.viewpoint(head));
    int differ = 0, sunk_differ = 0;
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) {
        const double expected = sky.at(x, y).y;
        differ += std::abs(seen.at(x, y).y - expected) > 0.01 * expected;
        sunk_differ += std::abs(sunk.at(x, y).y - expected) > 0.01 * expected;
      }
    EXPECT_EQ(differ, 0) << look.name;
    EXPECT_GT(sunk_differ, int(width * height) / 2) << look.name;
  }
}

// In a dry hall under the level of the sea with a box in it: outside of portals the picture is to the bit what it is
// where none is in sight; within, water; of two that overlap each pixel is that of the nearer one's own picture; edge
// on there is nothing. Control seen: things before a portal lit as
// in water.
TEST_F(WaterShapesDrawn, PortalsShowWaterWithinTheirOutlineAlone) {
  for (const test::FrameLook& look : test::sampled_looks()) {
    const auto scene = [&](const std::vector<PlacedShape>& portals) {
      SceneShapes shapes;
      shapes.portals = portals;
      test::ShotOptions made = options(look, {{"water.type", "3C"}}, shapes);
      test::stand(made.objects, test::solid_model(test::solid_box({2.0f, 0.3f, 0.3f}), "{}"), Pose{{0.0, -3.0, -9.0}});
      test::stand(made.objects, test::solid_model(test::solid_box({0.08f, 3.0f, 0.08f}), "{}"),
                  Pose{{0.3, -3.0, -2.0}});
      return made;
    };
    const PlacedShape behind = disc(1.0, {0.0, -3.0, 30.0}), left = disc(1.0, {-0.4, -3.0, -4.0}),
                      right = disc(1.2, {0.6, -2.8, -6.0});
    PlacedShape edge = left;
    edge.pose.orientation = glm::angleAxis(glm::radians(90.0), glm::dvec3(0.0, 1.0, 0.0));
    edge.pose.position_m.x = 0.0;
    const Pose head = pose({0.0, -3.0, 0.0}, 0.0, 0.0);
    const auto draw = [&](const std::vector<PlacedShape>& portals) {
      SeaShot shot(scene(portals));
      return shot.picture(head, 1.0);
    };
    const Image8 dry = draw({behind}), one = draw({left}), other = draw({right});
    EXPECT_EQ(test::differing_pixels(draw({edge}), dry), 0) << look.name;
    SeaShot shot(scene({left, right}));
    const Image8 both = shot.picture(head, 1.0);
    const View eye = shot.viewpoint(head).eyes.front();
    const gpu::WaterShapes first = placed_shapes({{}, {left}}, {}, head.position_m, nullptr),
                           second = placed_shapes({{}, {right}}, {}, head.position_m, nullptr);
    const auto apart = [&](const Image8& a, const Image8& b, std::uint32_t x, std::uint32_t y) {
      int most = 0;
      for (std::size_t c = 0, at = 4 * (std::size_t(y) * width + x); c < 3; ++c)
        most = std::max(most, std::abs(int(a.pixels[at + c]) - int(b.pixels[at + c])));
      return most;
    };
    int outside = 0, wet = 0, inside = 0, overlap = 0, before = 0;
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) {
        const Through a = test::through({first, 0, 1}, eye, x, y, width, height),
                      b = test::through({second, 0, 1}, eye, x, y, width, height);
        if (a == Through::unsure || b == Through::unsure) continue;
        const bool in_a = a == Through::some, in_b = b == Through::some;
        outside += !in_a && !in_b && apart(both, dry, x, y) > 0;
        if (in_a || in_b) ++inside, wet += apart(both, dry, x, y) > 0;
        if (in_a || in_b) {
          EXPECT_LE(apart(both, in_a ? one : other, x, y), 1) << look.name << " " << x << " " << y;
        }
        overlap += in_a && in_b;
        // The pillar stands in the air before them.
        if ((in_a || in_b) && test::meets_box({0.0, -3.0, 0.0}, test::pixel_ray(eye, x + 0.5, y + 0.5, width, height),
                                              {0.3, -3.0, -2.0}, {0.08, 3.0, 0.08}, -0.05)) {
          EXPECT_LE(apart(both, dry, x, y), 1) << look.name << " " << x << " " << y;
          ++before;
        }
      }
    EXPECT_EQ(outside, 0) << look.name << test::leave(both, "portals_" + look.name);
    EXPECT_GT(overlap, 50);
    EXPECT_GT(before, 10);
    EXPECT_GT(inside, 500);
    EXPECT_GT(wet, inside * 8 / 10) << look.name
                                    << test::leave(both, "portals_" + look.name);  // a pillar stands before
  }
}

// Into a volume that is flown through and out of it: a ball that shines by itself in the middle of it is dimmed by the
// water between its side and the eye, or from the eye on, 1 %, and shines bright where the eye has passed through.
// Control seen: the mode volume, which shows no water to an eye within.
TEST_F(WaterShapesDrawn, AVolumeIsFlownThrough) {
  for (const test::FrameLook& look : lit_looks) {
    SceneShapes shapes;
    shapes.portals.push_back(box({4.0, 4.0, 6.0}, {0.0, -4.0, 0.0}));
    shapes.portals.back().mode = gpu::portal_fly_through;
    test::ShotOptions made = options(look, with(black_water("8"), {{"camera.vertical_fov_deg", "4"}}), shapes);
    test::stand(
        made.objects,
        test::solid_model(
            test::solid_box({1.0f, 1.0f, 0.05f}),
            R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1]},"extensions":{"KHR_materials_unlit":{}}})"),
        Pose{{0.0, -4.0, 0.0}});
    SeaShot shot(made);
    for (const double z : {6.0, 4.0, 3.05, 2.95, 2.0, 1.0}) {
      const Lit seen = lit(shot, shot.viewpoint(pose({0.0, -4.0, z}, 0.0, 0.0)));
      const double wet_m = std::min(z, 3.0) - 0.05;
      for (int c = 0; c < 3; ++c) {
        const double a = seen.data.water_absorption[c], b = seen.data.water_backscatter[c], u = b / (a + b);
        const double expected =
            std::exp(-1.04 * std::sqrt(1.0 + 5.4 * u) * (a + b) * wet_m) / (n * n) / double(seen.light.exposure.x);
        EXPECT_NEAR(seen.middle()[c], expected, 0.01 * expected) << look.name << " " << z << " channel " << c;
      }
    }
  }
}

// From below, through a volume that lies under the sea, upwards: the plate behind it is dimmed by what water the line
// goes through, 1 %, though the line's end is the sky, whose side it would have without the volume. Control seen: the
// stencil's beginning by that end.
TEST_F(WaterShapesDrawn, AVolumeIsSeenThroughUpwards) {
  for (const test::FrameLook& look : lit_looks) {
    SceneShapes shapes;
    shapes.portals.push_back(box({4.0, 2.0, 2.0}, {0.0, -4.0, -3.0}));
    shapes.portals.back().mode = gpu::portal_volume;
    test::ShotOptions made = options(look, with(black_water("8"), {{"camera.vertical_fov_deg", "4"}}), shapes);
    test::stand(
        made.objects,
        test::solid_model(
            test::solid_box({1.0f, 1.0f, 0.05f}),
            R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1]},"extensions":{"KHR_materials_unlit":{}}})"),
        Pose{{0.0, -3.0, -6.0}});
    SeaShot shot(made);
    const double pitch = 10.0, cosine = std::cos(glm::radians(pitch));
    const Lit seen = lit(shot, shot.viewpoint(pose({0.0, -4.5, 0.0}, 0.0, pitch)));
    for (int c = 0; c < 3; ++c) {
      const double a = seen.data.water_absorption[c], b = seen.data.water_backscatter[c], u = b / (a + b);
      const double expected =
          std::exp(-1.04 * std::sqrt(1.0 + 5.4 * u) * (a + b) * (2.0 / cosine)) / double(seen.light.exposure.x);
      EXPECT_NEAR(seen.middle()[c], expected, 0.01 * expected) << look.name << " channel " << c;
    }
  }
}

// Named, but without shapes, the effect draws what is drawn without it, to the bit, by the same code; and where nothing
// names it shapes do nothing. Control: shapes with it.
TEST_F(WaterShapesDrawn, CostsNothingWithoutShapes) {
  SceneShapes shapes;
  shapes.air.push_back(box({2.0, 4.0, 2.0}, {0.0, -1.0, -4.0}));
  const auto code = [](SeaShot& shot) {
    std::vector<std::vector<std::uint32_t>> words;
    for (const auto& shader : shot.experience().surface().lighting().shaders()) words.push_back(shader->words);
    for (const auto& shader : shot.experience().surface().pipeline().shaders()) words.push_back(shader->words);
    return words;
  };
  for (const test::FrameLook& look : test::sampled_looks()) {
    if (look.name == "tile" && !test::long_run()) continue;
    test::ShotOptions with_it = options(look, {}, shapes), bare = options(look, {}, {}), unnamed = with_it;
    unnamed.effects = {{"waves", "models", "underwater"}};
    test::ShotOptions none = bare;
    none.effects = unnamed.effects;
    SeaShot named(bare), asleep(unnamed), absent(none), there(with_it);
    for (const Pose& head : {pose({0.0, 1.0, 0.0}, 0.0, -20.0), pose({0.0, -1.0, 0.0}, 0.0, 10.0)}) {
      const Image8 wanted = absent.picture(head, 1.0);
      EXPECT_EQ(test::differing_pixels(named.picture(head, 1.0), wanted), 0) << look.name;
      EXPECT_EQ(test::differing_pixels(asleep.picture(head, 1.0), wanted), 0) << look.name;
      EXPECT_GT(test::differing_pixels(there.picture(head, 1.0), wanted), 50) << look.name;
      EXPECT_EQ(named.counts().commands, absent.counts().commands);
    }
    EXPECT_EQ(code(named), code(absent)) << look.name;
    EXPECT_EQ(code(asleep), code(absent)) << look.name;
    EXPECT_NE(code(there), code(absent)) << look.name;
  }
}

}  // namespace
}  // namespace seascape
