// Solid things as they are seen through the water's surface: their colour, where the water bends them to, and what must
// not be seen in it. Controls are named beside each test.
#include <gtest/gtest.h>

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

class SolidsInWater : public test::GpuTest {};

constexpr std::uint32_t width = 240, height = 180;
constexpr double index_of_water = gpu::water_index;

SeaShot shot_of(const test::FrameLook& look, const SceneObjects& objects, const test::Set& set = {}) {
  return SeaShot(test::solid_options(look, objects, width, height, set));
}

const test::Set& flat = test::flat_water;

glm::dvec3 ray(const View& eye, double x, double y) { return test::pixel_ray(eye, x, y, width, height); }

glm::dvec3 refracted(const glm::dvec3& d) {  // Snell, at level water
  const double across = std::hypot(d.x, d.z) / index_of_water, down = std::sqrt(1.0 - across * across);
  return {d.x / index_of_water, -down, d.z / index_of_water};
}

// Radiance over exposure in the middle of the picture.
glm::dvec3 middle_of(SeaShot& shot, const Viewpoint& viewpoint) {
  shot.draw(viewpoint, 1.0);
  const ImageF picture = linear_picture_of(shot.device(), shot.experience(), 0);
  const float* at = &picture.pixels[4 * (std::size_t(height / 2) * width + width / 2)];
  const std::vector<std::uint8_t> bytes = read_buffer(shot.device(), shot.experience().sky().light());
  gpu::SkyLight light;
  std::memcpy(&light, bytes.data(), sizeof light);
  return glm::dvec3(at[0], at[1], at[2]) / double(light.exposure.x);
}

// A grey plate under still water, straight down and aslant, over what deep water shows there: the closed form of water
// that is as it is everywhere (Lee et al. 1998, eqs. 1, 2, 5, 6), out through a level surface by Snell and Fresnel
// (facts/underwater.md, section 2). 3 %. Control seen: 1.34 for 1.04 in water_column().
TEST_F(SolidsInWater, APlatesColourIsTheClosedForm) {
  for (const test::FrameLook& look : {test::frame_looks[2], test::frame_looks[3]})
    for (const double depth_m : {0.5, 2.0, 10.0})
      for (const double pitch_deg : {-89.0, -50.0}) {
        SceneObjects objects, none;
        const double ahead = 3.0 / std::tan(glm::radians(-pitch_deg));
        const std::string grey =
            R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0,"roughnessFactor":1}})";
        test::stand(objects, test::solid_model(test::solid_plate(40.0f), grey), Pose{{0.0, -depth_m, 0.0}});
        test::stand(none, test::solid_model(test::solid_plate(40.0f), grey), Pose{{0.0, -depth_m, 900.0}});
        test::Set set = flat;
        set.emplace_back("sky.exposure_ev", "0");
        SeaShot with = shot_of(look, objects, set), without = shot_of(look, none, set);
        const Viewpoint viewpoint = with.viewpoint(pose({0.0, 3.0, ahead}, 0.0, pitch_deg));
        const glm::dvec3 found = middle_of(with, viewpoint) - middle_of(without, viewpoint);

        gpu::FrameData data = frame_data(with.scene().settings, viewpoint, height);
        with.experience().ocean().describe(data, viewpoint);
        const std::vector<std::uint8_t> bytes = read_buffer(with.device(), with.experience().sky().light());
        gpu::SkyLight light;
        std::memcpy(&light, bytes.data(), sizeof light);
        const glm::dvec3 a(data.water_absorption), b(data.water_backscatter), c = a + b, u = b / c;
        const glm::dvec3 down = 0.93 * glm::dvec3(light.sky_irradiance) +
                                double(data.water_reflectance.w) * glm::dvec3(light.sun_irradiance);
        const glm::dvec3 deep = glm::dvec3(data.water_reflectance) * down;
        const double sine = std::sin(glm::radians(-pitch_deg)), across = std::cos(glm::radians(-pitch_deg));
        const double eye = std::sqrt(1.0 - across * across / (index_of_water * index_of_water));
        const double sun =
            std::sqrt(1.0 - (1.0 - double(data.sun.y) * double(data.sun.y)) / (index_of_water * index_of_water));
        const glm::dvec3 scattered = glm::exp(-c * depth_m * (1.0 / sun + 1.03 * glm::sqrt(1.0 + 2.4 * u) / eye)),
                         passed = glm::exp(-c * depth_m * (1.0 / sun + 1.04 * glm::sqrt(1.0 + 5.4 * u) / eye));
        const glm::dvec3 arrived = 0.5 / 3.14159265358979 * passed;
        const double out = 1.0 - double(gpu::fresnel(float(sine)));
        const glm::dvec3 expected =
            out * (arrived / (1.0 - 1.5 * arrived) / (index_of_water * index_of_water) * down - deep * scattered);
        const glm::dvec3 all = out * deep + expected;  // beneath what the surface mirrors
        for (int channel = 0; channel < 3; ++channel)
          EXPECT_NEAR(found[channel] + (out * deep)[channel], all[channel], 0.03 * all[channel])
              << look.name << " " << depth_m << " m, " << pitch_deg << " deg, channel " << channel;
      }
}

