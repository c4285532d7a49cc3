#include "ocean/sea/query.h"

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
  // Against differences of heights at neighbouring places, of waves so long (40 texels) that the tile's own
  // interpolation does not matter. Control: grad h without the inverse of I + grad D, which the last line bounds from
  // below.
  const WaveQuality quality{.resolution = 256, .cascades = 1};
  const SeaState sea;
  WaveBins bins = make_wave_bins(sea, quality);
  const double step = 2 * truth::pi / bins.ladder[0].side_m;
  for (int mz = -128; mz < 128; ++mz)
    for (int mx = -128; mx < 128; ++mx) {
      const double m = std::hypot(mx, mz);
      // Six waves of steepness 0.06 or so each.
      bins.at(0, mx, mz).amplitude =
          (std::abs(mx) + std::abs(mz) == 6 && mx > 0) ? glm::vec2(float(0.06 / (step * m)), 0) : glm::vec2(0);
    }
  const WaveField field(sea, quality, bins);
  WaveTiles tiles;
  field.evaluate(ticks_from_seconds(8), tiles);
  std::mt19937 random(5);
  double error = 0, size = 0, naive = 0;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec2 p(random() % 1000, random() % 1000);
    const double e = bins.ladder[0].side_m / 256;
    const glm::dvec2 places[5] = {p, p + glm::dvec2(e, 0), p - glm::dvec2(e, 0), p + glm::dvec2(0, e),
                                  p - glm::dvec2(0, e)};
    QueryAnswer a[5];
    query(field, tiles, places, a, {.most_iterations = 60, .tolerance_m = 1e-6});
    const glm::dvec2 truth((a[1].height_m - a[2].height_m) / (2 * e), (a[3].height_m - a[4].height_m) / (2 * e));
    const glm::dvec2 got = -glm::dvec2(a[0].normal.x, a[0].normal.z) / a[0].normal.y;
    const glm::dvec2 rest = p - glm::dvec2(a[0].displacement.x, a[0].displacement.z);
    const glm::dvec2 plain = field.sea(tiles, rest, 0).height_gradient;
    error += glm::dot(truth - got, truth - got), size += glm::dot(truth, truth),
        naive += glm::dot(truth - plain, truth - plain);
  }
  EXPECT_LE(std::sqrt(error / size), 0.05);
  EXPECT_GE(std::sqrt(naive / size), 0.1);
  RecordProperty("relative_error",
                 std::to_string(std::sqrt(error / size)) + " plain " + std::to_string(std::sqrt(naive / size)));
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

// Some long waves in the first cascade, and nothing else: forty texels and more each, so that the tile's own
// interpolation hardly matters.
WaveBins few_waves(const SeaState& sea, const WaveQuality& quality) {
  WaveBins bins = make_wave_bins(sea, quality);
  const double step = 2 * truth::pi / bins.ladder[0].side_m;
  for (gpu::WaveBin& bin : bins.bins) bin.amplitude = glm::vec2(0);
  std::mt19937 random(12);
  for (const glm::ivec2 m : {glm::ivec2(3, 0), {2, 3}, {4, -1}, {1, 4}, {5, 2}, {-2, 3}}) {
    const double phase = 2 * truth::pi * double(random()) / 4294967296.0,
                 size = 0.12 / (step * glm::length(glm::dvec2(m)));
    bins.at(0, m.x, m.y).amplitude = glm::vec2(glm::dvec2(size * std::cos(phase), size * std::sin(phase)));
  }
  return bins;
}

// The displacement of those waves, by direct sums.
glm::dvec3 direct(const SeaState& sea, const WaveBins& bins, glm::dvec2 rest, double t) {
  glm::dvec3 sum(0);
  const double step = 2 * truth::pi / bins.ladder[0].side_m, o = std::cos(bins.ladder[0].rotation_rad),
               s = std::sin(bins.ladder[0].rotation_rad);
  for (int mz = -32; mz < 32; ++mz)
    for (int mx = -32; mx < 32; ++mx) {
      const glm::dvec2 a(bins.at(0, mx, mz).amplitude);
      if (a == glm::dvec2(0)) continue;
      const double kx = step * (o * mx - s * mz), kz = step * (s * mx + o * mz), k = std::hypot(kx, kz);
      const double phase = kx * rest.x + kz * rest.y - std::sqrt(sea.gravity_mps2 * k + 7.17e-5 * k * k * k) * t;
      const double re = a.x * std::cos(phase) - a.y * std::sin(phase),
                   im = a.x * std::sin(phase) + a.y * std::cos(phase);
      sum += glm::dvec3(-sea.chop * kx / k * im, re, -sea.chop * kz / k * im);
    }
  return sum;
}

