#include "ocean/places/shallow_water.h"

#include <gtest/gtest.h>

#include "tests/support/shallows_truth.h"

namespace seascape {
namespace {

constexpr double g = 9.81;

// One wave, whole numbers (m, 0) of the first cascade.
struct OneWave {
  explicit OneWave(double from_depth_m = deep_water_m, double height_m = 1e-4, int m = 40) {
    sea.depth_m = from_depth_m;
    bins = make_wave_bins(sea, WaveQuality{.resolution = 16, .cascades = 1});
    for (gpu::WaveBin& bin : bins.bins) bin.amplitude = glm::vec2(0.0f);
    bins.at(0, m, 0).amplitude = {float(height_m / std::sqrt(8.0)), 0.0f};  // H = 4 sqrt(a^2 / 2)
    k = 2.0 * truth::pi * m / bins.ladder[0].side_m;
    w = truth::airy(k, g, from_depth_m);
  }
  SeaState sea;
  WaveBins bins;
  double k, w;
};

truth::Train train_of(const WaveBins& bins, int cascade) {
  truth::Train result;
  const int half = bins_of(cascade) / 2;
  for (int mz = -half; mz < half; ++mz)
    for (int mx = -half; mx < half; ++mx) {
      const glm::dvec2 a(bins.at(cascade, mx, mz).amplitude);
      if (const double v = 0.5 * (a.x * a.x + a.y * a.y); v > 0.0)
        result[2.0 * truth::pi * std::hypot(mx, mz) / bins.ladder[std::size_t(cascade)].side_m] += v;
    }
  return result;
}

TEST(ShallowWater, one_wave_shoals_as_linear_theory_has_it) {
  // truths.md: Ks = sqrt(cg0 / cg), bar 1 %, and its minimum of 0.9130 at k h = 1.20. Heights so low that none breaks.
  // Control, seen: the
  // phase's speed in place of the energy's (0.41 off, least 1).
  double least = 10.0, least_kh = 0.0, worst = 0.0, green = 0.0;
  const OneWave wave;
  const ShallowWater water(wave.sea, wave.bins);
  for (double kh = 0.1; kh < 10.0; kh *= 1.02) {
    const double h = g * kh * std::tanh(kh) / (wave.w * wave.w), truth = truth::shoaling(wave.k, g, h, deep_water_m);
    const double factor = water.factor(0, h);
    worst = std::max(worst, std::abs(factor / truth - 1.0));
    if (kh > 0.5 && kh < 0.52) green = std::pow(2.0 * kh, -0.5) / truth;
    if (factor < least) least = factor, least_kh = kh;
  }
  EXPECT_LE(worst, 1e-3);
  EXPECT_NEAR(least, 0.9130, 1e-3);
  EXPECT_NEAR(least_kh, 1.20, 0.03);
  EXPECT_GT(std::abs(green - 1.0), 0.07);  // Green's law, for shallow water alone, would be seen
  RecordProperty("worst", std::to_string(worst));
}

TEST(ShallowWater, a_sea_of_finite_depth_shoals_from_there) {
  // Made for 12 m: 1 in 12 m, and higher where it is deeper than the depth of the minimum.
  // Control, seen: cg0 of the deep (0.972 in its own 12 m).
  const OneWave wave(12.0);
  const ShallowWater water(wave.sea, wave.bins);
  EXPECT_NEAR(water.factor(0, 12.0), 1.0, 1e-3);
  for (const double h : {1.0, 3.0, 8.0, 30.0, 200.0}) {
    EXPECT_NEAR(water.factor(0, h) / truth::shoaling(wave.k, g, h, 12.0), 1.0, 1e-3) << h;
    EXPECT_NEAR(water.steepening(0, h) / (truth::airy_inverse(wave.w, g, h) / wave.k), 1.0, 1e-3) << h;
  }
}

TEST(ShallowWater, a_whole_sea_meets_both_laws_at_every_depth) {
  // Every cascade of three winds and of a sea with a swell and another train, against sums over its bins: within 1e-3.
  // Heights stay below 0.594 of the depth, those of a high sea reach 0.58 of it. Controls, seen: breaking by the
  // heights before shoaling (0.0025 of the share broken), factors held at 1 (0.11).
  double worst = 0.0;
  for (const double wind : {3.0, 10.0, 25.0}) {
    SeaState sea;
    sea.wind_speed_mps = wind;
    if (wind == 10.0) sea.swell_height_m = 2.0, sea.swell_period_s = 14.0;
    const WaveBins bins = make_wave_bins(sea, WaveQuality{.resolution = 64, .cascades = 5});
    const OtherWaves others{60.0, 0.5};
    const ShallowWater water(sea, bins, others);
    std::vector<truth::Train> trains;
    for (int i = 0; i < 5; ++i) trains.push_back(train_of(bins, i));
    trains.push_back({{2.0 * truth::pi / 60.0, 0.5 * 0.5 / 16.0}});
    for (const double h : {0.003, 0.05, 0.4, 1.1, 2.9, 7.3, 18.0, 55.0, 400.0}) {
      std::vector<double> shoaled;
      double all = 0.0;
      for (const truth::Train& train : trains)
        all += shoaled.emplace_back(truth::shoaled_variance(train, g, h, deep_water_m));
      const double height = 4.0 * std::sqrt(all), left = truth::broken(height, h);
      for (std::size_t i = 0; i < trains.size(); ++i) {
        const double truth = std::sqrt(shoaled[i] / truth::variance(trains[i])) * left / height;
        const double factor = i < 5 ? water.factor(int(i), h) : water.others(h);
        worst = std::max(worst, std::abs(factor - truth));
      }
      EXPECT_NEAR(water.height_m(h) / left, 1.0, ShallowWater::table_error) << wind << " " << h;
      EXPECT_NEAR(water.breaking(h), 1.0 - std::pow(left / height, 2.0), ShallowWater::table_error) << wind << " " << h;
    }
    for (double h = 1e-4; h < 1e4; h *= 1.003) {
      ASSERT_LE(water.height_m(h), 0.595 * h) << wind << " " << h;
      double drawn = std::pow(water.others(h) * 0.5, 2.0) / 16.0;
      for (int i = 0; i < 5; ++i) drawn += truth::variance(trains[std::size_t(i)]) * std::pow(water.factor(i, h), 2.0);
      ASSERT_LE(4.0 * std::sqrt(drawn), 0.595 * h) << wind << " " << h;
    }
    if (wind == 25.0) {
      EXPECT_GT(water.height_m(2.0), 0.58 * 2.0);
    }
  }
  EXPECT_LE(worst, ShallowWater::table_error);
  RecordProperty("worst", std::to_string(worst));
}

}  // namespace
}  // namespace seascape
