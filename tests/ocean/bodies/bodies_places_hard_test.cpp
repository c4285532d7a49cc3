// Bodies where water is at its worst, with contacts and open boats: over a river's drop, in a whirlpool, of masses from
// 1e-3 to 1e6 against each other; and their bits at any frame rate, with any number of threads.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/body_waves.h"

namespace seascape {
namespace {

using namespace test;

BodySpec crate(double density, const glm::dvec3& at) {
  BodySpec spec = even_body(box_hull({1.0, 0.7, 1.4}, 2), density);
  spec.drag = HullDrag{};
  const double bottom = 0.4 * rho, m = spec.mass.mass_kg;
  spec.mass.added = Matrix6::diagonal({0.3 * bottom, bottom, 0.3 * bottom, 0.1 * bottom, 0.05 * bottom, 0.1 * bottom});
  spec.damping = Matrix6::diagonal({0.1 * m, m, 0.1 * m, 0.3 * m, 0.1 * m, 0.3 * m});
  spec.at_m = at;
  return spec;
}

// Water whose still level, height and current are functions of the place.
struct PlaceWater : FormulaWater {
  std::function<double(const glm::dvec2&)> level;
  std::function<glm::dvec2(const glm::dvec2&)> current;
  void ask(double, double, std::span<const glm::dvec2> places, std::span<WaterHere> answers) const override {
    for (std::size_t n = 0; n < places.size(); ++n) {
      WaterHere& a = answers[n];
      a = {};
      a.height_m = a.still_m = level(places[n]), a.current_mps = current(places[n]), a.depth_m = 3.0;
      a.velocity_mps = {a.current_mps.x, 0.0, a.current_mps.y};
    }
  }
  std::optional<CalmWater> calm(double, const glm::dvec2&, double) const override { return std::nullopt; }
};

void step(Bodies& bodies, int n, const BodyWater& water, double highest_m) {
  bodies.step((n + 1) / 60.0, 1.0 / 60.0, water);
  for (const BodyState& state : bodies.result()) {
    ASSERT_FALSE(state.lost) << n;
    ASSERT_LT(state.motion.centre_m.y, highest_m) << n;
  }
}

// A river's level that drops by 2 m within half a metre, at 3 m/s, takes six bodies of three densities and all levels
// over it: they go down, come out below, and ride there as they did above. Control seen: the drop turned upwards (they
// do not get over it).
TEST(BodiesPlacesHard, OverARiversDrop) {
  PlaceWater river;
  river.level = [](const glm::dvec2& at) { return 2.0 - 2.0 * std::clamp(at.y / 0.5, 0.0, 1.0); };
  river.current = [](const glm::dvec2&) { return glm::dvec2(0.0, 3.0); };
  std::vector<BodySpec> specs;
  for (int n = 0; n < 6; ++n) {
    specs.push_back(crate(rho * (0.2 + 0.3 * (n % 3)), {4.0 * n, 2.0, -6.0}));
    specs.back().level = n < 3 ? BodyLevel::hull : BodyLevel::probes;
  }
  Bodies bodies({}, specs);
  for (int n = 0; n < 60 * 30; ++n) ASSERT_NO_FATAL_FAILURE(step(bodies, n, river, 4.0));
  for (const BodyState& state : bodies.result()) {
    EXPECT_GT(state.motion.centre_m.z, 20.0);
    EXPECT_LT(std::abs(state.motion.velocity.linear.y), 0.05);
    EXPECT_NEAR(state.motion.velocity.linear.z, 3.0, 0.3);
    EXPECT_LT(std::abs(state.motion.centre_m.y), 0.6);
  }
}

// Nine bodies in a whirlpool 2 m deep that turns at 4 m/s and draws in run into each other in its middle for 45
// seconds, stay there, and stay bodies. Control seen: without contacts (two of them within 0.13 m).
TEST(BodiesPlacesHard, InAWhirlpool) {
  PlaceWater pool;
  pool.level = [](const glm::dvec2& at) { return -2.0 * std::exp(-glm::dot(at, at) / 18.0); };
  pool.current = [](const glm::dvec2& at) {
    const double r = glm::length(at), turn = 4.0 * r / 2.0 * std::exp(0.5 - r * r / 8.0);
    return r > 1e-6 ? glm::dvec2(-at.y, at.x) / r * turn - 0.5 * at / (r + 1.0) : glm::dvec2(0.0);
  };
  std::vector<BodySpec> specs;
  for (int n = 0; n < 9; ++n)
    specs.push_back(crate(rho * (0.2 + 0.2 * (n % 3)), {2.5 * (n % 3 - 1), 0.2, 2.5 * (n / 3 - 1)}));
  Bodies bodies({}, specs, ContactSettings{});
  for (int n = 0; n < 60 * 45; ++n) ASSERT_NO_FATAL_FAILURE(step(bodies, n, pool, 2.0));
  double nearest = 1e9;
  for (std::size_t a = 0; a < 9; ++a) {
    EXPECT_LT(glm::length(bodies.result()[a].motion.centre_m), 12.0);
    EXPECT_LT(glm::length(bodies.result()[a].motion.velocity.linear), 8.0);
    for (std::size_t b = 0; b < a; ++b)
      nearest = std::min(nearest, glm::length(bodies.result()[a].motion.centre_m - bodies.result()[b].motion.centre_m));
  }
  EXPECT_GT(nearest, 0.6);  // no thinner are they
}

// Masses from 1e-3 to 1e6 times another's, run into, flipped and put on each other in a chop: finite, never flung
// higher than they fell, and at rest in still water in the end. Control seen: the push apart shared alike by both.
TEST(BodiesPlacesHard, AnyMassAgainstAnyOther) {
  for (const double ratio : {1e-3, 1.0, 1e3, 1e6}) {
    FormulaWater chop, still;
    chop.waves = {{0.2, 5.0}, {0.2, 4.0, {1.0, 0.0}, 1.0}};
    BodySpec light = crate(0.3 * rho, {0.1, 2.5, 0.1}), heavy = crate(0.3 * rho, {0.0, 0.1, 0.0});
    light.mass.mass_kg *= ratio, light.mass.inertia_kg_m2 *= ratio;
    light.velocity_mps = {0.0, -2.0, 0.0};
    Bodies bodies({}, {light, heavy}, ContactSettings{});
    for (int n = 0; n < 60 * 20; ++n) {
      if (n % 300 == 299) {
        BodyMotion over = bodies.result()[1].motion;
        over.orientation = over.orientation * glm::angleAxis(std::numbers::pi, glm::dvec3(0.0, 0.0, 1.0));
        bodies.place(1, over);
      }
      ASSERT_NO_FATAL_FAILURE(step(bodies, n, chop, 6.0)) << ratio;
    }
    for (int n = 60 * 20; n < 60 * 80; ++n) ASSERT_NO_FATAL_FAILURE(step(bodies, n, still, 6.0)) << ratio;
    if (ratio > 1.0) continue;  // what sinks may take it down
    EXPECT_LT(glm::length(bodies.result()[1].motion.velocity.linear), 0.1) << ratio;
    EXPECT_LT(std::abs(bodies.result()[1].motion.centre_m.y), 1.0) << ratio;
  }
}

// With contacts, land, lines and open boats too what bodies do is the same to the bit at 20, 60, 72, 90 and irregular
// frames a second, and on 1, 2 and all threads. Controls seen: contacts that are solved once a call of advance(); a
// mass that threads share.
TEST(BodiesPlacesHard, BitsWithContacts) {
  FormulaWater water;
  water.waves = {{0.4, 9.0}, {0.2, 5.0, {0.8, 0.6}}};
  ContactSettings contacts;
  contacts.still = {{"pier", box_hull({2.0, 4.0, 2.0}), {2.0, 0.0, 2.0}}};
  contacts.land = [](std::span<const glm::dvec2> places, std::span<double> heights) {
    for (std::size_t n = 0; n < places.size(); ++n) heights[n] = -1.0 - 0.3 * places[n].y;
  };
  contacts.lines = {{0, {0.0, 0.0, 0.7}, {0.0, 0.0, 3.0}, 2.5}};
  std::vector<std::uint64_t> hashes;
  const auto run = [&](const std::function<double(int)>& frame, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<BodySpec> specs;
    for (int n = 0; n < 12; ++n) {
      specs.push_back(crate(rho * (0.2 + 0.1 * (n % 4)), {1.3 * (n % 4), 0.4 * (n / 4), 1.6 * (n / 4)}));
      specs.back().inside.hull = std::make_shared<HullMesh>(moved(box_hull({0.8, 0.5, 1.2}), {0.0, 0.1, 0.0}));
      specs.back().level = BodyLevel(n % 2);
    }
    Bodies bodies({}, specs, contacts);
    bodies.advance(0.0, water);
    double t = 0.0;
    for (int n = 0; t < 5.0; ++n) bodies.advance(t = std::min(t + frame(n), 5.0), water);
    double filled = 0.0;
    for (const BodyState& state : bodies.result()) filled += state.filled_m3;
    EXPECT_GT(filled, 0.0);
    hashes.push_back(bodies.hash());
  };
  for (const double rate : {20.0, 60.0, 72.0, 90.0}) run([&](int) { return 1.0 / rate; }, 1);
  run([](int n) { return 0.001 + 0.03 * std::abs(std::sin(7.7 * n)); }, 2);
  run([](int) { return 0.11; }, 8);
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

}  // namespace
}  // namespace seascape
