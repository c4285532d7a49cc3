// Comfort in motion without a picture. Controls are named beside each test; each was seen to fail.
#include "app/comfort.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <random>

#include "app/camera_path.h"
#include "app/settings.h"

namespace seascape {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

Pose deck(double height_m, const ViewAngles& angles = {}) {
  return {{3.0, height_m, -4.0}, orientation_from_angles(angles)};
}

ComfortMotion going(double mps, double deg_per_s = 0.0) { return {{0.6 * mps, 0.0, -0.8 * mps}, deg_per_s, {}}; }

// What settles only after a while has settled.
ComfortShown settled(const ComfortSettings& settings, const ComfortMotion& motion) {
  Comfort comfort;
  comfort.step(settings, motion, 1e4);
  return comfort.shown();
}

// The camera's deck when the carrier lies still like this.
Pose taken(const ComfortSettings& settings, const Pose& carrier) {
  Comfort comfort;
  comfort.step(settings, {{}, 0.0, carrier}, 0.01);
  return comfort.carrier().value();
}

double apart_deg(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat d = glm::conjugate(a) * b;
  return glm::degrees(2.0 * std::atan2(glm::length(glm::dvec3(d.x, d.y, d.z)), std::abs(d.w)));
}

// Speeds that change every 50 ms and heights that run evenly meanwhile, cut into more or fewer frames. Controls: the
// vignette by closed += (wanted - closed) dt / vignette_s, and a height that is taken as still since the last frame.
TEST(Comfort, DoesNotDependOnTheFrameRate) {
  struct End {
    double clear_deg, deck_m, ridden_m, turned_deg;
  };
  const auto end = [](int frames) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> of(-1.0, 1.0);
    const ComfortSettings settings{.snap_turn_deg = 0};
    Comfort comfort;
    End e{};
    double before_m = 0.0;
    comfort.step(settings, {{}, 0.0, deck(0.0)}, 0.0);
    (void)comfort.ridden_m(settings, 0.0, 0.0);
    for (int piece = 0; piece < 200; ++piece) {
      const double mps = 2.0 * of(random), deg_per_s = 50.0 * of(random), to_m = 2.0 * of(random), stick = of(random);
      for (int n = 1; n <= frames; ++n) {
        const double height_m = before_m + (to_m - before_m) * n / frames, dt_s = 0.05 / frames;
        comfort.step(settings, {{mps, 0.0, 0.0}, deg_per_s, deck(height_m)}, dt_s);
        e.ridden_m = comfort.ridden_m(settings, height_m, dt_s);
        e.turned_deg += comfort.turned_deg(settings, stick, dt_s);
      }
      before_m = to_m;
    }
    e.clear_deg = comfort.shown().clear_deg;
    e.deck_m = comfort.carrier()->position_m.y;
    return e;
  };
  const End slow = end(1), fast = end(6), faster = end(50);  // 20, 120 and 1,000 Hz
  EXPECT_LT(slow.clear_deg, 300.0);
  EXPECT_GT(std::abs(slow.ridden_m), 1e-3);
  for (const End& other : {fast, faster}) {
    EXPECT_NEAR(slow.clear_deg, other.clear_deg, 1e-9);
    EXPECT_NEAR(slow.deck_m, other.deck_m, 1e-9);
    EXPECT_NEAR(slow.ridden_m, other.ridden_m, 1e-9);
    EXPECT_NEAR(slow.turned_deg, other.turned_deg, 1e-9);
  }
}

