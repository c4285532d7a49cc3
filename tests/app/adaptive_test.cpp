// Adaptive quality, case by case: levers and their order, timings of every kind, known jumps, settings, reasons.
#include "app/adaptive/adaptive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <vector>

#include "ocean/waves/split_mix.h"

namespace seascape {
namespace {

constexpr double period = 10.0;  // ms
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Lever scale_lever(double share = 0.8) {
  Lever lever;
  lever.name = "scale";
  lever.gpu_share = share;
  for (int i = 0; i <= 20; ++i) lever.steps.push_back({1.0 - 0.025 * i, std::pow(1.0 - 0.025 * i, 2), 0.05 * i});
  return lever;
}
Lever mesh_lever() {  // lowers both; cheap for the eye
  return {"mesh", {{1, 1.0, 0.0}, {2, 0.6, 0.02}, {4, 0.4, 0.08}}, 0.1, 0.5};
}
Lever spray_lever() { return {"spray", {{8, 1.0, 0.0}, {4, 0.5, 0.03}, {2, 0.25, 0.1}}, 0.0, 0.2}; }

// A program that draws: its cost follows the levels, and timings reach the controller after a dead time.
struct Rig {
  explicit Rig(std::vector<Lever> levers, const AdaptiveSettings& settings = {}, const AdaptiveTuning& tuning = {})
      : quality(std::move(levers), settings, tuning) {}

  double cost(CostOf of, const LeverLevels& levels) const {
    double product = of == CostOf::gpu ? gpu_ms : cpu_ms;
    for (std::size_t i = 0; i < quality.levers().size(); ++i) {
      const Lever& lever = quality.levers()[i];
      product *= 1.0 - lever.share(of) + lever.share(of) * lever.steps[levels[i]].work;
    }
    return product;
  }
  const Decision& frame(std::vector<ForeseenChange> foreseen = {}) {
    std::vector<FrameTiming> arrived;
    while (!in_flight.empty() && in_flight.front().frame + dead <= now) {
      if (timings_arrive) arrived.push_back(in_flight.front());
      in_flight.pop_front();
    }
    for (FrameTiming& one : arrived)
      if (spoil) spoil(one);
    if (shuffle) std::reverse(arrived.begin(), arrived.end());
    const Decision& decision = quality.decide({.frame = now,
                                               .period_ms = period_ms,
                                               .deadline_ms = deadline_ms,
                                               .interval_ms = interval_ms,
                                               .focused = focused,
                                               .loading = loading,
                                               .timings = arrived,
                                               .foreseen = foreseen});
    const double noise = 1.0 + 0.01 * (share_of(split_mix(now + 1)) - 0.5);
    last_gpu_ms = noise * cost(CostOf::gpu, decision.levels);
    last_cpu_ms = noise * cost(CostOf::cpu, decision.levels);
    misses += last_gpu_ms > period_ms || last_cpu_ms > period_ms;
    in_flight.push_back({now, last_gpu_ms, last_cpu_ms, decision.levels});
    ++now;
    return decision;
  }
  void frames(int n) {
    for (int i = 0; i < n; ++i) frame();
  }
  const LeverLevels& levels() const { return quality.last().levels; }

