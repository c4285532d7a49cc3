// A light sea's longest tile, whose pattern is warped: against waves of shift in double, and against the same tile
// laid straight.
#include "ocean/waves/pattern_warp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ocean/sea/query.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"
#include "shaders/shared/phase.h"
#include "tests/support/truth.h"

namespace seascape {
namespace {

SeaState wind(double mps) {
  SeaState sea;
  sea.wind_speed_mps = mps;
  return sea;
}

// The waves of shift, in long double.
PatternWarp::Local local_of(const PatternWarp& warp, glm::dvec2 at) {
  PatternWarp::Local local;
  for (const PatternWarp::Wave& wave : warp.waves()) {
    const long double turns = static_cast<long double>(wave.along.x) * static_cast<long double>(at.x) +
                              static_cast<long double>(wave.along.y) * static_cast<long double>(at.y) +
                              static_cast<long double>(wave.phase);
    const double turn = 2.0 * truth::pi * double(turns - std::floor(turns));
    local.shift_m += std::sin(turn) * wave.way;
    local.growth += 2.0 * truth::pi * std::cos(turn) * glm::outerProduct(wave.way, wave.along);
  }
  return local;
}

double distance(const glm::dmat2& a, const glm::dmat2& b) {
  return glm::length(a[0] - b[0]) + glm::length(a[1] - b[1]);
}

const std::vector<glm::dvec2> corners{{0.0, 0.0}, {1e6, -1e6}, {-3e7, 2e7}};

// Light seas are warped, and none of those that lie straight. Controls seen: the first warped class left straight, the
// last straight one warped, a swell for which nobody asks whether the tile has a place.
TEST(PatternWarp, OnlyLightSeasAreWarped) {
  for (const double mps : {0.0, 1.0, 10.0, 15.0, 25.0}) EXPECT_FALSE(PatternWarp(ladder(wind(mps)))) << mps;
  for (const double mps : {2.0, 3.0, 5.0, 7.0, 9.0}) EXPECT_TRUE(PatternWarp(ladder(wind(mps)))) << mps;
  SeaState swell = wind(5.0);  // which a tile of 1 km has no place for
  swell.swell_height_m = 1.0, swell.swell_period_s = 10.0;
  EXPECT_FALSE(PatternWarp(ladder(swell)));
}

// Near the world's origin and far from it, and as a picture has it, counted from a grid's origin. Control seen: phases
// at the grid origin left out.
TEST(PatternWarp, IsItsWavesOfShiftAnywhere) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> near(-3000.0, 3000.0);
  for (const double mps : {2.0, 5.0, 9.0}) {
    const PatternWarp warp(ladder(wind(mps)));
    for (const glm::dvec2 corner : corners) {
      const gpu::WarpData seen = warp.from(corner);
      for (int i = 0; i < 200; ++i) {
        const glm::dvec2 off(glm::vec2(near(random), near(random)));
        const PatternWarp::Local want = local_of(warp, corner + off), got = warp.at(corner + off);
        EXPECT_LT(glm::length(got.shift_m - want.shift_m), 1e-4);
        EXPECT_LT(distance(got.growth, want.growth), 1e-6);
        glm::dvec2 shown(0.0);
        for (int n = 0; n < gpu::warp_waves; ++n) {
          const glm::vec4 wave = seen.wave[n];
          const glm::vec2 turn =
              gpu::cos_sin_turns(gpu::warp_turns(wave.x, wave.y, seen.phase[n], float(off.x), float(off.y)));
          shown += double(turn.y) * glm::dvec2(wave.z, wave.w);
        }
        EXPECT_LT(glm::length(shown - want.shift_m), 2e-4);
      }
    }
  }
}

// Waves are stretched and turned by 5.5 % at most. Control seen: strains 1.1 times as large.
TEST(PatternWarp, StrainsByFiveAndAHalfPercentAtMost) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-1e6, 1e6);
  for (const double mps : {2.0, 3.0, 4.0, 5.0, 7.0, 9.0}) {
    const PatternWarp warp(ladder(wind(mps)));
    double most = 0.0;
    for (int i = 0; i < 200000; ++i) {
      const glm::dmat2 g = warp.at({anywhere(random), anywhere(random)}).growth;
      most = std::max(most, 0.5 * (std::hypot(g[0][0] + g[1][1], g[0][1] - g[1][0]) +
                                   std::hypot(g[0][0] - g[1][1], g[0][1] + g[1][0])));
    }
    EXPECT_LE(most, 0.0551) << mps;
    EXPECT_GT(most, 0.05) << mps;
  }
}

