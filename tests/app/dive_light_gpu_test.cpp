// The light that a diver carries, against Beer's law and sums in double precision, and his bubbles. Controls are
// named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "app/frame.h"
#include "app/lamp.h"
#include "app/program.h"
#include "shaders/shared/fresnel.h"
#include "shaders/shared/lamp_light.h"
#include "tests/support/gpu/frame_shapes.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using test::Set;

class DiveLight : public test::GpuTest {};

constexpr std::uint32_t width = 96, height = 72;
constexpr double pi = 3.14159265358979323846, n = gpu::water_index;
const char* const paint =
    R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0,"roughnessFactor":1}})";

// Night, or nearly: what is seen is the lamp's.
test::ShotOptions options(const test::FrameLook& look, Set set,
                          std::vector<std::string> effects = {"waves", "models", "underwater"}) {
  set.insert(set.end(), test::flat_water.begin(), test::flat_water.end());
  set.insert(set.end(), {{"water.type", "II"},
                         {"water.adaptation", "0"},
                         {"sky.sun_elevation_deg", "-4"},
                         {"camera.vertical_fov_deg", "50"}});
  test::ShotOptions options = test::solid_options(look, {}, width, height, set);
  options.effects = std::move(effects);
  return options;
}

// A plate across the view, `ahead_m` before the eye's place.
void stand_plate(test::ShotOptions& made, double ahead_m, double up_m) {
  test::stand(made.objects, test::solid_model(test::solid_box({3.0f, 3.0f, 0.05f}), paint),
              Pose{{0.0, up_m, -ahead_m - 0.05}});
}

struct Lit {
  ImageF picture;
  double exposure = 1.0;
  glm::dvec3 at(std::uint32_t x, std::uint32_t y) const {
    const float* p = &picture.pixels[4 * (std::size_t(y) * width + x)];
    return glm::dvec3(p[0], p[1], p[2]) / exposure;
  }
};

Lit lit(SeaShot& shot, const Viewpoint& viewpoint) {
  shot.draw(viewpoint, 1.0);
  gpu::SkyLight light;
  const std::vector<std::uint8_t> bytes = read_buffer(shot.device(), shot.experience().sky().light());
  std::memcpy(&light, bytes.data(), sizeof light);
  return {linear_picture_of(shot.device(), shot.experience(), 0), double(light.exposure.x)};
}

struct Water {
  glm::dvec3 attenuation, scattering;
};
Water water_of(SeaShot& shot, const Viewpoint& viewpoint) {
  gpu::FrameData data = frame_data(shot.scene().settings, viewpoint, height);
  shot.experience().ocean().describe(data, viewpoint);
  return {glm::dvec3(data.water_absorption) + glm::dvec3(data.water_scattering), glm::dvec3(data.water_scattering)};
}

// The beam in `way_m` metres of a line of sight: a sum of many short steps, by itself (tests/ocean/surface/
// lamp_light_test.cpp has a finer one).
glm::dvec3 beam_along(const glm::dvec3& lamp_m, const glm::dvec3& beam, const glm::dvec3& ray, double half_rad,
                      const Water& water, double way_m) {
  glm::dvec3 sum(0.0);
  constexpr int steps = 20000;
  const double g = double(gpu::water_forward), narrowness = std::log(2.0) / (1.0 - std::cos(half_rad));
  for (int i = 0; i < steps; ++i) {
    const double a = way_m * std::pow(double(i) / steps, 2.0), b = way_m * std::pow(double(i + 1) / steps, 2.0),
                 t = 0.5 * (a + b);
    const glm::dvec3 line = t * ray - lamp_m;
    const double range = std::max(glm::length(line), 0.02), turned = -glm::dot(line, ray) / range;
    const double phase = (1.0 - g * g) / (4.0 * pi * std::pow(1.0 + g * g - 2.0 * g * turned, 1.5));
    sum += (b - a) * std::exp(narrowness * (glm::dot(line, beam) / range - 1.0)) / (range * range) * phase *
           glm::exp(-water.attenuation * (range + t));
  }
  return sum * water.scattering;
}