// Controls: half the angle, the faster of the two instead of both together, an opening twice as fast as the closing.
TEST(Comfort, TheVignetteClosesSlowlyToItsAngle) {
  const ComfortSettings settings;
  Comfort comfort;
  EXPECT_EQ(comfort.shown().clear_deg, 360.0);
  for (int i = 1; i <= 100; ++i) {
    comfort.step(settings, going(3.0), 0.05);
    ASSERT_NEAR(comfort.shown().clear_deg, std::min(360.0, 90.0 / (1.0 - std::exp(-0.05 * i))), 1e-9);
  }
  const double closed = 1.0 - std::exp(-5.0);
  for (int i = 1; i <= 20; ++i) {
    comfort.step(settings, {}, 0.05);
    ASSERT_NEAR(comfort.shown().clear_deg, std::min(360.0, 90.0 / (closed * std::exp(-0.05 * i))), 1e-9);
  }
  EXPECT_EQ(comfort.shown().soft_deg, 20.0);
  EXPECT_NEAR(settled(settings, going(3.0)).clear_deg, 90.0, 1e-9);
  EXPECT_NEAR(settled(settings, going(50.0)).clear_deg, 90.0, 1e-9) << "never closer";
  EXPECT_NEAR(settled(settings, going(1.4)).clear_deg, 90.0 * 3.0 / 1.4, 1e-9) << "a walk: outside the picture";
  EXPECT_NEAR(settled(settings, going(0.0, -60.0)).clear_deg, 90.0, 1e-9) << "to the left too";
  EXPECT_NEAR(settled(settings, going(1.8, 36.0)).clear_deg, 90.0 / std::hypot(0.6, 0.6), 1e-9);
  EXPECT_EQ(settled(settings, going(0.0)).clear_deg, 360.0);
  EXPECT_EQ(settled({.vignette = false}, going(9.0)).clear_deg, 360.0);
  Comfort at_once;
  at_once.step({.vignette_deg = 50.0, .vignette_s = 0.0}, going(3.0), 0.0);
  EXPECT_EQ(at_once.shown().clear_deg, 50.0);
}

// The low-pass against its differential equation, solved by Runge and Kutta's fourth order in steps of 0.2 ms.
// Controls: a damping of 0.9 in the formula of the height, the rate without its change's decay.
TEST(Comfort, SlowHeightsSolveTheirEquation) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> of(-1.0, 1.0);
  for (const double period_s : {0.3, 2.0, 20.0}) {
    const double w = glm::two_pi<double>() / period_s;
    SlowHeight slow;
    double x = slow.step(0.4, period_s, 0.0), v = 0.0, u = 0.4;
    EXPECT_EQ(x, 0.4);
    for (int piece = 0; piece < 60; ++piece) {
      const double to = of(random), dt = 0.001 * std::pow(400.0, 0.5 * (of(random) + 1.0));
      const int steps = int(std::ceil(dt / 2e-4));
      const double h = dt / steps, rate = (to - u) / dt;
      for (int n = 0; n < steps; ++n) {
        const auto force = [&](double t, double height, double speed) {
          return w * w * (u + rate * (n * h + t) - height) - 2.0 * w * speed;
        };
        const double a1 = force(0.0, x, v), v2 = v + 0.5 * h * a1, a2 = force(0.5 * h, x + 0.5 * h * v, v2);
        const double v3 = v + 0.5 * h * a2, a3 = force(0.5 * h, x + 0.5 * h * v2, v3), v4 = v + h * a3;
        const double a4 = force(h, x + h * v3, v4);
        x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
        v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
      }
      u = to;
      ASSERT_NEAR(slow.step(to, period_s, dt), x, 1e-8) << period_s << " " << piece;
    }
  }
}

// How much of waves is left, and when a slow rise comes through: what the settings' sentences say. Control: the period
// taken as that of 2 pi times as long.
TEST(Comfort, SmallWavesLeaveTheHeight) {
  const auto amplitude = [](double wave_s, double period_s) {
    SlowHeight slow;
    double most = 0.0;
    for (int i = 0; i <= 40'000; ++i) {
      const double t = 0.001 * wave_s * i,
                   m = slow.step(std::sin(glm::two_pi<double>() * t / wave_s), period_s, i == 0 ? 0.0 : 0.001 * wave_s);
      if (t > 30.0 * wave_s) most = std::max(most, std::abs(m));
    }
    return most;
  };
  EXPECT_NEAR(amplitude(2.0, 2.0), 1.0 / 2.0, 1e-3);
  EXPECT_NEAR(amplitude(1.0, 2.0), 1.0 / 5.0, 1e-3);
  EXPECT_NEAR(amplitude(8.0, 2.0), 16.0 / 17.0, 1e-3);
  SlowHeight rise, step;
  (void)rise.step(0.0, 2.0, 0.0);
  (void)step.step(0.0, 2.0, 0.0);
  EXPECT_NEAR(rise.step(100.0, 2.0, 100.0), 100.0 - 2.0 / glm::pi<double>(), 1e-9);
  (void)step.step(1.0, 2.0, 0.0);
  for (double last = 0.0, m = 0.0; m < 1.0 - 1e-9; last = m) {
    m = step.step(1.0, 2.0, 0.02);
    ASSERT_GT(m, last);
    ASSERT_LE(m, 1.0) << "it overshoots";
  }
  SlowHeight none;
  for (const double m : {0.0, 1.0, -3.0}) EXPECT_EQ(none.step(m, 0.0, 0.01), m);
  Comfort rides;
  const ComfortSettings settings;
  (void)rides.ridden_m(settings, 0.0, 0.0);
  EXPECT_LT(rides.ridden_m(settings, 1.0, 0.1), 0.05);
  EXPECT_EQ(rides.ridden_m({.on = false}, 1.0, 0.1), 1.0);
}

