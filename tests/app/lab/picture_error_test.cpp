// Differences of pictures: known ones, and how SSIM tells a shift of light from a loss of form.
#include "app/lab/picture_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace seascape {
namespace {

Image8 of(int width, int height, const auto& value) {
  Image8 image{width, height, 4, {}};
  for (int z = 0; z < height; ++z)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 4; ++c) image.pixels.push_back(c == 3 ? 255 : std::uint8_t(value(x, z, c)));
  return image;
}
int waves(int x, int z, int) { return int(128 + 60 * std::sin(0.7 * x) * std::cos(0.4 * z)); }

// Controls seen: the 99th percentile taken as the 90th, alpha counted as a channel, variances not less their means.
TEST(PictureError, SaysWhatDiffers) {
  const Image8 truth = of(64, 48, waves);
  const PictureError none = picture_error(truth, truth);
  EXPECT_EQ(none.mean, 0.0);
  EXPECT_EQ(none.p99, 0.0);
  EXPECT_NEAR(none.dissimilarity, 0.0, 1e-12);
  const PictureError brighter =
      picture_error(of(64, 48, [](int x, int z, int c) { return waves(x, z, c) + (c == 1 ? 20 : 0); }), truth);
  EXPECT_NEAR(brighter.mean, 20.0 / 255.0, 1e-12);
  EXPECT_NEAR(brighter.p99, 20.0 / 255.0, 1e-12);
  const PictureError flat = picture_error(of(64, 48, [](int, int, int) { return 128; }), truth);
  EXPECT_GT(flat.dissimilarity, 0.8) << "no form is left";
  EXPECT_LT(brighter.dissimilarity, 0.05) << "the form is the same";
  // A hundredth and a half of the pixels: beyond the 99th percentile, hardly in the mean.
  const PictureError few = picture_error(
      of(64, 48, [](int x, int z, int c) { return (64 * z + x) % 67 == 0 ? 255 : waves(x, z, c); }), truth);
  EXPECT_GT(few.p99, 0.2);
  EXPECT_LT(few.mean, 0.01);
  Image8 clear = truth;
  for (std::size_t i = 3; i < clear.pixels.size(); i += 4) clear.pixels[i] = 0;
  EXPECT_EQ(picture_error(clear, truth).mean, 0.0) << "what is opaque is not looked at";
  EXPECT_THROW(picture_error(of(64, 40, waves), truth), std::invalid_argument);
  EXPECT_THROW(picture_error(of(4, 4, waves), of(4, 4, waves)), std::invalid_argument);
}

// Against the formula written out for one window (Wang et al. 2004, eq. 13). Control seen: C2 left out.
TEST(PictureError, OneWindowIsTheFormula) {
  std::mt19937 random(2);
  const Image8 a = of(8, 8, [&](int, int, int) { return int(random() % 256); }),
               b = of(8, 8, [&](int, int, int) { return int(random() % 256); });
  double ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
  const auto y = [](const Image8& i, int p) {
    return (0.2126 * i.pixels[std::size_t(4 * p)] + 0.7152 * i.pixels[std::size_t(4 * p + 1)] +
            0.0722 * i.pixels[std::size_t(4 * p + 2)]) /
           255.0;
  };
  for (int p = 0; p < 64; ++p) ma += y(a, p) / 64, mb += y(b, p) / 64;
  for (int p = 0; p < 64; ++p)
    va += std::pow(y(a, p) - ma, 2) / 63, vb += std::pow(y(b, p) - mb, 2) / 63,
        cov += (y(a, p) - ma) * (y(b, p) - mb) / 63;
  const double ssim = (2 * ma * mb + 1e-4) * (2 * cov + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
  EXPECT_NEAR(picture_error(a, b).dissimilarity, 1.0 - ssim, 1e-9);
}

// Light is averaged, not its code: half 40 and half 220 is 163, not 130. Control seen: codes taken for light (189).
TEST(PictureError, FinerPixelsAreAveragedInLinearLight) {
  const Image8 fine = of(16, 16, [](int x, int z, int) { return (x + z) % 2 == 0 ? 220 : 40; });
  const Image8 small = averaged(fine, 2);
  EXPECT_EQ(small.width, 8);
  EXPECT_EQ(small.height, 8);
  for (std::size_t i = 0; i < small.pixels.size(); ++i) EXPECT_EQ(small.pixels[i], i % 4 == 3 ? 255 : 163);
  EXPECT_EQ(averaged(fine, 1).pixels, fine.pixels);
  EXPECT_THROW(averaged(fine, 3), std::invalid_argument);
}

}  // namespace
}  // namespace seascape