const Pose lamp{{0.25, -0.2, -0.1}, glm::angleAxis(0.12, glm::dvec3(0.0, 1.0, 0.0))};

// In open water on either side of the beam, and on a plate across it at 1.2, 3 and 6 m: the plate's paint by Beer's law
// and the square of the distance, there and back, and the beam in between. 4 % and 1.5e-4 1/m^2 of the beam
// (LampLight); a half float's rounding of the sum. Red fades over the plates' distances by the attenuation alone: it
// returns with a near lamp. Controls seen: the way back left out; the square of the index left out. the lamp at the
// eye.
TEST_F(DiveLight, LightsPlatesAndWaterAsItsLawsHaveIt) {
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]})
    for (const double ahead_m : {0.0, 1.2, 3.0, 6.0}) {
      test::ShotOptions made = options(look, {{"dive_light.held", "hand"}, {"dive_light.beam_deg", "24"}});
      stand_plate(made, ahead_m > 0.0 ? ahead_m : 200.0, -10.0);
      SeaShot shot(made);
      const Pose head = pose({0.0, -10.0, 0.0}, 0.0, 0.0);
      const Viewpoint viewpoint = shot.viewpoint(head);
      shot.experience().hold_lamp(composed(head, lamp));
      const Lit dark = lit(shot, viewpoint);
      shot.set("dive_light.on", "true");
      const Lit bright = lit(shot, viewpoint);
      const Water water = water_of(shot, viewpoint);
      const gpu::LampData told = lamp_data(shot.scene().settings.dive_light, head, composed(head, lamp));
      const glm::dvec3 intensity(told.intensity), beam = lamp.orientation * glm::dvec3(0.0, 0.0, -1.0);
      for (const std::uint32_t y : {20u, 36u, 50u})
        for (const std::uint32_t x : {10u, 30u, 48u, 60u, 90u}) {
          const glm::dvec3 ray = test::pixel_ray(viewpoint.eyes.front(), x + 0.5, y + 0.5, width, height);
          const double way_m = ahead_m > 0.0 ? ahead_m / -ray.z : 60.0;
          glm::dvec3 expected = beam_along(lamp.position_m, beam, ray, glm::radians(12.0), water, way_m) * intensity;
          if (ahead_m > 0.0) {
            const glm::dvec3 line = way_m * ray - lamp.position_m;
            const double range = glm::length(line), cosine = -line.z / range,
                         share = std::exp(std::log(0.5) * (1.0 - glm::dot(line, beam) / range) /
                                          (1.0 - std::cos(glm::radians(12.0))));
            expected += intensity * share / (range * range) * cosine * (0.5 / pi) *
                        glm::exp(-water.attenuation * (range + way_m));
          }
          expected /= n * n;
          for (int i = 0; i < 3; ++i)
            EXPECT_NEAR((bright.at(x, y) - dark.at(x, y))[i], expected[i],
                        0.04 * expected[i] + 1.5e-4 * water.scattering[i] * intensity[i] + 1.5e-3 * bright.at(x, y)[i])
                << look.name << " " << ahead_m << " m, " << x << " " << y << " channel " << i;
        }
    }
}