// The first cascade alone, warped and straight.
struct Both {
  WaveField warped, straight;
  WaveTiles tiles{true}, straight_tiles{true};
  explicit Both(const SeaState& sea, int resolution = 64)
      : Both(sea, make_wave_bins(sea, {.resolution = resolution, .cascades = 1}), resolution) {}
  Both(const SeaState& sea, const WaveBins& bins, int resolution)
      : warped(sea, {.resolution = resolution, .cascades = 1}, bins),
        straight(sea, {.resolution = resolution, .cascades = 1}, laid_straight(bins)) {
    warped.evaluate(ticks_from_seconds(7.7), tiles);
    straight.evaluate(ticks_from_seconds(7.7), straight_tiles);
  }
  static WaveBins laid_straight(WaveBins bins) {
    bins.ladder[0].warped = false;
    return bins;
  }
};

// What a warped sea has at a place the straight one has where the warp shifts it to: displacement and velocity, and its
// derivatives by the chain rule; also where a footprint leaves roughness. Control seen: the shift turned about.
TEST(PatternWarp, AWarpedSeaIsTheStraightOneShifted) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> near(-2000.0, 2000.0);
  const Both sea(wind(5.0));
  const double hs = 4.0 * std::sqrt(sea.warped.statistics().height_variance);
  for (const glm::dvec2 corner : corners)
    for (const double footprint : {0.0, 12.0, 30.0, 500.0, 1e5})
      for (int i = 0; i < 50; ++i) {
        const glm::dvec2 at = corner + glm::dvec2(near(random), near(random));
        const PatternWarp::Local local = local_of(sea.warped.warp(), at);
        const SeaSample got = sea.warped.sea(sea.tiles, at, footprint),
                        want = sea.straight.sea(sea.straight_tiles, at + local.shift_m, footprint);
        ASSERT_LT(glm::length(got.displacement - want.displacement), 1e-4 * hs);
        ASSERT_LT(glm::length(sea.warped.displacement(sea.tiles, at, footprint) - want.displacement), 1e-4 * hs);
        ASSERT_LT(glm::length(sea.warped.velocity(sea.tiles, at, footprint) -
                              sea.straight.velocity(sea.straight_tiles, at + local.shift_m, footprint)),
                  1e-4 * hs);
        const auto chained = [&](glm::dvec2 g) {
          return glm::dvec2(g.x * (1.0 + local.growth[0][0]) + g.y * local.growth[0][1],
                            g.x * local.growth[1][0] + g.y * (1.0 + local.growth[1][1]));
        };
        ASSERT_LT(glm::length(got.height_gradient - chained(want.height_gradient)), 2e-5);
        const glm::dvec3& s = want.shift_gradient;
        const glm::dvec2 of_x = chained({s.x, s.z}), of_z = chained({s.z, s.y});
        ASSERT_LT(glm::length(got.shift_gradient - glm::dvec3(of_x.x, of_z.y, 0.5 * (of_x.y + of_z.x))), 4e-5);
        // Of a random slope with these moments, what its chained one's moments are.
        const glm::dvec3 tail = sea.warped.statistics().tail_slope_moments, m = want.slope_moments - tail;
        const glm::dvec2 x = chained({1.0, 0.0}), z = chained({0.0, 1.0});
        const glm::dvec3 moments(m.x * x.x * x.x + m.y * z.x * z.x + 2.0 * m.z * x.x * z.x,
                                 m.x * x.y * x.y + m.y * z.y * z.y + 2.0 * m.z * x.y * z.y,
                                 m.x * x.x * x.y + m.y * z.x * z.y + m.z * (x.x * z.y + z.x * x.y));
        ASSERT_LT(glm::length(got.slope_moments - tail - moments), 1e-6 + 1e-3 * glm::length(m));
      }
}

// Gradients are those of the height and the shift that are drawn, of waves of 20 texels and more. The last line
// bounds from below what leaving out the chain rule would come to.
TEST(PatternWarp, GradientsAreThoseOfWhatIsDrawn) {
  const SeaState state = wind(5.0);
  WaveBins bins = make_wave_bins(state, {.resolution = 128, .cascades = 1});
  for (int mz = -128; mz < 128; ++mz)
    for (int mx = -128; mx < 128; ++mx)
      if (std::hypot(mx, mz) > 25.0 || std::hypot(mx, mz) < 15.0) bins.at(0, mx, mz) = {};
  // Few waves of this sea are so long: as high as they may be.
  for (gpu::WaveBin& bin : bins.bins) bin.amplitude *= 20.0f;
  const Both sea(state, bins, 128);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> near(-2000.0, 2000.0);
  double off = 0.0, off_straight = 0.0, size = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec2 at(near(random), near(random));
    const auto along = [&](glm::dvec2 step) {  // the derivative to the fourth order, over two texels and four
      const auto height = [&](double steps) { return sea.warped.displacement(sea.tiles, at + steps * step, 0.0).y; };
      return (8.0 * (height(1.0) - height(-1.0)) - (height(2.0) - height(-2.0))) / (12.0 * glm::length(step));
    };
    const glm::dvec2 want(along({4.0, 0.0}), along({0.0, 4.0}));
    const glm::dvec2 got = sea.warped.sea(sea.tiles, at, 0.0).height_gradient,
                     straight = sea.straight.sea(sea.straight_tiles, at + sea.warped.warp().at(at).shift_m, 0.0)
                                    .height_gradient;
    const auto square = [](glm::dvec2 v) { return glm::dot(v, v); };
    off += square(got - want), off_straight += square(straight - want), size += square(got);
  }
  EXPECT_LT(std::sqrt(off / size), 0.02);
  EXPECT_GT(std::sqrt(off_straight / size), 0.025);
}

