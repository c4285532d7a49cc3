// How fast patterns of waves cease to be like themselves, against sums over all waves and against tiles.
#include "ocean/waves/pattern_moments.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "shaders/shared/flow_height.h"
#include "tests/support/truth.h"

namespace seascape {
namespace {

struct Wave {
  glm::dvec2 k;
  double variance;
};

std::vector<Wave> waves_of(const WaveBins& bins, int cascade) {
  std::vector<Wave> waves;
  const int half = bins_of(cascade) / 2;
  const Cascade& of = bins.ladder[std::size_t(cascade)];
  for (int mz = -half; mz < half; ++mz)
    for (int mx = -half; mx < half; ++mx) {
      const glm::dvec2 a(bins.at(cascade, mx, mz).amplitude);
      const double turn = 2.0 * truth::pi / of.side_m;
      if (a != glm::dvec2(0.0))
        waves.push_back({rotate_xz(turn * glm::dvec2(mx, mz), of.rotation_rad), 0.5 * glm::dot(a, a)});
    }
  return waves;
}

// The variance of the sum of all cascades' two patterns, `apart` from each other and each counting a half, over that of
// the sea: what it should keep is 1.
double variance_at_half(const WaveField& field, const std::vector<std::vector<Wave>>& cascades, glm::dvec2 apart) {
  double sum = 0.0, all = 0.0;
  for (std::size_t c = 0; c < cascades.size(); ++c) {
    const glm::dvec3 decay = field.places()[c].decay_per_m2;
    const double height = gpu::flow_height(decay.x, decay.y, decay.z, apart.x, apart.y, 0.5);
    for (const Wave& wave : cascades[c]) {
      sum += wave.variance * height * height * 0.5 * (1.0 + std::cos(glm::dot(wave.k, apart)));
      all += wave.variance;
    }
  }
  return sum / all;
}

// Two patterns of a current together stand as high as one, whatever lies between them and in which direction: the
// root mean square of the variance's logarithm, and its ends (a Gaussian knows no patterns that are opposite, so that
// along the waves at half a wave the variance falls to 0.5). Controls seen: the middle of a cascade's band for its wave
// number, as it was (0.25 to 0.27, and 0.32 to 0.38 of the variance); the same in every direction (1.32 to 1.39 across
// the waves); the moments along x and z exchanged (1.27 to 1.34).
TEST(PatternMoments, TwoPatternsStandAsHighAsOne) {
  std::vector<SeaState> seas(4);
  seas[1].wind_speed_mps = 20.0;
  seas[2].wind_speed_mps = 6.0, seas[2].fetch_m = 40e3, seas[2].depth_m = 40.0;
  seas[3].wind_speed_mps = 3.0;
  for (const SeaState& sea : seas) {
    const WaveField field(sea, {.resolution = 64, .cascades = 4});
    std::vector<std::vector<Wave>> cascades;
    for (int c = 0; c < 4; ++c) cascades.push_back(waves_of(field.bins(), c));
    double squares = 0.0, least = 10.0, most = 0.0;
    int count = 0;
    for (double distance_m = 0.25; distance_m < 400.0; distance_m *= 1.7)
      for (int i = 0; i < 12; ++i, ++count) {
        const double turn = truth::pi * i / 12.0;
        const double variance =
            variance_at_half(field, cascades, distance_m * glm::dvec2(std::cos(turn), std::sin(turn)));
        squares += std::log(variance) * std::log(variance);
        least = std::min(least, variance), most = std::max(most, variance);
      }
    EXPECT_LT(std::sqrt(squares / count), 0.15) << sea.wind_speed_mps;
    EXPECT_GT(least, 0.45) << sea.wind_speed_mps;
    EXPECT_LT(most, 1.27) << sea.wind_speed_mps;
  }
}

// Up to the distance's square the decay is the pattern's own, in every direction, and after take() that of the new
// waves. Control seen: take() without it.
TEST(PatternMoments, DecayIsThatOfTheCorrelationNearby) {
  SeaState sea;
  WaveField field(sea, {.resolution = 64, .cascades = 2});
  SeaState other = sea;
  other.wind_speed_mps = 7.0;
  const WaveBins bins = make_wave_bins(other, field.quality(), field.bins().ladder);
  for (const bool taken : {false, true}) {
    if (taken) field.take(bins, other.chop, sea_statistics(other, bins));
    for (int c = 0; c < 2; ++c) {
      const std::vector<Wave> waves = waves_of(taken ? bins : field.bins(), c);
      const glm::dvec3 decay = field.places()[std::size_t(c)].decay_per_m2;
      for (const glm::dvec2 towards : {glm::dvec2(1.0, 0.0), {0.0, 1.0}, {0.6, 0.8}, {0.6, -0.8}}) {
        const glm::dvec2 way = (c == 0 ? 0.5 : 0.1) * towards;
        double unlike = 0.0, all = 0.0;
        for (const Wave& wave : waves)
          unlike += wave.variance * (1.0 - std::cos(glm::dot(wave.k, way))), all += wave.variance;
        const double q = decay.x * way.x * way.x + decay.y * way.y * way.y + 2.0 * decay.z * way.x * way.y;
        EXPECT_NEAR(q, unlike / all, 0.01 * unlike / all) << taken << ' ' << c;
      }
    }
  }
}

// A source of one wave along x, laid once as it is and once at three times the size.
struct TwoSizes : TileSource {
  static constexpr double wave_number = 0.7, amplitude_m = 0.2;
  std::array<Laying, 2> sizes{{{.size = 1.0, .side_m = 40.0, .offset = 0.0, .longest_m = 9.0, .shortest_m = 9.0},
                               {.size = 3.0, .side_m = 120.0, .offset = 0.5, .longest_m = 27.0, .shortest_m = 27.0}}};
  std::string_view name() const override { return "particles"; }
  int samples() const override { return 16; }
  bool still() const override { return false; }
  std::span<const Laying> layings() const override { return sizes; }
  SourceStatistics statistics() const override {
    const double slope = wave_number * amplitude_m;
    return {.height_variance = 0.5 * amplitude_m * amplitude_m * (1.0 + 9.0),
            .slope_moments = {0.5 * slope * slope, 0.0, 0.0}};
  }
  std::size_t workspace_floats(bool) const override { return 0; }
  void evaluate(std::int64_t, bool, std::span<const PlaneLevel>, std::span<float>) const override {}
};

// Each of a source's layings has the wave number of its own size. Control seen: the source's variance for a laying's.
TEST(PatternMoments, ALayingsDecayIsThatOfItsSize) {
  const TwoSizes source;
  for (const Laying& laying : source.layings()) {
    const double k = TwoSizes::wave_number / laying.size;
    const glm::dvec3 decay = pattern_moments(source, laying).decay_per_m2();
    EXPECT_NEAR(decay.x, 0.5 * k * k, 1e-12) << laying.size;
    EXPECT_EQ(decay.y, 0.0);
    EXPECT_EQ(decay.z, 0.0);
  }
}

}  // namespace
}  // namespace seascape
