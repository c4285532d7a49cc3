// What happens to bodies is told once, at its moment, and no flicker is told.
#include "ocean/bodies/body_events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "tests/support/body_waves.h"

namespace seascape {
namespace {

using namespace test;

BodySpec crate(double at_y, double density = 0.4 * rho) {
  BodySpec spec = even_body(box_hull({1.0, 1.0, 1.0}, 2), density, at_y);
  spec.drag = HullDrag{};
  const double m = spec.mass.mass_kg;
  spec.mass.added = Matrix6::diagonal({0.3 * m, m, 0.3 * m, 0.1 * m, 0.05 * m, 0.1 * m});
  spec.damping = Matrix6::diagonal({0.1 * m, 2.0 * m, 0.1 * m, m, m, m});
  return spec;
}

std::vector<BodyEvent> events_of(
    Bodies& bodies, double seconds, const BodyWater& water, const BodyEventSettings& settings = {},
    const std::function<void(int)>& meanwhile = [](int) {}) {
  BodyEvents follower(settings);
  std::vector<BodyEvent> events;
  follower.follow(0.0, bodies, events);
  for (int n = 0; n < int(seconds * 60.0); ++n) {
    meanwhile(n);
    bodies.step((n + 1) / 60.0, 1.0 / 60.0, water);
    follower.follow((n + 1) / 60.0, bodies, events);
  }
  return events;
}

int count(const std::vector<BodyEvent>& events, BodyEventKind kind, std::size_t body = 0) {
  int sum = 0;
  for (const BodyEvent& event : events) sum += event.kind == kind && event.body == body;
  return sum;
}

// A crate dropped from 2 m comes in once, at the time and with the speed of its fall, and slams once; it comes out no
// more. Control seen: a slam by each step that takes speed.
TEST(BodyEvents, InAndSlamAreToldOnce) {
  BodySpec falls = crate(2.5);
  falls.orientation = glm::angleAxis(0.25, glm::dvec3(0.0, 0.0, 1.0));  // it comes in over several steps
  Bodies bodies({}, {falls});
  const std::vector<BodyEvent> events = events_of(bodies, 20.0, FormulaWater{});
  ASSERT_EQ(count(events, BodyEventKind::in), 1);
  EXPECT_EQ(count(events, BodyEventKind::slam), 1);
  EXPECT_EQ(events.size(), 2u);
  for (const BodyEvent& event : events) {
    EXPECT_NEAR(event.time_s, std::sqrt(2.0 * 1.9 / g), 0.08);
    if (event.kind == BodyEventKind::in) {
      EXPECT_NEAR(event.strength, std::sqrt(2.0 * g * 2.0), 0.4);
    }
    if (event.kind == BodyEventKind::slam) {
      EXPECT_GT(event.strength, 1.0);
    }
  }
}

// Waves that lick at a hung thing, and a boat that rolls to and fro about its beam's end, flicker about a limit: each
// is told once and not each time. Control seen: a second limit equal to the first (22 of each).
TEST(BodyEvents, NoFlickerIsTold) {
  FormulaWater licks;
  licks.waves = {{0.01, 3.0}};
  Bodies hung({}, {crate(0.0)});
  const BodyMotion still = [&] {
    BodyMotion motion;
    motion.centre_m.y = 0.5 - 0.008;  // between dry and two hundredths of what it displaces
    return motion;
  }();
  const std::vector<BodyEvent> wet = events_of(hung, 30.0, licks, {}, [&](int) { hung.place(0, still); });
  EXPECT_LE(count(wet, BodyEventKind::in), 1);
  EXPECT_LE(count(wet, BodyEventKind::out), 1);
  EXPECT_GE(wet.size(), 1u);
  Bodies rolls({}, {crate(0.0)});
  const std::vector<BodyEvent> over = events_of(rolls, 30.0, FormulaWater{}, {}, [&](int n) {
    BodyMotion motion;
    const double swing = 0.5 * std::numbers::pi + (n < 60 ? -1.0 : 0.1 * std::sin(0.4 * n));
    motion.orientation = glm::angleAxis(swing, glm::dvec3(0.0, 0.0, 1.0));
    rolls.place(0, motion);
  });
  EXPECT_EQ(count(over, BodyEventKind::capsize), 1);
}

// Run aground it is told once, for as long as it lies there, asleep too; run into by another, each once. Control seen:
// what sleeps counted as lifted (a second grounding when it wakes).
TEST(BodyEvents, GroundAndHit) {
  ContactSettings settings;
  settings.land = [](std::span<const glm::dvec2> places, std::span<double> heights) {
    for (std::size_t n = 0; n < places.size(); ++n) heights[n] = places[n].x < -3.0 ? 1.0 : -50.0;
  };
  BodySpec stands = crate(1.8), drifts = crate(0.1), comes = crate(0.1);
  stands.at_m.x = -10.0, comes.at_m.z = -1.8, comes.velocity_mps.z = 3.0;
  Bodies bodies({}, {stands, drifts, comes}, settings);
  bool slept = false;
  const std::vector<BodyEvent> events = events_of(bodies, 40.0, FormulaWater{}, {}, [&](int n) {
    slept = slept || bodies.result()[0].asleep;
    if (n == 60 * 20) bodies.push(0, {0.0, -10.0, 0.0}, bodies.result()[0].motion.centre_m);
  });
  EXPECT_TRUE(slept);
  EXPECT_EQ(count(events, BodyEventKind::ground, 0), 1);
  EXPECT_EQ(count(events, BodyEventKind::hit, 0), 0);
  EXPECT_EQ(count(events, BodyEventKind::hit, 1), 1);
  EXPECT_EQ(count(events, BodyEventKind::hit, 2), 1);
  for (const BodyEvent& event : events)
    if (event.kind == BodyEventKind::hit) {
      EXPECT_NEAR(event.strength, 1.2, 0.8);
    }
}

// Lifted out and let in again, turned over and filled: each has its event, at its moment, and time that goes back tells
// nothing. Control seen: out told by the first limit.
TEST(BodyEvents, OutCapsizeAndSwamped) {
  BodySpec spec = crate(0.1);
  spec.inside.hull = std::make_shared<HullMesh>(moved(box_hull({0.8, 0.8, 0.8}), {0.0, 0.1, 0.0}));
  Bodies bodies({}, {spec});
  BodyEvents follower;
  std::vector<BodyEvent> events;
  int step = 0;
  const auto go = [&](double seconds) {
    for (const int end = step + int(seconds * 60.0); step < end;) {
      ++step;
      bodies.step(step / 60.0, 1.0 / 60.0, FormulaWater{});
      follower.follow(step / 60.0, bodies, events);
    }
    std::map<BodyEventKind, int> sums;
    for (const BodyEvent& event : events) ++sums[event.kind];
    events.clear();
    return sums;
  };
  using enum BodyEventKind;
  EXPECT_TRUE(go(3.0).empty());
  BodyMotion motion = bodies.result()[0].motion;
  motion.centre_m.y = 2.0, motion.velocity = {};
  bodies.place(0, motion);
  EXPECT_EQ(go(0.3)[out], 1);
  EXPECT_EQ(go(5.0)[in], 1);
  motion = bodies.result()[0].motion;
  motion.orientation = glm::angleAxis(2.5, glm::dvec3(0.0, 0.0, 1.0));
  bodies.place(0, motion);
  EXPECT_EQ(go(0.1)[capsize], 1);
  motion.orientation = {1.0, 0.0, 0.0, 0.0};
  bodies.place(0, motion);
  go(3.0);
  bodies.fill(0, 0.45);
  EXPECT_EQ(go(0.1)[swamped], 1);
  events.clear();
  follower.follow(0.0, bodies, events);
  EXPECT_TRUE(events.empty());
}

}  // namespace
}  // namespace seascape
