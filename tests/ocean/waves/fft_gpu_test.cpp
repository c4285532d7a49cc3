// The shaders' transform alone (shaders/lib/fft.glsl) against direct sums in double.
#include <random>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/gpu_transform.h"
#include "tests/support/sampled.h"
#include "tests/support/truth.h"

namespace seascape {
namespace {

using test::GpuTransform;
using Bins = std::vector<std::complex<float>>;

class FftOnGpu : public test::GpuTest {};

Bins random_bins(int band) {
  std::mt19937 random{unsigned(band)};
  std::normal_distribution<float> normal;
  Bins bins(std::size_t(band) * std::size_t(band));
  for (std::complex<float>& bin : bins) bin = {normal(random), normal(random)};
  return bins;
}

// sum over m of F(m) exp(2 pi i (mx x + mz z) / n).
std::complex<double> direct(const Bins& bins, int band, int n, int x, int z) {
  const auto turn = [&](int m, int at) {
    const double angle = 2 * truth::pi * double(m * at % n) / n;
    return std::complex<double>(std::cos(angle), std::sin(angle));
  };
  std::complex<double> sum = 0;
  for (int mz = -band / 2; mz < band / 2; ++mz) {
    std::complex<double> row = 0;
    for (int mx = -band / 2; mx < band / 2; ++mx)
      row += std::complex<double>(bins[std::size_t((mz + band / 2) * band + mx + band / 2)]) * turn(mx, x);
    sum += row * turn(mz, z);
  }
  return sum;
}

struct Shape {
  int n, band, radix, slots;
};

TEST_F(FftOnGpu, equals_the_direct_sum) {
  // Relative L2 error over 24 places (60 with SEASCAPE_LONG), bar 1e-6. Controls, all seen: the last value of radix
  // 16 half a turn off, 0.85 to 0.97 where it is used; the exchange read one invocation off, 1.4 everywhere; bins
  // beyond the core folded without their further turn, 1.2 where there are some; a workgroup larger than the shader's
  // default left at that (engine/shader.cpp), no numbers.
  for (const Shape& s : {Shape{64, 64, 8, 8},
                         {128, 128, 8, 8},
                         {128, 64, 8, 8},
                         {256, 64, 8, 8},
                         {512, 64, 8, 8},
                         {256, 256, 8, 8},
                         {256, 256, 16, 4},
                         {512, 256, 16, 8},
                         {512, 512, 16, 8}}) {
    const Bins bins = random_bins(s.band);
    Frame frame(test::device(), 4096);
    GpuTransform transform(test::device(), test::shaders(), s.n, s.band, s.radix, s.slots, bins);
    frame.begin();
    transform.record(frame);
    frame.submit();
    frame.finish();
    const auto got = transform.samples();
    std::mt19937 random(1);
    double error = 0, size = 0;
    for (int i = 0; i < (test::long_run() ? 60 : 24); ++i) {
      const int x = int(random() % unsigned(s.n)), z = int(random() % unsigned(s.n));
      const std::complex<double> truth = direct(bins, s.band, s.n, x, z);
      error += std::norm(truth - std::complex<double>(got[std::size_t(z * s.n + x)]));
      size += std::norm(truth);
    }
    const std::string name = std::to_string(s.n) + "_" + std::to_string(s.band) + "_" + std::to_string(s.radix) + "_" +
                             std::to_string(s.slots);
    EXPECT_LE(std::sqrt(error / size), 1e-6) << name;
    RecordProperty("relative_l2_" + name, std::to_string(1e9 * std::sqrt(error / size)) + "e-9");
  }
}

}  // namespace
}  // namespace seascape
