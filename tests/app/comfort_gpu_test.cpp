// What comfort draws: a vignette of the same directions in both eyes, and a line at the Earth's horizon, in each shape
// of the frame. Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/multiview_check.h"
#include "tests/support/gpu/frame_shapes.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/gpu/settings_that_act.h"
#include "tests/support/gpu/solid_shot.h"

namespace seascape {

namespace {

using test::pose;
using test::SeaShot;
using test::ShotOptions;

class ComfortDrawn : public test::GpuTest {};

using Shape = test::FrameLook;
const auto& shapes = test::frame_looks;

constexpr double time_s = 5.0;
constexpr std::uint32_t width = 152, height = 160;

ShotOptions options(const Shape& shape, bool comfort = true) {
  ShotOptions o{.scene = "open_sea", .preset = "low", .width = width, .height = height, .views = 2};
  o.comfort = comfort;
  o.per_eye = !multiview_works(test::device(), test::shaders());
  o.set = shape.set;
  for (const auto& [key, value] : {std::pair("waves.resolution", "32"), {"waves.cascades", "2"}})
    o.set.emplace_back(key, value);
  return o;
}

// A headset's eyes: they see more outwards than inwards, and their screens are turned outwards by 8 degrees.
Viewpoint headset(const Pose& head, double scale = 1.0) {
  Viewpoint viewpoint{head, stereo_views(head, {}, 0.064), 0.0};
  viewpoint.eyes[0].fov = {-1.19 * scale, 1.0 * scale, 1.11 * scale, -1.19 * scale};
  viewpoint.eyes[1].fov = {-1.0 * scale, 1.19 * scale, 1.11 * scale, -1.19 * scale};
  for (const int eye : {0, 1})
    viewpoint.eyes[std::size_t(eye)].pose.orientation =
        head.orientation * glm::angleAxis(glm::radians(scale * (eye == 0 ? 8.0 : -8.0)), glm::dvec3(0.0, 1.0, 0.0));
  viewpoint.pixels_per_radian = pixels_per_radian(viewpoint.eyes, height);
  return viewpoint;
}

// World direction of a pixel's middle, or of another place in it; of unit length.
glm::dvec3 ray(const View& eye, double x, double y) { return test::pixel_ray(eye, x, y, width, height); }

double elevation_deg(const View& eye, double x, double y) { return glm::degrees(std::asin(ray(eye, x, y).y)); }

double encoded(double light) {  // IEC 61966-2-1, 0 to 255
  return 255.0 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055);
}

// How dark the vignette is in a direction: 0 clear to 1, and what shines through it.
double darkness(const glm::dvec3& direction, const Pose& head, const ComfortShown& shown) {
  const glm::dvec3 ahead = head.orientation * glm::dvec3(0.0, 0.0, -1.0);
  const double off_deg = glm::degrees(std::acos(std::clamp(glm::dot(direction, ahead), -1.0, 1.0)));
  const double t = std::clamp((off_deg - 0.5 * shown.clear_deg) / shown.soft_deg, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}
double through(double dark) { return (1.0 - dark) * (1.0 - dark); }

// The noise that hides the steps of 8 bits (Jimenez 2014), -0.5 to 0.5.
double noise(double x, double y) {
  const auto fract = [](double v) { return v - std::floor(v); };
  return fract(52.9829189 * fract(0.06711056 * x + 0.00583715 * y)) - 0.5;
}

const glm::dvec3 night{0.0012, 0.0019, 0.0027};

// Heads that are level, and rolled and pitched.
std::vector<Pose> heads() { return {pose({3.0, 6.0, -7.0}, 20.0, 0.0), pose({3.0, 6.0, -7.0}, 160.0, -12.0, 35.0)}; }

// In both eyes, pixel by pixel, against the formula in double precision. Controls: the angle measured from the middle
// of each eye's picture, from where the left eye's screen faces, twice as wide, a darkness that is even in light, and
// no dither.
TEST_F(ComfortDrawn, TheVignetteIsOfTheSameDirectionsInBothEyes) {
  for (const Shape& shape : shapes) {
    SeaShot shot(options(shape));
    for (const Pose& head : heads()) {
      const Viewpoint eyes = headset(head);
      const ComfortShown shown{.clear_deg = 64.0, .soft_deg = 16.0};
      shot.experience().show_comfort({});
      const auto plain = shot.pictures(eyes, time_s);
      shot.experience().show_comfort(shown);
      const auto drawn = shot.pictures(eyes, time_s);
      for (std::size_t eye = 0; eye < 2; ++eye) {
        int clear = 0, edge = 0, dark = 0, wrong = 0;
        double worst = 0.0, with_noise = 0.0, noises = 0.0;
        for (std::size_t i = 0; i < std::size_t(width) * height; ++i) {
          const double d = darkness(ray(eyes.eyes[eye], double(i % width) + 0.5, double(i / width) + 0.5), head, shown);
          (d == 0.0 ? clear : d == 1.0 ? dark : edge)++;
          const glm::dvec3 light = test::light_at(plain[eye], i) * through(d) + night * (1.0 - through(d));
          for (int c = 0; c < 3; ++c) {
            const double darker = encoded(light[c]) - drawn[eye].pixels[4 * i + std::size_t(c)], off = std::abs(darker);
            if (d > 0.0 && d < 1.0) {
              const double n = noise(double(i % width) + 0.5, double(i / width) + 0.5);
              with_noise += darker * n;
              noises += n * n;
            }
            worst = std::max(worst, off);
            wrong += off > (d == 0.0 ? 0.01 : 2.5);
          }
        }
        EXPECT_EQ(wrong, 0) << shape.name << " " << eye << ", worst " << worst << " "
                            << test::leave(drawn[eye], "comfort_" + shape.name + std::to_string(eye));
        EXPECT_GT(with_noise / noises, 0.3) << shape.name << ": steps that the noise makes, of about one in 8 bits";
        EXPECT_GT(clear, 3000);
        EXPECT_GT(edge, 3000);
        EXPECT_GT(dark, 3000);
      }
    }
  }
}

// How much of each pixel the horizon's line covers, from pictures without it and with it. In the dark it is fainter.
std::vector<double> line_in(const Image8& without, const Image8& with, const View& eye, const Pose& head,
                            const ComfortShown& shown) {
  constexpr double strength = 0.3, in_dark = 0.3, light = 0.80;  // of red
  std::vector<double> share;
  for (std::size_t i = 0; i < std::size_t(width) * height; ++i) {
    const double dark =
        1.0 - through(darkness(ray(eye, double(i % width) + 0.5, double(i / width) + 0.5), head, shown));
    const double before = test::light_at(without, i).x, line = strength * (1.0 - (1.0 - in_dark) * dark);
    share.push_back((test::light_at(with, i).x - before) / (line * (light - before)));
  }
  return share;
}

// The line by narrow eyes, of 0.06 degrees a pixel, and by a headset's; by a dark night, so that it is told from the
// sky. Controls: a line across each eye's picture, one that rolls with the head, one 0.3 degrees too high, one three
// times as thick, and one under the vignette.
TEST_F(ComfortDrawn, TheLineStaysAtTheEarthsHorizon) {
  for (const Shape& shape : shapes) {
    ShotOptions night_options = options(shape);
    night_options.set.emplace_back("sky.exposure_ev", "-10");
    SeaShot shot(night_options);
    for (const double scale : {0.08, 1.0})
      for (const Pose& head : {pose({3.0, 6.0, -7.0}, 20.0, 0.5), pose({3.0, 6.0, -7.0}, 160.0, -2.0, 35.0)}) {
        const Viewpoint eyes = headset(head, scale);
        for (const bool vignette : {false, true}) {
          ComfortShown shown{.clear_deg = 20.0 * scale, .soft_deg = 4.0};
          if (!vignette) shown.clear_deg = 360.0;
          shot.experience().show_comfort(shown);
          const auto without = shot.pictures(eyes, time_s);
          shown.horizon_line = true;
          shot.experience().show_comfort(shown);
          const auto with = shot.pictures(eyes, time_s);
          for (std::size_t eye = 0; eye < 2; ++eye) {
            const View& view = eyes.eyes[eye];
            const std::string what = shape.name + " " + std::to_string(scale) + " " + std::to_string(eye) +
                                     (vignette ? " vignette " : " ") +
                                     test::leave(with[eye], "comfort_line_" + shape.name + std::to_string(eye));
            const std::vector<double> share = line_in(without[eye], with[eye], view, head, shown);
            const bool narrow = scale < 0.5;
            int columns = 0;
            double mean_deg = 0.0;
            for (std::size_t x = 0; x < width; ++x) {
              const auto elevation = [&](double y) { return elevation_deg(view, double(x) + 0.5, y); };
              if (elevation(4.0) < 0.0 || elevation(height - 4.0) > 0.0) continue;  // it goes out above or below
              ++columns;
              double thick_deg = 0.0, moment = 0.0;
              for (std::size_t y = 0; y < height; ++y) {
                const double s = share[y * width + x], middle = elevation(double(y) + 0.5),
                             across = elevation(double(y)) - elevation(double(y) + 1.0);
                thick_deg += s * across;
                moment += s * across * middle;
                if (s > 0.02) {
                  ASSERT_LT(std::abs(middle), narrow ? 0.2 : 0.075 + across) << what << ", column " << x;
                }
              }
              mean_deg += thick_deg;
              if (!narrow) continue;
              ASSERT_NEAR(thick_deg, 0.15, 0.02) << what << ", column " << x;
              ASSERT_NEAR(moment / thick_deg, 0.0, 0.02) << what << ", column " << x;
            }
            EXPECT_NEAR(mean_deg / columns, 0.15, 0.01) << what;
            EXPECT_GT(columns, 60) << what;
          }
        }
      }
  }
}

// Control: a pipeline without its value of multiview.
TEST_F(ComfortDrawn, OnePassEqualsEachEye) {
  if (!multiview_works(test::device(), test::shaders())) GTEST_SKIP() << "this driver draws multiview passes wrongly";
  for (const Shape& shape : shapes)
    for (const Pose& head : heads()) {
      const ComfortShown shown{.clear_deg = 64.0, .soft_deg = 16.0, .horizon_line = true};
      std::vector<Image8> pictures[2];
      for (const bool per_eye : {false, true}) {
        ShotOptions o = options(shape);
        o.per_eye = per_eye;
        SeaShot shot(o);
        shot.experience().show_comfort(shown);
        pictures[per_eye] = shot.pictures(headset(head), time_s);
      }
      for (std::size_t eye = 0; eye < 2; ++eye)
        EXPECT_EQ(test::differing_pixels(pictures[0][eye], pictures[1][eye]), 0) << shape.name << " " << eye;
      EXPECT_GT(test::differing_pixels(pictures[0][0], pictures[0][1]), 1000);
    }
}

std::size_t objects_of_comfort() {
  const auto objects = test::device().objects();
  return std::size_t(
      std::count_if(objects.begin(), objects.end(), [](const auto& o) { return o.effect == "comfort"; }));
}

// What is not shown costs no command, and who does not ask for comfort has nothing of it. Controls: an update that
// always shows, one that looks at the pictures' upper corners alone, an Experience that always builds it.
TEST_F(ComfortDrawn, WhatIsNotShownRecordsNothing) {
  for (const Shape& shape : shapes) {
    const Viewpoint eyes = headset(heads()[1]);
    FrameCounts never;
    {
      SeaShot without(options(shape, false));
      EXPECT_EQ(objects_of_comfort(), 0u);
      without.draw(eyes, time_s);
      without.draw(eyes, time_s);
      never = without.counts();
    }
    SeaShot shot(options(shape));
    EXPECT_GT(objects_of_comfort(), 0u);
    shot.draw(eyes, time_s);
    const std::uint64_t objects = test::device().objects_made(), passes = shot.experience().options().per_eye ? 2 : 1;
    const auto counts = [&](const ComfortShown& shown) {
      shot.experience().show_comfort(shown);
      shot.draw(eyes, time_s);
      return shot.counts();
    };
    EXPECT_EQ(counts({}).hash, never.hash) << shape.name;
    EXPECT_EQ(counts({.clear_deg = 360.0, .soft_deg = 20.0}).hash, never.hash);
    // The outer lower corners are 65.1 degrees from ahead, the inner ones 52.3.
    EXPECT_EQ(counts({.clear_deg = 132.0, .soft_deg = 20.0}).hash, never.hash) << "it begins outside the picture";
    EXPECT_EQ(counts({.clear_deg = 130.0, .soft_deg = 20.0}).draws, never.draws + passes);
    EXPECT_EQ(counts({.clear_deg = 90.0, .soft_deg = 20.0}).draws, never.draws + passes);
    EXPECT_EQ(counts({.horizon_line = true}).draws, never.draws + passes);
    EXPECT_EQ(counts({.clear_deg = 90.0, .soft_deg = 20.0, .horizon_line = true}).draws, never.draws + passes);
    EXPECT_EQ(counts({}).hash, never.hash);
    EXPECT_EQ(test::device().objects_made(), objects) << "nothing is made after loading";
  }
}

// Whoever sets comfort while he is moved waits for nothing. Control: comfort.vignette_deg with a reason to build anew.
TEST_F(ComfortDrawn, ItsSettingsBuildNothing) {
  SeaShot shot(options(shapes[0]));
  shot.draw(headset(heads()[0]), time_s);
  const std::uint64_t builds = shot.experience().builds(), objects = test::device().objects_made();
  int rows = 0;
  for (const Setting& row : settings_table()) {
    if (!row.key.starts_with("comfort.")) continue;
    ++rows;
    shot.set(std::string(row.key), test::another(shot.scene().settings, row));
    EXPECT_EQ(shot.experience().builds(), builds) << row.key;
  }
  EXPECT_EQ(rows, 15);
  EXPECT_EQ(test::device().objects_made(), objects);
}

// Other pipelines and other sizes of the picture. Control: an Experience that forgets what it shows when it is built.
TEST_F(ComfortDrawn, OutlivesARebuildAndAResize) {
  SeaShot shot(options(shapes[0]));
  shot.experience().show_comfort({.clear_deg = 50.0, .soft_deg = 10.0});
  const Viewpoint eyes = headset(heads()[0]);
  const auto before = shot.pictures(eyes, time_s);
  shot.set("frame.shape", "desktop");
  shot.experience().resize(96, 64);
  shot.draw(eyes, time_s);
  shot.experience().resize(width, height);
  shot.set("frame.shape", "tile");
  EXPECT_EQ(test::differing_pixels(shot.pictures(eyes, time_s)[1], before[1]), 0);
  shot.experience().show_comfort({});
  EXPECT_GT(test::differing_pixels(shot.pictures(eyes, time_s)[1], before[1]), 3000);
}

}  // namespace

}  // namespace seascape
