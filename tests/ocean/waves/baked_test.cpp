// Recorded loops against closed forms in double (tests/support/gerstner_truth.h): what is recorded, and what is played
// at any time.
#include "ocean/waves/baked.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>
#include <map>
#include <numbers>
#include <random>
#include <tuple>

#include "ocean/sea/query.h"
#include "tests/support/expect_error.h"
#include "tests/support/gerstner_truth.h"
#include "tests/support/source_tile.h"

namespace seascape {
namespace {

using Tile = test::SourceTile;
constexpr double pi = std::numbers::pi;

// Waves of whole numbers on a tile of 64 m, of whole turns in a loop of 12 s, so that they close in place and time. The
// shortest has `texels` of a 64th of the tile.
std::vector<truth::Trochoid> waves_of_loop(double texels) {
  std::vector<truth::Trochoid> waves;
  const int most = int(64.0 / texels);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 12; ++i) {
    truth::Trochoid w;
    int mx = 0, mz = 0;
    while (mx == 0 && mz == 0)
      mx = int((2 * most + 1) * uniform(random)) - most, mz = int((2 * most + 1) * uniform(random)) - most;
    w.kx = 2.0 * pi * mx / 64.0;
    w.kz = 2.0 * pi * mz / 64.0;
    w.a = 0.1 / std::hypot(mx, mz);
    w.phase = 2.0 * pi * uniform(random);
    w.chop = 0.8;
    w.w = 2.0L * 3.14159265358979323846264338L / 12.0L *
          std::max(1.0L, std::round(truth::trochoid_frequency(std::hypot(w.kx, w.kz), 9.81L, 1e6L) * 12.0L /
                                    (2.0L * 3.14159265358979323846264338L)));
    waves.push_back(w);
  }
  return waves;
}

BakedLoop loop_of(const std::vector<truth::Trochoid>& waves, int samples, int frames) {
  BakedLoop loop{samples, frames, frames / 12.0, 64.0, {}};
  loop.texels.resize(std::size_t(frames) * loop.frame_floats());
  for (int f = 0; f < frames; ++f)
    for (int z = 0; z < samples; ++z)
      for (int x = 0; x < samples; ++x) {
        const truth::Trochoids at = truth::trochoids(waves, f * 12.0L / frames, x * 64.0 / samples, z * 64.0 / samples);
        const double d[3] = {at.x, at.y, at.z};
        for (int c = 0; c < 3; ++c) loop.texels[std::size_t(((f * 3 + c) * samples + z) * samples + x)] = float(d[c]);
      }
  return loop;
}

SeaState flat() {
  SeaState sea;
  sea.wind_speed_mps = 0.0;
  return sea;
}

// Root mean squares of what field and query are off, over the truth's own.
struct Off {
  double height = 0.0, slope = 0.0, shear = 0.0, asked = 0.0, velocity = 0.0;
};
Off off(const BakedSettings& settings, int samples, int frames, double texels, double time_s, double truth_time_s) {
  const std::vector<truth::Trochoid> waves = waves_of_loop(texels);
  static std::map<std::tuple<int, int, double>, BakedLoop> recorded;  // it takes a while
  BakedLoop& loop = recorded[{samples, frames, texels}];
  if (loop.frames == 0) loop = loop_of(waves, samples, frames);
  const auto source = std::make_shared<Baked>(loop, settings);
  const WaveField field(flat(), {.resolution = 16, .cascades = 1}, {source});
  WaveTiles tiles(true);
  field.evaluate(ticks_from_seconds(time_s), tiles);
  const double rate = settings.speed / std::sqrt(settings.scale), size = settings.scale;
  Off e;
  double heights = 0.0, slopes = 0.0, shears = 0.0, speeds = 0.0;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-300.0, 300.0);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec2 rest(size * uniform(random), size * uniform(random));
    truth::Trochoids want = truth::trochoids(waves, truth_time_s, rest.x / size, rest.y / size);
    const double by = size * settings.weight;
    const SeaSample sample = field.sea(tiles, rest, 0.0);
    const auto add = [](double& sum, double& all, double got, double right) {
      sum += (got - right) * (got - right), all += right * right;
    };
    add(e.height, heights, sample.displacement.y, by * want.y);
    add(e.slope, slopes, sample.height_gradient.x, settings.weight * want.hx);
    add(e.slope, slopes, sample.height_gradient.y, settings.weight * want.hz);
    add(e.shear, shears, sample.shift_gradient.x, settings.weight * want.xx);
    add(e.shear, shears, sample.shift_gradient.z, settings.weight * want.xz);
    add(e.velocity, speeds, field.velocity(tiles, rest, 0.0).y, by * rate * want.vy);
    const glm::dvec2 place = rest + by * glm::dvec2(want.x, want.z);
    QueryAnswer answer;
    query(field, tiles, {&place, 1}, {&answer, 1}, {.most_iterations = 40, .tolerance_m = 1e-6});
    EXPECT_TRUE(answer.converged);
    double ignored = 0.0;
    add(e.asked, ignored, answer.height_m, by * want.y);
  }
  const auto over = [](double sum, double all) { return std::sqrt(sum / all); };
  return {over(e.height, heights), over(e.slope, slopes), over(e.shear, shears), over(e.asked, heights),
          over(e.velocity, speeds)};
}

