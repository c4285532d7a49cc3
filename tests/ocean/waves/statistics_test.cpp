// The drawn sea's statistics over many seeds against the theory of its spectrum.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <random>

#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/causes_of_sea.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

// Means over a seed's places of: heights to the powers 1 to 3 and squared slopes over the displaced surface, which
// counts a rest place by its Jacobian; then over rest places h^2, (dh/dt)^2, h times the water's velocity, D D and grad
// h grad h.
enum Mean {
  mean_h,
  mean_h2,
  mean_h3,
  mean_s2,
  rest_h2,
  rest_w2,
  rest_u2,
  hu_x,
  hu_z,
  d_xx,
  d_zz,
  d_xz,
  s_xx,
  s_zz,
  s_xz,
  means
};
using Means = std::array<double, means>;

Means of_seed(const SeaState& sea, const WaveQuality& quality) {
  const WaveField field(sea, quality);
  WaveTiles tiles(true);
  std::mt19937 random(sea.seed);
  std::uniform_real_distribution<double> anywhere(-50e3, 50e3);
  field.evaluate(ticks_from_seconds(anywhere(random)), tiles);
  const WaveField::Filter filter = field.filter(0.0);
  Means sum{};
  constexpr int places = 3000;
  for (int i = 0; i < places; ++i) {
    const glm::dvec2 at(anywhere(random), anywhere(random));
    const SeaSample s = field.sea(tiles, at, filter);
    const glm::dvec3 u = field.velocity(tiles, at, filter), d = s.displacement;
    const glm::dvec2 g = s.height_gradient, slope = s.slope();
    const double h = d.y, j = s.jacobian();
    const Means here{h * j,
                     h * h * j,
                     h * h * h * j,
                     glm::dot(slope, slope) * j,
                     h * h,
                     u.y * u.y,
                     u.x * u.x + u.z * u.z,
                     h * u.x,
                     h * u.z,
                     d.x * d.x,
                     d.z * d.z,
                     d.x * d.z,
                     g.x * g.x,
                     g.y * g.y,
                     g.x * g.y};
    for (int m = 0; m < means; ++m) sum[std::size_t(m)] += here[std::size_t(m)] / places;
  }
  return sum;
}

// A statistic of the means, and its standard error by the jackknife (Quenouille 1949, Tukey 1958): each seed left out
// in turn.
struct Estimate {
  double value, error;
};
Estimate estimate(const std::vector<Means>& seeds, const std::function<double(const Means&)>& statistic) {
  const double n = double(seeds.size());
  Means sum{};
  for (const Means& s : seeds)
    for (std::size_t m = 0; m < means; ++m) sum[m] += s[m];
  Means all = sum;
  for (double& m : all) m /= n;
  double mean = 0.0, square = 0.0;
  for (const Means& s : seeds) {
    Means without = sum;
    for (std::size_t m = 0; m < means; ++m) without[m] = (sum[m] - s[m]) / (n - 1.0);
    const double value = statistic(without);
    mean += value / n;
    square += value * value / n;
  }
  return {statistic(all), std::sqrt((n - 1.0) * std::max(0.0, square - mean * mean))};
}

double degrees(double rad) { return rad * 180.0 / truth::pi; }
// Of the mean vector's length r, the circular deviation (Kuik, van Vledder and Holthuijsen 1988, eq. 13); of the
// second's, eq. 15.
double spread1(double r) { return degrees(std::sqrt(2.0 * (1.0 - r))); }
double spread2(double xx, double zz, double xz) {
  return degrees(std::sqrt(0.5 * (1.0 - std::hypot(xx - zz, 2.0 * xz) / (xx + zz))));
}
double central_skewness(double m1, double m2, double m3) {
  return (m3 - 3.0 * m1 * m2 + 2.0 * m1 * m1 * m1) / std::pow(m2 - m1 * m1, 1.5);
}

struct Case {
  const char* name;
  SeaState sea;
  int cascades;
  bool slopes_of_the_displaced;  // where the drawn waves are so long that it does not fold
};

