// No tiling: how alike the drawn sea is to itself 1 to 4 km away, over the infinite plane, beside the continuous
// spectrum.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "app/scene.h"
#include "ocean/waves/gaussian.h"
#include "ocean/waves/wave_field.h"
#include "tests/support/autocorrelation.h"
#include "tests/support/causes_of_sea.h"
#include "tests/support/sampled.h"
#include "tests/support/warped_tile.h"

namespace seascape {
namespace {

constexpr double most_excess = 0.2;

// The tiles' variance as drawn, or as expected over seeds: without the Gaussian numbers that the waves were drawn by.
std::vector<truth::SpectralTile> tiles_of(const SeaState& sea, const WaveBins& bins, bool expected) {
  std::vector<truth::SpectralTile> tiles;
  for (int c = 0; c < bins.cascades; ++c) {
    const int half = bins_of(c) / 2;
    truth::SpectralTile tile{bins.ladder[std::size_t(c)].side_m, bins.ladder[std::size_t(c)].rotation_rad, half, {}};
    tile.variance.assign(std::size_t(4 * half * half), 0.0);
    for (int mz = -half + 1; mz < half; ++mz)
      for (int mx = -half + 1; mx < half; ++mx) {
        const glm::dvec2 a(bins.at(c, mx, mz).amplitude), g = gaussian_pair(sea.seed, c, mx, mz);
        tile.variance[std::size_t((mz + half) * 2 * half + mx + half)] =
            glm::dot(a, a) * (expected ? 1.0 / glm::dot(g, g) : 0.5);
      }
    if (const PatternWarp warp = c == 0 ? PatternWarp(bins.ladder) : PatternWarp(); warp)
      for (const PatternWarp::Wave& wave : warp.waves())
        tile.warp.push_back({wave.along.x, wave.along.y, wave.way.x, wave.way.y});
    tiles.push_back(std::move(tile));
  }
  return tiles;
}

truth::ContinuousAutocorrelation continuous_of(const SeaState& sea) {
  const truth::SeaSpectrum spectrum(test::causes_of(sea));
  double longest = 0.0, most = 0.0;
  for (double k = 1e-3; k < 10.0; k *= 1.02) {
    double density = 0.0;
    for (int c = 0; c < spectrum.components(); ++c) density += k * spectrum.over_k(c, k);
    if (density > most) most = density, longest = 2.0 * truth::pi / k;
  }
  return {[&](double kx, double kz) { return spectrum.over_vector(kx, kz); }, spectrum.moments().m0, longest};
}

TEST(Repetition, a_periodic_field_is_the_sum_of_its_waves) {
  // Control: rows and columns exchanged.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::vector<double> variance(32 * 32);
  for (double& v : variance) v = any(random);
  const truth::PeriodicField field(16, 128,
                                   [&](int mx, int mz) { return variance[std::size_t((mz + 16) * 32 + mx + 16)]; });
  for (int i = 0; i < 50; ++i) {
    const double u = 3.0 * any(random) - 1.5, v = 3.0 * any(random) - 1.5;
    double sum = 0.0, all = 0.0;
    for (int mz = -15; mz < 16; ++mz)
      for (int mx = -15; mx < 16; ++mx) {
        sum += variance[std::size_t((mz + 16) * 32 + mx + 16)] * std::cos(2.0 * truth::pi * (mx * u + mz * v));
        all += variance[std::size_t((mz + 16) * 32 + mx + 16)];
      }
    EXPECT_NEAR(field.cubic(u, v), sum, 0.003 * all);
    EXPECT_NEAR(field.linear(u, v), sum, 0.02 * all);
  }
}

TEST(Repetition, a_continuous_bell_has_its_closed_form) {
  // A bell of waves around 250 m: R = exp(-s^2 r^2 / 2) cos(k0 . r). Control: the grid's step twice as long.
  const double kx = 2.0 * truth::pi / 250.0 * std::cos(0.6), kz = 2.0 * truth::pi / 250.0 * std::sin(0.6),
               s = 0.1 * 2.0 * truth::pi / 250.0;
  const auto density = [&](double x, double z) {
    return std::exp(-(std::pow(x - kx, 2) + std::pow(z - kz, 2)) / (2.0 * s * s));
  };
  const truth::ContinuousAutocorrelation r(density, 2.0 * truth::pi * s * s, 250.0);
  for (const double length : {0.0, 40.0, 130.0, 500.0, 1000.0, 3900.0})
    for (const double angle : {0.0, 0.6, 2.0, 4.0}) {
      const double x = length * std::cos(angle), z = length * std::sin(angle);
      EXPECT_NEAR(r.at(x, z), std::exp(-s * s * length * length / 2.0) * std::cos(kx * x + kz * z), 0.01)
          << length << " " << angle;
    }
}

// A narrow sea of 200 m waves in tiles, their shares equal.
struct Planted {
  double side_m, rotation_rad;
};
std::vector<truth::SpectralTile> planted(const std::vector<Planted>& sides) {
  std::vector<truth::SpectralTile> tiles;
  for (const auto& [side, rotation] : sides) {
    truth::SpectralTile tile{side, rotation, 64, std::vector<double>(128 * 128, 0.0)};
    for (int mz = -63; mz < 64; ++mz)
      for (int mx = -63; mx < 64; ++mx) {
        const double length = side / std::max(1e-9, std::hypot(double(mx), double(mz)));
        if (length > 150.0 && length < 280.0) tile.variance[std::size_t((mz + 64) * 128 + mx + 64)] = 1.0;
      }
    const double total = tile.total();
    for (double& v : tile.variance) v /= total * double(sides.size());
    tiles.push_back(std::move(tile));
  }
  return tiles;
}

TEST(Repetition, the_search_finds_planted_tiles) {
  // What must be found is the control of the bars below: one tile of 1.5 km, all there is, at its own lattice; one of
  // 1100 m with a third of the variance, among long ones; two almost alike with one rotation, whose peaks add up, which
  // turned they do not.
  const truth::ContinuousAutocorrelation none([](double, double) { return 0.0; }, 1.0, 200.0);
  const truth::Excess one = truth::largest_excess(planted({{1500.0, 0.3}}), none);
  EXPECT_NEAR(one.value, 1.0, 0.01);
  const glm::dvec2 lag = rotate_xz({one.x_m, one.z_m}, -0.3) / 1500.0;
  EXPECT_LE(glm::length(lag - glm::round(lag)), 0.01);
  const double third = truth::largest_excess(planted({{1100.0, 0.3}, {9100.0, 1.0}, {9700.0, 2.0}}), none).value;
  EXPECT_NEAR(third, 1.0 / 3.0, 0.05);
  const double aligned = truth::largest_excess(planted({{1100.0, 0.3}, {1101.0, 0.3}}), none).value;
  const double turned = truth::largest_excess(planted({{1100.0, 0.3}, {1117.0, 0.8}}), none).value;
  EXPECT_GT(aligned, 0.98);
  EXPECT_LT(turned, 0.9);
}

// A tile of 1.5 km that waves of shift warp, their wave vectors times `along` and their shifts times `way`.
truth::SpectralTile warped_tile(double along, double way) {
  truth::SpectralTile tile = planted({{1500.0, 0.3}}).front();
  tile.warp = {{along / 3100.0, along / 4700.0, 160.0 * way, 60.0 * way},
               {-along / 5300.0, along / 2900.0, -50.0 * way, 190.0 * way},
               {along / 9100.0, along / 8300.0, 220.0 * way, -240.0 * way}};
  return tile;
}

TEST(Repetition, a_warped_tile_is_its_mean_over_the_plane) {
  // The product of J0 against the mean of cosines at many places. Control: half the argument of J0.
  const truth::SpectralTile tile = warped_tile(1.0, 0.3);
  const double total = tile.total();
  const truth::PeriodicField field(
      64, 1024, [&](int mx, int mz) { return tile.variance[std::size_t((mz + 64) * 128 + mx + 64)] / total; });
  const truth::WarpedTile warped(tile, total);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-1e7, 1e7);
  double largest = 0.0;
  for (const glm::dvec2 lag : {glm::dvec2(1433.0, 443.3), glm::dvec2(1443.0, 473.0), glm::dvec2(90.0, -50.0)}) {
    double mean = 0.0;
    constexpr int places = 40000;
    for (int i = 0; i < places; ++i) {
      const glm::dvec2 at(anywhere(random), anywhere(random));
      glm::dvec2 apart = lag;
      for (const truth::WarpWave& wave : tile.warp) {
        const auto sine = [&](glm::dvec2 x) {
          return std::sin(2.0 * truth::pi * (wave.along_x * x.x + wave.along_z * x.y));
        };
        apart += (sine(at + lag) - sine(at)) * glm::dvec2(wave.way_x, wave.way_z);
      }
      const glm::dvec2 in_tile = rotate_xz(apart, -tile.rotation_rad) / tile.side_m;
      mean += field.cubic(in_tile.x, in_tile.y) / places;
    }
    EXPECT_NEAR(warped.at(lag.x, lag.y), mean, 0.03) << lag.x << ' ' << lag.y;
    largest = std::max(largest, std::abs(mean));
  }
  EXPECT_GT(largest, 0.2);
}

TEST(Repetition, the_search_knows_what_a_warp_takes) {
  // Warped, a tile that is all there is passes; warped by a tenth, or by waves that come round within it, it is found.
  const truth::ContinuousAutocorrelation none([](double, double) { return 0.0; }, 1.0, 200.0);
  const auto excess = [&](truth::SpectralTile tile) {
    const std::vector<truth::SpectralTile> tiles{std::move(tile)};
    return truth::largest_excess(tiles, none).value;
  };
  truth::SpectralTile whole = warped_tile(1.0, 1.0);
  for (truth::WarpWave& wave : whole.warp) {
    const glm::dvec2 along = rotate_xz({1.0 / 1500.0, 0.0}, 0.3);
    wave.along_x = along.x, wave.along_z = along.y;
  }
  EXPECT_LT(excess(warped_tile(1.0, 1.0)), 0.25);
  EXPECT_GT(excess(warped_tile(1.0, 0.1)), 0.7);
  EXPECT_GT(excess(std::move(whole)), 0.9);
}

void expect_no_tiling(const std::string& name, SeaState sea, const std::vector<WaveQuality>& qualities,
                      int fewest_seeds = 2) {
  const truth::ContinuousAutocorrelation continuous = continuous_of(sea);
  // 1 but for the waves too short for its grid, which are all of a light sea's.
  EXPECT_GT(continuous.at(0.0, 0.0), ladder(sea)[0].warped ? -1e-3 : 0.6);
  EXPECT_LT(continuous.at(0.0, 0.0), 1.01);
  const auto expect = [&](const std::string& what, const std::vector<truth::SpectralTile>& tiles) {
    const truth::Excess e = truth::largest_excess(tiles, continuous);
    EXPECT_GT(e.value, 0.0) << name << " " << what;  // over so many lags noise alone is above it
    EXPECT_LE(e.value, most_excess) << name << " " << what << " at " << e.x_m << ", " << e.z_m << " ("
                                    << std::hypot(e.x_m, e.z_m) << " m): tiles " << e.tiles << ", continuous "
                                    << e.continuous;
    ::testing::Test::RecordProperty((name + " " + what).c_str(), std::to_string(e.value));
  };
  // Resolution changes no wave from 64 samples on, so that a preset is its number of cascades.
  std::set<int> cascades;
  for (const WaveQuality& quality : qualities) {
    ASSERT_GE(quality.resolution, 64);
    cascades.insert(quality.cascades);
  }
  const auto bins = [&](int kept) { return make_wave_bins(sea, {.resolution = 256, .cascades = kept}); };
  for (const int kept : cascades)
    if (kept == *cascades.begin() || test::long_run())
      expect(std::to_string(kept) + " cascades, expected", tiles_of(sea, bins(kept), true));
  const int seeds = test::long_run() ? 25 : fewest_seeds;
  for (int i = 0; i < seeds; ++i) {
    sea.seed = std::uint32_t(1 + i);
    expect("seed " + std::to_string(sea.seed), tiles_of(sea, bins(*cascades.rbegin()), false));
  }
}

TEST(Repetition, hard_scenes_do_not_tile_at_any_preset) {
  // Expected over seeds, and as single seeds draw it. Controls: the longest tile's side 1499 m (0.98 and more); the
  // longest tile with |m| < 62 alone (0.24 to 0.55).
  for (const char* scene : {"open_sea", "storm", "calm", "swell"}) {
    std::vector<WaveQuality> qualities;
    for (const char* preset : {"low", "medium", "high", "ultra"})
      qualities.push_back(load_scene(scene, preset).settings.waves);
    expect_no_tiling(scene, load_scene(scene, "ultra").settings.sea, qualities);
  }
}

TEST(Repetition, hard_winds_do_not_tile) {
  // A wind sea alone.
  for (const double wind : {10.0, 15.0, 25.0}) {
    SeaState sea;
    sea.wind_speed_mps = wind;
    expect_no_tiling("U " + std::to_string(int(wind)), sea, {{.resolution = 256, .cascades = 5}});
  }
}

TEST(Repetition, hard_light_winds_do_not_tile) {
  // Wind seas whose longest tile is warped, at every preset's number of cascades. In the smallest tile the search
  // takes long. Control: all shifts a fifth as long (0.65 to 0.85).
  for (const double wind : {3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0}) {
    if ((wind == 4.0 || wind == 6.0) && !test::long_run()) continue;
    SeaState sea;
    sea.wind_speed_mps = wind;
    ASSERT_TRUE(ladder(sea)[0].warped) << wind;
    std::vector<WaveQuality> qualities;
    for (const int cascades : {3, 4, 5}) qualities.push_back({.resolution = 256, .cascades = cascades});
    expect_no_tiling("U " + std::to_string(int(wind)), sea, qualities, wind >= 7.0 ? 1 : 0);
  }
}

}  // namespace
}  // namespace seascape
