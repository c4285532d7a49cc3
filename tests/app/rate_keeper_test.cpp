// Adaptive quality in a loop of frames: which timing belongs to which levels, and what comes of it.
#include "app/adaptive/rate_keeper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <random>

namespace seascape {
namespace {

constexpr double period_ms = 11.1;

// A loop of frames before a GPU that tells its times `late` frames afterwards.
struct Loop {
  RateKeeper keeper{live_levers({})};
  AdaptiveSettings settings;
  int late = 2;
  std::uint64_t number = 0;  // of the frame loop: it does not begin with the keeper
  struct Gone {
    std::uint64_t number;
    double ms;
  };
  std::deque<Gone> on_gpu;
  Gone told{0, 0.0};
  std::mt19937 random{7};
  double gpu_ms = 0.0;
  int deaf = 0;        // so many frames more the levers save nothing
  bool waits = false;  // the display for the GPU, with 1.5 ms of its own
  std::optional<double> wind_mps = 8.0;

  // Draws one frame whose variable part takes `pixels_ms` at the finest levels; true: in time.
  bool step(double pixels_ms, bool under_water = false, bool whole = false, double patches_ms = 0.0) {
    KnownOfFrames known;
    known.period_ms = period_ms;
    known.timed_frame = told.number;
    known.gpu_ms = told.ms;
    keeper.decide(known, settings);
    ++number;
    const DrawnQuality q = whole ? DrawnQuality{} : keeper.quality();
    if (deaf > 0) --deaf, pixels_ms /= q.scale * q.scale;
    gpu_ms = (1.5 + pixels_ms * q.scale * q.scale) * std::lognormal_distribution<>(0.0, 0.01)(random);
    const double cpu_ms = 2.0 + patches_ms * std::pow(q.mesh, -0.7);
    keeper.drawn({number, cpu_ms, waits ? gpu_ms + 1.5 : 0.1, under_water, whole, wind_mps});
    on_gpu.push_back({number, gpu_ms});
    if (int(on_gpu.size()) > late) {
      told = on_gpu.front();
      on_gpu.pop_front();
    }
    return gpu_ms + (waits ? cpu_ms + 1.5 : 0.0) <= period_ms;
  }
};

// A load that does not fit is lowered until it does, and given back when it goes. Control seen: timings told with the
// levels of the frame that is decided (that loop swings).
TEST(RateKeeper, HoldsTheRateAndGivesQualityBack) {
  for (const int late : {1, 2, 3, 4}) {
    Loop loop;
    loop.late = late;
    loop.number = 1000;
    for (int i = 0; i < 60; ++i) loop.step(6.0);
    EXPECT_EQ(loop.keeper.quality(), DrawnQuality{}) << "it fits";
    for (int i = 0; i < 60; ++i) loop.step(16.0);
    int missed = 0, reversals = 0;
    double before = loop.keeper.quality().scale, direction = 0.0;
    for (int i = 0; i < 600; ++i) {
      missed += !loop.step(16.0);
      const double moved = loop.keeper.quality().scale - before;
      reversals += moved * direction < 0.0;
      if (moved != 0.0) direction = moved;
      before = loop.keeper.quality().scale;
    }
    EXPECT_LE(missed, 4) << late;
    EXPECT_LE(reversals, 4) << late;
    EXPECT_GT(loop.gpu_ms, 0.85 * period_ms) << "no more is lowered than has to be";
    for (int i = 0; i < 60; ++i) loop.step(6.0);
    EXPECT_EQ(loop.keeper.quality(), DrawnQuality{}) << late;
  }
}

// Off, and where no rate is known, frames are drawn as the preset has them. Control seen: the quality of the levels
// that the controller keeps.
TEST(RateKeeper, LeavesFramesAloneWhereItIsOff) {
  Loop loop;
  for (int i = 0; i < 60; ++i) loop.step(30.0);
  EXPECT_LT(loop.keeper.quality().scale, 0.8);
  loop.settings.on = false;
  loop.step(30.0);
  EXPECT_EQ(loop.keeper.quality(), DrawnQuality{});
  EXPECT_EQ(loop.keeper.last().reason, DecisionReason::off);
  RateKeeper keeper(live_levers({}));
  for (std::uint64_t i = 1; i < 40; ++i) {
    keeper.decide({.timed_frame = i - 1, .gpu_ms = 50.0}, {});
    keeper.drawn({.number = i, .cpu_ms = 50.0, .end_ms = 0.1});
  }
  EXPECT_EQ(keeper.quality(), DrawnQuality{}) << "no period, no target";
  double gpu_ms = 50.0;
  for (std::uint64_t i = 40; i < 80; ++i) {
    AdaptiveSettings asked;
    asked.target_hz = 60.0;
    keeper.decide({.timed_frame = i - 1, .gpu_ms = gpu_ms}, asked);
    gpu_ms = 5.0 + 45.0 * keeper.quality().scale * keeper.quality().scale;
    keeper.drawn({.number = i, .cpu_ms = 1.0, .end_ms = 0.1});
  }
  EXPECT_LT(keeper.quality().scale, 0.8) << "a target is a rate";
}

// Frames drawn whole, for screenshots, are no jump of the load. Control seen: it told with the levels decided.
TEST(RateKeeper, WholeFramesAreNoJump) {
  Loop loop;
  for (int i = 0; i < 120; ++i) loop.step(20.0);
  const DrawnQuality held = loop.keeper.quality();
  EXPECT_LT(held.scale, 0.8);
  for (int i = 0; i < 33; ++i) {
    loop.step(20.0, false, i < 3);
    EXPECT_NEAR(loop.keeper.quality().scale, held.scale, 0.06) << i;
  }
}

// Going under is dearer by 1.6: the first time it is met as a jump, from then on it is foreseen with the frame that
// goes under, and fewer frames are late. Control seen: nothing remembered.
TEST(RateKeeper, ForeseesTheWater) {
  Loop loop;
  for (int i = 0; i < 120; ++i) loop.step(8.0);
  std::vector<int> late;
  for (int dive = 0; dive < 6; ++dive) {
    int missed = 0;
    for (int i = 0; i < 90; ++i) missed += !loop.step(14.0, true);
    for (int i = 0; i < 90; ++i) missed += !loop.step(8.0);
    late.push_back(missed);
  }
  EXPECT_GE(late.front(), 4);
  for (std::size_t i = 1; i < late.size(); ++i) EXPECT_LT(late[i], late.front()) << i;
}

// A storm that is there at once is dearer by 1.6, and foreseen from the second time on, in the same strength alone.
// Where it comes wave by wave its load comes by degrees: nothing is foreseen then, and what its calm cost is remembered
// from before. Controls seen: one load for all seas; a change's end taken for a jump.
TEST(RateKeeper, ForeseesAStormThatIsThereAtOnce) {
  Loop loop;
  // Late frames of the first five.
  const auto blow = [](Loop& in, double wind_mps, double pixels_ms) {
    in.wind_mps = wind_mps;
    int missed = 0;
    for (int i = 0; i < 90; ++i) {
      const bool late = !in.step(pixels_ms);
      if (i < 5) missed += late;
    }
    return missed;
  };
  blow(loop, 8.0, 8.0);
  EXPECT_GE(blow(loop, 20.0, 14.0), 3);
  for (int again = 0; again < 4; ++again) {
    blow(loop, 8.0, 8.0);
    EXPECT_EQ(blow(loop, 20.0, 14.0), 1) << "its first frame alone";
  }
  blow(loop, 8.0, 8.0);
  EXPECT_GE(blow(loop, 26.0, 14.0), 3) << "no such storm was met";

  Loop slow;
  const auto foreseen = [&](double wind_mps, double from_ms, double to_ms) {
    int told = 0;
    slow.wind_mps.reset();
    for (int i = 0; i <= 360; ++i) {
      if (i == 360) slow.wind_mps = wind_mps;
      slow.step(std::lerp(from_ms, to_ms, i / 360.0));
      told += slow.keeper.last().reason == DecisionReason::foreseen_change;
    }
    for (int i = 0; i < 90; ++i) {
      slow.step(to_ms);
      told += slow.keeper.last().reason == DecisionReason::foreseen_change;
    }
    return told;
  };
  for (int i = 0; i < 120; ++i) slow.step(8.0);
  for (int again = 0; again < 3; ++again) {
    EXPECT_EQ(foreseen(20.0, 8.0, 14.0), 0) << again;
    EXPECT_EQ(foreseen(8.0, 14.0, 8.0), 0) << again;
  }
  EXPECT_EQ(blow(slow, 20.0, 14.0), 1) << "known from when it came by degrees";
}

// What the processor makes late does not lower the picture's scale. Control seen: the picture's lever with a share of
// the processor's time.
TEST(RateKeeper, TheProcessorsTimeLeavesThePicture) {
  Loop loop;
  for (int i = 0; i < 120; ++i) loop.step(4.0, false, false, 9.6);
  EXPECT_EQ(loop.keeper.quality().scale, 1.0);
  EXPECT_GT(loop.keeper.quality().mesh, 1.0);
  // Where lowering does not help, nothing is lowered, and the reason says so.
  Loop fixed;
  for (int i = 0; i < 120; ++i) fixed.step(4.0, false, false, 40.0);
  EXPECT_EQ(fixed.keeper.quality().scale, 1.0);
  EXPECT_TRUE(fixed.keeper.last().reason == DecisionReason::late_anyway ||
              fixed.keeper.last().reason == DecisionReason::at_floor)
      << name_of(fixed.keeper.last().reason);
}

// Levers that seemed not to help, because the load rose as they were lowered, are tried again; where they never help,
// they are left alone nearly all the time. Control seen: what was learnt is never forgotten.
TEST(RateKeeper, TriesAgainWhatSeemedInVain) {
  Loop loop;
  for (int i = 0; i < 120; ++i) loop.step(8.0);
  loop.deaf = 40;
  for (int i = 0; i < 130; ++i) loop.step(16.0);
  int missed = 0;
  for (int i = 0; i < 60; ++i) missed += !loop.step(16.0);
  EXPECT_LE(missed, 4);
  Loop fixed;
  double quality = 0.0;
  constexpr int frames = 3000;
  for (int i = 0; i < frames; ++i) {
    fixed.deaf = 2;
    fixed.step(16.0);
    quality += fixed.keeper.quality().scale / frames;
  }
  EXPECT_GT(quality, 0.9);
}

// Before a display that waits for the GPU, as a software driver's window does, nothing overlaps: the GPU has what the
// rest leaves of the period. Control seen: the whole period.
TEST(RateKeeper, ADisplayThatWaitsLeavesTheGpuLess) {
  Loop loop;
  loop.waits = true;
  for (int i = 0; i < 120; ++i) loop.step(16.0);
  int missed = 0;
  for (int i = 0; i < 300; ++i) missed += !loop.step(16.0);
  EXPECT_LE(missed, 6);
  EXPECT_GT(loop.gpu_ms + 3.5, 0.85 * period_ms);
}

// The same frames give the same decisions, bit for bit, and one line says what was done.
TEST(RateKeeper, IsTheSameEachTimeAndSaysWhy) {
  const auto run = [] {
    Loop loop;
    std::string all;
    for (int i = 0; i < 300; ++i) {
      loop.step(6.0 + 10.0 * (i / 50 % 2), i / 90 % 2 == 1);
      all += loop.keeper.text() + "\n";
    }
    return all;
  };
  const std::string text = run();
  EXPECT_EQ(run(), text);
  EXPECT_NE(text.find("the load jumped"), std::string::npos);
  EXPECT_NE(text.find("headroom"), std::string::npos);
  EXPECT_NE(text.find(" of 11.1 ms"), std::string::npos);
}

}  // namespace
}  // namespace seascape