// At frames and between them, early and late, and after 1e6 loops: the waves that were recorded. What texels of eight a
// wave leave is most of it. Controls seen: frames taken one late (0.48 of the height), the rates' factor
// frames_a_second_ left out (0.75 of the velocity), raise() left out (0.076 of waves of four texels); here: a quarter
// of a second late.
TEST(Baked, PlaysWhatWasRecorded) {
  for (const double time_s : {0.0, 0.125, 12.0e6 + 3.99, -0.4}) {
    const double in_loop = time_s - 12.0 * std::floor(time_s / 12.0);
    const Off e = off({}, 64, 48, 8.0, time_s, in_loop), late = off({}, 64, 48, 8.0, time_s, in_loop + 0.25);
    EXPECT_LE(e.height, 0.02) << time_s;
    EXPECT_LE(e.asked, 0.02) << time_s;
    EXPECT_LE(e.slope, 0.04) << time_s;
    EXPECT_LE(e.shear, 0.04) << time_s;
    EXPECT_LE(e.velocity, 0.03) << time_s;
    EXPECT_GT(late.height, 0.2);
    const Off fine = off({}, 64, 96, 16.0, time_s, in_loop);  // 16 texels a wave and twice the frames
    EXPECT_LE(fine.height, 0.006) << time_s;
    EXPECT_LE(fine.slope, 0.012) << time_s;
    EXPECT_LE(fine.velocity, 0.008) << time_s;
  }
  // Waves of four texels, the shortest that a recorder writes.
  const Off four = off({}, 64, 96, 4.0, 1.7, 1.7);
  EXPECT_LE(four.height, 0.06);
  EXPECT_LE(four.slope, 0.2);
}

// Scale, weight and speed: the same waves, larger and slower by the root; twice as high; twice as fast; backwards.
// Controls: each of them left at 1 in the truth is off by more than a quarter.
TEST(Baked, ScaleWeightAndSpeedAreAsSaid) {
  BakedSettings s;
  s.scale = 4.0;
  EXPECT_LE(off(s, 64, 48, 8.0, 5.0, 2.5).height, 0.02);
  EXPECT_LE(off(s, 64, 48, 8.0, 5.0, 2.5).velocity, 0.03);
  EXPECT_GT(off(s, 64, 48, 8.0, 5.0, 5.0).height, 0.25);
  s = {};
  s.weight = 2.0;
  EXPECT_LE(off(s, 64, 48, 8.0, 5.0, 5.0).slope, 0.04);
  s = {};
  s.speed = 2.0;
  EXPECT_LE(off(s, 64, 48, 8.0, 5.0, 10.0).velocity, 0.03);
  s.speed = -1.0;
  EXPECT_LE(off(s, 64, 48, 8.0, 5.0, 7.0).height, 0.02);
  EXPECT_LE(off(s, 64, 48, 8.0, 5.0, 7.0).velocity, 0.03);
  s.speed = 0.0;
  EXPECT_LE(off(s, 64, 48, 8.0, 5.0, 0.0).height, 0.02);
}