// Controls: a lock that takes the heading too, roll scaled without the lock, pitch scaled by comfort.roll.
TEST(Comfort, TheHorizonStaysLevelAndTheHeadingIsTheCarriers) {
  for (const double yaw : {-170.0, -30.0, 0.0, 100.0})
    for (const double pitch : {-40.0, 0.0, 25.0})
      for (const double roll : {-60.0, 10.0, 170.0}) {
        const Pose carrier = deck(0.0, {yaw, pitch, roll});
        const auto expect = [&](double lock, double share, const ViewAngles& angles) {
          const Pose pose = taken({.horizon_lock = lock, .roll = share}, carrier);
          EXPECT_LT(apart_deg(pose.orientation, orientation_from_angles(angles)), 1e-6)
              << yaw << " " << pitch << " " << roll << ", lock " << lock << ", roll " << share;
          EXPECT_EQ(pose.position_m.x, carrier.position_m.x);
          EXPECT_EQ(pose.position_m.z, carrier.position_m.z);
        };
        expect(1.0, 0.0, {yaw, 0.0, 0.0});
        expect(1.0, 1.0, {yaw, 0.0, 0.0});
        expect(0.0, 0.0, {yaw, pitch, 0.0});
        expect(0.0, 1.0, {yaw, pitch, roll});
        expect(0.5, 0.5, {yaw, 0.5 * pitch, 0.25 * roll});
      }
  EXPECT_EQ(ComfortSettings{}.horizon_lock, 1.0);
  EXPECT_EQ(ComfortSettings{}.roll, 0.0);
}

// Waves of 5 s on a tide. Controls: a heave taken of the slow part, a slow part of 2 s.
TEST(Comfort, HeaveIsScaledAndTheTideIsNot) {
  std::array<Comfort, 3> comfort;
  const std::array<double, 3> shares{0.0, 0.5, 1.0};
  double most_m = 0.0;
  for (int i = 0; i <= 6000; ++i) {
    const double t = 0.02 * i, tide_m = 0.01 * t, wave_m = std::sin(glm::two_pi<double>() * t / 5.0);
    std::array<double, 3> out{};
    for (std::size_t k = 0; k < 3; ++k) {
      comfort[k].step({.heave = shares[k]}, {{}, 0.0, deck(tide_m + wave_m)}, i == 0 ? 0.0 : 0.02);
      out[k] = comfort[k].carrier()->position_m.y;
    }
    ASSERT_EQ(out[2], tide_m + wave_m);
    ASSERT_NEAR(out[1], 0.5 * (out[0] + out[2]), 1e-12);
    if (t > 60.0) most_m = std::max(most_m, std::abs(out[0] - tide_m + 0.01 * 20.0 / glm::pi<double>()));
  }
  EXPECT_NEAR(most_m, 1.0 / 17.0, 2e-3);
}

// Controls: a vignette that opens slowly, a carrier's pose that keeps its lock, and filters that rest meanwhile.
TEST(Comfort, OffTakesAllOfItAwayAtOnceAndComesBackAsIfItHadNeverGone) {
  const ComfortSettings on, off{.on = false};
  Comfort kept, toggled;
  const auto both = [&](const ComfortSettings& other, double t) {
    const ComfortMotion motion{{5.0, 0.0, 0.0}, 10.0, deck(std::sin(t), {40.0, 12.0, -20.0})};
    kept.step(on, motion, 0.1);
    toggled.step(other, motion, 0.1);
    return motion.carrier.value();
  };
  for (int i = 0; i < 100; ++i) both(on, 0.1 * i);
  EXPECT_LT(toggled.shown().clear_deg, 91.0);
  EXPECT_TRUE(toggled.shown().horizon_line);
  for (int i = 100; i < 130; ++i) {
    const Pose carrier = both(off, 0.1 * i);
    EXPECT_EQ(toggled.shown().clear_deg, 360.0);
    EXPECT_FALSE(toggled.shown().horizon_line);
    EXPECT_EQ(toggled.carrier()->position_m, carrier.position_m);
    EXPECT_EQ(toggled.carrier()->orientation, carrier.orientation) << "roll and all";
  }
  EXPECT_NE(kept.carrier()->position_m.y, toggled.carrier()->position_m.y);
  both(on, 13.0);
  EXPECT_EQ(kept.carrier()->position_m.y, toggled.carrier()->position_m.y);
  EXPECT_GT(toggled.shown().clear_deg, 300.0) << "and closes slowly";
}

