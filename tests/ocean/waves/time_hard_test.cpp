#include <gtest/gtest.h>

#include "ocean/waves/wave_field.h"
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
    for (int mz = -30; mz <= 30; ++mz)
      for (int mx = -30; mx <= 30; ++mx) {
        if ((mx == 0 && mz == 0) || mx * mx + mz * mz >= 1024) continue;
        const gpu::WaveBin& b = bins.bins[(std::size_t(c) * 64 + mz + 32) * 64 + mx + 32];
        const gpu::uint turns = gpu::phase_turns(b.turns_high, b.turns_low, gpu::uint(std::uint64_t(ticks) >> 32), gpu::uint(ticks));
        const long double k = turn / bins.ladder[c].side_m * std::sqrt((long double)(mx * mx + mz * mz));
        const long double w = std::sqrt(9.81 * k);
        const long double error = std::remainder(w * t - turns * turn / 4294967296.0L, turn);
        worst = std::max(worst, double(std::abs(error)));
      }
  EXPECT_LE(worst, 1e-4);
  EXPECT_GT(worst, 0);
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