// Variance does not pulse with the frames: in the middle between two it is that of the frames within what
// kept_between_frames() says of the fastest wave. Straight lines between frames, the control, lose 1 - cos(w / 2) of a
// wave each time: here 6 % of variance.
TEST(Baked, VarianceDoesNotPulseWithTheFrames) {
  EXPECT_NEAR(1.0 - kept_between_frames(0.5), 7.3e-5, 1e-6);
  EXPECT_NEAR(1.0 - kept_between_frames(1.0), 0.0042, 2e-4);
  EXPECT_NEAR(1.0 - kept_between_frames(1.5), 0.039, 1e-3);
  const std::vector<truth::Trochoid> waves = waves_of_loop(8.0);
  double fastest = 0.0;
  for (const truth::Trochoid& w : waves) fastest = std::max(fastest, double(w.w) / 4.0);
  ASSERT_NEAR(fastest, 0.7, 0.3);
  const BakedLoop loop = loop_of(waves, 64, 48);
  const Baked source(loop, {});
  const auto variance = [&](double time_s) {
    const Tile tile(source, ticks_from_seconds(time_s));
    double sum = 0.0;
    for (int i = 0; i < 64 * 64; ++i) sum += tile.height(i % 64, i / 64) * tile.height(i % 64, i / 64) / 4096.0;
    return sum;
  };
  double worst = 0.0, straight = 0.0;
  for (int f = 0; f < 47; ++f) {
    const double before = variance(f / 4.0), after = variance((f + 1) / 4.0), between = variance((f + 0.5) / 4.0);
    worst = std::max(worst, std::abs(2.0 * between / (before + after) - 1.0));
    double sum = 0.0, ends = 0.0;
    const float *a = loop.texels.data() + std::size_t(f) * loop.frame_floats() + 4096, *b = a + loop.frame_floats();
    for (int i = 0; i < 4096; ++i) sum += std::pow(0.5 * (a[i] + b[i]), 2), ends += 0.5 * (a[i] * a[i] + b[i] * b[i]);
    straight = std::max(straight, std::abs(sum / ends - 1.0));
  }
  EXPECT_LE(worst, 2.0 * (1.0 - kept_between_frames(fastest)) + 2e-3);
  EXPECT_GT(straight, 0.03);
  RecordProperty("pulse", std::to_string(worst) + " of variance, straight lines " + std::to_string(straight));
}

