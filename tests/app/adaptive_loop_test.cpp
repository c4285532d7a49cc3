// The loop that adaptive quality closes: it settles, stays, and is the same each time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/lab/adaptive_report.h"
#include "ocean/waves/split_mix.h"

namespace seascape {
namespace {

// A load that jumps by `factor` at frame 400, with lognormal noise.
LoadTrace jump(double fixed_share, int dead_frames, double factor, double noise, std::uint64_t seed,
               std::size_t frames = 900) {
  LoadTrace trace;
  trace.name = "jump";
  trace.fixed_share = fixed_share;
  trace.dead_frames = dead_frames;
  for (std::size_t t = 0; t < frames; ++t) {
    trace.mean.push_back((factor > 1.0) == (t >= 400) ? 0.62 * std::max(factor, 1.0 / factor) : 0.62);
    // Twelve shares make a normal number (Irwin 1927, Hall 1927).
    double normal = -6.0;
    for (std::uint64_t k = 0; k < 12; ++k) normal += share_of(split_mix(seed * 1000003 + t * 12 + k));
    trace.load.push_back(trace.mean.back() * std::exp(noise * normal));
  }
  trace.period_ms.assign(frames, load_unit_ms);
  trace.arrivals.assign(frames, {dead_frames + 1, false, 1.0});
  return trace;
}

Played played(const LoadTrace& trace, const OursOptions& options = {}) {
  const std::unique_ptr<AreaRule> rule = ours(options);
  return play(trace, *rule);
}

// After a jump of the load, up or down, quality is within a tenth of where it stays within 90 frames, whatever the dead
// time and the fixed share. Control seen: no steps told, and the slow gain alone.
TEST(AdaptiveLoop, SettlesWithin90FramesOfAStep) {
  int worst = 0;
  for (const double fixed : {0.0, 0.3, 0.6})
    for (const int dead : {1, 2, 4})
      for (const double factor : {1.45, 1.2, 1.0 / 1.45, 1.0 / 1.2})
        for (const std::uint64_t seed : {11u, 12u}) {
          const LoadTrace trace = jump(fixed, dead, factor, 0.03, seed);
          const int frames = frames_to_settle(trace, played(trace));
          // Cheap enough to be drawn at the ceiling throughout: nothing to settle.
          if (0.62 * std::max(factor, 1.0 / factor) * (fixed + (1.0 - fixed) * most_area) < 0.9) continue;
          EXPECT_LE(frames, 90) << fixed << " " << dead << " " << factor << " " << seed;
          EXPECT_GE(frames, 0);
          worst = std::max(worst, frames);
        }
  RecordProperty("frames", worst);
}

// A minute of steady load with 3 % noise: at most two reversals, and at most 6 misses of 1,000, after the first two
// seconds, in which the noise is not known yet. Controls seen: no dead band (hundreds of reversals); a margin of
// nothing (misses of one in 50).
TEST(AdaptiveLoop, StaysUnderSteadyLoad) {
  int most_reversals = 0;
  double most_misses = 0.0;
  for (const double fixed : {0.0, 0.15, 0.3, 0.45, 0.6})
    for (const std::uint64_t seed : {21u, 22u}) {
      const LoadTrace trace = jump(fixed, 2, 1.0, 0.03, seed, 5580);
      const Played all = played(trace);
      int reversals = 0, misses = 0;
      double direction = 0.0;
      for (std::size_t t = 180; t < trace.frames(); ++t) {
        misses += all.missed[t];
        const double change = all.area[t] - all.area[t - 1];
        if (change == 0.0) continue;
        reversals += change * direction < 0.0;
        direction = change;
      }
      EXPECT_LE(reversals, 2) << fixed << " " << seed;
      EXPECT_LE(1000.0 * misses / 5400.0, 6.0) << fixed << " " << seed;
      most_reversals = std::max(most_reversals, reversals);
      most_misses = std::max(most_misses, 1000.0 * misses / 5400.0);
    }
  std::printf("reversals a minute: %d at most; misses of 1,000: %.1f at most\n", most_reversals, most_misses);
}

// Without noise, levels come to rest for any fixed share and dead time, near the budget, and without missing: no limit
// cycle. Control seen: timings taken for those of the levels that are there now (OursOptions::pairs_levels), which
// swings for ever.
TEST(AdaptiveLoop, HasNoLimitCycle) {
  const auto moves = [](double fixed, int dead, const OursOptions& options) {
    const LoadTrace trace = jump(fixed, dead, 1.0, 0.0, 1);
    const Played all = played(trace, options);
    int count = 0;
    for (std::size_t t = 300; t < trace.frames(); ++t) count += all.area[t] != all.area[t - 1];
    return count;
  };
  int control = 0;
  for (int tenths = 0; tenths <= 6; ++tenths)
    for (const int dead : {1, 2, 3, 4}) {
      const double fixed = 0.1 * tenths;
      EXPECT_LE(moves(fixed, dead, {}), 1) << fixed << " " << dead;
      const LoadTrace trace = jump(fixed, dead, 1.0, 0.0, 1);
      const Played all = played(trace);
      for (std::size_t t = 300; t < trace.frames(); ++t) EXPECT_FALSE(all.missed[t]);
      if (all.area.back() < 0.999 * most_area) {
        EXPECT_GT(all.cost_ms.back(), 0.95 * load_unit_ms) << fixed << " " << dead;
      }
      OursOptions unpaired;
      unpaired.pairs_levels = false;
      control += moves(fixed, dead, unpaired);
    }
  EXPECT_GT(control, 100);
}

// A first guess of the variable share of half or twice the true one still settles within 90 frames of a step, and the
// share that it learns is nearer. Control seen: shares that are not learnt (share_error 0).
TEST(AdaptiveLoop, SettlesWithACostModelWrongBy2) {
  for (const double fixed : {0.3, 0.6}) {
    const double right = (1.0 - fixed) * most_area / (fixed + (1.0 - fixed) * most_area);
    for (const double guess : {0.5 * right, std::min(2.0 * right, 0.98)}) {
      for (const double factor : {1.45, 1.0 / 1.45}) {
        OursOptions options;
        options.first_share = guess;
        const LoadTrace trace = jump(fixed, 2, factor, 0.03, 31);
        const Played wrong = played(trace, options);
        EXPECT_LE(frames_to_settle(trace, wrong), 90) << fixed << " " << guess << " " << factor;
        options.first_share = right;
        EXPECT_GT(score_of(wrong), 0.93 * score_of(played(trace, options))) << fixed << " " << guess << " " << factor;
      }
      // Twice over: the first jump has taught it.
      AdaptiveQuality quality({picture_scale_lever(guess)});
      for (std::uint64_t t = 0; t < 400; ++t) {
        const double load = t % 100 < 50 ? 0.5 : 0.75;
        std::vector<FrameTiming> timings;
        if (t > 0) {
          FrameTiming one{.frame = t - 1, .levels = quality.last().levels};
          one.gpu_ms = (t - 1) % 100 < 50 ? 0.5 : 0.75;
          one.gpu_ms *= load_unit_ms * (fixed + (1.0 - fixed) * optimum_area(optimum_levels - 1 - one.levels[0]));
          timings.push_back(one);
        }
        (void)load;
        quality.decide({.frame = t, .period_ms = load_unit_ms, .timings = timings});
      }
      EXPECT_LT(std::abs(quality.gpu().share(0) - right), 0.4 * std::abs(guess - right)) << fixed << " " << guess;
    }
  }
}

// Control seen: a number that counts instances in the controller's band.
TEST(AdaptiveLoop, SameInputsGiveTheSameDecisions) {
  for (const LoadTrace& trace : made_traces(5, 1)) {
    if (trace.frames() > 10000) continue;
    const Played first = played(trace), second = played(trace);
    EXPECT_EQ(first.area, second.area) << trace.name;
    EXPECT_EQ(first.cost_ms, second.cost_ms) << trace.name;
  }
}

}  // namespace
}  // namespace seascape
