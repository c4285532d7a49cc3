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
    s.place_m = side_m * (glm::dvec2(0.2) + 0.6 * glm::dvec2{unit(random), unit(random)});
    s.velocity_mps = {unit(random) - 0.5, unit(random)};
    s.length_m = 0.5 + 3.0 * unit(random);
    s.head_m = i % 3 == 0 ? 0.0 : unit(random);
    s.rise_mps = i % 4 == 1 ? 0.0 : unit(random) - 0.5;
    sources.push_back(s);
  }
  return sources;
}

// `by` as SourceSums has it.
std::vector<std::complex<double>> pushed(int samples, std::span<const WaveSource> sources, int by) {
  WaveLevel level(samples);
  level.sums().by = by;
  level.shape(0.25, false, 9.81, 5.0);
  level.turn(1.0 / 60.0, 0.1, {0, 0}, sources);
  return {level.modes().begin(), level.modes().end()};
}

double highest_of(std::span<const std::complex<double>> waves) {
  double highest = 0.0;
  for (const std::complex<double>& one : waves) highest = std::max(highest, std::abs(one));
  return highest;
}

double farthest(std::span<const std::complex<double>> one, std::span<const std::complex<double>> other) {
  double worst = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) worst = std::max(worst, std::abs(one[i] - other[i]));
  return worst;
}

// However many push at once, the waves are the sum of those of each alone. Control seen: the last sources forgotten
// where they are no whole group.
TEST(WaveLevel, OfManySourcesIsTheSumOfEach) {
  for (const int samples : {64, 128})
    for (const int count : {1, 15, 16, 17, 40}) {
      const std::vector<WaveSource> sources = sources_of(count, 0.25 * samples);
      const auto together = pushed(samples, sources, 0);
      std::vector<std::complex<double>> sum(together.size());
      for (const WaveSource& one : sources) {
        const auto alone = pushed(samples, {&one, 1}, 0);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += alone[i];
      }
      const double highest = highest_of(sum);
      EXPECT_GT(highest, 1e-8);
      EXPECT_LE(farthest(sum, together), 1e-12 * highest) << samples << " texels, " << count << " sources";
    }
}

// Through the texture that sources share, each wave is that of the plain sum within 5e-7 of the strongest source's,
// wherever in the window they lie, across its wrapped edges too, long or short, deep or not, heads alone and rises
// alone. Controls: a widening that is not undone; texels that do not wrap around; profiles cut off at exp(-9);
// rises that are not parted from heads. All seen.
TEST(WaveLevel, SourcesShareATextureAndLoseNothing) {
  for (const int samples : {64, 128, 256})
    for (int kind = 0; kind < 5; ++kind) {
      std::vector<WaveSource> sources = sources_of(kind == 0 ? 1 : 40, 0.25 * samples);
      for (std::size_t i = 0; i < sources.size(); ++i) {
        WaveSource& s = sources[i];
        s.place_m += 0.3 * 0.25 * samples * glm::dvec2(double(i % 2) - 1.0, double(i % 3) * 0.5);
        if (kind == 1) s.head_m = 0.0;
        if (kind == 2) s.rise_mps = 0.0;
        if (kind == 3) s.length_m = i % 2 ? 0.01 : 12.0 + 0.2 * double(i);
        if (kind == 4) s.depth_m = 0.1 * double(i);
      }
      // Windows around them, not beginning at 0.
      WaveLevel one_by_one(samples), shared(samples);
      for (WaveLevel* level : {&one_by_one, &shared}) {
        level->shape(0.25, kind % 2 == 0, 9.81, 5.0);
        level->sums().by = level == &shared;
        level->turn(1.0 / 60.0, 0.1, {-samples / 4, samples / 16}, sources);
      }
      double strongest = 0.0;
      for (const WaveSource& s : sources)
        strongest = std::max(strongest, s.length_m * s.length_m / (std::numbers::pi * 0.0625 * samples * samples) *
                                            std::max(std::abs(s.head_m), std::abs(s.rise_mps) / 60.0));
      EXPECT_GT(highest_of(one_by_one.modes()), 1e-3 * (kind == 3 ? 1e-6 : 1.0) * strongest);
      const double off = farthest(one_by_one.modes(), shared.modes());
      EXPECT_LE(off, 5e-7 * strongest) << samples << " texels, kind " << kind;
      EXPECT_GT(off, 0.0) << "the two are two ways";
    }
}

// Sources are taken in memory that is there: a shower is a thousand of them a step. Control seen: a list of their own
// each step (1 allocation).
TEST(WaveLevel, PushesWithoutAllocating) {
  if (!test::AllocationCounter::counts) GTEST_SKIP() << "nothing is counted";
  const std::vector<WaveSource> sources = sources_of(40, 16.0);
  WaveLevel level(64);
  level.shape(0.25, false, 9.81, 5.0);
  level.turn(1.0 / 60.0, 0.1, {0, 0}, sources);
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

// Of water given at a depth, each wave has exp(-k depth) of it (Airy 1845): within 0.7 % of all of it in a level's
// octave, within 4 % in the coarsest of 256 texels a side. Controls: one term where two are asked for
// (4 % and 17 %); half the width; both seen.
TEST(WaveLevel, WhatActsAtADepthRaisesLongWavesMore) {
  for (const bool coarsest : {false, true}) {
    const double bound = coarsest ? 0.04 : 0.007;
    double worst = 0.0;
    for (const double depth_m :
         {-1.0, 0.0, 0.003, 0.02, 0.05, 0.1, 0.15, 0.25, 0.4, 0.7, 1.0, 1.5, 2.5, 4.0, 8.0, 20.0}) {
      WaveSource source{.place_m = {31.3, 33.9}, .length_m = 1e-3, .rise_mps = 1.0, .depth_m = depth_m};
      WaveLevel deep(256), shallow(256);
      for (WaveLevel* level : {&deep, &shallow}) {
        level->shape(0.25, coarsest, 9.81, 1e6);
        level->turn(1.0 / 60.0, 0.0, {0, 0}, {&source, 1});
        source.depth_m = 0.0;
      }
      for (std::size_t i = 0; i < deep.modes().size(); ++i) {
        if (!(deep.share()[i] > 0.01)) continue;
        const double w = deep.frequency()[i], felt = std::exp(-w * w / 9.81 * std::max(depth_m, 0.0));
        worst = std::max(worst, std::abs(deep.modes()[i] / shallow.modes()[i] - felt));
      }
    }
    EXPECT_LT(worst, bound) << coarsest;
  }
}

}  // namespace
}  // namespace seascape
