// What an eye in the water sees, against closed forms, and what an eye in the air pays for it. Controls are named
// beside each test.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "app/eye_adaptation.h"
#include "app/frame.h"
#include "app/program.h"
#include "shaders/shared/fresnel.h"
#include "shaders/shared/water_volume.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/gpu/waterline.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using test::Set;

class Underwater : public test::GpuTest {};

constexpr std::uint32_t width = 160, height = 120;
constexpr double pi = 3.14159265358979323846, n = gpu::water_index;

// Without water on the lens, which hides what is measured, unless `set` wants it.
test::ShotOptions options(const test::FrameLook& look, Set set,
                          std::vector<std::string> effects = {"waves", "underwater"}) {
  set.insert(set.begin(), {"comfort.clear_lens", "true"});
  test::ShotOptions options = test::solid_options(look, {}, width, height, set);
  options.effects = std::move(effects);
  options.set.insert(options.set.begin(), {"water.adaptation", "0"});  // light is compared as it is
  return options;
}

Set with(Set set, Set more) {
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

struct Lit {
  ImageF picture;
  gpu::SkyLight light;
  gpu::FrameData data;
  glm::dvec3 at(std::uint32_t x, std::uint32_t y) const {
    const float* p = &picture.pixels[4 * (std::size_t(y) * width + x)];
    return glm::dvec3(p[0], p[1], p[2]) / double(light.exposure.x);
  }
};

// Of looks that keep the light.
Lit lit(SeaShot& shot, const Viewpoint& viewpoint) {
  shot.draw(viewpoint, 1.0);
  Lit result{
      linear_picture_of(shot.device(), shot.experience(), 0), {}, frame_data(shot.scene().settings, viewpoint, height)};
  shot.experience().ocean().describe(result.data, viewpoint);
  const std::vector<std::uint8_t> bytes = read_buffer(shot.device(), shot.experience().sky().light());
  std::memcpy(&result.light, bytes.data(), sizeof result.light);
  return result;
}

// Water that sends next to nothing back and takes little away.
const Set clear_water{{"water.type", "colour"},
                      {"water.red", "0.0001"},
                      {"water.green", "0.0001"},
                      {"water.blue", "0.0001"},
                      {"water.sight_m", "100"}};

// While no eye can be in the water, and no drop is left on a lens, nothing is drawn that is not drawn without the
// effect, and the picture is the same to the bit. Controls: the same eyes in the water; out of it a moment ago.
TEST_F(Underwater, CostsTheDryNothing) {
  for (const test::FrameLook& look : test::sampled_looks()) {
    SeaShot wet(options(look, {{"comfort.clear_lens", "false"}})), dry(options(look, {}, {"waves"}));
    const Pose above = pose({0.0, 2.0, 0.0}, 20.0, -12.0), below = pose({0.0, -2.0, 0.0}, 20.0, -12.0);
    const Image8 seen = wet.picture(above, 3.0), wanted = dry.picture(above, 3.0);
    EXPECT_EQ(test::differing_pixels(seen, wanted), 0) << look.name;
    EXPECT_EQ(wet.counts().draws, dry.counts().draws) << look.name;
    EXPECT_EQ(wet.counts().triangles, dry.counts().triangles) << look.name;
    EXPECT_EQ(wet.counts().dispatches, dry.counts().dispatches) << look.name;
    EXPECT_GT(test::differing_pixels(wet.picture(below, 3.0), dry.picture(below, 3.0)), 5000) << look.name;
    EXPECT_GT(wet.counts().draws, dry.counts().draws) << look.name;
    wet.draw(above, 3.1);
    dry.draw(above, 3.1);
    EXPECT_EQ(wet.counts().draws, dry.counts().draws + 1) << look.name << ", the drops";
    for (double time_s = 3.9; time_s < 9.0; time_s += 0.9) wet.draw(above, time_s);
    EXPECT_EQ(wet.counts().draws, dry.counts().draws) << look.name;
    EXPECT_EQ(wet.counts().moved, dry.counts().moved) << look.name;
  }
}

// In still water at 2 m the picture is brighter by what the exposure gains, and in the air the same to the bit. Control
// seen: the depth with its sign turned.
TEST_F(Underwater, TheExposureFollowsTheEye) {
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]}) {
    SeaShot plain(options(look, test::flat_water)),
        adapted(options(look, with(test::flat_water, {{"water.adaptation", "0.5"}})));
    const Pose above = pose({0.0, 2.0, 0.0}, 20.0, -12.0);
    EXPECT_EQ(test::differing_pixels(plain.picture(above, 3.0), adapted.picture(above, 3.0)), 0) << look.name;
    const Viewpoint below = plain.viewpoint(pose({0.0, -2.0, 0.0}, 20.0, 10.0));
    const Lit one = lit(plain, below), other = lit(adapted, below);
    const double sine = one.data.sun.y, sun_cosine = std::sqrt(1.0 - (1.0 - sine * sine) / (n * n));
    const double stops = adaptation_stops(
        {glm::dvec3(one.data.water_reflectance),
         (glm::dvec3(one.data.water_absorption) + glm::dvec3(one.data.water_backscatter)) / sun_cosine, 2.0},
        0.5);
    EXPECT_GT(stops, 1.0);
    for (const std::uint32_t y : {height / 4, height / 2, height - 1})
      for (int colour = 0; colour < 3; ++colour)
        EXPECT_NEAR(other.at(width / 2, y)[colour] / one.at(width / 2, y)[colour], std::exp2(stops),
                    2e-3 * std::exp2(stops))
            << look.name << " " << y;
  }
}