// Controls: carried taken for always, a line that asks for the vignette.
TEST(Comfort, TheHorizonsLineIsThereWhenItIsAskedFor) {
  for (const bool carried : {false, true})
    for (const HorizonLine when : {HorizonLine::none, HorizonLine::carried, HorizonLine::always}) {
      Comfort comfort;
      ComfortMotion motion;
      if (carried) motion.carrier = deck(0.0);
      comfort.step({.vignette = false, .horizon_line = when}, motion, 0.01);
      EXPECT_EQ(comfort.shown().horizon_line, when == HorizonLine::always || (when == HorizonLine::carried && carried));
      EXPECT_EQ(comfort.carrier().has_value(), carried);
    }
  EXPECT_EQ(ComfortSettings{}.horizon_line, HorizonLine::carried);
}

// Controls: a turn in each frame of a push, one that counts from the middle on, and one that takes a stick which goes
// from one side to the other between two frames for held.
TEST(Comfort, APushOfTheStickTurnsOnce) {
  ComfortSettings settings;
  Comfort comfort;
  const auto push = [&](double stick) { return comfort.turned_deg(settings, stick, 0.02); };
  EXPECT_EQ(push(0.0), 0.0);
  EXPECT_EQ(push(0.5), 0.0);
  EXPECT_EQ(push(0.9), 30.0);
  EXPECT_EQ(push(1.0), 0.0);
  EXPECT_EQ(push(0.5), 0.0);
  EXPECT_EQ(push(0.9), 0.0) << "it was not let go";
  EXPECT_EQ(push(0.1), 0.0);
  EXPECT_EQ(push(-1.0), -30.0);
  EXPECT_EQ(push(1.0), 30.0);
  EXPECT_EQ(push(nan), 0.0);
  EXPECT_EQ(push(0.0), 0.0);
  settings.snap_turn_deg = 45;
  EXPECT_EQ(push(infinity), 45.0);
  settings.on = false;
  EXPECT_NEAR(push(1.0), 60.0 * 0.02, 1e-12) << "evenly";
  settings = {.snap_turn_deg = 0, .turn_deg_per_s = 90.0};
  EXPECT_NEAR(push(-0.5), -0.5 * 90.0 * 0.02, 1e-12);
  settings = {};
  EXPECT_EQ(push(0.0), 0.0);
  EXPECT_EQ(push(1.0), 30.0);
}

// Each row of comfort at both its ends, with times and motions that no one asks for. Controls: the speed's check for
// what is no number left out, the pose's, the water's, the stick's, the step's.
TEST(Comfort, OddTimesSpeedsAndSettingsLeaveNumbers) {
  std::vector<ComfortSettings> all{{}};
  for (const Setting& row : settings_table()) {
    if (!row.key.starts_with("comfort.")) continue;
    const auto add = [&](const SettingValue& value) {
      Settings settings;
      set_value(settings, row, value, "test");
      all.push_back(settings.comfort);
    };
    if (std::holds_alternative<FlagMember>(row.member))
      add(false);
    else if (std::holds_alternative<ChoiceMember>(row.member))
      for (const std::string_view choice : row.choices) add(std::string(choice));
    else
      for (const double end : {row.least, row.most}) add(end);
  }
  EXPECT_GE(all.size(), 26u);
  for (const ComfortSettings& settings : all) {
    Comfort comfort;
    std::mt19937 random(9);
    const auto one_of = [&](std::initializer_list<double> list) { return list.begin()[random() % list.size()]; };
    for (int i = 0; i < 2000; ++i) {
      const double dt_s = one_of({0.0, 1e-300, 1e-9, 0.011, 0.1, 1e9, infinity, -1.0, nan});
      const double height_m = one_of({0.0, 1.0, -1e6, nan, infinity, 0.3});
      ComfortMotion motion{{one_of({0.0, 1.0, nan, infinity, -1e300}), one_of({0.0, 2.0}), 0.0},
                           one_of({0.0, 30.0, -infinity, nan, 1e308}),
                           {}};
      if (random() % 4 != 0)
        motion.carrier = deck(height_m, {one_of({0.0, 180.0, nan}), one_of({0.0, 90.0, -90.0}), 9.0});
      comfort.step(settings, motion, dt_s);
      const ComfortShown& shown = comfort.shown();
      ASSERT_TRUE(shown.clear_deg >= settings.vignette_deg && shown.clear_deg <= 360.0) << shown.clear_deg;
      if (comfort.carrier()) {
        const Pose pose = comfort.carrier().value();
        ASSERT_NEAR(glm::length(pose.orientation), 1.0, 1e-9);
        ASSERT_LE(std::abs(pose.position_m.y), 2e6) << pose.position_m.y;
      }
      const double water_m = one_of({0.0, 1.0, -5.0, nan}), ridden_m = comfort.ridden_m(settings, water_m, dt_s);
      if (settings.on) {
        ASSERT_LE(std::abs(ridden_m), 20.0);
      }
      ASSERT_TRUE(std::isfinite(comfort.turned_deg(settings, one_of({0.0, 1.0, -1.0, nan, infinity}), dt_s)));
    }
    // Nothing of that is kept.
    comfort.step(settings, going(settings.vignette_mps), 1e9);
    EXPECT_NEAR(comfort.shown().clear_deg, settings.on && settings.vignette ? settings.vignette_deg : 360.0, 1e-6);
  }
}

