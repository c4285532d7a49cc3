#include <gtest/gtest.h>

#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"
#include "shaders/shared/phase.h"
#include "tests/support/truth.h"

namespace seascape {
namespace {

TEST(WaveTime, hard_13_time_1e7) {
  // The phase of every kept wave at 1e7 s against w t in long double, to 1e-4 rad. Control: turns kept to 48 of their
  // 64 bits miss by 0.2 rad.
  SeaState sea;
  const WaveBins bins = make_wave_bins(sea, {.resolution = 256, .cascades = 5});
  const double time_s = 1e7 + 0.123;
  const std::int64_t ticks = ticks_from_seconds(time_s);
  const long double t = (long double)ticks / 1048576.0L, turn = 2.0L * 3.14159265358979323846264338327950288L;
  double worst = 0;
  for (int c = 0; c < 5; ++c)
    for (int mz = -bins_of(c) / 2; mz < bins_of(c) / 2; ++mz)
      for (int mx = -bins_of(c) / 2; mx < bins_of(c) / 2; ++mx) {
        if ((mx == 0 && mz == 0) || mx * mx + mz * mz >= bins_of(c) * bins_of(c) / 4) continue;
        const gpu::WaveBin& b = bins.at(c, mx, mz);
        const gpu::uint turns =
            gpu::phase_turns(b.turns_high, b.turns_low, gpu::uint(std::uint64_t(ticks) >> 32), gpu::uint(ticks));
        const long double k = turn / bins.ladder[c].side_m * std::sqrt((long double)(mx * mx + mz * mz));
        const long double w = std::sqrt(9.81L * k + 7.17e-5L * k * k * k);
        const long double error = std::remainder(w * t - turns * turn / 4294967296.0L, turn);
        worst = std::max(worst, double(std::abs(error)));
      }
  EXPECT_LE(worst, 1e-4);
  EXPECT_GT(worst, 0);
}

TEST(WaveTime, hard_14_a_loop_repeats_to_the_bit) {
  // Every bin's phase after a loop is that of tick 0, and after a thousand loops within 1e-6 of a turn; every frequency
  // is moved by half a turn a loop at most. Loops of whole and of broken ticks, at every resolution. Control: turns
  // rounded down miss by 2^-32 of a turn after one loop, frequencies left as they are by all of it.
  for (const double loop_s : {20.0, 64.0, 60.0, 33.333, 1000.1, 0.3})
    for (const int resolution : {16, 32, 64, 128, 256, 512}) {
      SeaState sea, endless;
      sea.loop_s = loop_s;
      const WaveBins bins = make_wave_bins(sea, {.resolution = resolution, .cascades = 5});
      const WaveBins free = make_wave_bins(endless, {.resolution = resolution, .cascades = 5});
      const std::int64_t ticks = ticks_from_seconds(loop_s), many = 1000 * ticks;
      int waves = 0;
      for (std::size_t i = 0; i < bins.bins.size(); ++i) {
        const gpu::WaveBin &b = bins.bins[i], &f = free.bins[i];
        ASSERT_EQ(b.amplitude, f.amplitude);
        if (b.turns_high == 0 && b.turns_low == 0) continue;
        ++waves;
        const auto phase = [&](std::int64_t t) {
          return gpu::phase_turns(b.turns_high, b.turns_low, gpu::uint(std::uint64_t(t) >> 32), gpu::uint(t));
        };
        ASSERT_EQ(phase(ticks), 0u) << loop_s;
        ASSERT_LE(std::abs(double(std::int32_t(phase(many)))) * 0x1p-32, 1e-6) << loop_s;
        const auto a_loop = [&](const gpu::WaveBin& w) {
          return double((std::uint64_t(w.turns_high) << 32) | w.turns_low) * 0x1p-64 * double(ticks);
        };
        ASSERT_NEAR(a_loop(b), std::max(1.0, std::round(a_loop(f))), 1e-6) << loop_s;
      }
      EXPECT_GT(waves, 100);
    }
}

TEST(WaveTime, hard_14_frame_T_equals_frame_0) {
  // The sea 48 s later, of a loop of 48 s, is what it was to 1e-6 of its largest displacement, at every resolution.
  // Control: a loop of 47.99 s in the bins for the 48 s that is asked.
  for (const int resolution : {16, 32, 64, 128, 256, 512}) {
    SeaState sea;
    sea.loop_s = 48;
    const WaveField field(sea, {.resolution = resolution, .cascades = 3});
    WaveTiles first, last;
    field.evaluate(ticks_from_seconds(0.75), first);
    field.evaluate(ticks_from_seconds(48.75), last);
    double worst = 0, largest = 0;
    for (int c = 0; c < 3; ++c)
      for (int z = 0; z < first.samples(c); ++z)
        for (int x = 0; x < first.samples(c); ++x) {
          const glm::vec4 a = first.texels(c, WavePlane::shift, 0)[z * first.stride(c, 0) + x];
          const glm::vec4 b = last.texels(c, WavePlane::shift, 0)[z * last.stride(c, 0) + x];
          worst = std::max(worst, double(glm::length(a - b)));
          largest = std::max(largest, double(glm::length(a)));
        }
    EXPECT_LE(worst, 1e-6 * largest) << resolution;
    EXPECT_GT(largest, 0.1);
  }
}

TEST(WaveTime, hard_12_time_backwards) {
  // Ticks before zero are two's complement: phases at -t mirror those at t. Control: clamping time at 0 fails.
  const std::int64_t t = ticks_from_seconds(123.456), back = ticks_from_seconds(-123.456);
  EXPECT_EQ(back, -t);
  const gpu::uint a = gpu::phase_turns(0x1234u, 0x56789abcu, gpu::uint(std::uint64_t(t) >> 32), gpu::uint(t));
  const gpu::uint b = gpu::phase_turns(0x1234u, 0x56789abcu, gpu::uint(std::uint64_t(back) >> 32), gpu::uint(back));
  EXPECT_LE(gpu::uint(a + b + 1u), 1u);
}

}  // namespace
}  // namespace seascape