// Queries see the same water, near and far: the point found is that of the field's own rest position, its slope that of
// the heights found beside it. Controls seen: the growth left out of its slopes (2.5e-3); the field's shift turned
// about.
TEST(PatternWarp, QueriesSeeTheWarpedSea) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> near(-3000.0, 3000.0);
  const WaveField field(wind(7.0), {.resolution = 64, .cascades = 1});
  WaveTiles tiles(true);
  field.evaluate(ticks_from_seconds(12.3), tiles);
  for (const glm::dvec2 corner : corners) {
    std::vector<glm::dvec2> places;
    for (int i = 0; i < 500; ++i) places.push_back(corner + glm::dvec2(near(random), near(random)));
    std::vector<QueryAnswer> answers(places.size());
    query(field, tiles, places, answers, {.most_iterations = 30, .tolerance_m = 1e-4});
    // Slopes are those of the heights that queries find beside a place, but where a texel ends in between.
    constexpr double e = 0.01;
    const auto beside = [&](glm::dvec2 off) {
      std::vector<glm::dvec2> moved = places;
      for (glm::dvec2& place : moved) place += off;
      std::vector<QueryAnswer> found(places.size());
      query(field, tiles, moved, found, {.most_iterations = 60, .tolerance_m = 1e-5});
      return found;
    };
    const auto east = beside({e, 0.0}), west = beside({-e, 0.0}), south = beside({0.0, e}), north = beside({0.0, -e});
    std::vector<double> slopes_off;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const QueryAnswer& a = answers[i];
      EXPECT_TRUE(a.converged);
      const glm::dvec2 rest = places[i] - glm::dvec2(a.displacement.x, a.displacement.z);
      const SeaSample s = field.sea(tiles, rest, 0.0);
      EXPECT_LT(glm::length(s.displacement - a.displacement), 1e-4);
      EXPECT_LT(glm::length(field.velocity(tiles, rest, 0.0) - a.orbital_velocity_mps), 1e-4);
      slopes_off.push_back(glm::length(
          -glm::dvec2(a.normal.x, a.normal.z) / a.normal.y -
          glm::dvec2(east[i].height_m - west[i].height_m, south[i].height_m - north[i].height_m) / (2.0 * e)));
    }
    std::sort(slopes_off.begin(), slopes_off.end());
    EXPECT_LT(slopes_off[slopes_off.size() * 9 / 10], 3e-4);
    RecordProperty("slope", std::to_string(slopes_off[slopes_off.size() * 9 / 10]));
  }
}

// The warp takes nothing from the statistics: height and slope variances over many places are the straight sea's.
// Control seen: four times the strain, which adds 1.4 % to the slopes' (twice the strain adds 0.4 %;
// StrainsByFiveAndAHalfPercentAtMost sees that).
TEST(PatternWarp, KeepsTheStatistics) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> anywhere(-1e5, 1e5);
  const Both sea(wind(5.0), 128);
  double height = 0.0, straight_height = 0.0, slope = 0.0, straight_slope = 0.0;
  constexpr int places = 200000;
  for (int i = 0; i < places; ++i) {
    const glm::dvec2 at(anywhere(random), anywhere(random));
    const SeaSample a = sea.warped.sea(sea.tiles, at, 0.0), b = sea.straight.sea(sea.straight_tiles, at, 0.0);
    height += a.displacement.y * a.displacement.y, straight_height += b.displacement.y * b.displacement.y;
    slope += glm::dot(a.height_gradient, a.height_gradient);
    straight_slope += glm::dot(b.height_gradient, b.height_gradient);
  }
  EXPECT_NEAR(height / straight_height, 1.0, 0.01);
  EXPECT_NEAR(slope / straight_slope, 1.0, 0.01);
}

}  // namespace
}  // namespace seascape