// The sea's waves as they are recorded: frame N is frame 0, the water stands as the sum of its bins does with
// frequencies rounded to the loop, and these are off by no more than half of 2 pi / T. Control seen: loop_s left 0
// (frame N off by as much as the height).
TEST(LoopRecorder, RecordsAClosedLoopOfTheSeasWaves) {
  SeaState sea;
  sea.wind_speed_mps = 8.0;
  LoopRecorder recorder(sea, {24, 2.0, 64, 100.0});
  BakedLoop loop{64, 24, 2.0, 100.0, std::vector<float>(24 * 3 * 64 * 64)};
  for (int f = 0; f < 24; ++f)
    recorder.record(f, std::span(loop.texels).subspan(std::size_t(f) * loop.frame_floats(), loop.frame_floats()));
  std::vector<float> next(loop.frame_floats());
  recorder.record(24, next);
  double closed = 0.0, moved = 0.0, height = 0.0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    closed = std::max(closed, double(std::abs(next[i] - loop.texels[i])));
    moved = std::max(moved, double(std::abs(loop.texels[loop.frame_floats() + i] - loop.texels[i])));
  }
  for (int i = 0; i < 4096; ++i) height += std::pow(loop.texels[std::size_t(4096 + i)], 2) / 4096.0;
  EXPECT_LE(closed, 1e-6 * recorder.height_m());
  EXPECT_GT(moved, 0.1 * recorder.height_m()) << "a frame later";
  EXPECT_NEAR(4.0 * std::sqrt(height), recorder.height_m(), 0.35 * recorder.height_m()) << "one time of it";
  EXPECT_GT(recorder.frequency_error(), 0.005);
  EXPECT_LE(recorder.worst_frequency_error(),
            0.5 * 2.0 * pi / 12.0 / double(truth::trochoid_frequency(2.0 * pi / 100.0, 9.81L, 1e6L)) + 1e-6);
  LoopRecorder longer(sea, {240, 2.0, 64, 100.0});
  EXPECT_LE(longer.frequency_error(), 0.15 * recorder.frequency_error()) << "a loop ten times as long";
  // The water against a sum over the bins, taken from the frame itself: amplitudes of frame 0 by a plain Fourier sum,
  // turned by the rounded frequencies, give a later frame. Two waves a bin run opposite ways, so that displacement
  // along x and height tell them apart; heights of frames 0 and 3 s on are enough for a sum of both.
  const auto bin = [&](int frame, int mx, int mz) {
    std::complex<double> sum = 0.0;
    for (int z = 0; z < 64; ++z)
      for (int x = 0; x < 64; ++x)
        sum += double(loop.texels[std::size_t(frame) * loop.frame_floats() + std::size_t(4096 + z * 64 + x)]) *
               std::polar(1.0, -2.0 * pi * (mx * x + mz * z) / 64.0) / 4096.0;
    return sum;
  };
  for (const auto& [mx, mz] : {std::pair(2, -1), std::pair(3, 2), std::pair(1, -4), std::pair(9, 5)}) {
    const double k = 2.0 * pi / 100.0 * std::hypot(mx, mz), step = 2.0 * pi / 12.0;
    const double w = step * std::max(1.0, std::round(double(truth::trochoid_frequency(k, 9.81L, 1e6L)) / step));
    // h(t) = A exp(-i w t) + B exp(i w t): frames t - d, t, t + d obey h(t - d) + h(t + d) = 2 cos(w d) h(t).
    const std::complex<double> a = bin(3, mx, mz), b = bin(4, mx, mz), c = bin(5, mx, mz);
    EXPECT_LE(std::abs(a + c - 2.0 * std::cos(0.5 * w) * b), 1e-5 * recorder.height_m()) << mx << " " << mz;
    EXPECT_GT(std::abs(a + c - 2.0 * std::cos(0.5 * (w + step)) * b), 1e-5 * recorder.height_m())
        << "the control: the next frequency";
  }
}

TEST(Baked, AreTheSameForAnyNumberOfThreads) {
  const Baked source(loop_of(waves_of_loop(8.0), 64, 48), {});
  std::vector<Tile> tiles;
  tiles.reserve(2);
  for (const int threads : {1, 2}) {
    tbb::task_arena arena(threads);
    arena.execute([&] { tiles.emplace_back(source, ticks_from_seconds(4.2), true); });
  }
  for (std::size_t i = 0; i < tiles[0].texels.size(); ++i)
    EXPECT_EQ(std::memcmp(tiles[0].texels[i].data(), tiles[1].texels[i].data(),
                          tiles[0].texels[i].size() * sizeof(glm::vec4)),
              0);
}