// A lamp's square under still water: its edges are where Snell puts them, within a pixel, whether it is near or far,
// steep or aslant. Control seen: an index of 1.25.
TEST_F(SolidsInWater, ThingsAreWhereSnellPutsThem) {
  for (const test::FrameLook& look : test::sampled_looks())
    for (const double depth_m : {0.5, 2.0, 10.0}) {
      SceneObjects objects;
      const double half = 0.5 + 0.25 * depth_m, ahead = 2.0 + 1.5 * depth_m;
      test::stand(objects, test::solid_model(test::solid_plate(float(half)), test::unlit_magenta),
                  Pose{{0.0, -depth_m, -ahead}});
      test::stand(objects, test::solid_model(test::solid_box({0.01f, 0.01f, 0.01f}), "{}"), Pose{{0.0, -18.0, -6.0}});
      test::Set set = flat;
      set.emplace_back("water.chlorophyll_mg_m3", "0.03");
      SceneObjects nowhere, everywhere;
      test::stand(nowhere, objects.models.front(), Pose{{0.0, -2.0, 900.0}});
      test::stand(everywhere, test::solid_model(test::solid_plate(300.0f), test::unlit_magenta),
                  Pose{{0.0, -depth_m, 0.0}});
      SeaShot shot = shot_of(look, objects, set), no_shot = shot_of(look, nowhere, set),
              all_shot = shot_of(look, everywhere, set);
      for (const double up_m : {1.7, 6.0}) {
        const Viewpoint viewpoint =
            shot.viewpoint(pose({0.2, up_m, 0.0}, 0.0, -glm::degrees(std::atan2(up_m + 0.6 * depth_m, ahead))));
        const Image8 picture = shot.picture(viewpoint, 1.0), none = no_shot.picture(viewpoint, 1.0),
                     all = all_shot.picture(viewpoint, 1.0);
        const View& eye = viewpoint.eyes.front();
        const auto on_plate = [&](double x, double y) {
          const glm::dvec3 d = ray(eye, x, y);
          if (d.y > -1e-3) return false;
          const glm::dvec3 at = eye.pose.position_m + d * (-up_m / d.y), in = refracted(d),
                           met = at + in * (depth_m / -in.y);
          return std::abs(met.x) < half && std::abs(met.z + ahead) < half;
        };
        int wrong = 0, shown = 0;
        for (std::size_t y = 0; y < height; ++y)
          for (std::size_t x = 0; x < width; ++x) {
            int of_it = 0, of_all = 0;
            for (const std::size_t channel : {0u, 2u}) {
              const std::size_t i = 4 * (y * width + x) + channel;
              of_it += int(picture.pixels[i]) - int(none.pixels[i]);
              of_all += int(all.pixels[i]) - int(none.pixels[i]);
            }
            if (std::abs(of_all) < 12) continue;  // there the water mirrors too much
            const bool is = 2 * std::abs(of_it) > std::abs(of_all);
            shown += is;
            int as_it_should = 0;
            for (const double v : {-1.0, 0.0, 1.0})
              for (const double h : {-1.0, 0.0, 1.0})
                as_it_should += on_plate(double(x) + 0.5 + h, double(y) + 0.5 + v) == is;
            wrong += as_it_should == 0;
          }
        EXPECT_GT(shown, 150) << look.name << depth_m << up_m;
        EXPECT_EQ(wrong, 0) << look.name << " " << depth_m << " m deep, from " << up_m << " m "
                            << test::leave(picture, "snell");
      }
    }
}

