// Pictures on the sea: bilinear, turned, averaged over a footprint, and mapped to values.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/image_file.h"
#include "ocean/inputs/inputs.h"

namespace seascape {
namespace {

template <class Texel>
std::shared_ptr<ImageF> picture(int width, int height, const Texel& texel) {
  auto image = std::make_shared<ImageF>();
  image->width = width, image->height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::vec4 v = texel(x, y);
      image->pixels.insert(image->pixels.end(), {v.x, v.y, v.z, v.w});
    }
  return image;
}
InputSpec texture(InputTarget to, std::shared_ptr<ImageF> image, glm::dvec2 at, glm::dvec2 size) {
  InputSpec spec;
  spec.to = to;
  spec.where = "here";
  TextureInput input;
  input.file = "picture.exr";
  input.image = std::move(image);
  input.at_m = at, input.size_m = size;
  spec.shape = input;
  return spec;
}
glm::vec4 at(const Inputs& inputs, double x, double z, double footprint = 0.0) {
  return inputs.value({x, z}, footprint, 0.0, glm::vec4(0.0f));
}

// A bilinear function comes back exactly between the texels' middles; beyond the outer ones it is level; outside there
// is nothing. Control: texels whose values lie at their corners are off by 0.16.
TEST(InputTextures, AreBilinear) {
  const auto f = [](double x, double y) { return 3.0 + 0.5 * x - 0.25 * y + 0.125 * x * y; };  // in texels
  const Inputs inputs(
      InputTarget::level,
      std::vector{texture(InputTarget::level,
                          picture(8, 5, [&](int x, int y) { return glm::vec4(float(f(x, y)), 0, 0, 0); }),
                          {100.0, -40.0}, {16.0, 20.0})});
  for (double x = 0.0; x <= 7.0; x += 0.125)
    for (double y = 0.0; y <= 4.0; y += 0.125)
      EXPECT_NEAR(at(inputs, 92.0 + 2.0 * (x + 0.5), -50.0 + 4.0 * (y + 0.5)).x, f(x, y), 1e-5);
  EXPECT_NEAR(at(inputs, 92.01, -50.0 + 4.0 * 2.5).x, f(0, 2), 1e-5);
  EXPECT_NEAR(at(inputs, 107.99, -49.99).x, f(7, 0), 1e-5);
  EXPECT_EQ(at(inputs, 91.99, -40.0).x, 0.0f);
}

// Control: a frame that turns the other way fails, and so do vectors that stay as they are.
TEST(InputTextures, TurnWithTheirVectors) {
  // Only the top right texel flows, to the right and half as fast to the top of the picture.
  InputSpec spec =
      texture(InputTarget::flow,
              picture(2, 2, [](int x, int y) { return x == 1 && y == 0 ? glm::vec4(2, -1, 0, 0) : glm::vec4(0.0f); }),
              {0.0, 0.0}, {20.0, 20.0});
  std::get<TextureInput>(spec.shape).turn_deg = 90.0;
  const Inputs inputs(InputTarget::flow, std::vector{spec});
  const glm::vec4 v = at(inputs, 9.0, 9.0);  // the top is to +x now, the right to +z
  EXPECT_NEAR(v.x, 1.0, 1e-6);
  EXPECT_NEAR(v.y, 2.0, 1e-6);
  EXPECT_EQ(at(inputs, 9.0, -9.0), glm::vec4(0.0f));
}

// Control: scale and offset in the other order give 0.
TEST(InputTextures, MapChannelsToValues) {
  InputSpec spec = texture(InputTarget::level, picture(2, 2, [](int, int) { return glm::vec4(1, 2, 3, 4); }),
                           {0.0, 0.0}, {2.0, 2.0});
  TextureInput& input = std::get<TextureInput>(spec.shape);
  input.scale = 2.0, input.offset = -1.0;
  EXPECT_EQ(at(Inputs(InputTarget::level, std::vector{spec}), 0.0, 0.0).x, 1.0f);
  input.channels = "b";
  EXPECT_EQ(at(Inputs(InputTarget::level, std::vector{spec}), 0.0, 0.0).x, 5.0f);
  spec.to = InputTarget::flow;
  input.channels = "ag";
  EXPECT_EQ(glm::vec2(at(Inputs(InputTarget::flow, std::vector{spec}), 0.0, 0.0)), glm::vec2(7.0f, 3.0f));
}

// A picture of 1 and 0 in turns is a half where the footprint is wider than its texels, and what is summed over the
// plane is the same at any footprint. Control: always the finest level gives 0 or 1 in the middle.
TEST(InputTextures, AreAveragedOverAFootprint) {
  const Inputs inputs(
      InputTarget::level,
      std::vector{texture(InputTarget::level,
                          picture(64, 64, [](int x, int y) { return glm::vec4(float((x + y) % 2), 0, 0, 0); }),
                          {0.0, 0.0}, {64.0, 64.0})});
  EXPECT_EQ(at(inputs, 0.5, 0.5).x, 0.0f);
  EXPECT_EQ(at(inputs, 1.5, 0.5).x, 1.0f);
  for (const double footprint : {2.0, 3.0, 8.0, 20.0}) {
    EXPECT_NEAR(at(inputs, 0.5, 0.5, footprint).x, 0.5f, 1e-6) << footprint;
    EXPECT_NEAR(at(inputs, 1.5, 0.5, footprint).x, 0.5f, 1e-6) << footprint;
  }
  for (const double footprint : {0.0, 10.0, 100.0, 400.0}) {
    const double step = footprint > 50.0 ? 2.0 : 0.5, reach = 33.0 + 0.5 * footprint;
    double sum = 0.0;
    for (double x = -reach + 0.5 * step; x < reach; x += step)
      for (double z = -reach + 0.5 * step; z < reach; z += step) sum += step * step * at(inputs, x, z, footprint).x;
    EXPECT_NEAR(sum / (0.5 * 64.0 * 64.0), 1.0, 5e-3) << footprint;
  }
}

// Holes of a raster of heights (-3.4e38), and a scale that takes texels out of a float's range, give the end of the
// range everywhere and at any footprint, next to sound texels as well. Control seen: values as they come (differences
// and means of texels are infinite, and no number in between).
TEST(InputTextures, TexelsBeyondAnyRangeStayFinite) {
  const auto holes = [](int x, int y) {
    return (x + y) % 3 == 0   ? glm::vec4(-3.4e38f, 3.4e38f, 0, 0)
           : (x + y) % 3 == 1 ? glm::vec4(3.4e38f, -2.0f, 0, 0)
                              : glm::vec4(-5.0f);
  };
  for (const InputTarget to : {InputTarget::sea_depth, InputTarget::flow})
    for (const double scale : {1.0, 1e6}) {
      InputSpec spec = texture(to, picture(8, 8, holes), {0.0, 0.0}, {80.0, 80.0});
      std::get<TextureInput>(spec.shape).scale = scale;
      const Inputs inputs(to, std::vector{spec, spec});
      for (double x = -39.0; x < 40.0; x += 1.7)
        for (const double footprint : {0.0, 3.0, 15.0, 60.0, 500.0}) {
          const glm::vec4 value = at(inputs, x, 0.6 * x, footprint);
          ASSERT_TRUE(std::isfinite(value.x) && std::isfinite(value.y)) << x << " " << footprint << " " << scale;
          ASSERT_LE(std::abs(value.x), 12000.0f);
        }
      const float deep = at(inputs, -35.0, -35.0).x;
      EXPECT_EQ(deep, to == InputTarget::flow ? -100.0f : -12000.0f) << "the hole at the corner";
    }
}

// Colours are mixed as light that passes what covers it: a texel that covers nothing has no colour to give. Control:
// without with_cover() the edge between red and a clear green is brown: green comes in.
TEST(InputTextures, WhatCoversNothingHasNoColour) {
  InputSpec spec =
      texture(InputTarget::albedo,
              picture(2, 1, [](int x, int) { return x == 0 ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 0); }),
              {0.0, 0.0}, {2.0, 1.0});
  spec.blend = InputBlend::replace;
  const Inputs inputs(InputTarget::albedo, std::vector{spec});
  const glm::vec4 between = at(inputs, 0.0, 0.0);
  EXPECT_EQ(between, glm::vec4(0.5f, 0.0f, 0.0f, 0.5f)) << "red that covers a half";
}

}  // namespace
}  // namespace seascape
