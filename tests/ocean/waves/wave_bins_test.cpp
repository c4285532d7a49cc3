#include <gtest/gtest.h>

#include <cstring>

#include "ocean/waves/gaussian.h"
#include "ocean/waves/spectrum.h"
#include "ocean/waves/wave_field.h"
#include "shaders/shared/phase.h"
#include "tests/support/spectrum_truth.h"

namespace seascape {
namespace {

// The spectrum's variance within the drawn bands: shares of the kept cascades, over the wave number.
double drawn_variance(const SeaState& sea, int cascades) {
  const Spectrum spectrum(sea);
  const Ladder l = ladder(sea);
  return truth::integral(
      [&](double s) {
        const double k = std::exp(s);
        double share = 0, density = 0;
        for (int i = 0; i < cascades; ++i) share += band_share(l, i, k);
        if (share == 0) return 0.0;
        for (int c = 0; c < Spectrum::components; ++c) density += spectrum.radial(c, k);
        return share * density * k * k;
      },
      std::log(1e-3), std::log(1e3), 1e-7);
}

TEST(Gaussian, pairs_are_standard_and_independent) {
  // Control: taking both numbers from one hash correlates radius and angle; dropping the sign of mx repeats pairs.
  double sum = 0, square = 0, product = 0, fourth = 0;
  int count = 0;
  for (int mz = -200; mz < 200; ++mz)
    for (int mx = -200; mx < 200; ++mx) {
      const glm::dvec2 g = gaussian_pair(7, 1, mx, mz);
      sum += g.x + g.y;
      square += g.x * g.x + g.y * g.y;
      product += g.x * g.y;
      fourth += std::pow(g.x, 4) + std::pow(g.y, 4);
      count += 2;
    }
  const double error = 4 / std::sqrt(double(count));
  EXPECT_NEAR(sum / count, 0, error);
  EXPECT_NEAR(square / count, 1, error * std::sqrt(2.0));
  EXPECT_NEAR(product / (count / 2), 0, error * std::sqrt(2.0));
  EXPECT_NEAR(fourth / count, 3, error * std::sqrt(96.0));
  EXPECT_NE(gaussian_pair(7, 1, 3, 4), gaussian_pair(7, 1, -3, 4));
  EXPECT_NE(gaussian_pair(7, 1, 3, 4), gaussian_pair(7, 1, 4, 3));
  EXPECT_NE(gaussian_pair(7, 1, 3, 4), gaussian_pair(7, 2, 3, 4));
  EXPECT_NE(gaussian_pair(7, 1, 3, 4), gaussian_pair(8, 1, 3, 4));
  EXPECT_EQ(gaussian_pair(7, 1, 3, 4), gaussian_pair(7, 1, 3, 4));
}

TEST(Phase, cosine_and_sine_of_turns) {
  // Control: a quadrant table with the signs of quarters 1 and 2 swapped fails at once.
  double worst = 0;
  for (std::uint64_t t = 0; t < 0x100000000u; t += 40503 * 3) {
    const glm::vec2 cs = gpu::cos_sin_turns(gpu::uint(t));
    const double angle = double(t) * 0x1p-32 * 2 * truth::pi;
    worst = std::max({worst, std::abs(cs.x - std::cos(angle)), std::abs(cs.y - std::sin(angle))});
  }
  EXPECT_LE(worst, 1e-7);
}

TEST(WaveBins, expected_variance_is_the_spectrums) {
  // Mean of 50 seeds against the integral over the drawn bands, within 3 standard errors. Control: amplitude
  // sqrt(S dk^2 / 2) halves it.
  for (const double swell : {0.0, 2.0}) {
    SeaState sea;
    sea.swell_height_m = swell;
    sea.fetch_m = 100e3;
    double sum = 0, square = 0;
    constexpr int seeds = 50;
    for (int i = 0; i < seeds; ++i) {
      sea.seed = 100 + i;
      const double v = sea_statistics(sea, make_wave_bins(sea, {.resolution = 256, .cascades = 4})).height_variance;
      sum += v;
      square += v * v;
    }
    const double mean = sum / seeds, error = std::sqrt((square / seeds - mean * mean) / (seeds - 1));
    EXPECT_NEAR(mean, drawn_variance(sea, 4), 3 * error);
    EXPECT_LT(error / mean, 0.02);
  }
}

// Sum of the variance that the bins were drawn with: amplitude over the Gaussian it was drawn by.
double sum_of_cells(const SeaState& sea, const WaveBins& bins) {
  double sum = 0;
  for (int c = 0; c < bins.cascades; ++c)
    for (int mz = -bins_of(c) / 2; mz < bins_of(c) / 2; ++mz)
      for (int mx = -bins_of(c) / 2; mx < bins_of(c) / 2; ++mx) {
        const glm::dvec2 a(bins.at(c, mx, mz).amplitude), g = gaussian_pair(sea.seed, c, mx, mz);
        sum += glm::dot(a, a) / glm::dot(g, g);
      }
  return sum;
}

TEST(WaveBins, cells_hold_the_spectrums_integral) {
  // Summed, against the integral over the drawn bands: no noise, so even a swell of two waves a tile is right to 1 %.
  // Control: the spectrum at the bins' centres misses that swell, of 30 s, by 16 %.
  for (const double period : {0.0, 6.0, 12.0, 20.0, 30.0}) {
    SeaState sea;
    sea.wind_speed_mps = period > 0 ? 0 : 25;
    sea.swell_height_m = period > 0 ? 2 : 0;
    if (period > 0) sea.swell_period_s = period;
    const double ratio =
        sum_of_cells(sea, make_wave_bins(sea, {.resolution = 256, .cascades = 4})) / drawn_variance(sea, 4);
    EXPECT_NEAR(ratio, 1, 0.01) << period;
    RecordProperty("ratio_" + std::to_string(int(period)), std::to_string(ratio));
  }
}

TEST(WaveBins, cells_hold_every_spectrum_spreading_and_depth) {
  // Control: densities without their cascade's share count the overlaps twice.
  for (int spectrum = 0; spectrum < 4; ++spectrum)
    for (int spreading = 0; spreading < 4; ++spreading)
      for (const double depth : {3.0, 30.0, deep_water_m}) {
        SeaState sea;
        sea.spectrum = WaveSpectrum(spectrum);
        sea.spreading = WaveSpreading(spreading);
        sea.depth_m = depth;
        sea.swell_elongation = 0.5;
        sea.swell_height_m = 0.5, sea.swell2_height_m = 0.7, sea.swell3_height_m = 0.2;
        const double ratio =
            sum_of_cells(sea, make_wave_bins(sea, {.resolution = 256, .cascades = 5})) / drawn_variance(sea, 5);
        EXPECT_NEAR(ratio, 1, 0.01) << spectrum << " " << spreading << " " << depth;
      }
}

TEST(WaveBins, a_cell_is_the_spectrums_integral_over_it) {
  // Single bins, near the peak and far out, against the exact spectrum's integral over the cell by adaptive quadrature:
  // 0.5 % and 3.5e-4 of the largest (where a narrow swell has all but ended its table's straight lines are off by
  // that). Controls: directions turned by the cascade's rotation the wrong way; the table's rows of angles read one row
  // on.
  SeaState sea;
  sea.swell_height_m = 1;
  sea.swell_elongation = 0.3;
  const Spectrum spectrum(sea);
  const WaveBins bins = make_wave_bins(sea, {.resolution = 256, .cascades = 5});
  double largest = 0;
  for (int c = 0; c < 5; ++c)
    for (const glm::ivec2 place :
         {glm::ivec2(2, 1), {-3, 5}, {7, -8}, {0, -12}, {12, 6}, {-20, 3}, {15, -15}, {24, 2}, {5, -29}}) {
      const glm::ivec2 m = (c == 0 ? 3 : 1) * place;  // the first has four times as many
      const double step = 2 * truth::pi / bins.ladder[c].side_m, tolerance = 3e-11 / (step * step);
      const auto column = [&](double x) {
        const auto density = [&](double z) {
          const glm::dvec2 k = step * rotate_xz({x, z}, bins.ladder[c].rotation_rad);
          const double share = band_share(bins.ladder, c, glm::length(k));
          return share > 0 ? share * spectrum(k) : 0.0;
        };
        return truth::integral(density, m.y - 0.5, m.y + 0.5, tolerance, 4);
      };
      const double cell = step * step * truth::integral(column, m.x - 0.5, m.x + 0.5, tolerance, 4);
      largest = std::max(largest, cell);
      const glm::dvec2 a(bins.at(c, m.x, m.y).amplitude), g = gaussian_pair(sea.seed, c, m.x, m.y);
      EXPECT_NEAR(glm::dot(a, a) / glm::dot(g, g), cell, 5e-3 * cell + 2.3e-8) << c << ": " << m.x << ", " << m.y;
    }
  EXPECT_NEAR(largest, 6.55e-5, 1e-6);
}

TEST(WaveBins, quality_never_changes_a_wave_that_it_keeps) {
  // Control: a draw that depends on the resolution, or bins kept whose |m| reaches half of it.
  SeaState sea;
  sea.swell_height_m = 1;
  const WaveBins full = make_wave_bins(sea, {.resolution = 512, .cascades = 5});
  for (const int resolution : {16, 32, 64, 128, 256})
    for (const int cascades : {1, 3, 5}) {
      const WaveBins some = make_wave_bins(sea, {.resolution = resolution, .cascades = cascades});
      ASSERT_EQ(some.bins.size(), 256u * 256 + std::size_t(cascades - 1) * 64 * 64);
      int kept = 0;
      for (int c = 0; c < cascades; ++c)
        for (int mz = -bins_of(c) / 2; mz < bins_of(c) / 2; ++mz)
          for (int mx = -bins_of(c) / 2; mx < bins_of(c) / 2; ++mx) {
            const gpu::WaveBin& a = some.at(c, mx, mz);
            const int samples = c > 0 ? resolution : std::min(4 * resolution, 512);
            if (mx * mx + mz * mz >= samples * samples / 4) {
              EXPECT_EQ(a.amplitude, glm::vec2(0));
              continue;
            }
            EXPECT_EQ(std::memcmp(&a, &full.at(c, mx, mz), sizeof a), 0);
            kept += a.amplitude != glm::vec2(0);
          }
      EXPECT_GT(kept, 10 * cascades);
    }
}

TEST(WaveBins, hard_8_and_9_origin_and_edge_rows_are_zero) {
  // Hard cases 8 and 9, at every resolution. Control: starting the loops at -32 and keeping |m| = 32 fails.
  for (const int resolution : {16, 32, 64, 128, 256, 512}) {
    const WaveBins bins = make_wave_bins({}, {.resolution = resolution, .cascades = 5});
    for (int c = 0; c < 5; ++c) {
      const int edge = c > 0 ? std::min(resolution / 2, 32) : std::min(2 * resolution, 128);
      EXPECT_EQ(bins.at(c, 0, 0).amplitude, glm::vec2(0));
      for (int m = -edge; m < edge; ++m) {
        EXPECT_EQ(bins.at(c, -edge, m).amplitude, glm::vec2(0));
        EXPECT_EQ(bins.at(c, m, -edge).amplitude, glm::vec2(0));
      }
    }
  }
}

TEST(WaveBins, hard_1_and_4_no_wind_or_no_fetch_is_flat) {
  // Without wind, or without fetch, every bin of every spectrum has an amplitude of exactly 0 (hard cases 1 and 4).
  // Control: a wind floored at 0.5 m/s leaves waves.
  for (const auto& [wind, fetch, spectrum] : {std::tuple{0.0, 300e3, WaveSpectrum::jonswap},
                                              {10.0, 0.0, WaveSpectrum::jonswap},
                                              {0.0, 0.0, WaveSpectrum::tma},
                                              {0.0, 300e3, WaveSpectrum::pierson_moskowitz},
                                              {10.0, 0.0, WaveSpectrum::pierson_moskowitz},
                                              {0.0, 300e3, WaveSpectrum::elfouhaily},
                                              {10.0, 0.0, WaveSpectrum::elfouhaily},
                                              {10.0, 0.0, WaveSpectrum::tma}}) {
    SeaState sea;
    sea.spectrum = spectrum;
    sea.wind_speed_mps = wind;
    sea.fetch_m = fetch;
    const WaveBins bins = make_wave_bins(sea, {});
    for (const gpu::WaveBin& b : bins.bins) ASSERT_EQ(b.amplitude, glm::vec2(0));
    const SeaStatistics s = sea_statistics(sea, bins);
    EXPECT_EQ(s.height_variance, 0);
    EXPECT_EQ(s.largest_height_m, 0);
    if (wind == 0) {
      EXPECT_EQ(s.tail_slope_moments, glm::dvec3(0));
    }
  }
}

TEST(WaveBins, drawn_and_tail_slopes_come_to_cox_and_munk) {
  // Control: forgetting to turn the wind's axes into x and z swaps up- and crosswind.
  SeaState sea;
  sea.wind_to_deg = 90;  // along x
  sea.wind_speed_mps = 8;
  const truth::Elfouhaily wind(8, 0.85, 9.81);
  const truth::Slopes slopes = truth::cox_munk(truth::wind_at_12(8, wind.friction));
  for (const int cascades : {1, 3, 5}) {
    const SeaStatistics s = sea_statistics(sea, make_wave_bins(sea, {.resolution = 256, .cascades = cascades}));
    EXPECT_NEAR(s.slope_moments.x + s.tail_slope_moments.x, slopes.up, 0.004) << cascades;
    EXPECT_NEAR(s.slope_moments.y + s.tail_slope_moments.y, slopes.cross, 0.004) << cascades;
    EXPECT_GT(s.tail_slope_moments.x, 0);
    EXPECT_GT(s.tail_slope_moments.y, 0);
    // However few cascades draw them, the sum is the whole spectrum's.
    const glm::dvec3 whole = slope_moments(sea);
    EXPECT_NEAR(s.slope_moments.x + s.tail_slope_moments.x, whole.x, 1e-9) << cascades;
    EXPECT_NEAR(s.slope_moments.y + s.tail_slope_moments.y, whole.y, 1e-9) << cascades;
    EXPECT_NEAR(s.largest_height_m, 5.26 * std::sqrt(s.height_variance), 1e-9);
  }
}

TEST(WaveBins, hard_6_dry_land_is_flat) {
  // Depth 0 or less: amplitude 0 for every spectrum at every resolution. Control: a depth held at 1e-3 m, in trains,
  // dispersion and bins at once (each alone keeps it dry), leaves waves.
  for (int spectrum = 0; spectrum < 4; ++spectrum)
    for (const double depth : {0.0, -1.0, -1e6})
      for (const int resolution : {16, 32, 64, 128, 256, 512}) {
        SeaState sea;
        sea.spectrum = WaveSpectrum(spectrum);
        sea.depth_m = depth;
        sea.swell_height_m = 2;
        const WaveBins bins = make_wave_bins(sea, {.resolution = resolution});
        for (const gpu::WaveBin& b : bins.bins)
          ASSERT_TRUE(b.amplitude == glm::vec2(0) && b.turns_high == 0 && b.turns_low == 0);
        const SeaStatistics s = sea_statistics(sea, bins);
        EXPECT_EQ(s.height_variance, 0);
        EXPECT_EQ(s.tail_slope_moments, glm::dvec3(0));
      }
}

TEST(WaveBins, hard_2_every_sea_is_finite) {
  // Gales, calms, puddles and other planets. Control: tanh by exponentials, infinity over infinity in the deep.
  for (int spectrum = 0; spectrum < 4; ++spectrum)
    for (const double wind : {0.001, 0.01, 0.5, 2.0, 60.0, 100.0})
      for (const double depth : {1e-6, 0.5, 1e6})
        for (const double gravity : {0.01, 9.81, 1000.0}) {
          SeaState sea;
          sea.spectrum = WaveSpectrum(spectrum);
          sea.spreading = WaveSpreading(spectrum);
          sea.wind_speed_mps = wind;
          sea.depth_m = depth;
          sea.gravity_mps2 = gravity;
          sea.swell_height_m = 3;
          sea.swell_elongation = 1;
          const WaveBins bins = make_wave_bins(sea, {.resolution = 64});
          const SeaStatistics s = sea_statistics(sea, bins);
          for (const gpu::WaveBin& b : bins.bins)
            ASSERT_TRUE(std::isfinite(b.amplitude.x) && std::isfinite(b.amplitude.y));
          ASSERT_TRUE(std::isfinite(s.height_variance) &&
                      std::isfinite(s.tail_slope_moments.x + s.tail_slope_moments.y + s.tail_slope_moments.z))
              << spectrum << " " << wind << " " << depth << " " << gravity;
        }
}

}  // namespace
}  // namespace seascape
