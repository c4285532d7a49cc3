#include "ocean/waves/wave_tiles.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>
#include <memory>
#include <random>

#include "ocean/waves/gerstner.h"
#include "ocean/waves/half_floats.h"
#include "tests/support/spectrum_truth.h"

namespace seascape {
namespace {

SeaState windy() {
  SeaState sea;
  sea.wind_speed_mps = 12;
  sea.swell_height_m = 1.5;
  sea.chop = 1.2;
  return sea;
}

// All fields of one cascade by direct sums in double, its waves raised for a tile of `samples` texels, or as they are
// for 0: h = sum of Re(a exp(i(k.x - w t))), D = chop Re(i k/|k| a exp(...)).
struct Fields {
  double h = 0, dx = 0, dz = 0, hx = 0, hz = 0, xx = 0, zz = 0, xz = 0, vx = 0, vy = 0, vz = 0;
};

Fields direct(const SeaState& sea, const WaveBins& bins, int cascade, double x, double z, double t, int samples = 0) {
  Fields f;
  const Cascade& c = bins.ladder[cascade];
  const int half = bins_of(cascade) / 2;
  for (int mz = -half; mz < half; ++mz)
    for (int mx = -half; mx < half; ++mx) {
      const gpu::WaveBin& b = bins.at(cascade, mx, mz);
      if (b.amplitude == glm::vec2(0)) continue;
      const double step = 2 * truth::pi / c.side_m, s = std::sin(c.rotation_rad), o = std::cos(c.rotation_rad);
      const double kx = step * (o * mx - s * mz), kz = step * (s * mx + o * mz), k = std::hypot(kx, kz);
      const double w = truth::airy(k, sea.gravity_mps2, sea.depth_m, 7.17e-5), phase = kx * x + kz * z - w * t;
      const glm::dvec2 a = (samples > 0 ? truth::raised(mx, mz, samples) : 1.0) * glm::dvec2(b.amplitude);
      const double re = a.x * std::cos(phase) - a.y * std::sin(phase),
                   im = a.x * std::sin(phase) + a.y * std::cos(phase);
      f.h += re;
      const double chop =
          sea.chop * std::min(1.0 / std::tanh(k * sea.depth_m), 8.0);  // orbits are coth(k h) as wide as high
      f.dx -= chop * kx / k * im;
      f.dz -= chop * kz / k * im;
      f.hx -= kx * im;
      f.hz -= kz * im;
      f.xx -= chop * kx * kx / k * re;
      f.zz -= chop * kz * kz / k * re;
      f.xz -= chop * kx * kz / k * re;
      f.vy += w * im;
      f.vx += chop * kx / k * w * re;
      f.vz += chop * kz / k * w * re;
    }
  return f;
}

glm::dvec2 texel_place(const Cascade& c, int samples, int x, int z) {
  return rotate_xz(c.side_m / samples * glm::dvec2(x, z), c.rotation_rad);
}

// Controls seen: the levels below a strip's left out, a strip sent to the columns of the one before.
TEST(WaveTiles, GoToMemoryOfOthersAsHalves) {
  const WaveQuality quality{.resolution = 64, .cascades = 2};
  const WaveField field(windy(), quality);
  WaveTiles own, out;
  const WaveTileLayout layout(quality);
  std::vector<std::uint16_t> memory(12 * layout.plane_texels);
  WaveTiles::Lent lent;
  for (std::size_t tile = 0; tile < 2; ++tile)
    for (int level = 0; level < layout.tiles[tile].levels; ++level)
      for (std::size_t plane = 0; plane < 3; ++plane)
        lent.halves[tile][std::size_t(level)][plane] = {
            memory.data() + 4 * layout.offset(int(tile), WavePlane(plane), level),
            4 * layout.level(int(tile), level).stride};
  out.keep_in(lent, layout, 2);
  field.evaluate(12345678, own);
  field.evaluate(12345678, out);
  std::vector<std::uint16_t> want;
  const auto wrong_rows = [&](bool halves) {
    int wrong = 0;
    for (int tile = 0; tile < 2; ++tile)
      for (int level = 0; level < own.levels(tile); ++level)
        for (int plane = 0; plane < (halves ? 3 : 1); ++plane)  // of floats displacements alone are kept
          for (int z = 0, size = own.samples(tile) >> level; z < size; ++z) {
            const glm::vec4* const row = own.texels(tile, WavePlane(plane), level) + z * own.stride(tile, level);
            const auto& to = lent.halves[std::size_t(tile)][std::size_t(level)][std::size_t(plane)];
            want.resize(4 * std::size_t(size));
            halves_from_floats(&row->x, want.data(), want.size());
            const glm::vec4* const got = out.texels(tile, WavePlane(plane), level) + z * out.stride(tile, level);
            wrong += halves ? std::memcmp(want.data(), to.first + z * to.row, 2 * want.size()) != 0
                            : std::memcmp(row, got, sizeof(glm::vec4) * std::size_t(size)) != 0;
          }
    return wrong;
  };
  EXPECT_EQ(wrong_rows(true), 0);
  EXPECT_EQ(wrong_rows(false), 0);
}

TEST(WaveTiles, equal_direct_sums) {
  // Every field of random texels against direct sums in double, relative to the field's root mean square. Control: the
  // mirrored wave taken without its conjugate, misses by 0.08, dDx/dz
  // with the other sign by 2; in shallow water displacements as wide as high by 0.5 (seen).
  for (const int resolution : {16, 32, 64, 128, 256, 512}) {
    SeaState sea = windy();
    if (resolution == 128) sea.depth_m = 6;  // shallow for the swell, where displacements are wider than heights
    const WaveQuality quality{.resolution = resolution, .cascades = 3};
    const WaveField field(sea, quality);
    WaveTiles tiles(true);
    const double t = 1234.5;
    field.evaluate(ticks_from_seconds(t), tiles);
    std::mt19937 random(3);
    for (int cascade = 0; cascade < 3; ++cascade) {
      double error[11] = {}, size[11] = {};
      const int samples = tiles.samples(cascade);
      EXPECT_EQ(samples, cascade > 0 ? resolution : std::min(4 * resolution, 512));
      const float share = moment_share(field.bins(), cascade, samples);
      for (int i = 0; i < 20; ++i) {
        const int x = int(random() % unsigned(samples)), z = int(random() % unsigned(samples));
        const glm::dvec2 place = texel_place(field.bins().ladder[cascade], samples, x, z);
        const Fields f = direct(sea, field.bins(), cascade, place.x, place.y, t, samples);
        const std::size_t at = std::size_t(z) * tiles.stride(cascade, 0) + x;
        const glm::vec4 a = tiles.texels(cascade, WavePlane::shift, 0)[at],
                        b = tiles.texels(cascade, WavePlane::slope, 0)[at],
                        m = tiles.texels(cascade, WavePlane::moments, 0)[at],
                        v = tiles.texels(cascade, WavePlane::velocity, 0)[at];
        const double truth[11] = {f.dx, f.h, f.dz, f.xz, f.hx, f.hz, f.xx, f.zz, f.vx, f.vy, f.vz};
        const float got[11] = {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, v.x, v.y, v.z};
        for (int j = 0; j < 11; ++j) error[j] += std::pow(truth[j] - double(got[j]), 2), size[j] += truth[j] * truth[j];
        EXPECT_EQ(m, share * glm::vec4(b.x * b.x, b.y * b.y, b.x * b.y, (b.z + b.w) * (b.z + b.w)));
      }
      for (int j = 0; j < 11; ++j) {
        if (size[j] > 0) {
          EXPECT_LE(std::sqrt(error[j] / size[j]), 1e-5) << resolution << " cascade " << cascade << " field " << j;
        }
      }
    }
  }
}

TEST(WaveTiles, one_trochoid_has_jacobian_1_minus_chop_ka) {
  // A single wave of cascade 0 along mx = 3. Control: displacement of the other sign gives 1 + chop kA at the crest.
  SeaState sea;
  sea.wind_speed_mps = 0;
  for (const double chop : {0.5, 1.0, 2.0}) {
    sea.chop = chop;
    const WaveQuality quality{.resolution = 256, .cascades = 1};
    WaveBins bins = make_wave_bins(sea, quality);
    const double k = 2 * truth::pi * 3 / bins.ladder[0].side_m, amplitude = 0.2 / k;
    bins.at(0, 3, 0).amplitude =
        glm::vec2(float(amplitude / truth::raised(3, 0, 512)), 0);  // as high as that at texels
    const WaveField field(sea, quality, bins);
    WaveTiles tiles;
    field.evaluate(0, tiles);
    const SeaSample crest = field.sea(tiles, {0, 0}, 0);
    EXPECT_NEAR(crest.displacement.y, amplitude, 1e-5 * amplitude);
    EXPECT_NEAR(crest.jacobian(), 1 - chop * 0.2, 1e-5);
    double least = 1;
    for (int z = 0; z < 512; z += 16)
      for (int x = 0; x < 512; ++x) {
        const std::size_t at = std::size_t(z) * tiles.stride(0, 0) + x;
        const glm::vec4 a = tiles.texels(0, WavePlane::shift, 0)[at], b = tiles.texels(0, WavePlane::slope, 0)[at];
        least = std::min(least, (1.0 + b.z) * (1.0 + b.w) - double(a.w) * a.w);
      }
    EXPECT_NEAR(least, 1 - chop * 0.2, 1e-5);
  }
}

TEST(WaveTiles, waves_travel_along_their_wave_vector) {
  // A quarter period later the crest stands a quarter wave further along +k. Control: phase of the other sign sends it
  // back.
  SeaState sea;
  sea.wind_speed_mps = 0;
  const WaveQuality quality{.resolution = 128, .cascades = 1};
  WaveBins bins = make_wave_bins(sea, quality);
  bins.at(0, 4, -2).amplitude = glm::vec2(1, 0);
  const WaveField field(sea, quality, bins);
  const double side = bins.ladder[0].side_m, k = 2 * truth::pi * std::sqrt(20.0) / side,
               period = 2 * truth::pi / truth::airy(k, 9.81, 1e5, 7.17e-5);
  WaveTiles tiles(true);
  field.evaluate(ticks_from_seconds(period / 4), tiles);
  const glm::dvec2 along = rotate_xz(glm::dvec2(4, -2) / std::sqrt(20.0), bins.ladder[0].rotation_rad);
  const glm::dvec2 crest = along * (2 * truth::pi / k / 4);
  EXPECT_NEAR(field.sea(tiles, crest, 0).displacement.y, 1, 0.02);
  // At the crest the water moves with the wave, at speed w a.
  const glm::dvec3 v = field.velocity(tiles, crest, 0);
  EXPECT_NEAR(glm::dot(glm::dvec2(v.x, v.z), along), 2 * truth::pi / period, 0.02 * 2 * truth::pi / period);
}

TEST(WaveTiles, mip_levels_are_averages) {
  // Control: taking the upper left texel instead of the mean of four fails at level 1.
  const WaveField field(windy(), {.resolution = 64, .cascades = 2});
  WaveTiles tiles(true);
  field.evaluate(ticks_from_seconds(5), tiles);
  ASSERT_EQ(tiles.levels(0), 9);
  ASSERT_EQ(tiles.levels(1), 7);
  for (int level = 1; level < 7; ++level)
    for (const WavePlane plane : {WavePlane::shift, WavePlane::slope, WavePlane::moments, WavePlane::velocity})
      for (int z = 0; z < 64 >> level; ++z)
        for (int x = 0; x < 64 >> level; ++x) {
          glm::dvec4 sum(0);
          const int block = 1 << level;
          for (int j = 0; j < block; ++j)
            for (int i = 0; i < block; ++i)
              sum += glm::dvec4(tiles.texels(1, plane, 0)[(z * block + j) * tiles.stride(1, 0) + x * block + i]);
          const glm::dvec4 truth = sum / double(block * block);
          const glm::dvec4 got(tiles.texels(1, plane, level)[z * tiles.stride(1, level) + x]);
          ASSERT_LE(glm::length(got - truth), 1e-6) << level << " " << int(plane) << " " << x << " " << z;
        }
}

TEST(WaveTiles, hard_8_mean_height_is_zero_and_variance_the_bins) {
  // Hard case 8; drawn Hs, at places anywhere between texels, equals the sum of its own bins to 1 %, here over 24 times
  // since opposed waves beat. Controls: spectra halved once more give half the height; waves as high at texels as they
  // are miss by 2.4 % (seen).
  const WaveField field(windy(), {.resolution = 128, .cascades = 4});
  WaveTiles tiles;
  double square = 0;
  constexpr int times = 24, places = 20000;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(-1e5, 1e5);
  for (int t = 0; t < times; ++t) {
    field.evaluate(ticks_from_seconds(t * 7.7), tiles);
    for (int c = 0; c < 4; ++c) {
      double sum = 0;
      const int samples = tiles.samples(c);
      for (int z = 0; z < samples; ++z)
        for (int x = 0; x < samples; ++x) sum += tiles.texels(c, WavePlane::shift, 0)[z * tiles.stride(c, 0) + x].y;
      EXPECT_LE(std::abs(sum / (samples * samples)), 1e-6);
    }
    for (int i = 0; i < places; ++i)
      square += std::pow(field.displacement(tiles, {uniform(random), uniform(random)}, 0).y, 2);
  }
  EXPECT_NEAR(std::sqrt(square / (times * places) / field.statistics().height_variance), 1, 0.01);
}

TEST(WaveTiles, hard_10_bits_do_not_depend_on_threads_or_history) {
  // Hard cases 10 and 28's kin. Control: ticks added to those the tiles held.
  const WaveField field(windy(), {.resolution = 128, .cascades = 3});
  WaveTiles one(true), many(true);
  field.evaluate(ticks_from_seconds(99), many);
  field.evaluate(ticks_from_seconds(-3), many);
  field.evaluate(ticks_from_seconds(42.5), many);
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    field.evaluate(ticks_from_seconds(42.5), one);
  }
  for (int c = 0; c < 3; ++c)
    for (int level = 0; level < one.levels(c); ++level)
      for (const WavePlane plane : {WavePlane::shift, WavePlane::slope, WavePlane::moments, WavePlane::velocity}) {
        const std::size_t bytes =
            sizeof(glm::vec4) * std::size_t(one.stride(c, level)) * std::size_t(one.samples(c) >> level);
        ASSERT_EQ(std::memcmp(one.texels(c, plane, level), many.texels(c, plane, level), bytes), 0)
            << c << " " << level;
      }
}

// Tiles made in parts are those that are made at once, to the bit, with other sources too. Controls seen: strips that
// begin with the first of their cascade in each part; coarsest levels made only where a part has all strips.
TEST(WaveTiles, MadeInPartsAreTheSame) {
  SeaState sea = windy();
  const WaveQuality quality{.resolution = 64, .cascades = 3};
  GerstnerSettings settings;
  const WaveField field(sea, quality, {std::make_shared<Gerstner>(settings)});
  for (const int parts : {2, 5, 1000}) {
    WaveTiles whole(true), pieces(true);
    field.evaluate(123456789, whole);
    field.evaluate(99, pieces);
    field.begin(123456789, pieces);
    int done = 0;
    for (int part = 1; part <= parts; ++part) {
      const int due = field.pieces_within(double(part) / parts);
      EXPECT_GE(due, done);
      field.fill(pieces, done, due);
      done = due;
    }
    EXPECT_EQ(done, field.piece_count());
    for (int tile = 0; tile < field.tile_count(); ++tile)
      for (int level = 0; level < whole.levels(tile); ++level)
        for (const WavePlane plane : {WavePlane::shift, WavePlane::slope, WavePlane::moments, WavePlane::velocity})
          for (int z = 0, size = whole.layout().level(tile, level).size; z < size; ++z) {
            const std::ptrdiff_t row = std::ptrdiff_t(z) * whole.stride(tile, level);
            ASSERT_EQ(std::memcmp(whole.texels(tile, plane, level) + row, pieces.texels(tile, plane, level) + row,
                                  std::size_t(size) * sizeof(glm::vec4)),
                      0)
                << parts << " parts, tile " << tile << " level " << level << " row " << z;
          }
  }
  EXPECT_EQ(field.pieces_within(0.0), 0);
  EXPECT_EQ(field.pieces_within(7.0), field.piece_count());
}

TEST(WaveTiles, samples_between_texels_and_across_footprints) {
  // Anywhere between texels a sample of no footprint is the sea within 3 % of its deviation (straight lines between
  // texels, four and eight to the shortest wave; root mean square); far above every tile only moments are left, and
  // resolved plus unresolved slope variance is the same at every footprint (5 %). Control: without the half texel
  // places miss by 0.4 of the deviation; waves not raised by 6 % (seen); without moments the variance by 9 % and more.
  const WaveField field(windy(), {.resolution = 256, .cascades = 3});
  WaveTiles tiles;
  field.evaluate(ticks_from_seconds(10), tiles);
  std::mt19937 random(9);
  double error = 0;
  glm::dvec2 place;
  for (int i = 0; i < 40; ++i) {
    place = {random() % 100000 * 0.1, random() % 100000 * 0.1};
    glm::dvec3 sum(0);
    for (int c = 0; c < 3; ++c) {
      const Fields f = direct(field.state(), field.bins(), c, place.x, place.y, 10);
      sum += glm::dvec3(f.dx, f.h, f.dz);
    }
    error += std::pow(glm::length(field.sea(tiles, place, 0).displacement - sum), 2) / 40;
  }
  EXPECT_LE(std::sqrt(error / field.statistics().height_variance), 0.03);
  RecordProperty("error", std::to_string(std::sqrt(error / field.statistics().height_variance)));
  EXPECT_EQ(field.sea(tiles, place, 0).displacement, field.displacement(tiles, place, 0));

  const SeaSample far = field.sea(tiles, place, 1e5);
  EXPECT_EQ(far.displacement, glm::dvec3(0));
  const glm::dvec3 all = field.statistics().slope_moments + field.statistics().tail_slope_moments;
  EXPECT_NEAR(far.slope_moments.x / all.x, 1, 0.05);
  EXPECT_NEAR(far.slope_moments.y / all.y, 1, 0.05);
  for (const double footprint : {0.0, 0.5, 3.0, 12.0, 50.0, 200.0}) {
    glm::dvec2 total(0);
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
      const glm::dvec2 at(random() % 100000 * 0.1, random() % 100000 * 0.1);
      const SeaSample s = field.sea(tiles, at, footprint);
      total += (s.height_gradient * s.height_gradient + glm::dvec2(s.slope_moments)) / double(count);
    }
    EXPECT_NEAR(total.x / far.slope_moments.x, 1, 0.05) << footprint;
    EXPECT_NEAR(total.y / far.slope_moments.y, 1, 0.05) << footprint;
  }
}

}  // namespace
}  // namespace seascape
