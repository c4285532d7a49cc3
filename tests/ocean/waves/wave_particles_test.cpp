// Wave particles against direct sums in double (tests/support/particle_truth.h), d'Alembert, and what their settings
// say.
#include "ocean/waves/wave_particles.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "ocean/waves/wave_particles_simd.h"
#include "shaders/shared/wave_bin.h"
#include "tests/support/expect_error.h"
#include "tests/support/particle_truth.h"
#include "tests/support/source_tile.h"

namespace seascape {
namespace {

constexpr int n = WaveParticles::tile_samples;

using Tile = test::SourceTile;

std::int64_t ticks_of(double s) { return std::llround(s * double(gpu::ticks_per_second)); }

// Where the particles are, in long double and whole numbers; lengths in texels.
std::vector<truth::Bump> truth_of(const WaveParticles& source, std::int64_t ticks) {
  std::vector<truth::Bump> list;
  for (const WaveParticle& p : source.particles()) {
    const auto axis = [&](std::uint32_t start, std::uint64_t turns) {
      const long double turned =
          std::ldexp(static_cast<long double>(std::int64_t(turns)), -64) * static_cast<long double>(ticks);
      const long double at = std::ldexp(static_cast<long double>(start), -32) + turned;
      return double(at - std::floor(at)) * n;
    };
    list.push_back({axis(p.x, p.turns_x), axis(p.z, p.turns_z), (p.trough ? -1.0 : 1.0) * source.amplitude_m()});
  }
  return list;
}

struct Errors {
  double height = 0.0, slope = 0.0, worst_height = 0.0;  // root mean squares over the truth's own; the largest
};

Errors errors(const WaveParticles& source, const WaveParticleSettings& s, double time_s, int points = 3000) {
  const std::int64_t ticks = ticks_of(time_s);
  const Tile tile(source, ticks);
  const std::vector<truth::Bump> bumps = truth_of(source, ticks);
  const double r = s.radius_m / s.tile_m * n, texel = s.tile_m / n;
  double mean = 0.0;
  for (const truth::Bump& b : bumps)
    mean += b.a * std::numbers::pi * (0.5 - 2.0 / std::pow(std::numbers::pi, 2)) * r * r / (double(n) * n);
  Errors e;
  double square = 0.0, slope_square = 0.0;
  std::mt19937 random(3);
  for (int i = 0; i < points; ++i) {
    const int x = int(random() % n), z = int(random() % n);
    const double want = truth::bumps(bumps, r, n, x, z) - mean, slope = truth::bumps_dx(bumps, r, n, x, z) / texel;
    const double error = tile.height(x, z) - want;
    e.height += error * error;
    e.worst_height = std::max(e.worst_height, std::abs(error));
    e.slope += std::pow(double(tile.at(WavePlane::slope, x, z).x) - slope, 2);
    square += want * want;
    slope_square += slope * slope;
  }
  return {std::sqrt(e.height / square), std::sqrt(e.slope / slope_square), e.worst_height / std::sqrt(square / points)};
}

WaveParticleSettings many() {
  WaveParticleSettings s;
  s.count = 10000;
  return s;
}

// Heights within float of the direct sum at any time, slopes within what differences over a texel leave where a
// particle's rim bends; with many particles, summed on half the grid, within 1.3 % and 7 %. Controls seen: w0 a
// thousandth off (6e-4), a strip that leaves out the particles of the one before (0.43), the second of the splines'
// parts left out (0.47).
TEST(WaveParticles, AreTheDirectSumAtAnyTime) {
  const WaveParticleSettings few;
  for (const double time_s : {0.0, 12.3, -1e3, 1e7}) {
    const Errors e = errors(WaveParticles(few), few, time_s);
    EXPECT_LE(e.height, 1e-5) << time_s;
    EXPECT_LE(e.worst_height, 1e-4) << time_s;
    EXPECT_LE(e.slope, 0.03) << time_s;
    const Errors m = errors(WaveParticles(many()), many(), time_s, 1000);
    EXPECT_LE(m.height, 0.013) << time_s;
    EXPECT_LE(m.slope, 0.07) << time_s;
    EXPECT_GT(m.height, 1e-3) << "or these were not summed on half the grid";
    RecordProperty("errors_" + std::to_string(int(time_s)), std::to_string(e.height) + " " + std::to_string(e.slope) +
                                                                "; many " + std::to_string(m.height) + " " +
                                                                std::to_string(m.slope));
  }
}

TEST(WaveParticles, AreTheDirectSumAtEveryRadius) {
  for (const double texels : {4.0, 5.3, 8.0, 11.7, 16.0, 24.9, 64.0})
    for (const int count : {37, 300, 12000}) {
      WaveParticleSettings s;
      s.count = count;
      s.radius_m = texels / n * s.tile_m;
      const Errors e = errors(WaveParticles(s), s, 3.3, 600);
      // Half a particle's texels or fewer are only what interpolation makes of them.
      const WaveParticles source(s);
      EXPECT_LE(e.height, source.splined() ? 0.02 : texels < 16.0 ? 2e-5 : 2e-3) << texels << " texels, " << count;
      EXPECT_LE(e.slope, texels < 6.0 ? 0.2 : 0.08) << texels << " texels, " << count;
    }
}

// A front of particles `spacing` apart, all running along x, its crest across the whole tile.
WaveParticles front(const WaveParticleSettings& s, double spacing_texels, double tiles_per_s) {
  std::vector<WaveParticle> list;
  for (double z = 0.0; z < n - 1e-9; z += spacing_texels) {
    WaveParticle p;
    p.x = 0x40000000u;
    p.z = std::uint32_t(z / n * 0x1p32);
    p.turns_x = std::uint64_t(std::llround(tiles_per_s * 0x1p64 / double(gpu::ticks_per_second)));
    list.push_back(p);
  }
  return WaveParticles(s, list, 0.01);
}

// truths.md: a ripple of 3.5 % half a radius off the crest at spacing r / 2 and of 24 % at r, and so in the tile. A
// control is the other spacing.
TEST(WaveParticles, AFrontRipplesAsItsSpacingSays) {
  EXPECT_NEAR(truth::ripple(1.0, 0.5, 0.5), 0.035, 5e-4);
  EXPECT_NEAR(truth::ripple(1.0, 1.0, 0.5), 0.24, 5e-3);
  const WaveParticleSettings s;  // a radius of 8 texels
  for (const auto& [spacing, most] : {std::pair(4.0, 0.035), std::pair(8.0, 0.24)}) {
    const Tile tile(front(s, spacing, 0.1), 0);
    const double mean_of_tile =
        0.01 * (n / spacing) * std::numbers::pi * (0.5 - 2.0 / std::pow(std::numbers::pi, 2)) * 64.0 / (double(n) * n);
    double least = 1e9, highest = 0.0, mean = 0.0;
    for (int z = 0; z < n; ++z) {
      const double h = tile.height(64 + 4, z) + mean_of_tile;
      least = std::min(least, h);
      highest = std::max(highest, h);
      mean += h / n;
    }
    EXPECT_NEAR((highest - least) / mean, most, 5e-3) << spacing;
  }
}

// d'Alembert: the front of any later time is the first one moved by c t, a year on too (its speed is held to 2^-64
// turns a tick, 2e-4 texels in a year); and it is within 4 % of a smooth front's height at spacing r / 2. Control seen:
// the ticks' upper 32 bits left out; a front spaced by r is seen here.
TEST(WaveParticles, AFrontRunsOnUnchanged) {
  const WaveParticleSettings s;
  const WaveParticles source = front(s, 4.0, 1.0 / 50.0);  // 64 texels in 12.5 seconds
  const Tile start(source, 0);
  double crest = 0.0;
  for (int x = 0; x < n; ++x) crest = std::max(crest, std::abs(start.height(x, 0)));
  for (const double time_s : {12.5, 62.5, 1e7, -1e7, 3.2e7 + 12.5}) {
    const Tile later(source, ticks_of(time_s));
    const int moved = int(std::fmod(5.12 * time_s, double(n)));
    double worst = 0.0;
    for (int z = 0; z < n; z += 3)
      for (int x = 0; x < n; ++x) worst = std::max(worst, std::abs(later.height(x + moved, z) - start.height(x, z)));
    EXPECT_LE(worst, 2e-4 * crest) << time_s;
  }
  // Between texels too, and against the front of infinitely many particles of as much height: the height off the crest.
  for (const auto& [spacing, bar] : {std::pair(4.0, 0.04), std::pair(8.0, 0.24)}) {
    const WaveParticles of_spacing = front(s, spacing, 1.0 / 64.0);
    const double time_s = 0.6;  // 2.4 texels on
    const Tile later(of_spacing, ticks_of(time_s));
    const std::vector<truth::Bump> dense = [] {
      std::vector<truth::Bump> list;
      for (int i = 0; i < 640; ++i) list.push_back({0.0, 0.4 * i, 0.01 * 0.4});
      return list;
    }();
    const double mean =
        0.01 * (n / spacing) * std::numbers::pi * (0.5 - 2.0 / std::pow(std::numbers::pi, 2)) * 64.0 / (double(n) * n);
    double worst = 0.0;
    const double top = truth::bumps(dense, 8.0, n, 0.0, 0.0);
    for (int z = 0; z < n; ++z)
      for (int x = 56; x < 80; ++x) {
        const double want = truth::bumps(dense, 8.0, n, x - (64.0 + 4.0 * time_s), 0.0) / spacing;
        worst = std::max(worst, std::abs(later.height(x, z) + mean - want) / (top / spacing));
      }
    EXPECT_LE(worst, bar) << spacing;
    RecordProperty("front_" + std::to_string(int(spacing)), std::to_string(worst));
    if (spacing == 8.0) {
      EXPECT_GT(worst, 0.04) << "a front too thin must be seen";
    }
  }
}

// Nothing is lost at the tile's border: the mean stays, and starts moved by whole texels give the tile moved, to the
// bit. Control seen: wrap_row without its sum (0.003 of the mean, 0.03 of the tile moved).
TEST(WaveParticles, WrapWithoutASeam) {
  for (const WaveParticleSettings& s : {WaveParticleSettings{}, many()}) {
    const WaveParticles source(s);
    const double rms = std::sqrt(source.statistics().height_variance);
    for (const double time_s : {0.0, 5.5, 1e6}) {
      const Tile tile(source, ticks_of(time_s));
      double sum = 0.0;
      for (int i = 0; i < n * n; ++i) sum += tile.height(i % n, i / n) / (n * n);
      EXPECT_LE(std::abs(sum), 1e-4 * rms) << s.count << " " << time_s;
    }
    std::vector<WaveParticle> moved = source.particles();
    for (WaveParticle& p : moved) p.x += 100u << 24, p.z += 202u << 24;  // texels
    const Tile tile(source, ticks_of(7.7)), other(WaveParticles(s, moved, source.amplitude_m()), ticks_of(7.7));
    // The order of a texel's sum follows the strips, so that its last bits may differ.
    double worst = 0.0;
    for (int i = 0; i < n * n; ++i)
      worst = std::max(worst, std::abs(tile.height(i % n, i / n) - other.height(i % n + 100, i / n + 202)));
    EXPECT_LE(worst, 1e-5 * rms);
  }
}

// One for each 1 / count of a turn, crests and troughs alike; places without preference. Control: steps of 2 to 5
// degrees, as the effect was first described, leave 800 directions up to 9 degrees' worth uneven.
TEST(WaveParticles, RunInEvenDirections) {
  for (const int count : {1, 16, 800, 100000}) {
    WaveParticleSettings s;
    s.count = count;
    const WaveParticles source(s);
    ASSERT_EQ(source.particles().size(), std::size_t(count));
    std::vector<int> found(std::size_t(count), 0);
    glm::dvec2 places(0.0);
    for (const WaveParticle& p : source.particles()) {
      const double vx = double(std::int64_t(p.turns_x)), vz = double(std::int64_t(p.turns_z));
      EXPECT_NEAR(std::hypot(vx, vz) * 0x1p-64 * gpu::ticks_per_second * s.tile_m, source.speed_mps(), 1e-9);
      const double turn = std::atan2(vz, vx) / (2.0 * std::numbers::pi);
      ++found[std::size_t(std::min(count - 1, int((turn - std::floor(turn)) * count)))];
      places += glm::dvec2(p.x, p.z) * 0x1p-32 / double(count);
    }
    int wrong = 0;
    for (const int f : found) wrong += f != 1;
    EXPECT_LE(wrong, 2 * count / 10000) << "directions within rounding of a border";
    if (count >= 800) {
      EXPECT_LE(glm::length(places - 0.5), 3.0 * 0.41 / std::sqrt(count));
    }
    const auto troughs = std::count_if(source.particles().begin(), source.particles().end(),
                                       [](const WaveParticle& p) { return p.trough; });
    EXPECT_EQ(troughs, count / 2);
  }
  // A deep-water wave two radii long.
  EXPECT_NEAR(WaveParticles(WaveParticleSettings{}).speed_mps(), std::sqrt(9.81 * 0.5 / (2.0 * std::numbers::pi)),
              1e-12);
}

// Heights' and slopes' variance over time are what the settings ask for and the statistics say, and no crest passes the
// bounds that culling takes. Control seen: amplitude_of without the smaller sizes' squares.
TEST(WaveParticles, StandAsHighAsTheirSettingsSay) {
  for (const int count : {200, 800, 10000}) {
    WaveParticleSettings s;
    s.count = count;
    const WaveParticles source(s);
    const SourceStatistics stated = source.statistics();
    EXPECT_NEAR(4.0 * std::sqrt(stated.height_variance), s.height_m, 1e-9);
    double squares = 0.0, biggest = 0.0, furthest = 0.0;
    for (const Laying& laying : source.layings()) squares += laying.size * laying.size;
    double variance = 0.0, slope = 0.0;
    Tile tile(source, 0);
    constexpr int times = 12;
    for (int t = 0; t < times; ++t) {
      tile.evaluate(source, ticks_of(40.0 * t));
      for (int i = 0; i < n * n; ++i) {
        const glm::dvec4 shift(tile.at(WavePlane::shift, i % n, i / n)), d(tile.at(WavePlane::slope, i % n, i / n));
        variance += shift.y * shift.y / (double(n) * n * times);
        slope += (d.x * d.x + d.y * d.y) / (double(n) * n * times);
        biggest = std::max(biggest, std::abs(shift.y));
        furthest = std::max(furthest, std::hypot(shift.x, shift.z));
      }
    }
    EXPECT_NEAR(squares * variance / stated.height_variance, 1.0, 0.08) << count;
    EXPECT_NEAR(slope / (stated.slope_moments.x + stated.slope_moments.y), 1.0, 0.08) << count;
    double sizes = 0.0;
    for (const Laying& laying : source.layings()) sizes += laying.size;
    EXPECT_LE(sizes * biggest, stated.largest_height_m) << count;
    EXPECT_LE(sizes * furthest, stated.largest_shift_m) << count;
    EXPECT_GE(sizes * biggest, 0.5 * stated.largest_height_m) << "a bound far from it";
  }
}

// dD/dt is the displacement's own rate of change. Control seen: the factor 2 of by_p left out (0.43).
TEST(WaveParticles, MoveAsFastAsTheyChange) {
  for (const WaveParticleSettings& s : {WaveParticleSettings{}, many()}) {
    const WaveParticles source(s);
    constexpr double step = 1.0 / 512.0;
    const Tile now(source, ticks_of(9.0), true), before(source, ticks_of(9.0 - step)),
        after(source, ticks_of(9.0 + step));
    glm::dvec3 wrong(0.0), right(0.0);
    for (int i = 0; i < n * n; ++i) {
      const glm::dvec3 rate =
          glm::dvec3(after.at(WavePlane::shift, i % n, i / n) - before.at(WavePlane::shift, i % n, i / n)) /
          (2.0 * step);
      const glm::dvec3 error = glm::dvec3(now.at(WavePlane::velocity, i % n, i / n)) - rate;
      wrong += error * error;
      right += rate * rate;
    }
    for (int c = 0; c < 3; ++c) EXPECT_LE(std::sqrt(wrong[c] / right[c]), s.count == 800 ? 5e-3 : 0.05) << c;
    // With velocity the other planes are the same, to the bit.
    const Tile without(source, ticks_of(9.0));
    for (int plane = 0; plane < 3; ++plane)
      EXPECT_EQ(std::memcmp(now.texels[std::size_t(plane)].data(), without.texels[std::size_t(plane)].data(),
                            n * n * sizeof(glm::vec4)),
                0);
  }
}

// The planes are what the height says, and each level is the mean of the one before. Control seen: a strip's mips in
// the place of the next one's.
TEST(WaveParticles, PlanesAgreeWithEachOther) {
  const WaveParticleSettings s;
  const WaveParticles source(s);
  const Tile tile(source, ticks_of(2.0));
  const double towards = s.chop * 2.0 * s.radius_m / std::numbers::pi;
  for (int i = 0; i < n * n; i += 7) {
    const int x = i % n, z = i / n;
    const glm::dvec4 shift(tile.at(WavePlane::shift, x, z)), slope(tile.at(WavePlane::slope, x, z)),
        moments(tile.at(WavePlane::moments, x, z));
    EXPECT_NEAR(shift.x, towards * slope.x, 1e-7);
    EXPECT_NEAR(shift.z, towards * slope.y, 1e-7);
    EXPECT_NEAR(moments.x, slope.x * slope.x, 1e-7);
    EXPECT_NEAR(moments.z, slope.x * slope.y, 1e-7);
    EXPECT_NEAR(moments.w, std::pow(slope.z + slope.w, 2), 1e-6);
  }
  for (int level = 1; level <= 8; ++level)
    for (int plane = 0; plane < 3; ++plane)
      for (int i = 0; i < (n >> level) * (n >> level); i += 3) {
        const int x = i % (n >> level), z = i / (n >> level);
        const auto p = WavePlane(plane);
        const glm::vec4 mean =
            0.25f * (tile.at(p, 2 * x, 2 * z, level - 1) + tile.at(p, 2 * x + 1, 2 * z, level - 1) +
                     tile.at(p, 2 * x, 2 * z + 1, level - 1) + tile.at(p, 2 * x + 1, 2 * z + 1, level - 1));
        ASSERT_LE(glm::length(mean - tile.at(p, x, z, level)), 1e-6f * (1.0f + glm::length(mean))) << level;
      }
}

TEST(WaveParticles, AreTheSameForAnyNumberOfThreads) {
  for (const WaveParticleSettings& s : {WaveParticleSettings{}, many()}) {
    const WaveParticles source(s);
    std::vector<Tile> tiles;
    tiles.reserve(2);
    for (const int threads : {1, 2}) {
      tbb::task_arena arena(threads);
      arena.execute([&] { tiles.emplace_back(source, ticks_of(4.2), true); });
    }
    for (std::size_t i = 0; i < tiles[0].texels.size(); ++i)
      EXPECT_EQ(std::memcmp(tiles[0].texels[i].data(), tiles[1].texels[i].data(),
                            tiles[0].texels[i].size() * sizeof(glm::vec4)),
                0);
    const Tile later(source, ticks_of(4.2) + 1000, true);
    EXPECT_NE(std::memcmp(later.texels[0].data(), tiles[0].texels[0].data(), n * n * sizeof(glm::vec4)), 0);
  }
}

// With waves.loop_s the tile of T is that of 0. Controls seen: turns_of without it; here the same without loop_s.
TEST(WaveParticles, LoopWhereTheSeaLoops) {
  const WaveParticleSettings s;
  const WaveParticles looping(s, 9.81, 90.0), free(s, 9.81, 0.0);
  const auto same = [](const WaveParticles& source) {
    const Tile a(source, 0), b(source, ticks_of(90.0));
    double worst = 0.0;
    for (int i = 0; i < n * n; ++i) worst = std::max(worst, std::abs(a.height(i % n, i / n) - b.height(i % n, i / n)));
    return worst / std::sqrt(source.statistics().height_variance);
  };
  EXPECT_LE(same(looping), 1e-6);
  EXPECT_GT(same(free), 0.5);
  // No particle's speed is off by more than half a tile a loop and axis.
  for (std::size_t i = 0; i < free.particles().size(); ++i) {
    const auto off = [](std::uint64_t a, std::uint64_t b) {
      return std::abs(double(std::int64_t(a - b))) * 0x1p-64 * gpu::ticks_per_second * 90.0;
    };
    EXPECT_LE(off(looping.particles()[i].turns_x, free.particles()[i].turns_x), 0.5 + 1e-6);
    EXPECT_LE(off(looping.particles()[i].turns_z, free.particles()[i].turns_z), 0.5 + 1e-6);
  }
}

TEST(WaveParticles, RefuseWhatIsOutOfRangeByName) {
  const auto refuse = [](auto change, const std::string& name) {
    WaveParticleSettings s;
    change(s);
    EXPECT_NE(test::error_of([&] { WaveParticles{s}; }).find(name), std::string::npos) << name;
  };
  refuse([](auto& s) { s.count = 0; }, "wave_particles.count");
  refuse([](auto& s) { s.count = 100001; }, "wave_particles.count");
  refuse([](auto& s) { s.radius_m = s.tile_m / 65.0; }, "wave_particles.radius_m");
  refuse([](auto& s) { s.tile_m = s.radius_m * 3.9; }, "wave_particles.radius_m");
  refuse([](auto& s) { s.height_m = std::nan(""); }, "wave_particles.height_m");
  refuse([](auto& s) { s.speed_mps = -1.0; }, "wave_particles.speed_mps");
  refuse([](auto& s) { s.speed_mps = INFINITY; }, "wave_particles.speed_mps");
  refuse([](auto& s) { s.chop = 2.1; }, "wave_particles.chop");
  refuse([](auto& s) { s.scales = 4; }, "wave_particles.scales");
  WaveParticleSettings flat;
  flat.height_m = 0.0;
  EXPECT_TRUE(WaveParticles(flat).still());
  EXPECT_FALSE(WaveParticles(WaveParticleSettings{}).still());
}

}  // namespace
}  // namespace seascape