// A step of no time changes nothing, and ever so many short ones come to one long one. Controls: 1 - exp(-z) without
// expm1 in the height, the speed by a hypot of three numbers, which makes nothing of infinity.
TEST(Comfort, ShortStepsAddUp) {
  const ComfortSettings settings;
  SlowHeight once, often;
  Comfort one, many;
  for (SlowHeight* slow : {&once, &often}) {
    (void)slow->step(0.0, 2.0, 0.0);
    (void)slow->step(1.0, 2.0, 0.5);
  }
  for (Comfort* comfort : {&one, &many}) comfort->step(settings, going(3.0), 0.7);
  constexpr int steps = 100'000;
  for (int i = 0; i < steps; ++i) {
    (void)often.step(1.0 + 1e-4 * (i + 1) / steps, 2.0, 1e-4 / steps);
    many.step(settings, going(2.0), 1e-4 / steps);
  }
  (void)once.step(1.0 + 1e-4, 2.0, 1e-4);
  one.step(settings, going(2.0), 1e-4);
  EXPECT_NEAR(one.shown().clear_deg, many.shown().clear_deg, 1e-9);
  EXPECT_NEAR(once.step(1.0, 2.0, 1.0), often.step(1.0, 2.0, 1.0), 1e-10);
  const double before_deg = many.shown().clear_deg;
  many.step(settings, going(9.0), 0.0);
  EXPECT_EQ(many.shown().clear_deg, before_deg);
  EXPECT_NEAR(settled(settings, going(infinity)).clear_deg, 90.0, 1e-9);
  EXPECT_EQ(settled(settings, going(nan)).clear_deg, 360.0);
  // A jump of the height within no time, or within a very short one, is a step that the filter then follows.
  for (const double dt_s : {0.0, 1e-9, 1e-12}) {
    SlowHeight a, b;
    (void)a.step(0.0, 2.0, 0.0);
    (void)b.step(0.0, 2.0, 0.0);
    EXPECT_NEAR(a.step(1.0, 2.0, 0.0), 0.0, 0.0);
    EXPECT_NEAR(b.step(1.0, 2.0, dt_s), 0.0, 1e-8);
    EXPECT_NEAR(a.step(1.0, 2.0, 0.3), b.step(1.0, 2.0, 0.3), 1e-8);
  }
}

// Control: an empty begin_anew.
TEST(Comfort, BeginsAnewAfterAJump) {
  Comfort comfort;
  const ComfortSettings settings{.heave = 0.0};
  comfort.step(settings, {{9.0, 0.0, 0.0}, 0.0, deck(0.0)}, 5.0);
  comfort.begin_anew();
  comfort.step(settings, {{}, 0.0, deck(50.0)}, 0.01);
  EXPECT_EQ(comfort.shown().clear_deg, 360.0);
  EXPECT_EQ(comfort.carrier()->position_m.y, 50.0);
  comfort.step(settings, {}, 0.01);  // ashore, then aboard again
  comfort.step(settings, {{}, 0.0, deck(7.0)}, 0.01);
  EXPECT_EQ(comfort.carrier()->position_m.y, 7.0);
}

}  // namespace
}  // namespace seascape
