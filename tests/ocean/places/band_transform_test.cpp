// The transform to a band, against a direct sum in double.
#include "ocean/places/band_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

namespace seascape {
namespace {

TEST(BandTransform, IsTheDirectSum) {
  for (const auto& [n, band] : {std::pair{64, 16}, {64, 64}, {128, 32}, {256, 64}, {512, 128}}) {
    const FftPlan plan = make_fft_plan(n, n);
    const int stride = n + 16;
    std::vector<float> re(std::size_t(n) * std::size_t(stride)), im(re.size()),
        out_re(std::size_t(band) * std::size_t(band)), out_im(out_re.size()), work(forward_band_floats(plan, band));
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (std::size_t i = 0; i < re.size(); ++i) re[i] = normal(random), im[i] = normal(random);
    forward_band(plan, band, re.data(), im.data(), stride, out_re.data(), out_im.data(), work);
    double error = 0.0, power = 0.0;
    for (int i = 0; i < 24; ++i) {  // some of the band, its first and its last among them
      const int jx = i == 0   ? 0
                     : i == 1 ? band - 1
                              : (i * 37) % band,
                jz = i == 0   ? 0
                     : i == 1 ? band - 1
                              : (i * 53 + 11) % band;
      std::complex<double> sum = 0.0;
      for (int z = 0; z < n; ++z)
        for (int x = 0; x < n; ++x) {
          const std::size_t at = std::size_t(z) * std::size_t(stride) + std::size_t(x);
          sum += std::complex<double>(re[at], im[at]) *
                 std::polar(1.0, -2.0 * std::numbers::pi * double((jx - band / 2) * x + (jz - band / 2) * z) / n);
        }
      const std::size_t at = std::size_t(jz) * std::size_t(band) + std::size_t(jx);
      error += std::norm(std::complex<double>(out_re[at], out_im[at]) - sum);
      power += std::norm(sum);
    }
    EXPECT_LT(std::sqrt(error / power), 5e-7) << n << " " << band;
  }
}

}  // namespace
}  // namespace seascape
