// Solid things above the water as eyes in it see them through its surface: where they are, how bright, and that eyes in
// the air pay nothing for them. Controls are named beside each test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/frame.h"
#include "app/program.h"
#include "shaders/shared/fresnel.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

class SolidsAboveWater : public test::GpuTest {};

constexpr std::uint32_t width = 320, height = 240;
constexpr double index_of_water = gpu::water_index;

SeaShot shot_of(const test::FrameLook& look, const SceneObjects& objects) {
  test::ShotOptions options = test::solid_options(look, objects, width, height, test::flat_water);
  options.effects = std::vector<std::string>{"waves", "models", "underwater"};
  options.set.emplace_back("water.chlorophyll_mg_m3", "0.03");
  options.set.emplace_back("sky.exposure_ev", "0");
  options.set.emplace_back("water.adaptation", "0");
  return SeaShot(options);
}

// A lamp's box above still water, from below: overhead, beside, and where the window ends; near it and far. Snell's
// pixels of it show it, within three, which are a texel and a half. Others do not, within ten: the pictures do not have
// what it hides from their middle, and a ray that passes close behind it is taken for one that meets it. Controls seen:
// an index of 1.25; the direction alone looked up; the search's beginning a little late; a sixteenth of its steps;
// things taken for three times as thick; a part not cut off where the next picture begins.
TEST_F(SolidsAboveWater, ThingsAreWhereSnellPutsThem) {
  struct Case {
    glm::dvec3 at, half;
    double depth_m, yaw_deg, pitch_deg;
  };
  const Case cases[] = {
      {{0.0, 1.5, 0.0}, {0.6, 0.3, 0.4}, 2.0, 0.0, 88.0},    {{0.0, 2.0, -3.0}, {1.5, 0.5, 0.5}, 3.0, 0.0, 50.0},
      {{-6.0, 1.5, 1.0}, {0.5, 1.4, 2.0}, 1.5, 270.0, 40.0}, {{7.0, 2.2, -1.0}, {0.5, 2.0, 3.0}, 4.0, 90.0, 40.0},
      {{1.0, 4.0, 14.0}, {3.0, 3.5, 3.0}, 0.5, 180.0, 40.0}, {{4.0, 4.5, -4.0}, {0.7, 2.5, 0.7}, 8.0, 45.0, 55.0},
  };
  SceneObjects nothing, everywhere;
  test::stand(nothing, test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), test::unlit_magenta),
              Pose{{0.0, 3.0, 4000.0}});
  test::stand(everywhere, test::solid_model(test::solid_box({300.0f, 0.1f, 300.0f}), test::unlit_magenta),
              Pose{{0.0, 3.0, 0.0}});
  for (const test::FrameLook& look : test::sampled_looks()) {
    SeaShot none_shot = shot_of(look, nothing), all_shot = shot_of(look, everywhere);
    for (const Case& one : cases) {
      SceneObjects objects;
      test::stand(objects, test::solid_model(test::solid_box(glm::vec3(one.half)), test::unlit_magenta), Pose{one.at});
      SeaShot shot = shot_of(look, objects);
      const Viewpoint viewpoint = shot.viewpoint(pose({0.0, -one.depth_m, 0.0}, one.yaw_deg, one.pitch_deg));
      const Image8 picture = shot.picture(viewpoint, 1.0), none = none_shot.picture(viewpoint, 1.0),
                   all = all_shot.picture(viewpoint, 1.0);
      ASSERT_TRUE(shot.experience().solids()->any_above());
      const View& eye = viewpoint.eyes.front();
      const auto on_it = [&](double x, double y) {
        const glm::dvec3 d = test::pixel_ray(eye, x, y, width, height);
        const double across = index_of_water * std::hypot(d.x, d.z);
        if (d.y <= 0.0 || across >= 1.0) return false;
        const glm::dvec3 leaves(index_of_water * d.x, std::sqrt(1.0 - across * across), index_of_water * d.z);
        const glm::dvec3 at = eye.pose.position_m + d * (-eye.pose.position_m.y / d.y);
        return test::meets_box(at, leaves, one.at, one.half, 0.0);
      };
      int wrong = 0, shown = 0;
      for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
          int of_it = 0, of_all = 0;
          for (std::size_t i = 4 * (y * width + x), channel = 0; channel < 3; ++channel) {
            of_it += std::abs(int(picture.pixels[i + channel]) - int(none.pixels[i + channel]));
            of_all += std::abs(int(all.pixels[i + channel]) - int(none.pixels[i + channel]));
          }
          const bool outside = of_all < 30;  // of the window, or where it lets little through
          const bool is = outside ? of_it > 30 : 2 * of_it > of_all;
          if (outside && !is) continue;
          shown += is;
          const int near = is ? 10 : 3;
          bool as_it_should = false;
          for (int v = -near; v <= near && !as_it_should; ++v)
            for (int h = -near; h <= near && !as_it_should; ++h)
              as_it_should = on_it(double(x) + 0.5 + h, double(y) + 0.5 + v) == is;
          wrong += !as_it_should;
        }
      EXPECT_GT(shown, 150) << look.name << " case " << &one - cases
                            << test::leave(picture, "above" + std::to_string(&one - cases));
      EXPECT_EQ(wrong, 0) << look.name << " case " << &one - cases
                          << test::leave(picture, "above" + std::to_string(&one - cases));
    }
  }
}