// Spray is in the air: from the water none of it is seen, though it falls into it. Control seen: spray drawn for all
// eyes.
TEST_F(Underwater, SprayIsNotSeenFromTheWater) {
  const auto storm = [](bool spray) {
    test::ShotOptions o{.scene = "storm", .preset = "low", .width = width, .height = height};
    o.set = {{"waves.where", "cpu"}, {"waves.resolution", "32"}, {"msaa", "1"}};
    o.effects = {"waves", "foam", "underwater"};
    if (spray) o.effects->push_back("spray");
    return o;
  };
  SeaShot with_spray(storm(true)), without(storm(false));
  const Pose above = pose({0.0, 6.0, 0.0}, 20.0, -18.0), below = pose({0.0, -9.0, 0.0}, 20.0, 40.0);
  for (SeaShot* shot : {&with_spray, &without})
    for (int i = 0; i < 12; ++i) shot->draw(above, 4.0 + i / 12.0);
  EXPECT_GT(test::differing_pixels(with_spray.picture(above, 5.0), without.picture(above, 5.0)), 20);
  EXPECT_EQ(test::differing_pixels(with_spray.picture(below, 5.0), without.picture(below, 5.0)), 0);
}

// The edge of Snell's window in still water, 48.607 degrees from the zenith within 0.05 (facts/underwater.md), in four
// directions away from the sun. Control seen: an index of 1.34 (48.27 degrees).
TEST_F(Underwater, SnellsWindowEndsWhereItDoes) {
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]}) {
    SeaShot shot(options(look, with(with(test::flat_water, clear_water), {{"camera.vertical_fov_deg", "3"}})));
    for (const double yaw_deg : {100.0, 160.0, 220.0, 250.0}) {
      const Viewpoint viewpoint = shot.viewpoint(pose({0.0, -2.0, 0.0}, yaw_deg, 90.0 - 48.607));
      const Lit seen = lit(shot, viewpoint);
      double brightest = 0.0;
      for (std::uint32_t y = 0; y < height; ++y) brightest = std::max(brightest, seen.at(width / 2, y).y);
      std::uint32_t edge = 0;  // rows go down, out of the window
      while (edge + 1 < height && seen.at(width / 2, edge).y > 0.05 * brightest) ++edge;
      const glm::dvec3 ray = test::pixel_ray(viewpoint.eyes.front(), width / 2 + 0.5, edge, width, height);
      EXPECT_NEAR(glm::degrees(std::acos(ray.y)), 48.607, 0.05) << look.name << " " << yaw_deg;
    }
  }
}

// Its brightness by angle: the sky's own, as an eye in the air sees it where Snell leads, times what the surface lets
// through (facts/underwater.md, section 2), over the square of the index, and what a quarter of a metre of water takes.
// 1 %. Control seen: Schlick's reflectance.
TEST_F(Underwater, SnellsWindowIsAsBrightAsTheSkyThroughIt) {
  const Set set = with(with(test::flat_water, clear_water), {{"camera.vertical_fov_deg", "1"}});
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]}) {
    SeaShot shot(options(look, set));
    struct Row {
      double in_deg, out_deg, passes;
    };
    for (const Row& row : {Row{20, 27.12, .9790}, Row{30, 41.80, .9745}, Row{40, 58.96, .9444}, Row{45, 70.49, .8605},
                           Row{47, 77.13, .7386}, Row{48, 82.14, .5669}}) {
      const double yaw_deg = 200.0, depth_m = 0.25;
      const Lit below = lit(shot, shot.viewpoint(pose({0.0, -depth_m, 0.0}, yaw_deg, 90.0 - row.in_deg)));
      const Lit sky = lit(shot, shot.viewpoint(pose({0.0, 300.0, 0.0}, yaw_deg, 90.0 - row.out_deg)));
      const glm::dvec3 a(below.data.water_absorption), b(below.data.water_backscatter),
          c = a + b,
          takes = glm::exp(-1.03 * glm::sqrt(1.0 + 2.4 * b / c) * c * depth_m / std::cos(glm::radians(row.in_deg)));
      for (int channel = 1; channel < 3; ++channel) {
        const double expected = row.passes * (sky.at(width / 2, height / 2) * takes)[channel];
        EXPECT_NEAR(below.at(width / 2, height / 2)[channel], expected, 0.01 * expected)
            << look.name << " " << row.in_deg << " channel " << channel;
      }
    }
  }
}

