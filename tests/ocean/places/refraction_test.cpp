#include "ocean/places/refraction.h"

#include <gtest/gtest.h>

#include "tests/support/shallows_truth.h"

namespace seascape {
namespace {

constexpr double g = 9.81;

// A swell alone.
struct Swell {
  Swell() {
    sea.wind_speed_mps = 0.0;
    sea.swell_height_m = 1.0, sea.swell_period_s = 10.0, sea.swell_to_deg = 70.0;
    bins = make_wave_bins(sea, WaveQuality{.resolution = 64, .cascades = 1});
  }
  Refraction over(const InputBounds& shallows, const DepthOfPlace& depth, int cells = 256) const {
    return Refraction(sea, bins, ShallowWater(sea, bins), shallows, depth, {.cells = cells});
  }
  SeaState sea;
  WaveBins bins;
};

InputBounds square(double half) { return {glm::dvec2(-half), glm::dvec2(half)}; }

// A plane beach, its water `slope` deep a metre from the shore, which lies `in` metres from the middle against its
// normal.
struct Beach {
  glm::dvec2 up;  // towards land, a unit vector
  double slope, in, deepest;
  double depth(glm::dvec2 p) const { return std::clamp(slope * (in - glm::dot(p, up)), -5.0, deepest); }
  glm::dvec2 at(double depth_m, double along) const {
    return up * (in - depth_m / slope) + glm::dvec2(-up.y, up.x) * along;
  }
};

struct Bent {
  double angle, length;  // from the beach's normal (rad); of grad S
};
Bent bent(const Refraction& r, const Beach& beach, glm::dvec2 p) {
  const double e = r.grid().cell_m;
  const auto s = [&](glm::dvec2 off) { return r.shift(0, p + off) - r.shift(0, p - off); };
  const glm::dvec2 grad = r.direction(0) + glm::dvec2(s({e, 0.0}), s({0.0, e})) / (2.0 * e);
  return {std::atan2(beach.up.x * grad.y - beach.up.y * grad.x, glm::dot(grad, beach.up)), glm::length(grad)};
}

TEST(Refraction, waves_turn_towards_a_plane_beach_by_snells_law) {
  // k sin(angle) stays (Snell), k(h) / k0 by bisection: the angle within 1 degree and the length within 1 %, from half
  // a wavelength's depth to a twentieth. The beach lies aslant on the grid. Also on half as many cells: the two agree
  // within 4 % of a wave. Controls, seen: differences of the first order alone (3.1 %, grids 0.09), waves drawn out
  // rather than together (150 degrees), drawn together by 1.5 at most (6.7 degrees).
  const Swell swell;
  const MeanWave wave = mean_wave(swell.sea, swell.bins, 0);
  const double wave_m = 2.0 * truth::pi / wave.wave_number;
  EXPECT_NEAR(truth::airy(wave.wave_number, g, deep_water_m) / wave.frequency, 1.0, 3e-5);
  double worst_angle = 0.0, worst_length = 0.0, worst_grids = 0.0;
  for (const double incidence : {20.0, 45.0, 60.0, -45.0}) {
    const double turn = incidence * truth::pi / 180.0;
    const double c = std::cos(turn), s = std::sin(turn);
    const double wide = 0.6 * wave_m * 20.0;
    const Beach beach{{c * wave.direction.x + s * wave.direction.y, c * wave.direction.y - s * wave.direction.x},
                      1.0 / 20.0,
                      0.55 * wide,
                      0.6 * wave_m};
    const auto depth = [&](glm::dvec2 p, double) { return beach.depth(p); };
    const Refraction fine = swell.over(square(0.95 * wide), depth),
                     coarse = swell.over(square(0.95 * wide), depth, 128);
    for (double h = 0.5 * wave_m; h >= wave_m / 20.0; h *= 0.9)
      for (const double along : {-0.2 * wide, 0.0, 0.15 * wide}) {
        const glm::dvec2 p = beach.at(h, along);
        const double ratio =
            truth::airy_inverse(wave.frequency, g, h) / truth::airy_inverse(wave.frequency, g, deep_water_m);
        const Bent b = bent(fine, beach, p);
        worst_angle = std::max(worst_angle, std::abs(b.angle - std::asin(std::sin(turn) / ratio)));
        worst_length = std::max(worst_length, std::abs(b.length / ratio - 1.0));
        worst_grids = std::max(worst_grids, std::abs(fine.shift(0, p) - coarse.shift(0, p)) / wave_m);
      }
  }
  EXPECT_LE(worst_angle * 180.0 / truth::pi, 1.0);
  EXPECT_LE(worst_length, 0.01);
  EXPECT_LE(worst_grids, 0.04);
  RecordProperty("angle_deg", std::to_string(worst_angle * 180.0 / truth::pi));
  RecordProperty("length", std::to_string(worst_length));
  RecordProperty("grids", std::to_string(worst_grids));
}

TEST(Refraction, no_pattern_is_drawn_out_behind_a_breakwater) {
  // A wall of 400 m across the waves: the pattern goes on by three quarters of a metre and more in each metre along its
  // direction, in all of the lee, where crests turn still; and what stands before the wall, a cell and more away, knows
  // nothing of what comes to the water behind it. Seen: 0.749 m, 0. Controls, seen: fronts as they are (-0.03 m in a
  // metre), a field that is smoothed across the wall (0.6 m before it).
  const Swell swell;
  const double half_m = 200.0, thick_m = 3.6;
  const MeanWave wave = mean_wave(swell.sea, swell.bins, 0);
  const glm::dvec2 d = wave.direction, aside{-d.y, d.x};
  const auto wall = [&](glm::dvec2 p, double) {
    return std::abs(glm::dot(p, d)) < thick_m && std::abs(glm::dot(p, aside)) < half_m ? -2.0 : 5000.0;
  };
  const Refraction r = swell.over(square(300.0), wall);
  const double cell = r.grid().cell_m, e = cell;
  ASSERT_LT(cell, 6.0);
  double least = 1.0, before = 0.0, turned = 0.0;
  for (double along = thick_m + 3.0 * cell; along < 280.0; along += 3.0)
    for (double across = -190.0; across <= 190.0; across += 3.0) {
      const glm::dvec2 p = along * d + across * aside;
      least = std::min(least, 1.0 + (r.shift(0, p + e * d) - r.shift(0, p - e * d)) / (2.0 * e));
      turned = std::max(turned, std::abs(r.shift(0, p + e * aside) - r.shift(0, p - e * aside)) / (2.0 * e));
    }
  for (double across = -190.0; across <= 190.0; across += 3.0)
    before = std::max(before, std::abs(r.shift(0, across * aside - (thick_m + 1.5 * cell) * d)));
  RecordProperty("least", std::to_string(least)), RecordProperty("before", std::to_string(before)),
      RecordProperty("turned", std::to_string(turned));
  EXPECT_GT(least, 0.73);
  EXPECT_GT(turned, 0.5);
  EXPECT_LT(before, 0.1);
}

TEST(Refraction, plane_waves_come_in_over_whichever_edges_they_meet) {
  // Over an even bed no front bends, whatever its direction: what is left of S is rounding. Over one half as fast it
  // gains as many metres as it goes, from the edges that it came in over. Controls, seen: no edge in the east, in the
  // north, in the west (each alone), an edge that waves leave over taken for one they come in by.
  const BedGrid grid{.least = {-40.0, 25.0}, .cell_m = 2.0, .nx = 37, .nz = 23};
  const std::vector<double> even(grid.size(), 1.0), slow(grid.size(), 2.0);
  for (int n = 0; n < 16; ++n) {
    const double angle = (n + (n % 4 == 0 ? 0.0 : 0.3)) * truth::pi / 8.0;  // along the axes too
    const glm::dvec2 d(std::cos(angle), std::sin(angle));
    for (const double left : bent_fronts(grid, even, d)) ASSERT_NEAR(left, 0.0, 1e-9) << n;
    const std::vector<double> gained = bent_fronts(grid, slow, d);
    int came_in = 0;
    for (int j = 0; j < grid.nz; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        const bool over = (i == 0 && d.x > 1e-6) || (i + 1 == grid.nx && d.x < -1e-6) || (j == 0 && d.y > 1e-6) ||
                          (j + 1 == grid.nz && d.y < -1e-6);
        came_in += over;
        if (over)
          ASSERT_EQ(gained[grid.node(i, j)], 0.0) << n;
        else
          ASSERT_GT(gained[grid.node(i, j)], 0.0) << n;
      }
    EXPECT_EQ(came_in, std::abs(d.x) < 1e-6 ? grid.nx : std::abs(d.y) < 1e-6 ? grid.nz : grid.nx + grid.nz - 1);
  }
}

// A round island of steep sides in the deep.
constexpr double island_m = 300.0;
double island(glm::dvec2 p, double) { return glm::length(p) < island_m ? -2.0 : 5000.0; }

TEST(Refraction, fronts_close_behind_an_island_by_the_shortest_way_around_it) {
  // Straight past it, along its shore and off it again on a tangent (Huygens): within two cells, and straight on
  // wherever it is not in the way. Controls, seen: land let pass as deep water (122 m off), fading within the most of
  // the shift (3 m in 10).
  const Swell swell;
  const Refraction r = swell.over(square(1.2 * island_m), island);
  const glm::dvec2 d = r.direction(0), aside{-d.y, d.x};
  double worst = 0.0;
  for (const double away : {1.3, 1.6, 2.0})
    for (double angle = -3.1; angle < 3.14; angle += 0.1) {
      const double tangent = std::acos(1.0 / away), arc = truth::pi / 2 - std::abs(angle) - tangent;
      const double way = arc > 0.0 ? island_m * (arc + std::sqrt(away * away - 1.0) - away * std::cos(angle)) : 0.0;
      const glm::dvec2 p = away * island_m * (std::cos(angle) * d + std::sin(angle) * aside);
      worst = std::max(worst, std::abs(r.shift(0, p) - way));
    }
  EXPECT_LE(worst, 2.0 * r.grid().cell_m);
  EXPECT_GT(r.shift(0, d * 1.3 * island_m), 90.0);
  // Far behind it has faded away, and nowhere faster than a fifth.
  EXPECT_EQ(r.shift(0, d * 1e4), 0.0);
  for (double far = 2.0 * island_m; far < 1e4; far += 10.0)
    ASSERT_LE(std::abs(r.shift(0, d * (far + 10.0)) - r.shift(0, d * far)), 2.0 + 0.25) << far;
}

TEST(Refraction, an_islands_lee_has_the_waves_whose_way_to_it_is_free) {
  // Against straight lines from each wave of the sea, drawn by the test; monotone from the lee to the windward side, 1
  // far away. Controls, seen: lines half as slanting (0.32 off), directions two sectors off (0.23).
  for (const double swell_m : {0.0, 2.0}) {
    SeaState sea;
    sea.wind_speed_mps = 12.0, sea.swell_height_m = swell_m, sea.swell_to_deg = 140.0;
    const WaveBins bins = make_wave_bins(sea, WaveQuality{.resolution = 64, .cascades = 4});
    const Refraction r(sea, bins, ShallowWater(sea, bins), square(1.2 * island_m), island);
    for (const int cascade : {0, 2, -1}) {
      SCOPED_TRACE(cascade);
      std::map<double, double> by_angle;
      double all = 0.0;
      for (int c = cascade < 0 ? 0 : cascade; c <= (cascade < 0 ? 3 : cascade); ++c) {
        const int half = bins_of(c) / 2;
        for (int mz = -half; mz < half; ++mz)
          for (int mx = -half; mx < half; ++mx) {
            const glm::dvec2 a(bins.at(c, mx, mz).amplitude);
            const double angle = std::atan2(double(mz), double(mx)) + bins.ladder[std::size_t(c)].rotation_rad;
            by_angle[std::round(angle * 1000.0) / 1000.0] += a.x * a.x + a.y * a.y, all += a.x * a.x + a.y * a.y;
          }
      }
      const auto free = [&](glm::dvec2 p) {
        double sum = 0.0;
        for (const auto& [angle, energy] : by_angle) {
          const glm::dvec2 e{std::cos(angle), std::sin(angle)};
          if (!(p.x * e.x + p.y * e.y > 0.0 && std::abs(p.x * e.y - p.y * e.x) < island_m)) sum += energy;
        }
        return sum / all;
      };
      const auto has = [&](glm::dvec2 p) { return cascade < 0 ? r.shelter(p) : r.shelter(cascade, p); };
      double worst = 0.0;
      for (const double away : {1.2, 1.5, 2.0})
        for (double angle = 0.0; angle < 6.28; angle += 0.1) {
          const glm::dvec2 p = away * island_m * glm::dvec2(std::cos(angle), std::sin(angle));
          worst = std::max(worst, std::abs(has(p) - free(p)));
        }
      EXPECT_LE(worst, 0.06);  // 0.042 seen

      EXPECT_EQ(has({1e4, -1e4}), 1.0f);
      if (swell_m > 0.0) continue;
      const glm::dvec2 to{std::sin(sea.wind_to_deg * truth::pi / 180.0),
                          -std::cos(sea.wind_to_deg * truth::pi / 180.0)},
          aside{-to.y, to.x};
      EXPECT_LE(has(to * 1.2 * island_m), cascade == 2 ? 0.4 : 0.3);  // short waves go every way
      EXPECT_GE(has(-to * 1.2 * island_m), cascade == 2 ? 0.9 : 0.99);
      for (const double side : {-1.0, 1.0}) {
        double before = 0.0;
        for (double angle = 0.0; angle < 3.14; angle += 0.05) {
          const double now = has(1.4 * island_m * (std::cos(angle) * to + side * std::sin(angle) * aside));
          EXPECT_GE(now, before - 0.01) << angle;
          before = std::max(before, now);
        }
      }
    }
  }
}

TEST(Refraction, what_breaks_on_a_reef_stays_gone_behind_it) {
  // A bar 1 m deep across the waves' way, 20 m on both sides: there is no shelter before it, and behind it the energy
  // that the bar let stand. On the bar itself the depth's own factor has it all. Controls, seen: the bar's own breaking
  // counted in the shelter too (0.16 on the bar), breaking forgotten behind it (1).
  const Swell swell;
  const glm::dvec2 d = mean_wave(swell.sea, swell.bins, 0).direction;
  const auto bar = [&](glm::dvec2 p, double) { return std::abs(glm::dot(p, d)) < 60.0 ? 1.0 : 20.0; };
  const ShallowWater water(swell.sea, swell.bins);
  const Refraction r = swell.over(square(1000.0), bar);
  const double left = (1.0 - water.breaking(1.0)) / (1.0 - water.breaking(20.0));
  EXPECT_LT(left, 0.6);
  EXPECT_NEAR(r.shelter(0, d * -300.0), 1.0, 1e-3);
  EXPECT_NEAR(r.shelter(0, d * 0.0), 1.0, 1e-2);
  EXPECT_NEAR(r.shelter(0, d * 300.0), left, 1e-2);
}

}  // namespace
}  // namespace seascape
