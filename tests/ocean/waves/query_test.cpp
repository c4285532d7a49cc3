#include "ocean/waves/query.h"

#include <gtest/gtest.h>

#include <random>

#include "ocean/waves/wave_tiles.h"
#include "tests/support/truth.h"

namespace seascape {
namespace {

TEST(Query, equals_the_inverse_by_brute_force) {
  // The rest position whose displaced place is nearest, searched on finer and finer grids. Control: heights read at the
  // place itself, without inverting, miss by 0.15 m.
  SeaState sea;
  sea.wind_speed_mps = 10;
  const WaveField field(sea, {.resolution = 128, .cascades = 2});
  WaveTiles tiles;
  field.evaluate(ticks_from_seconds(3), tiles);
  std::mt19937 random(4);
  double naive = 0;
  for (int i = 0; i < 25; ++i) {
    const glm::dvec2 place(random() % 1000, random() % 1000);
    glm::dvec2 best = place;
    double reach = 6;
    for (int round = 0; round < 12; ++round, reach *= 0.4) {
      const glm::dvec2 centre = best;
      double least = 1e9;
      for (int z = -8; z <= 8; ++z)
        for (int x = -8; x <= 8; ++x) {
          const glm::dvec2 rest = centre + reach / 8 * glm::dvec2(x, z);
          const glm::dvec3 d = field.displacement(tiles, rest, 0);
          const double miss = glm::length(rest + glm::dvec2(d.x, d.z) - place);
          if (miss < least) least = miss, best = rest;
        }
    }
    const double truth = field.displacement(tiles, best, 0).y;
    QueryAnswer answer;
    query(field, tiles, {&place, 1}, {&answer, 1}, {.most_iterations = 30, .tolerance_m = 1e-5});
    EXPECT_TRUE(answer.converged);
    EXPECT_LE(answer.residual_m, 1e-5);
    EXPECT_NEAR(answer.height_m, truth, 2e-3);
    naive = std::max(naive, std::abs(field.displacement(tiles, place, 0).y - truth));
  }
  EXPECT_GT(naive, 0.05);
}

TEST(Query, normal_is_that_of_the_displaced_surface) {
  // Against differences of heights at neighbouring places, of waves so long (40 texels) that the tile's own interpolation
  // does not matter. Control: grad h without the inverse of I + grad D, which the last line bounds from below.
  const WaveQuality quality{.resolution = 256, .cascades = 1};
  const SeaState sea;
  WaveBins bins = make_wave_bins(sea, quality);
  const double step = 2 * truth::pi / bins.ladder[0].side_m;
  for (int mz = -128; mz < 128; ++mz)
    for (int mx = -128; mx < 128; ++mx) {
      const double m = std::hypot(mx, mz);
      // Six waves of steepness 0.06 or so each.
      bins.at(0, mx, mz).amplitude = (std::abs(mx) + std::abs(mz) == 6 && mx > 0) ? glm::vec2(float(0.06 / (step * m)), 0) : glm::vec2(0);
    }
  const WaveField field(sea, quality, bins);
  WaveTiles tiles;
  field.evaluate(ticks_from_seconds(8), tiles);
  std::mt19937 random(5);
  double error = 0, size = 0, naive = 0;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec2 p(random() % 1000, random() % 1000);
    const double e = bins.ladder[0].side_m / 256;
    const glm::dvec2 places[5] = {p, p + glm::dvec2(e, 0), p - glm::dvec2(e, 0), p + glm::dvec2(0, e), p - glm::dvec2(0, e)};
    QueryAnswer a[5];
    query(field, tiles, places, a, {.most_iterations = 60, .tolerance_m = 1e-6});
    const glm::dvec2 truth((a[1].height_m - a[2].height_m) / (2 * e), (a[3].height_m - a[4].height_m) / (2 * e));
    const glm::dvec2 got = -glm::dvec2(a[0].normal.x, a[0].normal.z) / a[0].normal.y;
    const glm::dvec2 rest = p - glm::dvec2(a[0].displacement.x, a[0].displacement.z);
    const glm::dvec2 plain = field.sea(tiles, rest, 0).height_gradient;
    error += glm::dot(truth - got, truth - got), size += glm::dot(truth, truth), naive += glm::dot(truth - plain, truth - plain);
  }
  EXPECT_LE(std::sqrt(error / size), 0.05);
  EXPECT_GE(std::sqrt(naive / size), 0.1);
  RecordProperty("relative_error", std::to_string(std::sqrt(error / size)) + " plain " + std::to_string(std::sqrt(naive / size)));
}

TEST(Query, velocity_is_the_change_of_displacement) {
  // Control: -w instead of w turns it about.
  SeaState sea;
  sea.swell_height_m = 1;
  const WaveField field(sea, {.resolution = 128, .cascades = 3});
  WaveTiles now(true), before, after;
  const double t = 1e4, step = 1.0 / 256;
  field.evaluate(ticks_from_seconds(t), now);
  field.evaluate(ticks_from_seconds(t - step), before);
  field.evaluate(ticks_from_seconds(t + step), after);
  std::mt19937 random(6);
  double error = 0, size = 0;
  for (int i = 0; i < 100; ++i) {
    const glm::dvec2 p(random() % 1000, random() % 1000);
    const glm::dvec3 truth = (field.displacement(after, p, 0) - field.displacement(before, p, 0)) / (2 * step);
    const glm::dvec3 d = field.velocity(now, p, 0) - truth;
    error += glm::dot(d, d), size += glm::dot(truth, truth);
  }
  EXPECT_LE(std::sqrt(error / size), 1e-3);
}

TEST(Query, a_wider_object_feels_fewer_waves) {
  // Control: a footprint that is ignored leaves the variance as it is.
  const WaveField field(SeaState{}, {.resolution = 128, .cascades = 4});
  WaveTiles tiles;
  field.evaluate(0, tiles);
  double variance[3] = {};
  const double footprints[3] = {0, 20, 1e5};
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec2 p(random() % 10000, random() % 10000);
    for (int j = 0; j < 3; ++j) {
      QueryAnswer a;
      query(field, tiles, {&p, 1}, {&a, 1}, {.footprint_m = footprints[j]});
      variance[j] += a.height_m * a.height_m;
    }
  }
  EXPECT_LT(variance[1], 0.9 * variance[0]);
  EXPECT_GT(variance[1], 0.2 * variance[0]);
  EXPECT_EQ(variance[2], 0);
}

}  // namespace
}  // namespace seascape
