// The sea's time by a clock.
#include "app/sea_time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ocean/waves/wave_field.h"

namespace seascape {
namespace {

TEST(SeaTime, FollowsStartScaleAndOffset) {
  Settings s;
  EXPECT_EQ(sea_time_s(s, 12.5), 12.5);
  s.time_start_s = 100.0;
  s.time_scale = -2.0;
  EXPECT_EQ(sea_time_s(s, 12.5), 75.0);
  s.time_offset_s = 10.0;
  EXPECT_EQ(sea_time_s(s, 12.5), 55.0);
  s.time_scale = 0.0;
  EXPECT_EQ(sea_time_s(s, 1e7), 100.0);
}

// Two clocks of which one says so much more are one clock: to the tick for offsets that a server's may have, frame
// after frame. Control: an offset of a float's precision.
TEST(SeaTime, AnOffsetOfAYearIsExactToATick) {
  Settings near, far;
  far.time_offset_s = 1e7;
  std::int64_t single = 0;
  for (int frame = 0; frame < 5000; frame += 7) {
    const double clock_s = frame / 90.0;
    const std::int64_t exact = std::llround(static_cast<long double>(frame) / 90.0L * gpu::ticks_per_second) +
                               10'000'000LL * gpu::ticks_per_second;
    EXPECT_LE(std::abs(ticks_from_seconds(sea_time_s(far, clock_s)) - exact), 1);
    EXPECT_EQ(sea_time_s(near, clock_s + 1e7), sea_time_s(far, clock_s));
    single = std::max(single, std::abs(ticks_from_seconds(double(float(sea_time_s(far, clock_s)))) - exact));
  }
  EXPECT_GT(single, 100'000) << "the control";
}

// The sea's time goes on by a frame's with every frame that a capture draws, and is the path's own from its first on.
// Control seen: a warm-up along the path's first frames, after which time went back.
TEST(CaptureMoments, TimeNeverGoesBack) {
  for (const int warmup : {0, 1, 7}) {
    for (int i = 0; i < warmup + 5; ++i) {
      const CaptureMoment now = capture_moment(i, warmup, 20.0);
      EXPECT_EQ(now.number, i - warmup);
      EXPECT_EQ(now.path_time_s, (i - warmup) / 20.0);
      const double sea_s = std::max(now.path_time_s, 0.0) + now.before_s;  // a path stands at its first key before it
      EXPECT_EQ(sea_s, (i - warmup) / 20.0);
    }
  }
}

}  // namespace
}  // namespace seascape