// What the water adds to lines of sight into the deep, in double: to all sides, at two depths, in three kinds of water.
// 1 %. Control seen: fading left out.
TEST_F(Underwater, TheDeepIsTheClosedForm) {
  for (const char* type : {"I", "II", "3C"}) {
    SeaShot shot(options(test::frame_looks[3],
                         with(test::flat_water, {{"camera.vertical_fov_deg", "1"}, {"water.type", type}})));
    for (const double depth_m : {1.0, 10.0})
      for (const double pitch_deg : {-89.0, -45.0, -20.0, -3.0})
        for (const double yaw_deg : {0.0, 130.0}) {
          const Viewpoint viewpoint = shot.viewpoint(pose({0.0, -depth_m, 0.0}, yaw_deg, pitch_deg));
          const Lit seen = lit(shot, viewpoint);
          const glm::dvec3 ray =
              test::pixel_ray(viewpoint.eyes.front(), width / 2 + 0.5, height / 2 + 0.5, width, height);
          const glm::dvec3 a(seen.data.water_absorption), bb(seen.data.water_backscatter),
              b(seen.data.water_scattering), c = a + bb;
          const glm::dvec3 sun(seen.data.sun), irradiance(seen.light.sun_irradiance);
          const double across = std::hypot(sun.x, sun.z) / n, up = std::sqrt(1.0 - across * across);
          const glm::dvec3 to_sun(sun.x / n, up, sun.z / n);
          const double enters = double(seen.data.water_reflectance.w);
          const glm::dvec3 down = 0.93 * glm::dvec3(seen.light.sky_irradiance) + enters * irradiance;
          const glm::dvec3 deep = glm::dvec3(seen.data.water_reflectance) * down;
          const double g = double(gpu::water_forward), falls = -ray.y, cosine = glm::dot(to_sun, ray);
          for (int i = 0; i < 3; ++i) {
            const double fading = c[i] / up, along = 1.03 * std::sqrt(1.0 + 2.4 * bb[i] / c[i]) * c[i];
            const double forwards =
                std::pow((1 + g * g + 2 * g * 0.66) / (1 + g * g + 2 * g * std::min(falls, 0.66)), 1.5);
            const double spread = deep[i] * (along + fading * falls) * forwards / (along + fading * falls);
            const double glow = b[i] *
                                std::max(gpu::henyey_greenstein(cosine, g) - gpu::henyey_greenstein(0.0, g), 0.0) *
                                irradiance[i] * enters / (up * n * n) / (a[i] + b[i] + fading * falls);
            const double expected = (spread + glow) * std::exp(-fading * depth_m);
            EXPECT_NEAR(seen.at(width / 2, height / 2)[i], expected, 0.01 * expected + 2e-7)
                << type << " " << depth_m << " m, " << pitch_deg << ", " << yaw_deg << " channel " << i;
          }
        }
  }
}

// A plate 2 m under still water from just above it is what it is from just below, as much as the surface lets through,
// and the sky that it mirrors: 3 %. Control seen: radiance in the water without the square of the index.
TEST_F(Underwater, NothingJumpsWhereTheEyeDives) {
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]}) {
    test::ShotOptions made =
        options(look, with(test::flat_water, {{"water.type", "I"}}), {"waves", "models", "underwater"});
    test::stand(
        made.objects,
        test::solid_model(
            test::solid_plate(40.0f),
            R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0,"roughnessFactor":1}})"),
        Pose{{0.0, -2.0, 0.0}});
    SeaShot shot(made);
    const Lit above = lit(shot, shot.viewpoint(pose({0.0, 0.2, 0.0}, 0.0, -89.0))),
              below = lit(shot, shot.viewpoint(pose({0.0, -0.2, 0.0}, 0.0, -89.0))),
              sky = lit(shot, shot.viewpoint(pose({0.0, 2.0, 0.0}, 180.0, 89.0)));
    const double mirrored = double(gpu::fresnel(1.0f));
    for (int i = 1; i < 3; ++i) {  // red light loses more than that in 0.2 m
      const double expected =
          (1.0 - mirrored) * below.at(width / 2, height / 2)[i] + mirrored * sky.at(width / 2, height / 2)[i];
      EXPECT_NEAR(above.at(width / 2, height / 2)[i], expected, 0.03 * expected) << look.name << " channel " << i;
    }
  }
}

