#include "ocean/waves/fft.h"

#include <gtest/gtest.h>

#include <complex>
#include <random>
#include <stdexcept>

#include "tests/support/truth.h"

namespace seascape {
namespace {

struct Field {
  int band = 0;
  std::vector<float> re, im;
};

Field random_field(int band, unsigned seed) {
  Field f;
  f.band = band;
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  for (int i = 0; i < f.band * f.band; ++i) f.re.push_back(normal(random)), f.im.push_back(normal(random));
  return f;
}

// One value of the direct sum in double.
std::complex<double> direct(const Field& f, int n, int x, int z) {
  std::complex<double> sum = 0;
  const int half = f.band / 2;
  const auto turn = [&](std::int64_t m, int at) {
    const double angle = 2 * truth::pi * double(m * at % n) / n;
    return std::complex<double>(std::cos(angle), std::sin(angle));
  };
  std::vector<std::complex<double>> along_x;
  for (int mx = -half; mx < half; ++mx) along_x.push_back(turn(mx, x));
  for (int mz = -half; mz < half; ++mz) {
    std::complex<double> row = 0;
    for (int i = 0; i < f.band; ++i) {
      const std::size_t at = std::size_t(mz + half) * f.band + i;
      // Written out: the library's product looks for infinities at a cost of ten times.
      const std::complex<double> w = along_x[i];
      row += std::complex<double>(f.re[at] * w.real() - f.im[at] * w.imag(), f.re[at] * w.imag() + f.im[at] * w.real());
    }
    sum += row * turn(mz, z);
  }
  return sum;
}

TEST(Fft, equals_the_direct_sum) {
  // Every band of every size, the dense transform among them: relative L2 error over places, bar 5e-7. Controls, all
  // seen: one odd result of radix 8 turned by the wrong eighth gave 0.77 to 1.02, the last value of radix 16 by the
  // wrong sixteenth 0.26 to 0.35, a fold of two turned the other way 1.3 (1024, band 512 alone).
  for (int n = 16; n <= 1024; n *= 2)
    for (int band = 16; band <= n; band *= 2) {
      const Field f = random_field(band, unsigned(n + band));
      const FftPlan plan = make_fft_plan(n, band);
      const int stride = n + 16, places = band <= 128 ? 400 : 100;
      std::vector<float> re(std::size_t(stride) * n), im(re.size());
      std::vector<float> workspace(inverse_fft_floats(plan));
      inverse_fft(plan, f.re.data(), f.im.data(), re.data(), im.data(), stride, workspace);
      std::mt19937 random(1);
      double error = 0, size = 0;
      for (int i = 0; i < places; ++i) {
        const int x = int(random() % unsigned(n)), z = int(random() % unsigned(n));
        const std::complex<double> truth = direct(f, n, x, z);
        const std::size_t at = std::size_t(z) * stride + x;
        error += std::norm(truth - std::complex<double>(re[at], im[at]));
        size += std::norm(truth);
      }
      EXPECT_LE(std::sqrt(error / size), 5e-7) << n << " band " << band;
      RecordProperty("relative_l2_" + std::to_string(n) + "_" + std::to_string(band),
                     std::to_string(1e9 * std::sqrt(error / size)) + "e-9");
    }
}

TEST(Fft, energy_is_kept) {
  // Parseval over all samples of dense transforms: the mean square is the sum of the squared amplitudes, to 1e-6.
  // Sampled places alone would miss a few wrong rows. Control: the last eight rows of 1024 left out, 0.008 too little
  // (seen).
  for (int n = 16; n <= 1024; n *= 2) {
    const Field f = random_field(n, unsigned(n));
    const int stride = n + 16;
    std::vector<float> re(std::size_t(stride) * n), im(re.size());
    const FftPlan plan = make_fft_plan(n, n);
    std::vector<float> workspace(inverse_fft_floats(plan));
    inverse_fft(plan, f.re.data(), f.im.data(), re.data(), im.data(), stride, workspace);
    double squares = 0, amplitudes = 0;
    for (std::size_t i = 0; i < f.re.size(); ++i) amplitudes += double(f.re[i]) * f.re[i] + double(f.im[i]) * f.im[i];
    for (int z = 0; z < n; ++z)
      for (int x = 0; x < n; ++x)
        squares += std::norm(std::complex<double>(re[std::size_t(z) * stride + x], im[std::size_t(z) * stride + x]));
    EXPECT_NEAR(squares / (double(n) * n) / amplitudes, 1, 1e-6) << n;
  }
}

TEST(Fft, sizes_out_of_range_are_refused) {
  // Control: a check for powers of two alone takes 8 and 2048.
  for (const int n : {0, 8, 48, 2048, -16}) EXPECT_THROW(make_fft_plan(n), std::invalid_argument);
  for (const int band : {0, 8, 48, 256, -16}) EXPECT_THROW(make_fft_plan(128, band), std::invalid_argument);
}

}  // namespace
}  // namespace seascape
