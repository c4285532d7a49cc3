// The sea with wave particles in it: field and query against direct sums over all layings of the tile
// (tests/support/particle_truth.h).
#include "ocean/waves/tile_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "ocean/sea/query.h"
#include "ocean/waves/wave_particles.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/particle_truth.h"

namespace seascape {
namespace {

SeaState flat() {
  SeaState sea;
  sea.wind_speed_mps = 0.0;
  return sea;
}

// The height and its slope along x at a world place, in double: every laying is the tile, `size` times as long and
// high, moved by its offset.
double truth_at(const WaveParticles& source, const WaveParticleSettings& s, double time_s, glm::dvec2 place,
                double (*of)(const std::vector<truth::Bump>&, double, double, double, double)) {
  const std::int64_t ticks = ticks_from_seconds(time_s);
  double sum = 0.0;
  for (const Laying& laying : source.layings()) {
    std::vector<truth::Bump> bumps;
    for (const WaveParticle& p : source.particles()) {
      const auto axis = [&](std::uint32_t start, std::uint64_t turns) {
        const long double at = std::ldexp(static_cast<long double>(start), -32) +
                               std::ldexp(static_cast<long double>(std::int64_t(turns)), -64) * ticks;
        return double(at - std::floor(at)) * laying.side_m;
      };
      bumps.push_back(
          {axis(p.x, p.turns_x), axis(p.z, p.turns_z), (p.trough ? -1.0 : 1.0) * source.amplitude_m() * laying.size});
    }
    sum += of(bumps, s.radius_m * laying.size, laying.side_m, place.x + laying.offset * laying.side_m,
              place.y + laying.offset * laying.side_m);
  }
  return sum;
}

// Of heights, slopes and heights asked of the surface, near and far from the origin. What bilinear reading leaves of
// bumps 16 texels wide is most of the difference. Controls seen: QueryLayer::plain of every layer (0.6 of the rms), a
// query's layers without offset (0.8), Spot::size left out of the displacement (0.6).
TEST(TileSource, FieldAndQueryStandWhereTheDirectSumDoes) {
  WaveParticleSettings s;
  s.chop = 0.0;
  s.count = 400;
  const auto source = std::make_shared<WaveParticles>(s);
  const WaveField field(flat(), {.resolution = 16, .cascades = 1}, {source});
  WaveTiles tiles(true);
  const double rms = std::sqrt(source->statistics().height_variance),
               slopes = std::sqrt(source->statistics().slope_moments.x * 3.0);
  for (const auto& [time_s, far] : {std::pair(0.0, 0.0), std::pair(31.7, 1e5), std::pair(1e6, -3e4)}) {
    field.evaluate(ticks_from_seconds(time_s), tiles);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-20.0, 20.0);
    double height = 0.0, slope = 0.0, asked = 0.0, late = 0.0;
    constexpr int points = 300;
    for (int i = 0; i < points; ++i) {
      const double x = far + uniform(random);  // before z, whatever the compiler
      const glm::dvec2 place(x, 0.5 * far + uniform(random));
      const double want = truth_at(*source, s, time_s, place, &truth::bumps),
                   want_slope = truth_at(*source, s, time_s, place, &truth::bumps_dx);
      const SeaSample sample = field.sea(tiles, place, 0.0);
      QueryAnswer answer;
      query(field, tiles, {&place, 1}, {&answer, 1});
      EXPECT_TRUE(answer.converged);
      height += std::pow(sample.displacement.y - want, 2) / points;
      slope += std::pow(sample.height_gradient.x - want_slope, 2) / points;
      asked += std::pow(answer.height_m - want, 2) / points;
      // Between texels as linear interpolation has it, and at one as on either side of it.
      const auto height_at = [&](double along) {
        return field.displacement(tiles, place + glm::dvec2(along, 0.0), 0.0).y;
      };
      // So near that the two layings' texels have no edge on either side of one point.
      constexpr double e = 1e-5;
      const double before = (height_at(0.0) - height_at(-e)) / e, after = (height_at(e) - height_at(0.0)) / e,
                   got = -answer.normal.x / answer.normal.y;
      EXPECT_GE(got, std::min(before, after) - 1e-3);
      EXPECT_LE(got, std::max(before, after) + 1e-3);
      EXPECT_NEAR(answer.orbital_velocity_mps.y, field.velocity(tiles, place, 0.0).y, 1e-6);
      late += std::pow(sample.displacement.y - truth_at(*source, s, time_s + 0.05, place, &truth::bumps), 2) / points;
    }
    EXPECT_LE(std::sqrt(height), 0.016 * rms) << time_s;
    EXPECT_LE(std::sqrt(asked), 0.016 * rms) << time_s;
    EXPECT_LE(std::sqrt(slope), 0.05 * slopes) << time_s;
    EXPECT_GT(std::sqrt(late), 0.03 * rms) << "a twentieth of a second";
  }
}

// The point that a query finds is displaced to the place asked, as the field has it, and folds where the field does.
TEST(TileSource, QueriesFindTheDisplacedSurface) {
  WaveParticleSettings s;
  s.height_m = 0.1;
  SeaState sea;
  sea.wind_speed_mps = 4.0;
  const WaveField field(sea, {.resolution = 64, .cascades = 4}, {std::make_shared<WaveParticles>(s)});
  const WaveField without(sea, {.resolution = 64, .cascades = 4});
  WaveTiles tiles, other;
  field.evaluate(ticks_from_seconds(5.0), tiles);
  without.evaluate(ticks_from_seconds(5.0), other);
  double moved = 0.0;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec2 place(1.7 * i, -0.9 * i);
    QueryAnswer answer, plain;
    query(field, tiles, {&place, 1}, {&answer, 1}, {.most_iterations = 60, .tolerance_m = 1e-5});
    query(without, other, {&place, 1}, {&plain, 1});
    if (!answer.converged) continue;
    const glm::dvec2 rest = place - glm::dvec2(answer.displacement.x, answer.displacement.z);
    const glm::dvec3 d = field.displacement(tiles, rest, 0.0);
    EXPECT_LE(glm::length(d - answer.displacement), 1e-4);
    moved = std::max(moved, std::abs(answer.height_m - plain.height_m));
  }
  EXPECT_GT(moved, 0.03) << "particles must be in it";
}