// Water that sends nothing back and is seen through no farther than a step: what of a picture is wet is black, and
// level lines of sight out of the window show nothing else.
const Set black_water{{"water.type", "colour"},        {"water.red", "0.0001"},           {"water.green", "0.0001"},
                      {"water.blue", "0.0001"},        {"water.sight_m", "0.5"},          {"water.crest_light", "0"},
                      {"sky.sun_elevation_deg", "50"}, {"camera.vertical_fov_deg", "24"}, {"sky.sun_to_deg", "180"}};

struct Sides {
  int wrong = 0, wet = 0, dry = 0, wet_shown_dry = 0;
  double brightest_wet = 0.0, darkest_dry = 1e9;
};

// Each pixel's side against the water's height where its line of sight begins, on the near plane; within `unsure_m` of
// it either may be.
template <class Height>
Sides compare_sides(SeaShot& shot, const Viewpoint& viewpoint, double unsure_m, Height&& height_m) {
  const Lit seen = lit(shot, viewpoint);
  const View& eye = viewpoint.eyes.front();
  const double near_m = shot.scene().settings.render.near_m;
  const glm::dvec3 ahead = eye.pose.orientation * glm::dvec3(0.0, 0.0, -1.0);
  Sides sides;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const glm::dvec3 ray = test::pixel_ray(eye, x + 0.5, y + 0.5, width, height),
                       from = eye.pose.position_m + ray * (near_m / glm::dot(ray, ahead));
      const std::optional<double> water_m = height_m(glm::dvec2(from.x, from.z));
      if (!water_m || std::abs(from.y - *water_m) < unsure_m) continue;
      const bool wet = from.y < *water_m, shown = seen.at(x, y).y < 0.001;
      (wet ? sides.wet : sides.dry) += 1;
      sides.wrong += wet != shown;
      sides.wet_shown_dry += wet && !shown;
      (wet ? sides.brightest_wet : sides.darkest_dry) =
          wet ? std::max(sides.brightest_wet, seen.at(x, y).y) : std::min(sides.darkest_dry, seen.at(x, y).y);
    }
  return sides;
}

// Still water across the picture, rolled, lit as it is drawn and later: every pixel that is farther from the line than
// a pixel is on its side. Controls seen: in the light, the horizon asked in place of the stencil; where it is drawn,
// faces taken for backs.
TEST_F(Underwater, TheWaterlineOfStillWaterIsOnItsPixel) {
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]}) {
    SeaShot shot(options(look, with({{"waves.wind_speed_mps", "0"}, {"waves.swell_height_m", "0"}}, black_water)));
    Sides all;
    for (const double up_m : {-0.015, -0.004, 0.0, 0.003, 0.012})
      for (const double roll_deg : {0.0, 30.0, -80.0}) {
        const Viewpoint viewpoint = shot.viewpoint(pose({0.0, up_m, 0.0}, 10.0, 0.0, roll_deg));
        const double pixel_m = 0.1 * 2.0 * std::tan(glm::radians(12.0)) / height;
        const Sides sides = compare_sides(shot, viewpoint, pixel_m, [](glm::dvec2) { return std::optional(0.0); });
        EXPECT_EQ(sides.wrong, 0) << look.name << " " << up_m << " " << roll_deg;
        all.wet += sides.wet, all.dry += sides.dry;
      }
    EXPECT_GT(all.wet, 50000);
    EXPECT_GT(all.dry, 50000);
  }
}

