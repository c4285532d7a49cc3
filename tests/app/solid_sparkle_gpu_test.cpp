// Nothing sparkles at the waterline of what stands still in a swell: no pixel flashes for a frame.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

class SolidSparkle : public test::GpuTest {};

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

// Differs from the frames before and after by more than 40 of 255 while those differ by less than 10.
int flashes(const Image8& before, const Image8& now, const Image8& after) {
  int count = 0;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t pixel = y * width + x;
      count += apart(now, before, pixel) > 40 && apart(now, after, pixel) > 40 && apart(before, after, pixel) < 10 &&
               near_waterline(before, x, y);
    }
  return count;
}

// A pile and a square post in a swell of 1.5 m, at 72 frames a second, with one sample and with four, forward and
// deferred, seen from the side and from above: 300 frames with SEASCAPE_LONG, else 40. Control: every other frame the
// things stand 5 mm nearer (a row of DrawnSolids::upload()).
TEST_F(SolidSparkle, NoPixelAtTheWaterlineFlashes) {
  const int frames = std::getenv("SEASCAPE_LONG") != nullptr ? 300 : 40;
  std::vector<test::FrameLook> looks{test::frame_looks[0], test::frame_looks[1]};
  looks.push_back({"forward_1", {{"frame.shape", "tile"}, {"msaa", "1"}, {"frame.lighting", "forward"}}});
  int line_pixels = 0;
  for (const test::FrameLook& look : looks)
    for (const bool round : {true, false})
      for (const bool high : {true, false}) {
        SceneObjects objects;
        test::stand(
            objects,
            test::solid_model(round ? test::solid_pile(1.0f, -6.0f, 12.0f) : test::solid_box({0.8f, 12.0f, 0.8f}),
                              test::unlit_magenta),
            Pose{});
        SeaShot shot(test::solid_options(look, objects, width, height,
                                         {{"waves.wind_speed_mps", "0"},
                                          {"waves.swell_height_m", "1.5"},
                                          {"waves.swell_period_s", "6"},
                                          {"sky.exposure_ev", "0"}}));
        const Pose head = high ? pose({0.5, 6.0, 5.0}, -5.0, -48.0) : pose({-3.0, 2.2, 5.5}, 28.0, -14.0);
        Image8 older, newer;
        int flashed = 0;
        for (int i = 0; i < frames; ++i) {
          Image8 now = shot.picture(head, 3.0 + i / 72.0);
          if (i >= 2) flashed += flashes(older, newer, now);
          if (i == 0)
            for (std::size_t x = 0; x < width; ++x)
              for (std::size_t y = 0; y < height; ++y) line_pixels += near_waterline(now, x, y);
          older = std::move(newer);
          newer = std::move(now);
        }
        const std::string name = look.name + (round ? " pile" : " box") + (high ? " from above" : " from the side");
        RecordProperty(name, flashed);
        EXPECT_EQ(flashed, 0) << name << test::leave(newer, "sparkle");
      }
  EXPECT_GT(line_pixels, 600);
}

}  // namespace
}  // namespace seascape