// What a footprint no longer resolves of the slopes it counts as roughness: together they stay. Control seen:
// unresolved() without its moments.
TEST(TileSource, SlopesLostToAFootprintBecomeRoughness) {
  const WaveParticleSettings s;
  const auto source = std::make_shared<WaveParticles>(s);
  const WaveField field(flat(), {.resolution = 16, .cascades = 1}, {source});
  WaveTiles tiles;
  field.evaluate(0, tiles);
  const double whole = 3.0 * (source->statistics().slope_moments.x + source->statistics().slope_moments.y);
  double first = 0.0;
  for (const double footprint : {0.0, 0.05, 0.2, 0.6, 1.5, 4.0, 9.0, 40.0}) {
    std::mt19937 random(9);
    double sum = 0.0;
    constexpr int points = 4000;
    for (int i = 0; i < points; ++i) {
      const glm::dvec2 place(0.01 * double(random() % 100000), 0.01 * double(random() % 100000));
      const SeaSample sample = field.sea(tiles, place, footprint);
      sum +=
          (glm::dot(sample.height_gradient, sample.height_gradient) + sample.slope_moments.x + sample.slope_moments.y) /
          points;
    }
    if (footprint == 0.0) first = sum;
    EXPECT_NEAR(sum / first, 1.0, 0.1) << footprint;
    EXPECT_NEAR(sum / whole, 1.0, 0.15) << footprint;
  }
}

// The tile does not repeat as a whole: no place is more like another than 0.43 where layings count alike, as for
// slopes, and 0.67 for heights; laid at 1, 2/3 and 1/3 of its side, as the effect was first described, all of it is
// there again two sides on (the control).
TEST(TileSource, LayingsDoNotRepeatTogether) {
  const WaveParticleSettings s;
  const WaveParticles source(s);
  const auto likeness = [&](const std::vector<double>& sizes, double& height) {
    // The tile's own correlation at lags of texels, from its particles: that of one particle, repeated.
    const auto alike = [&](double dx, double dz) {  // the overlap of two particles, by their shape's own sum
      double sum = 0.0, own = 0.0;
      for (int z = -8; z <= 8; ++z)
        for (int x = -8; x <= 8; ++x) {
          const double here = truth::bumps({{0.0, 0.0, 1.0}}, 8.0, 0.0, x, z);
          sum += here * truth::bumps({{dx, dz, 1.0}}, 8.0, 0.0, x, z);
          own += here * here;
        }
      return sum / own;
    };
    double slope = 0.0, squares = 0.0;
    height = 0.0;
    for (const double size : sizes) squares += size * size;
    for (const double side : sizes)
      for (int i = 0; i <= 8; ++i)
        for (int j = 0; j <= i; ++j) {
          if (i == 0) continue;
          double slopes_alike = 0.0, heights_alike = 0.0;
          for (const double size : sizes) {
            const double x = truth::nearest(i * side / size, 1.0) * 256.0,
                         z = truth::nearest(j * side / size, 1.0) * 256.0;
            const double both = alike(x, z);
            slopes_alike += both / double(sizes.size());
            heights_alike += both * size * size / squares;
          }
          slope = std::max(slope, slopes_alike);
          height = std::max(height, heights_alike);
        }
    return slope;
  };
  std::vector<double> ours;
  for (const Laying& laying : source.layings()) ours.push_back(laying.size);
  double height = 0.0, height_then = 0.0;
  const double slope = likeness(ours, height), slope_then = likeness({1.0, 2.0 / 3.0, 1.0 / 3.0}, height_then);
  EXPECT_LE(slope, 0.44);
  EXPECT_LE(height, 0.70);
  EXPECT_GT(slope_then, 0.99);
  EXPECT_GT(height_then, 0.99);
  RecordProperty("likeness", std::to_string(slope) + " of slopes, " + std::to_string(height) + " of heights");
}

}  // namespace
}  // namespace seascape
