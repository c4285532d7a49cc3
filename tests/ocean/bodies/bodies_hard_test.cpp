// Bodies whose mass, motion or place no boat has: finite, and settled in the end.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/error.h"
#include "ocean/bodies/bodies.h"
#include "tests/support/body_waves.h"

namespace seascape {
namespace {

using namespace test;

BodySpec crate(double density) {
  BodySpec spec = even_body(box_hull({1.0, 1.0, 1.0}, 2), density);
  spec.drag = HullDrag{};
  const double bottom = 0.4 * rho;
  spec.mass.added = Matrix6::diagonal({0.3 * bottom, bottom, 0.3 * bottom, 0.1 * bottom, 0.05 * bottom, 0.1 * bottom});
  const double m = spec.mass.mass_kg;
  spec.damping = Matrix6::diagonal({0.1 * m, m, 0.1 * m, 0.3 * m, 0.1 * m, 0.3 * m});
  return spec;
}

// The last second's motion is slow, and no number was none on the way; gives the body's height.
double settles(Bodies& bodies, const BodyWater& water, double seconds, double slow_mps = 0.05) {
  double fastest = 0.0;
  for (int n = 0; n < int(seconds * 60.0); ++n) {
    bodies.step((n + 1) / 60.0, 1.0 / 60.0, water);
    for (const BodyState& state : bodies.result()) {
      EXPECT_FALSE(state.lost);
      if (n > int((seconds - 1.0) * 60.0)) fastest = std::max(fastest, glm::length(state.motion.velocity.linear));
    }
  }
  EXPECT_LT(fastest, slow_mps);
  return bodies.result()[0].motion.centre_m.y;
}

// Dropped from 100 m, flat and on a corner: it goes under, comes up and floats at its draught; the fall's speed is
// never exceeded. Control seen: an entry whose momentum
// has the wrong sign.
TEST(BodiesHard, hard_25_dropped_from_100_m) {
  for (const double turn : {0.0, 0.6}) {
    BodySpec spec = crate(0.4 * rho);
    spec.at_m.y = 100.0;
    spec.orientation = glm::angleAxis(turn, glm::normalize(glm::dvec3(1.0, 0.3, 0.5)));
    Bodies bodies({}, {spec});
    bool wet = false;
    for (int n = 0; n < 60 * 90; ++n) {
      bodies.step((n + 1) / 60.0, 1.0 / 60.0, FormulaWater{});
      const BodyState& state = bodies.result()[0];
      ASSERT_LT(glm::length(state.motion.velocity.linear), std::sqrt(2.0 * g * 100.0) + 0.1);
      wet = wet || state.submerged_m3 > 0.0;
      if (wet) {
        ASSERT_LT(state.motion.centre_m.y, 2.0);
      }
    }
    EXPECT_TRUE(wet);
    EXPECT_NEAR(bodies.result()[0].submerged_m3, 0.4, 0.01);
  }
}

// Of a thousandth of the water's density and of a thousand times it; and masses of 1e-3 to 1e6 kg in a cubic metre
// (boats.md, (b): 1 kg in 1 m3 flies). The light ones lie on the water, the heavy ones sink at their steady speed,
// with added mass and without. Control seen: one substep, and no damping of the time step (light ones do not
// come down on it).
TEST(BodiesHard, hard_26_b_density_ratios) {
  for (const double kg : {1e-3, 1.0, 1.025, 30.0, 1.025e6, 1e6})
    for (const bool added : {true, false}) {
      BodySpec spec = crate(kg);
      if (!added) spec.mass.added = {};
      spec.at_m.y = 0.6;
      Bodies bodies({}, {spec});
      double highest = 0.0;
      const bool sinks = kg > rho;
      for (int n = 0; n < 60 * 20; ++n) {
        bodies.step((n + 1) / 60.0, 1.0 / 60.0, FormulaWater{});
        ASSERT_FALSE(bodies.result()[0].lost);
        highest = std::max(highest, bodies.result()[0].motion.centre_m.y);
      }
      EXPECT_LT(highest, 1.0) << kg;
      const BodyMotion& motion = bodies.result()[0].motion;
      if (sinks) {
        EXPECT_LT(motion.velocity.linear.y, -1.0) << kg;
      } else {
        EXPECT_NEAR(motion.centre_m.y, 0.5 - kg / rho, 0.02) << kg << " " << added;
        EXPECT_LT(glm::length(motion.velocity.linear), 0.05) << kg << " " << added;
      }
    }
}

// Capsized a hull floats on as it lies or comes upright, by its mass's height, and stays there (boats.md, (i)). Control
// seen: the pressure's moment with the wrong sign.
TEST(BodiesHard, hard_27_i_capsized) {
  for (const double height : {-0.5, 0.3}) {
    BodySpec spec = even_body(wigley_hull(6.0, 1.2, 0.7, 0.5, 12, 6), 0.35 * rho);
    spec.mass_centre_m = {0.0, height, 0.0};
    const double m = spec.mass.mass_kg;
    spec.mass.added = Matrix6::diagonal({0.05 * m, m, m, 0.5 * m, 0.5 * m, 0.2 * m});
    spec.damping = Matrix6::diagonal({0.0, m, m, m, m, 0.4 * m});
    spec.drag = HullDrag{};
    spec.orientation = glm::angleAxis(3.0, glm::dvec3(0.0, 0.0, 1.0));
    Bodies bodies({}, {spec});
    settles(bodies, FormulaWater{}, 120.0);
    EXPECT_NEAR(bodies.result()[0].submerged_m3, m / rho, 0.005 * m / rho);
    if (height < 0.0) {
      EXPECT_GT(glm::mat3_cast(bodies.result()[0].motion.orientation)[1].y, 0.99);
    }
  }
}

// A hundred bodies of all three levels on a confused sea for two seconds: each finite, near the surface, and the same
// to the bit on one thread and on all. Control seen: scratch memory shared among bodies.
TEST(BodiesHard, hard_28_a_hundred_in_Parallel) {
  FormulaWater water;
  for (int n = 0; n < 8; ++n)
    water.waves.push_back({0.3, 4.0 + 7.0 * n, {std::cos(0.7 * n), std::sin(0.7 * n)}, 1.3 * n});
  std::vector<BodySpec> specs;
  for (int n = 0; n < 100; ++n) {
    specs.push_back(crate(0.1 * rho * (1 + n % 9)));
    specs.back().at_m = {7.0 * (n % 10), 0.0, 7.0 * (n / 10)};
    specs.back().level = BodyLevel(n % 3);
  }
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Bodies bodies({}, specs);
    for (int n = 0; n < 120; ++n) bodies.step((n + 1) / 60.0, 1.0 / 60.0, water);
    for (const BodyState& state : bodies.result()) {
      EXPECT_FALSE(state.lost);
      EXPECT_LT(std::abs(state.motion.centre_m.y), 5.0);
    }
    return bodies.hash();
  };
  EXPECT_EQ(run(1), run(8));
}

// At 100 m/s, at 100 m/s downwards, spun at 1e4 rad/s, spinning in place on the water (boats.md, (j)), flipped at
// 30 rad/s, and teleported under water, of two densities: finite, slower from then on, and afloat in the end. Control
// seen: a quaternion that is turned to first order and not kept of length 1.
TEST(BodiesHard, hard_29_j_at_any_speed) {
  FormulaWater water;
  const glm::dvec3 speeds[] = {
      {100.0, 0.0, 0.0}, {0.0, -100.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {70.0, 0.0, -70.0}};
  const glm::dvec3 spins[] = {{0.0, 0.0, 0.0}, {1e4, 1e4, 0.0}, {0.0, 50.0, 0.0}, {30.0, 0.0, 5.0}, {1.0, 2.0, 3.0}};
  for (int n = 0; n < 10; ++n) {
    const double density = n < 5 ? 0.4 : 0.02;
    BodySpec spec = crate(density * rho);
    spec.velocity_mps = speeds[n % 5], spec.spin_rad_s = spins[n % 5];
    Bodies bodies({}, {spec});
    settles(bodies, water, 120.0, 0.5);
    BodyMotion under = bodies.result()[0].motion;
    under.centre_m = {1e5, -50.0, -1e5};
    bodies.place(0, under);
    settles(bodies, water, 90.0, 0.5);
    EXPECT_NEAR(bodies.result()[0].submerged_m3, density, 0.02) << n;
  }
}

// Heights, velocities and currents that are no numbers, water that is nowhere, and steps of any length. Control seen:
// without the check of heights the body is lost.
TEST(BodiesHard, WaterThatIsNone) {
  struct Broken : FormulaWater {
    void ask(double, double, std::span<const glm::dvec2>, std::span<WaterHere> answers) const override {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      for (WaterHere& a : answers) a = {none, glm::dvec3(none), glm::dvec2(none), 0.0, none, false};
    }
    std::optional<CalmWater> calm(double, const glm::dvec2&, double) const override { return std::nullopt; }
  };
  Bodies bodies({}, {crate(0.4 * rho)});
  settles(bodies, Broken{}, 60.0);
  EXPECT_NEAR(bodies.result()[0].submerged_m3, 0.4, 0.01);
  FormulaWater nowhere;
  nowhere.dry = true;
  BodySpec bare = crate(0.4 * rho);
  bare.drag = no_drag();
  Bodies falls({}, {bare});
  for (int n = 0; n < 60; ++n) falls.step((n + 1) / 60.0, 1.0 / 60.0, nowhere);
  EXPECT_NEAR(falls.result()[0].motion.velocity.linear.y, -g, 0.01);
  for (const double dt : {1e-300, 1e-9, 1.0, 1e3, 1e300, std::numeric_limits<double>::infinity(), 0.0, -1.0}) {
    Bodies any({}, {crate(0.4 * rho)});
    for (int n = 0; n < 10; ++n) any.step(n * 1.0, dt, FormulaWater{});
    const BodyMotion& m = any.result()[0].motion;
    EXPECT_TRUE(std::isfinite(m.centre_m.y + m.velocity.linear.y + m.orientation.w)) << dt;
  }
  Bodies times({}, {crate(0.4 * rho)});
  for (const double t : {0.0, 1e300, -1e300, std::numeric_limits<double>::quiet_NaN(), 5.0, 4.0, 1e6, 1e6 + 0.1})
    times.advance(t, FormulaWater{});
  EXPECT_TRUE(std::isfinite(times.result()[0].motion.centre_m.y));
}

// Hulls and masses that are none are refused with a word. Control seen: each check left out.
TEST(BodiesHard, UnfitBodiesAreRefused) {
  const auto refused = [](const char* what, const auto& spoil) {
    BodySpec spec = crate(0.5 * rho);
    HullMesh mesh = *spec.hull;
    spoil(spec, mesh);
    spec.hull = std::make_shared<HullMesh>(mesh);
    try {
      Bodies bodies({}, {spec});
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  refused("not closed", [](BodySpec&, HullMesh& mesh) { mesh.triangles.pop_back(); });
  refused("not there", [](BodySpec&, HullMesh& mesh) { mesh.triangles[0][1] = 9999; });
  refused("no number", [](BodySpec&, HullMesh& mesh) { mesh.vertices[3].x = std::numeric_limits<double>::infinity(); });
  refused("encloses nothing", [](BodySpec&, HullMesh& mesh) {
    for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  });
  refused("mass_kg", [](BodySpec& spec, HullMesh&) { spec.mass.mass_kg = 0.0; });
  refused("inertia", [](BodySpec& spec, HullMesh&) { spec.mass.inertia_kg_m2 = glm::dmat3(0.0); });
  refused("symmetric", [](BodySpec& spec, HullMesh&) { spec.mass.added.rows[0][1] = 5.0; });
  refused("symmetric", [](BodySpec& spec, HullMesh&) { spec.damping.rows[2][2] = -5.0; });
}

}  // namespace
}  // namespace seascape