void expect_theory(const Case& of, int seed_count) {
  // Of the ladder the theory has to know where the drawn waves end: the share of a wave number falls by a smooth step
  // over ln k.
  const std::array<double, 2> end = ladder(of.sea)[std::size_t(of.cascades - 1)].k_out;
  const truth::SeaSpectrum spectrum(test::causes_of(of.sea));
  const truth::SeaMoments m = spectrum.moments([&](double k) {
    const double t = std::clamp(std::log(k / end[0]) / std::log(end[1] / end[0]), 0.0, 1.0);
    return 1.0 - t * t * (3.0 - 2.0 * t);
  });
  std::vector<Means> seeds;
  for (int i = 0; i < seed_count; ++i) {
    SeaState sea = of.sea;
    sea.seed = std::uint32_t(1000 + i);
    seeds.push_back(of_seed(sea, {.resolution = 256, .cascades = of.cascades}));
  }
  const auto expect = [&](const char* what, double theory, const std::function<double(const Means&)>& statistic) {
    const Estimate e = estimate(seeds, statistic);
    const double off = (e.value - theory) / e.error;
    EXPECT_LE(std::abs(off), 3.0) << of.name << ": " << what << " " << e.value << ", theory " << theory
                                  << ", standard error " << e.error;
    ::testing::Test::RecordProperty(what, std::to_string(off) + " standard errors");
  };
  const truth::Heights h = truth::chopped_heights(m, of.sea.chop);
  expect("significant height m", 4.0 * std::sqrt(h.square - h.mean * h.mean),
         [](const Means& s) { return 4.0 * std::sqrt(s[mean_h2] - s[mean_h] * s[mean_h]); });
  expect("mean period Tm02 s", 2.0 * truth::pi * std::sqrt(m.m0 / m.w2),
         [](const Means& s) { return 2.0 * truth::pi * std::sqrt(s[rest_h2] / s[rest_w2]); });
  expect("mean direction", degrees(std::atan2(m.w1.x, -m.w1.z)),
         [](const Means& s) { return degrees(std::atan2(s[hu_x], -s[hu_z])); });
  expect("spread of the first moment", spread1(std::hypot(m.w1.x, m.w1.z) / std::sqrt(m.m0 * m.u2)),
         [&](const Means& s) { return spread1(std::hypot(s[hu_x], s[hu_z]) / std::sqrt(s[rest_h2] * s[rest_u2])); });
  expect("spread of the second moment", spread2(m.k0_wide.xx, m.k0_wide.zz, m.k0_wide.xz),
         [](const Means& s) { return spread2(s[d_xx], s[d_zz], s[d_xz]); });
  expect("spread of slopes", spread2(m.k2.xx, m.k2.zz, m.k2.xz),
         [](const Means& s) { return spread2(s[s_xx], s[s_zz], s[s_xz]); });
  expect("slope variance", m.k2.trace(), [](const Means& s) { return s[s_xx] + s[s_zz]; });
  if (of.slopes_of_the_displaced)
    expect("slope variance of the displaced", truth::chopped_slopes(m, of.sea.chop),
           [](const Means& s) { return s[mean_s2]; });
  expect("mean level m", h.mean, [](const Means& s) { return s[mean_h]; });
  expect("skewness about the still sea", h.cube / std::pow(h.square, 1.5),
         [](const Means& s) { return s[mean_h3] / std::pow(s[mean_h2], 1.5); });
  expect("skewness about the mean", central_skewness(h.mean, h.square, h.cube),
         [](const Means& s) { return central_skewness(s[mean_h], s[mean_h2], s[mean_h3]); });
}

int seed_count() { return test::long_run() ? 200 : 40; }

// 40 seeds (200 with SEASCAPE_LONG). Controls: amplitudes 3 % higher fail Hs and slope variance by 10 standard errors;
// Donelan's beta 10 % higher the spreads; chop of the other sign the mean level, the skewness and the direction;
// amplitudes not divided by the bilinear filter's response Hs and slope variance.
TEST(SeaStatistics, wind_sea) { expect_theory({"wind", {}, 2, true}, seed_count()); }
TEST(SeaStatistics, swell_under_wind) {
  SeaState sea;
  sea.wind_speed_mps = 8;
  sea.fetch_m = 120e3;
  sea.swell_height_m = 1.2;
  sea.swell_period_s = 11;
  expect_theory({"swell", sea, 3, false}, seed_count());
}
TEST(SeaStatistics, storm) {
  SeaState sea;
  sea.wind_speed_mps = 23;
  sea.fetch_m = 400e3;
  sea.chop = 1.15;
  expect_theory({"storm", sea, 2, true}, seed_count());
}
TEST(SeaStatistics, finite_depth) {
  SeaState sea;
  sea.spectrum = WaveSpectrum::tma;
  sea.wind_speed_mps = 12;
  sea.depth_m = 12;
  expect_theory({"depth", sea, 2, true}, seed_count());
}

}  // namespace
}  // namespace seascape