// Above the water it is the square of the distance alone: a plate at 4 m has a quarter of one at 2 m, within 1 %, and
// what paint of half sends back, within a tenth (its gloss takes some). Control: the water's attenuation in the air.
TEST_F(DiveLight, LightsThingsInTheAirToo) {
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]}) {
    glm::dvec3 sent[2], intensity;
    for (const int k : {0, 1}) {
      test::ShotOptions made = options(look, {{"dive_light.held", "hand"}, {"sky.visibility_m", "1000000"}});
      stand_plate(made, 2.0 * (k + 1), 20.0);
      SeaShot shot(made);
      const Pose head = pose({0.0, 20.0, 0.0}, 0.0, 0.0);
      shot.experience().hold_lamp(head);
      const Lit dark = lit(shot, shot.viewpoint(head));
      shot.set("dive_light.on", "true");
      sent[k] = lit(shot, shot.viewpoint(head)).at(width / 2, height / 2) - dark.at(width / 2, height / 2);
      intensity = glm::dvec3(lamp_data(shot.scene().settings.dive_light, head, head).intensity);
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(sent[0][i] / sent[1][i], 4.0, 0.05) << look.name << i;
      EXPECT_NEAR(sent[0][i], intensity[i] / 4.0 * 0.5 / pi, 0.1 * sent[0][i]) << look.name << i;
    }
  }
}

// Off it records the same draws, and a lamp of no light is the same picture to the bit, in and out of the water;
// one that shines is not. Control: all that is in the water a fiftieth brighter while the lamp is on.
TEST_F(DiveLight, AddsNothingButItsLight) {
  for (const test::FrameLook& look : test::sampled_looks())
    for (const double up_m : {-3.0, 2.0}) {
      test::ShotOptions made = options(look, {});
      stand_plate(made, 3.0, up_m);
      SeaShot shot(made);
      const Pose head = pose({0.0, up_m, 0.0}, 10.0, -5.0);
      const Image8 off = shot.picture(head, 1.0);
      const auto draws = shot.counts().draws;
      const std::uint64_t builds = shot.experience().builds();
      shot.set("dive_light.candela", "0");
      shot.set("dive_light.on", "true");
      EXPECT_EQ(test::differing_pixels(shot.picture(head, 1.0), off), 0) << look.name << up_m;
      shot.set("dive_light.candela", "20000");
      EXPECT_GT(test::differing_pixels(shot.picture(head, 1.0), off), 300) << look.name << up_m;
      EXPECT_EQ(shot.counts().draws, draws) << look.name << up_m;
      EXPECT_EQ(shot.experience().builds(), builds);
    }
}

// Bubbles are one draw more where an eye is in the water and has breathed, and none where it is dry, where they are
// off, or before the first breath; in the water they are seen. Control seen: drawn by a dry eye too.
TEST_F(DiveLight, BubblesAreDrawnInTheWaterAlone) {
  for (const test::FrameLook& look : test::sampled_looks()) {
    SeaShot with(options(look, {{"sky.sun_elevation_deg", "50"}, {"waves.wind_speed_mps", "0"}})),
        without(
            options(look, {{"sky.sun_elevation_deg", "50"}, {"waves.wind_speed_mps", "0"}, {"breath.on", "false"}}));
    const Pose mouth = pose({0.0, -2.0, -1.2}, 0.0, 0.0), below = pose({0.0, -1.5, 0.5}, 0.0, 5.0),
               dry = pose({0.0, 2.0, 0.5}, 0.0, -40.0);
    const auto shown = [&](SeaShot& shot, const Pose& eye) {
      for (double t = 0.0; t < 9.0; t += 0.25) shot.experience().breathe(t, mouth);
      const Image8 picture = shot.picture(eye, 9.0);
      return std::pair(picture, shot.counts().draws);
    };
    const auto [seen, draws] = shown(with, below);
    const auto [plain, fewer] = shown(without, below);
    EXPECT_EQ(draws, fewer + 1) << look.name;
    EXPECT_GT(test::differing_pixels(seen, plain), 100) << look.name << test::leave(seen, "bubbles");
    const auto [above, dry_draws] = shown(with, dry);
    const auto [wanted, as_many] = shown(without, dry);
    EXPECT_EQ(dry_draws, as_many) << look.name;
    EXPECT_EQ(test::differing_pixels(above, wanted), 0) << look.name;
  }
}

}  // namespace
}  // namespace seascape
