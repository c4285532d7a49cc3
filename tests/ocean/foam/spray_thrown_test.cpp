// Spray that actors throw: as much as they say, from where and how fast, the same however frames fall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "ocean/foam/spray.h"
#include "tests/support/own_sea.h"

namespace seascape {
namespace {

const glm::dvec3 head{3.0, 1.7, -2.0};

SeaSpec calm() {
  SeaState state;
  state.wind_speed_mps = 3.0;
  return test::spec_of(state, {.resolution = 32, .cascades = 3});
}

class Thrower : public SeaActor {
 public:
  explicit Thrower(std::function<SprayThrow(double time_s)> thrown) : thrown_(std::move(thrown)) {}
  void step(SeaStep& step) override { taken = step.spray(thrown_(step.time_s)); }
  bool taken = false;

 private:
  std::function<SprayThrow(double)> thrown_;
};

SpraySettings settings() {
  SpraySettings s;
  s.life_s = 6.0;
  return s;
}

// Puffs fly off as many as a rate says, in a wind that tears none off crests, from the place and with the velocity of
// the throw; taken away, the actor throws no more. Controls: the throw's velocity forgotten;
// each step's throws counted for a whole step of spray; both seen.
TEST(SprayThrown, FliesAsItIsThrown) {
  Sea sea(calm());
  Spray spray(settings(), sea, 3.85);
  const auto actor = std::make_shared<Thrower>([](double) {
    return SprayThrow{.at_m = {6.0, 1.0, -3.0},
                      .velocity_mps = {2.0, 5.0, -1.0},
                      .spread_mps = 0.3,
                      .per_s = 400.0,
                      .width_m = 0.2,
                      .coarse = 1.0};
  });
  sea.add(actor);
  const auto to = [&](double time_s) { sea.advance(time_s, head), spray.update(time_s, head); };
  to(5.0);
  EXPECT_TRUE(spray.puffs().empty());
  for (int i = 1; i <= 15; ++i) to(5.0 + i / 30.0);
  EXPECT_TRUE(actor->taken);
  // Half a second less one step of the sea, of which spray has taken whole steps of its own; none has come down yet.
  EXPECT_NEAR(double(spray.puffs().size()), 400.0 * (0.5 - 1.0 / 60.0), 25.0);
  glm::dvec3 place(0.0), velocity(0.0);
  double weight = 0.0;
  for (const Spray::Puff& p : spray.puffs()) {
    EXPECT_LT(glm::length(p.place_m - glm::dvec3(6.0, 1.0, -3.0)), 4.0);
    if (p.age_s > 0.0) continue;
    place += p.place_m, velocity += p.velocity_mps, weight += 1.0;
  }
  ASSERT_GT(weight, 20.0);
  EXPECT_LT(glm::length(place / weight - glm::dvec3(6.0, 1.0, -3.0)), 0.1);
  EXPECT_LT(glm::length(velocity / weight - glm::dvec3(2.0, 5.0, -1.0)), 0.3);
  sea.take_away(*actor);
  to(5.6);
  const auto youngest = [&] {
    double age = 1e9;
    for (const Spray::Puff& p : spray.puffs()) age = std::min(age, p.age_s);
    return age;
  };
  to(6.2);
  EXPECT_GT(youngest(), 0.3);
}

// To the bit the same however frames fall. Control: throws of a moment after the step, which only some
// frames know; seen.
TEST(SprayThrown, IsTheSameHoweverFramesFall) {
  const auto puffs_of = [](auto next) {
    Sea sea(calm());
    Spray spray(settings(), sea, 3.85);
    for (int actor = 0; actor < 2; ++actor)
      sea.add(std::make_shared<Thrower>([actor](double time_s) {
        return SprayThrow{.at_m = {time_s - 5.0, 0.5, double(actor)}, .velocity_mps = {0.0, 4.0, 0.0}, .per_s = 37.0};
      }));
    for (double time_s = 10.0;; time_s = std::min(next(time_s), 11.5)) {
      sea.advance(time_s, head);
      spray.update(time_s, head);
      if (time_s == 11.5) break;
    }
    std::vector<double> all;
    for (const Spray::Puff& p : spray.puffs())
      all.insert(all.end(), {p.place_m.x, p.place_m.y, p.place_m.z, p.age_s, p.diameter_m, p.velocity_mps.y});
    EXPECT_GT(all.size(), 100u);
    return all;
  };
  const std::vector<double> want = puffs_of([](double t) { return t + 1.0 / 60.0; });
  for (const double rate : {20.0, 72.0, 90.0})
    EXPECT_EQ(puffs_of([&](double t) { return (std::round(t * rate) + 1.0) / rate; }), want) << rate;
}

// What cannot be is left out, and the actor is told; so is what a step has no room for. Control: a share of 1.5 let by;
// seen.
TEST(SprayThrown, RefusesWhatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ActorSpray spray;
  for (const SprayThrow& bad : {SprayThrow{.at_m = {nan, 0.0, 0.0}}, SprayThrow{.velocity_mps = {0.0, 200.0, 0.0}},
                                SprayThrow{.spread_mps = nan}, SprayThrow{.per_s = -1.0}, SprayThrow{.per_s = 1e9},
                                SprayThrow{.width_m = -1.0}, SprayThrow{.coarse = 1.5}})
    EXPECT_FALSE(spray.add(bad));
  for (std::size_t i = 0; i < most_spray_throws; ++i) EXPECT_TRUE(spray.add({}));
  EXPECT_FALSE(spray.add({}));
}

}  // namespace
}  // namespace seascape
