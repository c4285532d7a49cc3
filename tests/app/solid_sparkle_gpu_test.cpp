// Nothing sparkles at the waterline of what stands still in a swell: no pixel flashes for a frame.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "engine/srgb.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/sampled.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

class SolidSparkle : public test::GpuTest {};
const test::DrawsMuch draws_much("SolidSparkle");

constexpr std::uint32_t width = 160, height = 120;

int apart(const Image8& a, const Image8& b, std::size_t pixel) {
  int most = 0;
  for (std::size_t c = 0; c < 3; ++c)
    most = std::max(most, std::abs(int(a.pixels[4 * pixel + c]) - int(b.pixels[4 * pixel + c])));
  return most;
}

bool is_thing(const Image8& picture, std::size_t pixel) {
  const std::uint8_t* p = &picture.pixels[4 * pixel];
  return p[0] > 110 && p[2] > 110 && p[1] < 70;
}

// Whether the thing's edge towards the water is within three pixels.
bool near_waterline(const Image8& picture, std::size_t x, std::size_t y) {
  bool thing = false, other = false;
  for (std::size_t v = y < 3 ? 0 : y - 3; v <= std::min<std::size_t>(y + 3, height - 1); ++v)
    (is_thing(picture, v * width + x) ? thing : other) = true;
  return thing && other;
}

// What is there: of a frame drawn `finer` times as wide and high, the mean light of a pixel's part.
constexpr std::uint32_t finer = 8;
std::array<int, 3> mean_of(const Image8& fine, std::size_t x, std::size_t y) {
  std::array<int, 3> mean{};
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0.0;
    for (std::size_t v = finer * y; v < finer * (y + 1); ++v)
      for (std::size_t u = finer * x; u < finer * (x + 1); ++u)
        sum += srgb_to_light(fine.pixels[4 * (v * finer * width + u) + c] / 255.0);
    mean[c] = int(std::lround(255.0 * light_to_srgb(sum / (finer * finer))));
  }
  return mean;
}

int off(const Image8& picture, std::size_t pixel, const std::array<int, 3>& there) {
  int most = 0;
  for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int(picture.pixels[4 * pixel + c]) - there[c]));
  return most;
}

// Differs from the frames before and after by more than 40 of 255 while those differ by less than 10, and is not the
// nearest of the three to what is there. (With several samples a pixel is lit once for each triangle in it: beside a
// shadow's corner one frame may be nearly right and those about it too dark.) `fine`: draws the frame finer.
int flashes(const Image8& before, const Image8& now, const Image8& after, const std::function<Image8()>& fine,
            std::string& where) {
  int count = 0;
  std::optional<Image8> there;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t pixel = y * width + x;
      if (apart(now, before, pixel) <= 40 || apart(now, after, pixel) <= 40 || apart(before, after, pixel) >= 10 ||
          !near_waterline(before, x, y))
        continue;
      if (!there) there = fine();
      const std::array<int, 3> mean = mean_of(*there, x, y);
      if (off(now, pixel, mean) <= std::min(off(before, pixel, mean), off(after, pixel, mean))) continue;
      ++count;
      where += fmt::format(" {} {}:", x, y);
      for (const Image8* picture : {&before, &now, &after})
        where += fmt::format(" {}-{}-{}", picture->pixels[4 * pixel], picture->pixels[4 * pixel + 1],
                             picture->pixels[4 * pixel + 2]);
      where += fmt::format(" (there {}-{}-{})", mean[0], mean[1], mean[2]);
    }
  return count;
}

struct Case {
  test::FrameLook look;
  bool round, high;
};

// Of all cases, in frames 1/72 s apart: a pile and a square post in a swell of 1.5 m, with one sample and with four,
// forward and deferred, seen from the side and from above.
std::vector<Case> cases() {
  std::vector<test::FrameLook> looks{test::frame_looks[0], test::frame_looks[1]};
  looks.push_back({"forward_1", {{"frame.shape", "tile"}, {"msaa", "1"}, {"frame.lighting", "forward"}}});
  std::vector<Case> all;
  for (const test::FrameLook& look : looks)
    for (const bool round : {true, false})
      for (const bool high : {true, false}) all.push_back({look, round, high});
  return all;
}

struct Flashes {
  int count = 0, line_pixels = 0;
  std::string where;
};

// All 300 frames with SEASCAPE_LONG; or else those in which the controls below were seen.

Flashes flashes_of(const Case& one, const char* seen_in_water) {
  SceneObjects objects;
  test::stand(objects,
              test::solid_model(one.round ? test::solid_pile(1.0f, -6.0f, 12.0f) : test::solid_box({0.8f, 12.0f, 0.8f}),
                                test::unlit_magenta),
              Pose{});
  const auto options = [&](std::uint32_t times) {
    return test::solid_options(one.look, objects, times * width, times * height,
                               {{"waves.wind_speed_mps", "0"},
                                {"waves.swell_height_m", "1.5"},
                                {"waves.swell_period_s", "6"},
                                {"models.seen_in_water", seen_in_water},
                                {"sky.exposure_ev", "0"}});
  };
  SeaShot shot(options(1));
  const Pose head = one.high ? pose({0.5, 6.0, 5.0}, -5.0, -48.0) : pose({-3.0, 2.2, 5.5}, 28.0, -14.0);
  Flashes found;
  found.where = one.look.name + (one.round ? " pile" : " box") + (one.high ? " from above" : " from the side");
  Image8 older, newer;
  const int first = test::long_run() ? 0 : 125, frames = test::long_run() ? 300 : 40;
  for (int i = 0; i < frames; ++i) {
    Image8 now = shot.picture(head, 3.0 + (first + i) / 72.0);
    if (i >= 2) {
      const int had = found.count;
      const double time_s = 3.0 + (first + i - 1) / 72.0;
      found.count += flashes(
          older, newer, now, [&] { return SeaShot(options(finer)).picture(head, time_s); }, found.where);
      if (found.count > had) found.where += fmt::format(" [frame {}]", first + i - 1);
    }
    for (std::size_t pixel = 0; i == 0 && pixel < std::size_t(width) * height; ++pixel)
      found.line_pixels += near_waterline(now, pixel % width, pixel / width);
    older = std::move(newer);
    newer = std::move(now);
  }
  return found;
}

// Where the water meets things. Control seen: every third frame the things stand 5 mm nearer (row_z in
// DrawnSolids::upload()).
TEST_F(SolidSparkle, NoPixelAtTheWaterlineFlashes) {
  int line_pixels = 0;
  for (const Case& one : cases()) {
    const Flashes found = flashes_of(one, "false");
    line_pixels += found.line_pixels;
    EXPECT_EQ(found.count, 0) << found.where;
  }
  EXPECT_GT(line_pixels, 600);
}

// The same where things are seen through the water too. Controls seen: a line meets a thing where it first comes behind
// it, with what is covered there, and else not at all; lines begin in the middle of the samples that a triangle covers.
TEST_F(SolidSparkle, NoPixelFlashesWhereThingsAreSeenInTheWater) {
  int line_pixels = 0;
  for (const Case& one : cases()) {
    const Flashes found = flashes_of(one, "true");
    line_pixels += found.line_pixels;
    EXPECT_EQ(found.count, 0) << found.where;
  }
  EXPECT_GT(line_pixels, 600);
}

}  // namespace
}  // namespace seascape
