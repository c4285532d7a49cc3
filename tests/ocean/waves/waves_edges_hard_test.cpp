// Hard cases found by reading the waves' divisions, roots, logarithms and casts: the ends of what settings, places and
// times may be.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ocean/sea/query.h"
#include "ocean/sea/sea_change.h"
#include "ocean/sea/water_side.h"
#include "ocean/waves/baked.h"
#include "ocean/waves/dispersion.h"
#include "ocean/waves/elfouhaily.h"
#include "ocean/waves/gerstner.h"
#include "ocean/waves/spectrum.h"
#include "ocean/waves/wave_particles.h"
#include "ocean/waves/wave_tiles.h"
#include "shaders/shared/phase.h"
#include "tests/support/expect_error.h"
#include "tests/support/source_tile.h"
#include "tests/support/truth.h"

namespace seascape {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity(),
                 least_double = 5e-324;

bool finite(const SeaSample& s) {
  return std::isfinite(s.displacement.x + s.displacement.y + s.displacement.z + s.height_gradient.x +
                       s.height_gradient.y + s.shift_gradient.x + s.shift_gradient.y + s.shift_gradient.z +
                       s.slope_moments.x + s.slope_moments.y + s.slope_moments.z + s.divergence_moment);
}
bool finite(const SeaStatistics& s) {
  return std::isfinite(s.height_variance + s.slope_moments.x + s.slope_moments.y + s.slope_moments.z +
                       s.tail_slope_moments.x + s.tail_slope_moments.y + s.tail_slope_moments.z + s.largest_height_m +
                       s.largest_shift_m + s.mesh_error(1.0) + s.near_motion(10.0).x + s.near_motion(10.0).y);
}
bool finite(const test::SourceTile& tile) {
  for (std::size_t i = 0; i < tile.texels.size(); ++i)
    if (i % 4 != 3 || tile.velocity)
      for (const glm::vec4& t : tile.texels[i])
        if (!std::isfinite(t.x + t.y + t.z + t.w)) return false;
  return true;
}

// Hard 46: Of a sea without chop an eye is in the water exactly where it is below the surface, on crests and in troughs
// alike (200 places, 1 mm to either side). Control: the code as it was, which took such water for flat: an eye in a
// crest was in the air.
TEST(WaterSideHard, hard_46_no_chop) {
  for (const double chop : {0.0, least_double, 1e-30}) {
    SeaState sea;
    sea.chop = chop;
    const WaveField field(sea, {.resolution = 32, .cascades = 3});
    WaveTiles tiles;
    field.evaluate(ticks_from_seconds(7.0), tiles);
    double highest = 0.0;
    for (int i = 0; i < 200; ++i) {
      const glm::dvec2 place(37.0 * i, -11.0 * i);
      const double height = field.displacement(tiles, place, 0.0).y;
      highest = std::max(highest, std::abs(height));
      for (const double off : {-1e-3, 1e-3}) {
        const WaterSide side = water_side(field, tiles, {place.x, height + off, place.y});
        ASSERT_EQ(side.in_water, off < 0.0) << i << " " << chop;
        ASSERT_NEAR(side.height_m, height, 1e-6);
        ASSERT_TRUE(side.certain);
      }
    }
    EXPECT_GT(highest, 0.5);
  }
}

// Hard 47: Where doubles lie farther apart than waves, from 1e11 m on, an eye's side is query()'s and says that it is
// not certain, after one search and not some million. Control: without the limit the lattice of places is one place,
// and at 1e16 m the sheets found made a whole or were searched for through all depths (certain).
TEST(WaterSideHard, hard_47_beyond_doubles) {
  const WaveField field(SeaState{}, {.resolution = 32, .cascades = 3});
  WaveTiles tiles;
  field.evaluate(ticks_from_seconds(3.0), tiles);
  for (const double far : {2e11, 1e16, 1e100, 1e300})
    for (const double y : {-0.3, 0.0, 0.3}) {
      const WaterSide side = water_side(field, tiles, {far, y, -0.5 * far});
      EXPECT_FALSE(side.certain);
      EXPECT_TRUE(std::isfinite(side.height_m));
      EXPECT_EQ(side.in_water, y < side.height_m);
    }
  EXPECT_TRUE(water_side(field, tiles, {1e7, 0.1, -1e7}).certain);
}

// Hard 48: Water of 1e-30 m down to the least double: wave numbers within 3e-5 of w / sqrt(g h), group speeds within
// 1e-9 of sqrt(g h), and every statistic of a sea in it finite. Control: the code as it was: NaN or infinite wave
// numbers below 1e-250 m, and NaN slopes of a sea in 5e-324 m.
TEST(Dispersion, hard_48_depths_down_to_the_least_double) {
  for (const double h : {1e-12, 1e-30, 1e-200, 1e-260, 1e-300, 1e-310, 1e-320, least_double})
    for (const double w : {1e-3, 1.0, 30.0}) {
      const double shallow = w / (std::sqrt(9.81) * std::sqrt(h));
      EXPECT_NEAR(airy_wave_number(w, 9.81, h) / shallow, 1.0, 3e-5) << h;
      EXPECT_NEAR(airy_group_speed(w, 9.81, h) / (std::sqrt(9.81) * std::sqrt(h)), 1.0, 1e-6) << h;
    }
  for (const WaveSpectrum spectrum : {WaveSpectrum::jonswap, WaveSpectrum::tma, WaveSpectrum::elfouhaily})
    for (const double h : {1e-30, 1e-310, least_double}) {
      SeaState sea;
      sea.depth_m = h;
      sea.spectrum = spectrum;
      sea.swell_height_m = 2.0;
      const WaveField field(sea, {.resolution = 16, .cascades = 2});
      EXPECT_TRUE(finite(field.statistics())) << h;
      WaveTiles tiles;
      field.evaluate(12345, tiles);
      EXPECT_TRUE(finite(field.sea(tiles, {1.0, 2.0}, 0.0)));
    }
}

// Hard 49: The other end: wave numbers, frequencies and depths up to 1e308 give finite spectra and speeds of energy,
// and w^2 / g for the wave number. Control: the code as it was: NaN from k = 1e77 rad/m on where short waves are
// suppressed, and for speeds where k h is infinite.
TEST(Spectrum, hard_49_wave_numbers_up_to_the_largest_double) {
  for (const double k : {1e-320, 1e-100, 1e30, 1e77, 1e154, 1e300, 1.7e308}) {
    for (const double h : {1.0, 1e6}) EXPECT_TRUE(std::isfinite(airy_group_speed(k, 9.81, h))) << k;
    for (const WaveSpectrum spectrum : {WaveSpectrum::jonswap, WaveSpectrum::elfouhaily}) {
      SeaState sea;
      sea.small_wave_suppression = 1.0;
      sea.swell_height_m = 1.0;
      sea.spectrum = spectrum;
      const Spectrum s(sea);
      for (int c = 0; c < Spectrum::components; ++c) {
        const double density = s.radial(c, k);
        EXPECT_TRUE(density >= 0.0 && std::isfinite(density)) << k << " " << c << " " << density;
      }
      EXPECT_GE(s.suppression(k), 0.0);
    }
  }
  for (const double w : {1e100, 1e150}) EXPECT_NEAR(airy_wave_number(w, 9.81, 1e6) / (w / 9.81 * w), 1.0, 1e-12) << w;
}

// Hard 50: A loop of waves at 1e-12 and at 1e-300 of its speed stands all but still: its period is two years, and in an
// hour it moves by less than a thousandth of its height, either way. Control: the code as it was: the loop's time in
// ticks was too long for 64 bits and came out as one tick, a period of a microsecond.
TEST(BakedHard, hard_50_slower_than_any_clock) {
  BakedLoop loop{16, 8, 1.0, 32.0, {}};
  loop.texels.resize(std::size_t(loop.frames) * loop.frame_floats());
  for (int f = 0; f < loop.frames; ++f)
    for (int z = 0; z < 16; ++z)
      for (int x = 0; x < 16; ++x)
        loop.texels[std::size_t(f) * loop.frame_floats() + 256 + std::size_t(z * 16 + x)] =
            float(std::cos(2.0 * truth::pi * (x / 16.0 - f / 8.0)));
  for (const double speed : {1e-12, -1e-12, 1e-300, -1e-300, least_double}) {
    const Baked baked(loop, {.speed = speed});
    EXPECT_GT(baked.period_s(), 6e7) << speed;
    const test::SourceTile first(baked, 0), later(baked, ticks_from_seconds(3600.0)),
        before(baked, ticks_from_seconds(-3600.0), true);
    ASSERT_TRUE(finite(first) && finite(later) && finite(before));
    double most = 0.0, moved = 0.0;
    for (int x = 0; x < 16; ++x)
      most = std::max(most, std::abs(first.height(x, 3))),
      moved = std::max(moved, std::abs(later.height(x, 3) - first.height(x, 3)));
    EXPECT_GT(most, 0.9);
    EXPECT_LT(moved, 1e-3 * most) << speed;
  }
}

// Hard 51: Gerstner waves 1e-200 m high, whose squares no double holds: all texels and statistics finite, the sea flat.
// Control: the code as it was: NaN second moments (0 / 0).
TEST(GerstnerHard, hard_51_waves_too_low_to_be_squared) {
  for (const double height : {1e-30, 1e-160, 1e-200, 1e-310, least_double})
    for (const int octaves : {0, 2}) {
      GerstnerSettings settings;
      settings.set1 = {.height_m = height, .wavelength_m = 40.0, .octaves = octaves};
      const Gerstner gerstner(settings);
      if (gerstner.still()) continue;  // of the least double's quarter nothing is left
      const test::SourceTile tile(gerstner, 777, true);
      EXPECT_TRUE(finite(tile)) << height;
      EXPECT_NEAR(tile.height(3, 5), 0.0, 1e-29);
      EXPECT_TRUE(std::isfinite(gerstner.steepness() + gerstner.statistics().largest_curvature_per_m));
    }
}

// Hard 52: Gerstner waves whose steepnesses come to exactly what is allowed, 1 to the last bit: no Jacobian, between
// texels either, is below -1e-3, and normals are unit vectors. Control: a limit of 1.1 in place of 1 lets the surface
// fold (Jacobian -0.1).
TEST(GerstnerHard, hard_52_steepness_of_exactly_one) {
  GerstnerSettings settings;
  settings.set1 = {.height_m = 3.0, .wavelength_m = 40.0, .octaves = 0};
  double low = 0.1, high = 2.0;
  const auto accepted = [&](double chop) {
    settings.chop = chop;
    try {
      return Gerstner(settings).steepness() <= 2.0;
    } catch (const Error&) {
      return false;
    }
  };
  settings.set1.height_m = 12.0;
  ASSERT_FALSE(accepted(high));
  for (int i = 0; i < 60; ++i) (accepted(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  ASSERT_TRUE(accepted(low));
  settings.chop = low;
  auto gerstner = std::make_shared<const Gerstner>(settings);
  EXPECT_NEAR(gerstner->steepness(), 1.0, 1e-12);
  SeaState calm;
  calm.wind_speed_mps = 0.0;
  const WaveField field(calm, {.resolution = 16, .cascades = 1}, {gerstner});
  WaveTiles tiles(true);
  field.evaluate(ticks_from_seconds(2.3), tiles);
  std::vector<glm::dvec2> places;
  for (int i = 0; i < 400; ++i) places.push_back({0.1 * i, 0.37 * i});
  std::vector<QueryAnswer> answers(places.size());
  query(field, tiles, places, answers);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SeaSample s = field.sea(tiles, places[i], 0.0);
    ASSERT_TRUE(finite(s));
    ASSERT_GE(s.jacobian(), -1e-3);
    ASSERT_NEAR(glm::length(answers[i].normal), 1.0, 1e-12);
    ASSERT_TRUE(std::isfinite(answers[i].height_m + answers[i].eulerian_velocity_mps.y));
  }
}

// Hard 53: A footprint that is no number, negative, infinite or the least double gets a finite sea: no number and below
// 0 count as 0, and an infinite one sees flat water with all slopes as moments. Control: the code as it was: NaN
// heights for a footprint of NaN.
TEST(WaveFieldHard, hard_53_footprints_that_are_none) {
  const WaveField field(SeaState{}, {.resolution = 32, .cascades = 3});
  WaveTiles tiles(true);
  field.evaluate(ticks_from_seconds(5.0), tiles);
  const glm::dvec2 place(12.3, -45.6);
  const SeaSample sharp = field.sea(tiles, place, 0.0);
  for (const double footprint : {nan, -1.0, -infinity, -0.0, least_double}) {
    const SeaSample s = field.sea(tiles, place, footprint);
    EXPECT_EQ(s.displacement, sharp.displacement) << footprint;
    EXPECT_EQ(s.slope_moments, sharp.slope_moments);
    QueryAnswer answer;
    query(field, tiles, {&place, 1}, {&answer, 1}, {.footprint_m = footprint});
    EXPECT_TRUE(std::isfinite(answer.height_m));
    EXPECT_TRUE(answer.converged);
  }
  for (const double footprint : {1e7, 1e308, infinity}) {
    const SeaSample s = field.sea(tiles, place, footprint);
    EXPECT_TRUE(finite(s));
    EXPECT_EQ(s.displacement, glm::dvec3(0.0));
    EXPECT_GT(s.slope_moments.x, sharp.slope_moments.x);
  }
}

// Hard 54: A change of the sea that ends as it begins: before it the old sea, from then on the new one, finite at every
// tick. Control: the code as it was: 0 / 0 at that tick.
TEST(SeaBlend, hard_54_a_change_of_no_duration) {
  constexpr WaveQuality quality{.resolution = 16, .cascades = 2};
  SeaState old_sea, new_sea;
  new_sea.wind_speed_mps = 18.0;
  const Ladder l = ladder(old_sea);
  const auto made = [&](const SeaState& sea) {
    MadeSea result{sea, make_wave_bins(sea, quality, l), {}};
    result.statistics = sea_statistics(sea, result.bins);
    return result;
  };
  for (const bool same : {true, false}) {
    const MadeSea from = made(old_sea), to = made(new_sea);
    const SeaBlend blend(from, to, 1000, 1000, same);
    WaveBins bins = from.bins;
    for (const std::int64_t ticks :
         {std::int64_t(-1) << 61, std::int64_t(999), std::int64_t(1000), std::int64_t(1001), std::int64_t(1) << 61}) {
      blend.amplitudes(ticks, bins);
      for (std::size_t i = 0; i < bins.bins.size(); ++i)
        ASSERT_EQ(bins.bins[i].amplitude, (ticks < 1000 ? from : to).bins.bins[i].amplitude) << ticks;
      ASSERT_TRUE(finite(blend.statistics(ticks)));
      ASSERT_EQ(blend.chop(ticks), new_sea.chop);
    }
  }
}

// Hard 55: Wind straight along an axis: the slopes' cross moment is below 1e-9 of the others, a quarter of a turn swaps
// those to 1e-9, and -360, 0, 360 and 720 degrees are one sea to 1e-9. Control: the directions of slopes turned by 0.15
// rad.
TEST(SpectrumHard, hard_55_wind_straight_along_an_axis) {
  const auto moments = [](double degrees) {
    SeaState sea;
    sea.wind_to_deg = degrees;
    return slope_moments(sea);
  };
  const glm::dvec3 along_z = moments(0.0);
  EXPECT_GT(along_z.y, 1.1 * along_z.x);
  for (const double degrees : {-360.0, -0.0, 90.0, 180.0, 270.0, 360.0, 720.0}) {
    const glm::dvec3 m = moments(degrees);
    const bool turned = std::fmod(std::abs(degrees), 180.0) != 0.0;
    EXPECT_NEAR(turned ? m.y : m.x, along_z.x, 1e-9 * along_z.x) << degrees;
    EXPECT_NEAR(turned ? m.x : m.y, along_z.y, 1e-9 * along_z.y) << degrees;
    EXPECT_NEAR(m.z, 0.0, 1e-9 * along_z.x) << degrees;
    SeaState sea;
    sea.wind_to_deg = degrees;
    EXPECT_TRUE(finite(sea_statistics(sea, make_wave_bins(sea, {.resolution = 16, .cascades = 2}))));
  }
}

// Hard 56: Times at the ends of what ticks hold: the sea is finite at +-2^62 ticks and at the least and largest 64-bit
// number, t = -1e7 s is as exact as 1e7 s (phases mirror to 2^-31 of a turn), and seconds beyond 4e12 are refused by
// name. Control: ticks of the time without its sign.
TEST(WaveTime, hard_56_the_ends_of_time) {
  const WaveField field(SeaState{}, {.resolution = 32, .cascades = 2});
  WaveTiles tiles(true);
  for (const std::int64_t ticks : {std::numeric_limits<std::int64_t>::min(), -(std::int64_t(1) << 62),
                                   std::int64_t(1) << 62, std::numeric_limits<std::int64_t>::max()}) {
    field.evaluate(ticks, tiles);
    EXPECT_TRUE(finite(field.sea(tiles, {3.0, 4.0}, 0.0)));
    EXPECT_LT(std::abs(field.displacement(tiles, {3.0, 4.0}, 0.0).y), 1.5 * field.statistics().largest_height_m);
  }
  const std::int64_t t = ticks_from_seconds(1e7 + 0.125), back = ticks_from_seconds(-1e7 - 0.125);
  EXPECT_EQ(back, -t);
  for (const gpu::WaveBin& bin : field.bins().bins) {
    const auto phase = [&](std::int64_t ticks) {
      return gpu::phase_turns(bin.turns_high, bin.turns_low, gpu::uint(std::uint64_t(ticks) >> 32), gpu::uint(ticks));
    };
    ASSERT_LE(gpu::uint(phase(t) + phase(back) + 1u), 1u);
  }
  // 2^46 s later a wave has run on by a part of a turn that its own turns a tick tell.
  const gpu::WaveBin& bin = field.bins().at(0, 3, 5);
  const std::uint64_t turns = (std::uint64_t(bin.turns_high) << 32) | bin.turns_low, much = std::uint64_t(1) << 50;
  EXPECT_EQ(gpu::phase_turns(bin.turns_high, bin.turns_low, gpu::uint(much >> 32), gpu::uint(much)),
            gpu::uint((turns * much) >> 32));
  EXPECT_NE(gpu::uint((turns * much) >> 32), 0u);
  for (const double bad : {5e12, -5e12, 1e300, nan, infinity})
    EXPECT_NE(test::error_of([&] { ticks_from_seconds(bad); }).find("time"), std::string::npos) << bad;
}

// Hard 57: Loops of a tick, and of less than one: of a tick every wave stands still to the bit, of less the sea does
// not loop; both finite. Control: a loop's ticks rounded up to 1.
TEST(WaveTime, hard_57_a_loop_of_one_tick) {
  constexpr double tick_s = 1.0 / 1048576.0;
  for (const double loop_s : {tick_s, 0.4 * tick_s, least_double}) {
    SeaState sea;
    sea.loop_s = loop_s;
    const WaveField field(sea, {.resolution = 16, .cascades = 2});
    WaveTiles now(true), later(true);
    field.evaluate(0, now);
    field.evaluate(123456789, later);
    const SeaSample a = field.sea(now, {1.0, 2.0}, 0.0), b = field.sea(later, {1.0, 2.0}, 0.0);
    EXPECT_TRUE(finite(a) && finite(b));
    EXPECT_EQ(a.displacement == b.displacement, loop_s == tick_s) << loop_s;
    if (loop_s == tick_s) {
      EXPECT_EQ(field.velocity(now, {1.0, 2.0}, 0.0), glm::dvec3(0.0));
    }
  }
}

// Hard 58: Wave particles at the ends of their settings: one alone, the largest and the smallest radius of the least
// and the widest tile, the least speed, a loop of a tick: all texels finite, and none higher than the particles
// together. Control: a loop of no ticks taken for one (a division by 0).
TEST(WaveParticlesHard, hard_58_ends_of_their_settings) {
  for (const double tile : {0.25, 4000.0})
    for (const double share : {1.0 / 64.0, 0.25})
      for (const int count : {1, 2, 9000})
        for (const auto& [speed, loop_s] : {std::pair{0.0, 0.0}, {least_double, 0.0}, {100.0, 1.0 / 1048576.0}}) {
          WaveParticleSettings s;
          s.count = count, s.tile_m = tile, s.radius_m = share * tile, s.speed_mps = speed, s.height_m = 1e-3 * tile;
          const WaveParticles particles(s, 1000.0, loop_s);
          const test::SourceTile made(particles, ticks_from_seconds(1e6), true);
          ASSERT_TRUE(finite(made)) << tile << " " << share << " " << count;
          for (int z = 0; z < 256; z += 3)
            for (int x = 0; x < 256; x += 3)
              ASSERT_LE(std::abs(made.height(x, z)), 1.01 * count * particles.amplitude_m());
        }
}

}  // namespace
}  // namespace seascape
