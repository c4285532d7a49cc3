#include "ocean/places/wave_level.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/allocations.h"

namespace seascape {
namespace {

std::vector<WaveSource> sources_of(int count, double side_m) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<WaveSource> sources;
  for (int i = 0; i < count; ++i) {
    WaveSource s;
    s.place_m = side_m * (glm::dvec2(0.2) + 0.6 * glm::dvec2(unit(random), unit(random)));
    s.velocity_mps = {unit(random) - 0.5, unit(random)};
    s.length_m = 0.5 + 3.0 * unit(random);
    s.head_m = i % 3 == 0 ? 0.0 : unit(random);
    s.rise_mps = i % 4 == 1 ? 0.0 : unit(random) - 0.5;
    sources.push_back(s);
  }
  return sources;
}

std::vector<std::complex<double>> pushed(int samples, std::span<const WaveSource> sources) {
  WaveLevel level(samples);
  level.shape(0.25, false, 9.81, 5.0);
  level.turn(1.0 / 60.0, 0.1, {0, 0}, sources);
  return {level.modes().begin(), level.modes().end()};
}

// However many push at once, the waves are the sum of those of each alone. Control seen: the last sources forgotten
// where they are no whole group.
TEST(WaveLevel, OfManySourcesIsTheSumOfEach) {
  for (const int samples : {64, 128})
    for (const int count : {1, 15, 16, 17, 40}) {
      const std::vector<WaveSource> sources = sources_of(count, 0.25 * samples);
      const auto together = pushed(samples, sources);
      std::vector<std::complex<double>> sum(together.size());
      for (const WaveSource& one : sources) {
        const auto alone = pushed(samples, {&one, 1});
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += alone[i];
      }
      double highest = 0.0, worst = 0.0;
      for (std::size_t i = 0; i < sum.size(); ++i) {
        highest = std::max(highest, std::abs(sum[i]));
        worst = std::max(worst, std::abs(sum[i] - together[i]));
      }
      EXPECT_GT(highest, 1e-8);
      EXPECT_LE(worst, 1e-12 * highest) << samples << " texels, " << count << " sources";
    }
}

// Sources are taken in memory that is there: a shower is a thousand of them a step. Control seen: two lists for each
// (74 allocations).
TEST(WaveLevel, PushesWithoutAllocating) {
  if (!test::AllocationCounter::counts) GTEST_SKIP() << "nothing is counted";
  const std::vector<WaveSource> sources = sources_of(40, 16.0);
  WaveLevel level(64);
  level.shape(0.25, false, 9.81, 5.0);
  level.turn(1.0 / 60.0, 0.1, {0, 0}, {sources.data(), 1});
  const test::AllocationCounter allocations;
  level.turn(1.0 / 60.0, 0.1, {0, 0}, sources);
  EXPECT_EQ(allocations.ours(), 0u);
}

// A source is a Gaussian at its place (Darmon, Benzaquen and Raphael 2014), in all the waves that a level carries, by
// the plain sum. Controls seen: the waves of opposite numbers left out, of water that is added and of pressures; rows
// that end a group of 8 early.
TEST(WaveLevel, ASourceIsAGaussianInEveryWaveItCarries) {
  constexpr int samples = 128, band = samples / 4;
  constexpr double texel_m = 0.25, side_m = texel_m * samples, dt = 1.0 / 60.0;
  WaveLevel level(samples);
  level.shape(texel_m, false, 9.81, 1e6);
  const WaveSource source{.place_m = {13.3, 18.9}, .length_m = 1.7, .head_m = 0.3, .rise_mps = 0.8};
  level.turn(dt, 0.0, {0, 0}, {&source, 1});
  int carried = 0;
  for (int j = 0; j < band; ++j)
    for (int i = 0; i < band; ++i) {
      const std::size_t at = std::size_t(j * band + i);
      const glm::dvec2 k = glm::dvec2(i - band / 2, j - band / 2) * (2.0 * std::numbers::pi / side_m);
      const double length_m = source.length_m, gaussian = length_m * length_m / (std::numbers::pi * side_m * side_m) *
                                                          std::exp(-glm::dot(k, k) * length_m * length_m /
                                                                   (4.0 * std::numbers::pi * std::numbers::pi));
      // The texel's middle counts. Water that is added turns for half of the time; what a pressure holds, for all of
      // it.
      const double place = -glm::dot(k, source.place_m - 0.5 * texel_m), turned = -level.frequency()[at] * dt;
      const std::complex<double> added = std::polar(source.rise_mps * dt, place + 0.5 * turned),
                                 held = source.head_m * (std::polar(1.0, place + turned) - std::polar(1.0, place));
      const std::complex<double> want = level.share()[at] * gaussian * (added + held);
      EXPECT_LE(std::abs(level.modes()[at] - want), 1e-12 * source.rise_mps) << i << ' ' << j;
      carried += level.share()[at] > 0.0;
    }
  EXPECT_GT(carried, 600);
}

}  // namespace
}  // namespace seascape