// A post hangs over a swell, dipped by no crest that is there, in sight of the water behind: the water never takes its
// colour. Control seen: things are met up to 50 m in front of the line.
TEST_F(SolidsInWater, NothingBeforeTheWaterIsSeenInIt) {
  for (const test::FrameLook& look : {test::frame_looks[1], test::frame_looks[2]}) {
    SceneObjects objects;
    test::stand(objects, test::solid_model(test::solid_box({0.15f, 1.2f, 0.15f}), test::unlit_magenta),
                Pose{{0.0, 1.9, -4.0}});
    test::stand(objects, test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), "{}"), Pose{{2.0, -8.0, -7.0}});
    SeaShot shot = shot_of(look, objects,
                           {{"waves.wind_speed_mps", "0"},
                            {"waves.swell_height_m", "0.7"},
                            {"waves.swell_period_s", "7"},
                            {"sky.sun_elevation_deg", "50"}});
    for (int moment = 0; moment < 8; ++moment) {
      const Viewpoint viewpoint = shot.viewpoint(pose({0.3, 2.6, 0.0}, 0.0, -28.0));
      const Image8 picture = shot.picture(viewpoint, 1.7 * moment);
      ASSERT_TRUE(shot.experience().solids()->any_in_water());
      const View& eye = viewpoint.eyes.front();
      int seen_of_it = 0;
      for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
          const std::uint8_t* p = &picture.pixels[4 * (y * width + x)];
          if (!(p[0] > 90 && p[2] > 90 && p[1] < 70)) continue;
          ++seen_of_it;
          bool is_there = false;
          for (const double v : {-1.0, 0.0, 1.0})
            for (const double h : {-1.0, 0.0, 1.0}) {
              const glm::dvec3 d = ray(eye, double(x) + 0.5 + h, double(y) + 0.5 + v);
              double near = 0.0, far = 1e30;
              for (int axis = 0; axis < 3; ++axis) {
                const double middle = glm::dvec3(0.0, 1.9, -4.0)[axis], half = axis == 1 ? 1.2 : 0.15;
                const double s = (middle - half - eye.pose.position_m[axis]) / d[axis],
                             t = (middle + half - eye.pose.position_m[axis]) / d[axis];
                near = std::max(near, std::min(s, t));
                far = std::min(far, std::max(s, t));
              }
              is_there = is_there || near < far;
            }
          EXPECT_TRUE(is_there) << look.name << " " << moment << ": " << x << ", " << y
                                << test::leave(picture, "before");
          if (HasFailure()) return;
        }
      EXPECT_GT(seen_of_it, 200);
    }
  }
}

// Things that are all above the water cost no pass, and those that are not one. Control seen: all things taken
// for wet.
TEST_F(SolidsInWater, OnlyWhatMayBeUnderWaterHasAPass) {
  for (const test::FrameLook& look : test::sampled_looks()) {
    const auto passes = [&](double up_m) {
      SceneObjects objects;
      test::stand(objects, test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), "{}"), Pose{{0.0, up_m, -6.0}});
      SeaShot shot = shot_of(look, objects, flat);
      for (const double time_s : {1.0, 1.1}) shot.draw(pose({0.0, 2.0, 0.0}, 0.0, -15.0), time_s);
      return shot.counts().passes;
    };
    const std::uint64_t above = passes(3.0), below = passes(-3.0);
    EXPECT_EQ(below, above + 1) << look.name;
  }
}

// Two boxes above the water, in a model whose bounds reach into it: nothing is drawn to be seen in the water, so
// nothing is looked for there, in a picture that nobody has drawn. Control seen: select_in_water() that gives the
// bounds all the same.
TEST_F(SolidsInWater, BoundsInTheWaterShowNothingThere) {
  for (const test::FrameLook& look : test::sampled_looks()) {
    const auto picture = [&](const char* seen_in_water) {
      SceneObjects objects;
      test::stand(objects,
                  test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), "{}",
                                    R"({"children":[1,2]},{"mesh":0,"translation":[-3,-3,0]},)"
                                    R"({"mesh":0,"translation":[3,3,0]})"),
                  Pose{{0.0, 2.0, -12.0}, glm::angleAxis(glm::radians(-45.0), glm::dvec3(0.0, 0.0, 1.0))});
      test::Set set = flat;
      set.push_back({"models.seen_in_water", seen_in_water});
      SeaShot shot = shot_of(look, objects, set);
      return shot.picture(pose({0.0, 2.0, 0.0}, 0.0, -15.0), 1.0);
    };
    const Image8 with = picture("true"), without = picture("false");
    EXPECT_LT(test::difference(with, without).p99, 0.005) << look.name << test::leave(with, "seen in water");
  }
}

}  // namespace
}  // namespace seascape