TEST(Query, velocities_are_those_of_direct_sums) {
  // Differences in time of direct sums in double: orbital at a fixed rest position, Eulerian of the height at a fixed
  // place, whose inverse is found anew for each time. Controls: the orbital velocity's vertical part is not the
  // Eulerian velocity (last line), and + slope . v instead of - misses by more.
  const WaveQuality quality{.resolution = 256, .cascades = 1};
  const SeaState sea;
  const WaveBins bins = few_waves(sea, quality);
  const WaveField field(sea, quality, bins);
  WaveTiles tiles(true);
  const double t = 20, step = 1e-3;
  field.evaluate(ticks_from_seconds(t), tiles);
  const auto rest_of = [&](glm::dvec2 place, double time) {
    glm::dvec2 rest = place;
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 d = direct(sea, bins, rest, time);
      rest = place - glm::dvec2(d.x, d.z);
    }
    return rest;
  };
  const auto height = [&](glm::dvec2 place, double time) { return direct(sea, bins, rest_of(place, time), time).y; };
  std::vector<glm::dvec2> places;
  std::mt19937 random(9);
  for (int i = 0; i < 600; ++i) {
    const double x = double(random() % 1000);  // before z, whatever the compiler
    places.emplace_back(x, double(random() % 1000));
  }
  std::vector<QueryAnswer> answers(places.size());
  query(field, tiles, places, answers, {.most_iterations = 40, .tolerance_m = 1e-4});
  double orbital = 0, orbital_size = 0, eulerian = 0, eulerian_size = 0, plain = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::dvec2 rest = rest_of(places[i], t);
    const glm::dvec3 v = (direct(sea, bins, rest, t + step) - direct(sea, bins, rest, t - step)) / (2 * step);
    const glm::dvec3 miss = answers[i].orbital_velocity_mps - v;
    orbital += glm::dot(miss, miss), orbital_size += glm::dot(v, v);
    const double rate = (height(places[i], t + step) - height(places[i], t - step)) / (2 * step);
    eulerian += std::pow(answers[i].eulerian_velocity_mps.y - rate, 2), eulerian_size += rate * rate;
    plain += std::pow(answers[i].orbital_velocity_mps.y - rate, 2);
  }
  EXPECT_LE(std::sqrt(orbital / orbital_size), 0.002);
  // Slopes are those of the surface between texels, of first order in a texel's share of a wave.
  EXPECT_LE(std::sqrt(eulerian / eulerian_size), 0.0025);
  EXPECT_GE(std::sqrt(plain / eulerian_size), 0.1);
  RecordProperty("relative_error", std::to_string(std::sqrt(orbital / orbital_size)) + " " +
                                       std::to_string(std::sqrt(eulerian / eulerian_size)) + " plain " +
                                       std::to_string(std::sqrt(plain / eulerian_size)));
}

TEST(Query, each_step_brings_it_nearer) {
  // Root mean square of heights over Hs after 0 to 6 steps, against an inversion in double by 200 steps: each step
  // divides it by 3 at least, and the slope at the point found by 1.5 again. Controls: a rest position of q + D(x); a
  // slope of the other sign; height_m without it fails the last line.
  SeaState sea;
  sea.wind_speed_mps = 10;
  const WaveField field(sea, {.resolution = 128, .cascades = 3});
  WaveTiles tiles;
  field.evaluate(ticks_from_seconds(3), tiles);
  std::vector<glm::dvec2> places;
  std::vector<double> truth;
  std::mt19937 random(10);
  for (int i = 0; i < 500; ++i) {
    glm::dvec2 rest = places.emplace_back(random() % 5000 * 0.1, random() % 5000 * 0.1);
    for (int step = 0; step < 200; ++step) {
      const glm::dvec3 d = field.displacement(tiles, rest, 0);
      rest = places.back() - glm::dvec2(d.x, d.z);
    }
    truth.push_back(field.displacement(tiles, rest, 0).y);
  }
  const double hs = 4 * std::sqrt(field.statistics().height_variance);
  double before = 1, before_residual = 1e9;
  for (int steps = 0; steps <= 5; ++steps) {
    std::vector<QueryAnswer> answers(places.size());
    query(field, tiles, places, answers, {.most_iterations = steps, .tolerance_m = 0});
    double sum = 0, plain = 0, residual = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_EQ(answers[i].iterations, answers[i].residual_m > 0 ? steps : answers[i].iterations);
      sum += std::pow(answers[i].height_m - truth[i], 2), plain += std::pow(answers[i].displacement.y - truth[i], 2);
      residual += std::pow(answers[i].residual_m, 2);
    }
    const double error = std::sqrt(sum / 500) / hs;
    EXPECT_LE(error, std::max(before / 3, 1e-7)) << steps;  // floats
    EXPECT_LE(residual, before_residual / 9) << steps;
    if (steps >= 1) {
      EXPECT_LE(error, std::sqrt(plain / 500) / hs / 1.5) << steps;
    }
    before = error, before_residual = residual;
  }
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
