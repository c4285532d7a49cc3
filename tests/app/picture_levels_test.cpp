// Smaller copies of a model's pictures: means of light, of data and of directions.
#include "app/solids/picture_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace seascape {
namespace {

double light_of(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }
double srgb_of(double light) { return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055; }

// Both tables are the formula (IEC 61966-2-1): all bytes, and a million lights. Controls seen: a cell's byte not
// carried on to the next within it; half a byte left out of where one byte's light begins.
TEST(PictureLevels, SrgbIsTheFormula) {
  for (int i = 0; i < 256; ++i) {
    EXPECT_FLOAT_EQ(light_of_srgb(std::uint8_t(i)), float(light_of(i / 255.0))) << i;
    EXPECT_EQ(srgb_of_light(light_of_srgb(std::uint8_t(i))), i);
  }
  for (int i = -10; i <= 1000010; ++i) {
    const double light = std::clamp(i * 1e-6, 0.0, 1.0), exact = 255.0 * srgb_of(light);
    ASSERT_LE(std::abs(srgb_of_light(float(i * 1e-6)) - exact), 0.5005) << i;
  }
}

Image8 filled(int width, int height, const std::vector<std::uint8_t>& texels) {
  Image8 image{width, height, 4, {}};
  for (int i = 0; i < width * height; ++i)
    for (std::size_t c = 0; c < 4; ++c) image.pixels.push_back(texels[(4 * std::size_t(i) + c) % texels.size()]);
  return image;
}

// Half white, half black is half the light, 188 of sRGB, and 128 of data; so with greys between. Alpha is data.
// Controls seen: bytes of a colour read as data; its light written as data.
TEST(PictureLevels, MeansAreOfLight) {
  const Image8 checks = filled(2, 2, {0, 60, 0, 255, 255, 200, 255, 0});
  const auto colour = picture_levels(checks, TexelKind::colour), data = picture_levels(checks, TexelKind::linear);
  ASSERT_EQ(colour.size(), 2u);
  EXPECT_EQ(colour[1].pixels, (std::vector<std::uint8_t>{188, 151, 188, 128}));
  EXPECT_EQ(data[1].pixels, (std::vector<std::uint8_t>{128, 130, 128, 128}));
  EXPECT_EQ(colour[0].pixels, checks.pixels);
}

// Sides that are no powers of two: every texel counts, the last one too. Control seen: the last column left out.
TEST(PictureLevels, OddSides) {
  const auto levels = picture_levels(filled(5, 1, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 240, 240, 240, 240}),
                                     TexelKind::linear);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[1].width, 2);
  EXPECT_EQ(levels[1].pixels, (std::vector<std::uint8_t>{0, 0, 0, 0, 80, 80, 80, 80}));
  EXPECT_EQ(levels[2].width, 1);
  EXPECT_EQ(picture_levels(filled(300, 7, {9}), TexelKind::colour).size(), 9u);
}

// Directions keep unit length where they are averaged. Control seen: kind taken for data.
TEST(PictureLevels, DirectionsStayOfUnitLength) {
  const auto levels = picture_levels(filled(2, 2, {218, 128, 218, 255, 38, 128, 218, 255}), TexelKind::normal);
  const std::vector<std::uint8_t>& up = levels[1].pixels;
  const glm::vec3 n = 2.0f * glm::vec3(up[0], up[1], up[2]) / 255.0f - 1.0f;
  EXPECT_NEAR(glm::length(n), 1.0f, 0.01f);
  EXPECT_GT(n.z, 0.99f);
}

}  // namespace
}  // namespace seascape