  AdaptiveQuality quality;
  double gpu_ms = 8.0, cpu_ms = 3.0;  // at the finest levels
  double period_ms = period, deadline_ms = 0.0, interval_ms = 0.0;
  bool focused = true, loading = false, timings_arrive = true, shuffle = false;
  std::function<void(FrameTiming&)> spoil;
  std::uint64_t now = 0, dead = 3;
  double last_gpu_ms = 0.0, last_cpu_ms = 0.0;
  int misses = 0;
  std::deque<FrameTiming> in_flight;
};

// Each rung is the step that costs the eye least for the logarithm of time it saves; levers that rebuild, or do not
// change that time, are in no ladder. Control seen: the least error alone, whatever it saves.
TEST(AdaptiveQuality, LadderTakesWhatCostsTheEyeLeast) {
  const std::vector<Lever> levers{scale_lever(),
                                  mesh_lever(),
                                  spray_lever(),
                                  {"filter", {{16, 1.0, 0.0}, {8, 0.99, 0.005}}, 0.05, 0.0},  // little, for little
                                  {"msaa", {{4, 1, 0}, {1, 0.5, 0.01}}, 0.4, 0.0, LeverMoves::at_loading}};
  for (const CostOf of : {CostOf::gpu, CostOf::cpu}) {
    const std::vector<Rung> ladder = make_ladder(levers, of);
    EXPECT_EQ(ladder.size(), of == CostOf::gpu ? 23u : 4u);
    LeverLevels at{};
    double error = 0.0;
    for (const Rung& rung : ladder) {
      const auto price = [&](std::size_t i) {
        const LeverStep &a = levers[i].steps[at[i]], &b = levers[i].steps[at[i] + 1u];
        const double s = levers[i].share(of);
        return (b.error - a.error) / (std::log(1 - s + s * a.work) - std::log(1 - s + s * b.work));
      };
      EXPECT_EQ(rung.level, at[rung.lever] + 1);
      for (std::size_t i = 0; i < 4; ++i)
        if (levers[i].share(of) > 0.0 && at[i] + 1u < levers[i].steps.size()) {
          EXPECT_LE(price(rung.lever), price(i) * (1.0 + 1e-12));
        }
      ++at[rung.lever];
      EXPECT_GT(rung.error, error);
      error = rung.error;
      EXPECT_NEAR(error, error_of(levers, at), 1e-12);
    }
  }
}

// What is taken last is given back first. Control seen: rungs given back from the first.
TEST(AdaptiveQuality, GivesBackInTheSameOrder) {
  Rig rig({scale_lever(), mesh_lever()});
  rig.gpu_ms = 11.0;
  std::vector<LeverLevels> down, up;
  for (int i = 0; i < 600; ++i) {  // the load grows, then falls
    rig.gpu_ms = 9.0 + 5.0 * (1.0 - std::abs(i - 300) / 300.0);
    if (rig.frame().moved()) (i < 310 ? down : up).push_back(rig.levels());
  }
  ASSERT_GT(down.size(), 5u);
  ASSERT_GT(up.size(), 5u);
  const std::vector<Rung> ladder = make_ladder(rig.quality.levers(), CostOf::gpu);
  const auto on_the_ladder = [&](const LeverLevels& levels) {
    LeverLevels at{};
    for (std::size_t r = 0; r <= ladder.size(); ++r) {
      if (at == levels) return true;
      if (r < ladder.size()) at[ladder[r].lever] = ladder[r].level;
    }
    return false;
  };
  for (const LeverLevels& levels : down) EXPECT_TRUE(on_the_ladder(levels));
  for (const LeverLevels& levels : up) EXPECT_TRUE(on_the_ladder(levels));
  rig.gpu_ms = 5.0;
  rig.frames(60);
  EXPECT_EQ(rig.levels(), LeverLevels{});
}

// A frame that the processor makes late lowers what the processor does, and leaves the picture's scale. Control seen:
// one time, the greater of both.
TEST(AdaptiveQuality, CpuBoundFramesKeepTheScale) {
  Rig rig({scale_lever(), mesh_lever(), spray_lever()});
  rig.gpu_ms = 6.0, rig.cpu_ms = 14.0;
  for (int i = 0; i < 120; ++i) EXPECT_EQ(rig.frame().levels[0], 0) << i;
  EXPECT_GT(rig.levels()[1], 0);
  EXPECT_LT(rig.last_cpu_ms, period);
  // And the other way round.
  Rig other({scale_lever(), mesh_lever(), spray_lever()});
  other.gpu_ms = 14.0;
  other.frames(120);
  EXPECT_GT(other.levels()[0], 0);
  EXPECT_EQ(other.levels()[2], 0);
  EXPECT_LT(other.last_gpu_ms, period);
}

// Zero, negative, infinite and undefined times, times in any order and twice, change nothing but what is lost with
// them. Controls seen: zero taken as a time; older timings taken after newer ones.
TEST(AdaptiveQuality, BadTimingsAreLeftOut) {
  const auto levels_with = [](std::function<void(FrameTiming&)> spoil, bool shuffle) {
    Rig rig({scale_lever()});
    rig.gpu_ms = 13.0;
    rig.dead = 4;
    rig.spoil = std::move(spoil);
    rig.shuffle = shuffle;
    rig.frames(300);
    EXPECT_LT(rig.last_gpu_ms, period);
    EXPECT_GT(rig.last_gpu_ms, 0.93 * period);
    return rig.levels();
  };
  const LeverLevels whole = levels_with({}, false);
  for (const double bad : {0.0, -5.0, nan, std::numeric_limits<double>::infinity()}) {
    const auto every_third = [bad](FrameTiming& one) {
      if (one.frame % 3 == 0) one.gpu_ms = bad;
    };
    EXPECT_NEAR(levels_with(every_third, true)[0], whole[0], 1) << bad;
  }
  CostEstimator estimator(std::vector<Lever>{}, CostOf::gpu);
  EXPECT_EQ(estimator.add(10, 5.0, 1.0, {}), TimingUse::taken);
  EXPECT_EQ(estimator.add(12, 5.0, 1.0, {}), TimingUse::taken);
  for (const std::uint64_t old : {11u, 12u}) EXPECT_EQ(estimator.add(old, 9.0, 1.0, {}), TimingUse::unusable);
  EXPECT_EQ(estimator.add(13, 0.0, 1.0, {}), TimingUse::unusable);
  EXPECT_EQ(estimator.add(13, nan, 1.0, {}), TimingUse::unusable);
  EXPECT_NEAR(std::exp(estimator.log_load(13)), 5.0, 1e-9);
}

// Intervals between frames are whole periods, in which headroom cannot be seen. With GPU times they decide nothing;
// without any they lower levels while frames are late, and never raise them. Controls seen: intervals taken as busy
// time; a raise while blind.
TEST(AdaptiveQuality, IntervalsAreNotBusyTime) {
  Rig told({scale_lever()});
  told.gpu_ms = 9.0;
  told.interval_ms = period;  // as is each frame's that is in time
  told.frames(200);
  EXPECT_EQ(told.levels()[0], 0);

  Rig blind({scale_lever()});
  blind.timings_arrive = false;
  blind.interval_ms = period;
  blind.frames(200);
  EXPECT_EQ(blind.levels()[0], 0);
  EXPECT_EQ(blind.quality.last().reason, DecisionReason::no_timings);
  bool lowered = false;
  for (int i = 0; i < 300; ++i) {
    blind.interval_ms = blind.now % 3 == 0 ? 2.0 * period : period;
    lowered = blind.frame().reason == DecisionReason::intervals || lowered;
  }
  EXPECT_TRUE(lowered);
  const int low = blind.levels()[0];
  EXPECT_GT(low, 0);
  blind.interval_ms = period;
  blind.frames(300);
  EXPECT_EQ(blind.levels()[0], low);
}

// A single slow frame moves nothing for longer than it takes to see the next; a second one is a step. What spikes have
// been teaches: after several, one slow frame moves nothing at all. Controls seen: outliers taken into the load; each
// single one taken for a step.
TEST(AdaptiveQuality, SpikesAreNotSteps) {
  Rig rig({scale_lever()});
  rig.gpu_ms = 9.0;
  rig.frames(100);
  int moves = 0;
  const auto spike = [&] {
    moves = 0;
    for (int i = 0; i < 40; ++i) {
      rig.gpu_ms = i == 3 ? 20.0 : 9.0;
      moves += rig.frame().moved();
    }
    EXPECT_EQ(rig.levels()[0], 0);
  };
  for (int n = 0; n < 8; ++n) spike();
  EXPECT_EQ(moves, 0) << "the eighth";
  rig.gpu_ms = 14.0;
  for (int i = 0; i < 20 && rig.quality.last().reason != DecisionReason::load_step; ++i) rig.frame();
  EXPECT_EQ(rig.quality.last().reason, DecisionReason::load_step);
  rig.frames(20);
  EXPECT_LT(rig.last_gpu_ms, period);
}

// A jump that is told ahead costs no frame, on its very frame, and is not taken twice when it is measured. Control
// seen: nothing told (frames are missed); a change applied at once.
TEST(AdaptiveQuality, KnownJumpsAreForeseen) {
  const auto run = [](bool tell, double ratio) {
    Rig rig({scale_lever()});
    rig.gpu_ms = 9.0;
    rig.frames(100);
    rig.misses = 0;
    const ForeseenChange change{ForeseenKind::going_under, rig.now + 10, ratio, 1.0};
    for (int i = 0; i < 100; ++i) {
      rig.gpu_ms = i < 10 ? 9.0 : 9.0 * 1.4;
      const Decision& decision = rig.frame(tell && i == 0 ? std::vector{change} : std::vector<ForeseenChange>{});
      EXPECT_TRUE(i >= 10 || decision.levels[0] == 0) << i;
      EXPECT_TRUE(!tell || i != 10 || decision.reason == DecisionReason::foreseen_change);
    }
    EXPECT_GT(rig.last_gpu_ms, 0.9 * period);
    return rig.misses;
  };
  EXPECT_EQ(run(true, 1.4), 0);
  EXPECT_EQ(run(true, 1.5), 0);  // the guess may be off
  EXPECT_GT(run(false, 1.4), 2);
}

// Another refresh rate is taken at its first frame: loads are held in ms, not in periods. Control seen: the budget of
// the first frame kept.
TEST(AdaptiveQuality, RefreshRatesChangeAtOnce) {
  Rig rig({scale_lever()});
  rig.gpu_ms = 9.0;
  rig.frames(100);
  rig.misses = 0;
  rig.period_ms = 7.5;
  EXPECT_EQ(rig.frame().reason, DecisionReason::refresh_changed);
  rig.frames(60);
  EXPECT_EQ(rig.misses, 0);
  EXPECT_GT(rig.last_gpu_ms, 0.9 * 7.5);
  rig.period_ms = period;
  rig.frames(30);
  EXPECT_EQ(rig.levels()[0], 0);
}

// Without focus levels stay, and what is measured then is not believed. Control seen: timings of that time taken in.
TEST(AdaptiveQuality, LostFocusHoldsTheLevels) {
  Rig rig({scale_lever()});
  rig.gpu_ms = 12.0;
  rig.frames(150);
  const LeverLevels before = rig.levels();
  rig.focused = false;
  rig.gpu_ms = 60.0;
  for (int i = 0; i < 200; ++i) EXPECT_EQ(rig.frame().reason, DecisionReason::unfocused);
  EXPECT_EQ(rig.levels(), before);
  rig.gpu_ms = 12.0;
  rig.in_flight.clear();
  rig.focused = true;
  rig.frames(5);
  EXPECT_NEAR(rig.levels()[0], before[0], 2);
  rig.frames(60);
  EXPECT_NEAR(rig.levels()[0], before[0], 1);
}

// Off, bounds, another rate and a shorter deadline. Controls seen: each left out.
TEST(AdaptiveQuality, SettingsAreKept) {
  AdaptiveSettings off;
  off.on = false;
  Rig held({scale_lever()}, off);
  held.gpu_ms = 40.0;
  held.frames(100);
  EXPECT_EQ(held.levels(), LeverLevels{});
  EXPECT_EQ(held.quality.last().reason, DecisionReason::off);

  Rig bounded({scale_lever()}, {.floor = 0.5, .ceiling = 0.8});
  bounded.gpu_ms = 40.0;
  bounded.frames(100);
  EXPECT_EQ(bounded.levels()[0], 10);
  EXPECT_EQ(bounded.quality.last().reason, DecisionReason::at_floor);
  bounded.gpu_ms = 2.0;
  bounded.frames(100);
  EXPECT_EQ(bounded.levels()[0], 4);
  EXPECT_NEAR(bounded.quality.last().quality, 0.8, 1e-9);

  Rig half({scale_lever()}, {.target_hz = 50.0});  // of a display of 100 Hz
  half.gpu_ms = 25.0;
  half.frames(150);
  EXPECT_LT(half.last_gpu_ms, 2.0 * period);
  EXPECT_GT(half.last_gpu_ms, 1.85 * period);

  Rig early({scale_lever()});
  early.deadline_ms = 8.0;
  early.gpu_ms = 12.0;
  early.frames(150);
  EXPECT_LT(early.last_gpu_ms, 8.0);
  EXPECT_GT(early.last_gpu_ms, 7.3);
}

// Levers that rebuild move only while a scene loads: down where the others would have to fall far, up again where there
// is room. Control seen: the lever in the ladder.
TEST(AdaptiveQuality, RebuildingLeversMoveAtLoading) {
  Lever samples{"msaa", {{4, 1.0, 0.0}, {2, 0.6, 0.1}, {1, 0.4, 0.25}}, 0.5, 0.0, LeverMoves::at_loading};
  Rig rig({scale_lever(), samples});
  rig.gpu_ms = 26.0;
  for (int i = 0; i < 200; ++i) EXPECT_EQ(rig.frame().levels[1], 0);
  rig.loading = true;
  EXPECT_EQ(rig.frame().reason, DecisionReason::at_loading);
  rig.loading = false;
  EXPECT_GT(rig.levels()[1], 0);
  const int loaded = rig.levels()[1];
  for (int i = 0; i < 100; ++i) EXPECT_EQ(rig.frame().levels[1], loaded);
  rig.gpu_ms = 5.0;
  rig.frames(100);
  rig.loading = true;
  rig.frame();
  EXPECT_EQ(rig.levels()[1], 0);
}

// For another scene the same is asked without moving: one that takes longer wants them lowered, a lighter one gives
// them back. Control seen: the ratio left out of the budget.
TEST(AdaptiveQuality, AnotherScenesLeversAreToldAhead) {
  Lever samples{"msaa", {{4, 1.0, 0.0}, {2, 0.6, 0.1}, {1, 0.4, 0.25}}, 0.5, 0.0, LeverMoves::at_loading};
  Rig rig({scale_lever(), samples});
  rig.gpu_ms = 9.0;
  EXPECT_EQ(rig.quality.best_for_scene(3.0, 1.0)[1], 0) << "nothing is known";
  rig.frames(100);
  const LeverLevels before = rig.levels();
  EXPECT_EQ(rig.quality.best_for_scene(1.0, 1.0)[1], 0);
  EXPECT_GT(rig.quality.best_for_scene(3.0, 1.0)[1], 0);
  EXPECT_EQ(rig.quality.best_for_scene(0.2, 1.0)[1], 0);
  rig.frames(20);
  EXPECT_EQ(rig.levels(), before) << "nothing has moved";
}

// A clock that is told makes work of time: a slow clock is not a heavy load. The same frame at half the clock, and the
// forecast for the clock that is there. Control seen: the clock left out.
TEST(AdaptiveQuality, ClocksAreTold) {
  Rig rig({scale_lever()});
  rig.gpu_ms = 8.0;
  double clock = 1.0;
  rig.spoil = [&](FrameTiming& one) { one.gpu_ms /= clock, one.gpu_clock = clock; };
  rig.frames(100);
  const double load = rig.quality.gpu().log_load(rig.now);
  clock = 0.5;
  rig.frames(100);
  EXPECT_NEAR(rig.quality.gpu().log_load(rig.now), load, 0.02);
  EXPECT_GT(rig.levels()[0], 0) << "8 ms of work take 16 now";
}

// The line of a decision says why, with figures and moves. Control seen: moves from and to the same levels.
TEST(AdaptiveQuality, DecisionsHaveTheirReasons) {
  Rig rig({scale_lever()});
  rig.gpu_ms = 9.0;
  rig.frames(60);
  rig.gpu_ms = 13.0;
  while (!rig.frame().moved()) ASSERT_LT(rig.now, 100u);
  const std::string text = decision_text(rig.quality.last(), rig.quality.levers());
  EXPECT_NE(text.find("GPU"), std::string::npos) << text;
  EXPECT_NE(text.find("of 10.00 ms"), std::string::npos) << text;
  EXPECT_NE(text.find("scale 1 to 0."), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
  for (int reason = 0; reason <= int(DecisionReason::at_loading); ++reason)
    EXPECT_NE(name_of(DecisionReason(reason)), "unknown");
}

}  // namespace
}  // namespace seascape