// Statistics are those of what is played, and bounds hold it; slopes lost to a footprint become roughness. Not seen:
// moment_share_ left at 1, which these waves of eight texels and more hardly need.
TEST(Baked, StatisticsAreThoseOfTheLoop) {
  const std::vector<truth::Trochoid> waves = waves_of_loop(8.0);
  double variance = 0.0, slope = 0.0;
  for (const truth::Trochoid& w : waves)
    variance += 0.5 * w.a * w.a, slope += 0.5 * w.a * w.a * (w.kx * w.kx + w.kz * w.kz);
  const auto source = std::make_shared<Baked>(loop_of(waves, 64, 48), BakedSettings{});
  EXPECT_NEAR(source->statistics().height_variance / variance, 1.0, 0.01);
  EXPECT_NEAR((source->statistics().slope_moments.x + source->statistics().slope_moments.y) / slope, 1.0, 0.02);
  EXPECT_EQ(source->bytes(), 48u * 3u * 64u * 64u * 4u);
  EXPECT_NEAR(source->period_s(), 12.0, 1e-6);
  const WaveField field(flat(), {.resolution = 16, .cascades = 1}, {source});
  WaveTiles tiles;
  double highest = 0.0;
  for (const double time_s : {0.1, 3.4, 9.9}) {
    field.evaluate(ticks_from_seconds(time_s), tiles);
    for (int i = 0; i < 4000; ++i)
      highest = std::max(highest, std::abs(field.sea(tiles, {0.37 * i, 0.91 * i}, 0.0).displacement.y));
  }
  EXPECT_LE(highest, source->statistics().largest_height_m);
  EXPECT_GE(highest, 0.5 * source->statistics().largest_height_m);
  for (const double footprint : {0.0, 2.0, 6.0, 15.0, 40.0, 100.0}) {
    double sum = 0.0;
    std::mt19937 random(9);
    for (int i = 0; i < 4000; ++i) {
      const SeaSample sample =
          field.sea(tiles, {0.01 * double(random() % 100000), 0.01 * double(random() % 100000)}, footprint);
      sum +=
          (glm::dot(sample.height_gradient, sample.height_gradient) + sample.slope_moments.x + sample.slope_moments.y) /
          4000.0;
    }
    EXPECT_NEAR(sum / slope, 1.0, 0.08) << footprint;
  }
}

TEST(Baked, RefuseWhatIsOutOfRangeByName) {
  const auto refuse = [](auto change, const std::string& name) {
    BakedSettings s;
    change(s);
    EXPECT_NE(test::error_of([&] { validate(s); }).find(name), std::string::npos) << name;
  };
  refuse([](auto& s) { s.scale = 0.0; }, "baked.scale");
  refuse([](auto& s) { s.weight = -1.0; }, "baked.weight");
  refuse([](auto& s) { s.speed = std::nan(""); }, "baked.speed");
  refuse([](auto& s) { s.fade_m = -1.0; }, "baked.fade_m");
  const auto record = [](LoopRequest r, const std::string& name, double wind = 8.0) {
    SeaState sea;
    sea.wind_speed_mps = wind;
    EXPECT_NE(test::error_of([&] { LoopRecorder(sea, r); }).find(name), std::string::npos) << name;
  };
  record({7, 4.0, 64, 0.0}, "--frames");
  record({48, 0.0, 64, 0.0}, "--fps");
  record({48, 4.0, 96, 0.0}, "--size");
  record({48, 4.0, 64, -1.0}, "--tile");
  record({48, 4.0, 64, 0.0}, "neither wind waves nor swell", 0.0);
  SeaState sea;
  sea.wind_speed_mps = 8.0;
  EXPECT_GT(LoopRecorder(sea, {48, 4.0, 256, 0.0}).request().side_m,
            LoopRecorder(sea, {48, 4.0, 64, 0.0}).request().side_m);
  EXPECT_TRUE(Baked(BakedLoop{16, 8, 1.0, 10.0, std::vector<float>(8 * 3 * 256, 0.0f)}, {}).still());
}

}  // namespace
}  // namespace seascape
