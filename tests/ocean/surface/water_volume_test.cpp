// Light along a line of sight in even water. Controls are named beside each test; each was seen to fail.
#include "shaders/shared/water_volume.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shaders/shared/fresnel.h"

namespace seascape {
namespace {

constexpr double pi = 3.14159265358979323846;

// One scattering of the sun 60 degrees high in clear water (Petzold 1972), an eye 5 m deep and lines of sight of 10 m:
// the four directions of facts/underwater.md, section 1, which agree with quadrature in seven digits. 1e-4; in floats
// 1e-3. Controls: the cosine's sign; fading left out of the line's attenuation.
TEST(WaterVolume, OneScatteringIsTheClosedForm) {
  const double out = pi / 6.0, in = std::asin(std::sin(out) / 1.333), a = 0.114, b = 0.037, c = a + b;
  const double enters = (1.0 - double(gpu::fresnel(float(std::cos(out))))) * std::cos(out) / std::cos(in);
  EXPECT_NEAR(enters, 0.91421, 2e-5);
  struct Way {
    double along, up, way_m, expected;
  };
  const double half = std::sqrt(0.5);
  for (const Way& w : {Way{-1.0, 0.0, 10.0, 2.2127e-4}, Way{1.0, 0.0, 10.0, 7.1932e-4}, Way{0.0, -1.0, 10.0, 7.8866e-5},
                       Way{half, half, 5.0 / half, 1.8320e-2}}) {
    const double cosine = w.along * std::sin(in) + w.up * std::cos(in), fading = c / std::cos(in);
    EXPECT_NEAR(enters * gpu::sun_scattered(b, c, fading, 5.0, -w.up, w.way_m, cosine), w.expected, 1e-4 * w.expected)
        << w.along << " " << w.up;
    EXPECT_NEAR(enters * double(gpu::sun_scattered(float(b), float(c), float(fading), 5.0f, float(-w.up),
                                                   float(w.way_m), float(cosine))),
                w.expected, 1e-3 * w.expected);
  }
}

// A way cut in two adds up, wherever it is cut: what the first part adds, and the second dimmed by the first. Sums of
// either sign of k and near 0, in doubles 1e-12, in floats 3e-6. Control: the series' second term.
TEST(WaterVolume, WaysAddUp) {
  for (const double k : {-0.4, -1e-3, -1e-9, 0.0, 1e-9, 1e-4, 0.019, 0.021, 0.3, 5.0})
    for (const double first : {1e-3, 0.2, 3.0, 40.0})
      for (const double second : {0.05, 1.0, 12.0}) {
        const double whole = gpu::path_sum(k, first + second),
                     parts = gpu::path_sum(k, first) + std::exp(-k * first) * gpu::path_sum(k, second);
        EXPECT_NEAR(parts, whole, 1e-8 * whole) << k << " " << first << " " << second;
        EXPECT_NEAR(double(gpu::path_sum(float(k), float(first + second))), whole, 3e-6 * whole) << k << " " << first;
      }
  EXPECT_EQ(gpu::path_sum(0.0, 7.0), 7.0);
  EXPECT_NEAR(gpu::path_sum(0.2, 1e9), 5.0, 1e-12);  // to where nothing is left
}

// All that is scattered goes somewhere. Control: 4 pi for 2 pi in the constant.
TEST(WaterVolume, ThePhaseFunctionSumsToOne) {
  for (const double g : {0.0, 0.5, double(gpu::water_forward)}) {
    double sum = 0.0, forward = 0.0;
    constexpr int steps = 200000;
    for (int i = 0; i < steps; ++i) {
      const double cosine = -1.0 + 2.0 * (i + 0.5) / steps,
                   share = gpu::henyey_greenstein(cosine, g) * 4.0 * pi / steps;
      sum += share, forward += share * cosine;
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    EXPECT_NEAR(forward, g, 1e-5);
  }
}

}  // namespace
}  // namespace seascape