// A sea of wind, of pictures of 20 places whose eye is within 2 cm of the water: each pixel is on the side that the
// drawn water's query says, beyond 5 mm and where it converged, where the sea is lit after it is drawn. Where pixels
// are lit as they are drawn a sliver that is seen edge on may turn a pixel over: no more than 3 in 10,000. Control
// seen: at the horizon, the felt water asked within two pixels in place of the picture's own within one.
TEST_F(Underwater, TheWaterlineOfASeaIsWhereItsQueryHasIt) {
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]}) {
    SeaShot shot(options(look, with({{"waves.wind_speed_mps", "7"}}, black_water)));
    Sides all;
    for (int i = 0; i < 20; ++i) {
      const glm::dvec2 place(31.0 * i, -17.0 * i);
      shot.draw(pose({place.x, 1.0, place.y}, 0.0, 0.0), 1.0);
      const SeaView drawn = shot.experience().ocean().waves_held();
      if (!drawn) GTEST_SKIP() << "the GPU makes the waves";
      const QueryAnswer here = drawn.query(place);
      if (!here.converged) continue;
      const Viewpoint viewpoint =
          shot.viewpoint(pose({place.x, here.height_m + 0.004 * (i % 9 - 4), place.y}, 10.0, 0.0, 7.0 * (i % 5)));
      const Sides sides = compare_sides(shot, viewpoint, 0.005, [&](glm::dvec2 at) {
        const QueryAnswer water = drawn.query(at);
        return water.converged ? std::optional(water.height_m) : std::nullopt;
      });
      all.wrong += sides.wrong, all.wet += sides.wet, all.dry += sides.dry;
      if (shot.experience().deferred()) {
        EXPECT_EQ(sides.wrong, 0) << i << ": " << sides.wet_shown_dry << " wet ones as dry; wet up to "
                                  << sides.brightest_wet << ", dry from " << sides.darkest_dry;
      }
    }
    EXPECT_LE(all.wrong, 3e-4 * (all.wet + all.dry)) << look.name;
    EXPECT_GT(all.wet, 30000) << look.name;
    EXPECT_GT(all.dry, 30000) << look.name;
  }
}

// The bed before an eye in the water is where the sea has it, within two pixels but for one in a hundred: along the
// sand, over a reef's edge, and straight down. Control seen: vertices eight times as far apart (BedMesh).
TEST_F(Underwater, TheBedIsWhereTheSeaHasIt) {
  struct Look {
    const char* scene;
    Pose head;
  };
  for (const Look& look :
       {Look{"lagoon", pose({-30.0, -2.0, -100.0}, 66.0, -12.0)},
        Look{"lagoon", pose({-62.0, -1.5, -140.0}, 200.0, -25.0)},
        Look{"lagoon", pose({-30.0, -2.5, -100.0}, 0.0, -88.0)}, Look{"wreck", pose({8.0, -10.0, 16.0}, 330.0, -30.0)},
        Look{"harbour", pose({60.0, -2.0, 60.0}, 120.0, -10.0)}}) {
    test::ShotOptions options{.scene = look.scene,
                              .preset = "medium",
                              .width = width,
                              .height = height,
                              .views = 1,
                              .set = {{"msaa", "1"}, {"frame.lighting", "deferred"}, {"frame.shape", "tile"}}};
    options.effects = load_scene(look.scene, "low").effects;
    std::erase_if(*options.effects, [](const std::string& effect) { return effect == "models" || effect == "boats"; });
    SeaShot shot(options);
    const Viewpoint viewpoint = shot.viewpoint(look.head);
    const View& eye = viewpoint.eyes.front();
    shot.draw(viewpoint, 5.0);
    const std::vector<double> away = test::distances(shot, 0);
    if (away.empty()) GTEST_SKIP() << "no depths to read";
    const SeaView sea = shot.experience().sea()->view_at(5.0, SeaDetail::felt);
    int there = 0, off = 0;
    double sum_px = 0.0;
    for (std::uint32_t y = 0; y < height; y += 2)
      for (std::uint32_t x = 0; x < width; x += 2) {
        const double ahead_m = away[std::size_t(y) * width + x];
        if (!(ahead_m < 100.0)) continue;
        const glm::dvec3 ray = test::pixel_ray(eye, x + 0.5, y + 0.5, width, height),
                         axis = eye.pose.orientation * glm::dvec3(0.0, 0.0, -1.0);
        const glm::dvec3 at = eye.pose.position_m + ahead_m / glm::dot(ray, axis) * ray;
        if (at.y > -1.0) continue;  // the surface
        const QueryAnswer water = sea.query({at.x, at.z});
        const double off_m = std::abs(at.y - (water.still_m - water.depth_m)),
                     off_px = off_m * viewpoint.pixels_per_radian / glm::distance(at, eye.pose.position_m);
        ++there;
        sum_px += off_px;
        off += off_px > 2.0;
      }
    const std::string name = std::string(look.scene) + fmt::format(" {:.0f}", look.head.position_m.x);
    EXPECT_GT(there, 1000) << name;
    EXPECT_LE(off, there / 100) << name << ": mean " << sum_px / there << " px, of " << there;
    RecordProperty(name, fmt::format("mean {:.3f} px, {} of {} beyond 2", sum_px / there, off, there));
  }
}

}  // namespace
}  // namespace seascape