// Of a plate overhead the water shows what its light keeps through the surface (Fresnel) and on the way down. 2 %.
// Controls seen: what passes the surface taken for all of it; the exposure left in.
TEST_F(SolidsAboveWater, APlatesLightComesThroughTheSurface) {
  const auto plate = [](double grey) {
    SceneObjects objects;
    const std::string value = std::to_string(grey);
    test::stand(objects,
                test::solid_model(test::solid_box({30.0f, 0.1f, 30.0f}),
                                  R"({"pbrMetallicRoughness":{"baseColorFactor":[)" + value + "," + value + "," +
                                      value + R"(,1]},"extensions":{"KHR_materials_unlit":{}}})"),
                Pose{{0.0, 3.0, 0.0}});
    return objects;
  };
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]})
    for (const double depth_m : {0.5, 4.0}) {
      SeaShot bright = shot_of(look, plate(0.8)), dim = shot_of(look, plate(0.4));
      const Viewpoint viewpoint = bright.viewpoint(pose({0.0, -depth_m, 0.0}, 0.0, 89.0));
      const auto middle_of = [&](SeaShot& shot) {
        shot.draw(viewpoint, 1.0);
        const ImageF picture = linear_picture_of(shot.device(), shot.experience(), 0);
        const float* at = &picture.pixels[4 * (std::size_t(height / 2) * width + width / 2)];
        return glm::dvec3(at[0], at[1], at[2]);
      };
      const glm::dvec3 found = middle_of(bright) - middle_of(dim);
      gpu::FrameData data = frame_data(bright.scene().settings, viewpoint, height);
      bright.experience().ocean().describe(data, viewpoint);
      const glm::dvec3 c = glm::dvec3(data.water_absorption) + glm::dvec3(data.water_backscatter),
                       u = glm::dvec3(data.water_backscatter) / c;
      const glm::dvec3 expected =
          0.4 * (1.0 - double(gpu::fresnel(1.0f))) * glm::exp(-1.03 * glm::sqrt(1.0 + 2.4 * u) * c * depth_m);
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(found[channel], expected[channel], 0.02 * expected[channel])
            << look.name << " " << depth_m << " m, channel " << channel;
    }
}

// Eyes in the air have no pass for it, nor do eyes in the water over which nothing stands. Controls seen: the pictures
// drawn for all eyes; things under water taken for what stands above it.
TEST_F(SolidsAboveWater, OnlyEyesInTheWaterHaveAPassForIt) {
  for (const test::FrameLook& look : test::sampled_looks()) {
    const auto above = [&](double thing_m, double eye_m) {
      SceneObjects objects;
      test::stand(objects, test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), "{}"), Pose{{0.0, thing_m, -20.0}});
      SeaShot shot = shot_of(look, objects);
      for (const double time_s : {1.0, 1.1}) shot.draw(pose({0.0, eye_m, 0.0}, 0.0, 0.0), time_s);
      const std::vector<PassTime>& times = shot.experience().frame().times();
      return std::any_of(times.begin(), times.end(),
                         [](const PassTime& pass) { return std::string_view(pass.name) == "above"; });
    };
    EXPECT_TRUE(above(3.0, -2.0)) << look.name;
    EXPECT_FALSE(above(3.0, 2.0)) << look.name;
    EXPECT_FALSE(above(-3.0, -2.0)) << look.name;
  }
}

}  // namespace
}  // namespace seascape
