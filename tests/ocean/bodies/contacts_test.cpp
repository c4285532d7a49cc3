// Bodies that run into each other, into piers and the land, and that lie at their lines.
#include "ocean/bodies/contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/error.h"
#include "tests/support/body_waves.h"

namespace seascape {
namespace {

using namespace test;

// Half in the water, with added mass that is its own along each axis, so that it spins as it likes.
BodySpec tub(const glm::dvec3& at, const glm::dvec3& velocity, double density = 0.5 * rho) {
  BodySpec spec = even_body(box_hull({1.0, 1.0, 2.0}, 2), density);
  const double m = spec.mass.mass_kg;
  spec.mass.added = Matrix6::diagonal({0.4 * m, 0.4 * m, 0.4 * m, 0.0, 0.3 * spec.mass.inertia_kg_m2[1][1], 0.0});
  spec.at_m = at, spec.velocity_mps = velocity;
  return spec;
}

// Momentum of bodies and of the water that goes with them, its moment about the origin, and the energy.
struct Books {
  glm::dvec3 linear{0.0}, angular{0.0};
  double energy = 0.0;
  void add(const BodyMotion& motion, const BodyMass& mass, const Vector6& velocity) {
    const glm::dmat3 axes = glm::mat3_cast(motion.orientation);
    const Vector6 p = (rigid_mass(mass, axes) + turned(mass.added, axes)) * velocity;
    linear += p.linear, angular += p.angular + glm::cross(motion.centre_m, p.linear);
    energy += 0.5 * dot(velocity, p);
  }
};

// Two boxes meet head-on and glancing, with added mass that couples, bouncing and not, with friction and without, as
// heavy as each other and three times: they part, their momentum and its moment stay within 1e-6 and energy never
// grows. Controls seen: the impulse on one of them alone; masses without what they take of the water; a bounce of 1.3.
TEST(Contacts, MomentumIsKept) {
  for (const double glancing : {0.0, 0.4, 0.9})
    for (const double restitution : {0.0, 0.5, 1.0})
      for (const double heavier : {1.0, 3.0}) {
        ContactSettings settings;
        settings.restitution = restitution, settings.friction = restitution > 0.7 ? 0.0 : 0.4;
        BodySpec specs[] = {tub({}, {}), tub({}, {}, 0.5 * rho * heavier)};
        for (BodySpec& spec : specs) {
          if (glancing == 0.0) continue;  // straight ahead
          spec.mass.added.rows[0][0] *= 2.0;
          spec.mass.added.rows[0][4] = spec.mass.added.rows[4][0] = 0.05 * spec.mass.mass_kg;
        }
        const HullMesh hulls[] = {*specs[0].hull, *specs[1].hull};
        const glm::dvec3 centres[] = {glm::dvec3(0.0), glm::dvec3(0.0)};
        Contacts contacts(settings, hulls, centres);
        BodyMotion motions[2];
        motions[0].centre_m.z = -2.0, motions[0].velocity.linear.z = 2.0;
        motions[1].centre_m = {glancing, 0.0, 2.0}, motions[1].velocity.linear.z = -1.0;
        double hit = 0.0, parts = 0.0;
        for (int n = 0; n < 180; ++n) {
          for (int i = 0; i < 2; ++i) drift(motions[i], specs[i].mass, 1.0, {}, 1.0 / 60.0);
          const Vector6 before[] = {motions[0].velocity, motions[1].velocity};
          Collider colliders[] = {{{&motions[0], &specs[0].mass, 1.0}}, {{&motions[1], &specs[1].mass, 1.0}}};
          ContactImpulses impulses[2];
          contacts.step(1.0 / 60.0, colliders, impulses);
          Books had, has;
          for (int i = 0; i < 2; ++i) {
            had.add(motions[i], specs[i].mass, before[i]);
            has.add(motions[i], specs[i].mass, motions[i].velocity);
          }
          ASSERT_LE(has.energy, had.energy * (1.0 + 1e-11)) << n;
          ASSERT_LT(glm::length(has.linear - had.linear), 1e-9 * (glm::length(had.linear) + 1.0));
          ASSERT_LT(glm::length(has.angular - had.angular), 1e-9 * (glm::length(had.angular) + 1.0));
          EXPECT_EQ(impulses[0].hit_ns, impulses[1].hit_ns);
          if (impulses[0].hit_ns > 0.0 && parts == 0.0)
            parts = motions[1].velocity.linear.z - motions[0].velocity.linear.z;
          hit += impulses[0].hit_ns;
        }
        EXPECT_GT(hit, 100.0);
        EXPECT_GT(glm::length(motions[1].centre_m - motions[0].centre_m), glancing > 0.0 ? 0.95 : 1.98);
        if (glancing == 0.0) {
          EXPECT_GE(motions[1].velocity.linear.z - motions[0].velocity.linear.z, -1e-6);
          EXPECT_NEAR(parts, 3.0 * restitution, 0.05);
        }
      }
}

// Boxes dropped onto each other on a pier come to rest, three high, and lie still: in 100 seconds none moves by a
// millimetre, and none has more than a hundredth of a metre a second. Control seen: a single sweep of the solver (they
// wander by 0.1 m).
TEST(Contacts, AStackLiesStill) {
  ContactSettings settings;
  settings.still = {{"pier", box_hull({6.0, 1.0, 6.0}), {0.0, 4.5, 0.0}}};  // its top is at 5 m
  std::vector<BodySpec> specs;
  for (int n = 0; n < 3; ++n) specs.push_back(even_body(box_hull({1.0, 0.5, 1.0}), 200.0, 5.27 + 0.52 * n));
  Bodies bodies({}, specs, settings);
  const auto run = [&](double from, double to, auto&& each) {
    for (int n = int(from * 60.0); n < int(to * 60.0); ++n) {
      bodies.step((n + 1) / 60.0, 1.0 / 60.0, FormulaWater{});
      for (std::size_t body = 0; body < 3; ++body) each(bodies.result()[body], body);
    }
  };
  run(0.0, 20.0, [](const BodyState&, std::size_t) {});
  std::vector<BodyState> rest = bodies.result();
  run(20.0, 120.0, [&](const BodyState& state, std::size_t body) {
    ASSERT_LT(glm::length(state.motion.centre_m - rest[body].motion.centre_m), 1e-3);
    ASSERT_LT(glm::length(state.motion.velocity.linear), 0.01);
    ASSERT_LT(glm::length(state.motion.velocity.angular), 0.01);
  });
  for (std::size_t n = 0; n < 3; ++n)
    EXPECT_NEAR(bodies.result()[n].motion.centre_m.y, 5.25 + 0.5 * double(n), 0.03 * double(n + 1));
}

// A boat dropped on a beach slides, settles and stays, dry, on its slope of 1 in 10; without friction it slides on
// into the water and floats. Control seen: no friction of the ground.
TEST(Contacts, ABeachHoldsABoat) {
  for (const double friction : {0.5, 0.0}) {
    ContactSettings settings;
    settings.ground_friction = friction;
    settings.land = [](std::span<const glm::dvec2> places, std::span<double> heights) {
      for (std::size_t n = 0; n < places.size(); ++n) heights[n] = -0.1 * places[n].y;  // it falls to +z
    };
    BodySpec spec = even_body(wigley_hull(4.0, 1.4, 0.4, 0.3, 10, 4), 0.35 * rho);
    spec.drag = HullDrag{};
    const double m = spec.mass.mass_kg;
    spec.damping = Matrix6::diagonal({0.1 * m, m, 0.1 * m, m, m, 0.4 * m});
    spec.at_m = {0.0, 3.0, -10.0}, spec.velocity_mps = {0.0, -3.0, 1.0};
    Bodies bodies({}, {spec}, settings);
    double most = 0.0, ground = 0.0;
    for (int n = 0; n < 60 * 40; ++n) {
      bodies.step((n + 1) / 60.0, 1.0 / 60.0, FormulaWater{});
      const BodyState& state = bodies.result()[0];
      ASSERT_FALSE(state.lost);
      ground += state.contact.ground_ns;
      ASSERT_GT(state.motion.centre_m.y, -0.1 * state.motion.centre_m.z - 0.1) << n;
      if (n > 60 * 38) most = std::max(most, glm::length(state.motion.velocity.linear));
    }
    EXPECT_GT(ground, m);
    if (friction > 0.0) {
      EXPECT_LT(most, 0.02);
      EXPECT_LT(bodies.result()[0].motion.centre_m.z, -5.0);
      EXPECT_EQ(bodies.result()[0].submerged_m3, 0.0);
    } else {
      EXPECT_GT(bodies.result()[0].motion.centre_m.z, 2.0);
      EXPECT_GT(bodies.result()[0].submerged_m3, 0.1);
    }
  }
}

// At a line of 8 m a boat in wind and current of 1.5 m/s goes no further than the line and its stretch, hangs still at
// its end, and pulls as hard as the current; slack it is as free as without. Lines as stiff as steel do not swing it.
// Controls seen: a line that pushes too; a force at the step's beginning instead of its end (steel tears it away).
TEST(Contacts, AMooredBoatStays) {
  for (const double stiffness : {2e3, 1e5, 1e12}) {
    FormulaWater water;
    water.current_mps = {0.0, 1.5};
    BodySettings wind;
    wind.media.wind_mps = {0.0, 0.0, 8.0};
    ContactSettings settings;
    settings.lines = {{0, {0.0, 0.0, -1.0}, {0.0, 0.0, -3.0}, 8.0, stiffness, 500.0}};
    BodySpec spec = tub({0.0, 0.0, 0.0}, {});
    spec.drag = HullDrag{};
    const double m = spec.mass.mass_kg;
    spec.damping = Matrix6::diagonal({0.0, m, 0.0, m, 0.3 * m, m});
    Bodies bodies(wind, {spec, spec}, settings);
    BodyMotion aside = bodies.result()[1].motion;
    aside.centre_m.x = 100.0;
    bodies.place(1, aside);
    double furthest = 0.0, late_ns = 0.0;
    for (int n = 0; n < 60 * 120; ++n) {
      bodies.step((n + 1) / 60.0, 1.0 / 60.0, water);
      const BodyState& state = bodies.result()[0];
      const glm::dvec3 end = state.at_m + state.motion.orientation * glm::dvec3(0.0, 0.0, -1.0);
      furthest = std::max(furthest, glm::length(end - glm::dvec3(0.0, 0.0, -3.0)));
      if (n < 60 * 3) {
        EXPECT_EQ(state.motion.velocity.linear.z, bodies.result()[1].motion.velocity.linear.z) << n;
      }
      ASSERT_GE(state.contact.lines_ns, 0.0);
      if (n >= 60 * 110) late_ns += state.contact.lines_ns / 10.0;
    }
    EXPECT_LT(furthest, 8.0 + 2.0 * std::sqrt(1.4 * m / stiffness) + 0.01) << stiffness;
    EXPECT_LT(glm::length(bodies.result()[0].motion.velocity.linear), 0.05) << stiffness;
    const double current = 0.5 * rho * 1.5 * 1.5 * 0.5 * 1.0, air = 0.5 * 1.2 * 64.0 * 0.5 * 0.8;
    EXPECT_NEAR(late_ns / (current + air), 1.0, 0.15) << stiffness;
    EXPECT_GT(bodies.result()[1].motion.centre_m.z, 100.0);
    bodies.moor({});
    for (int n = 0; n < 600; ++n) bodies.step(120.0 + (n + 1) / 60.0, 1.0 / 60.0, water);
    EXPECT_GT(bodies.result()[0].motion.velocity.linear.z, 1.0);
  }
}

// Two boats part on a line that leads from one to the other, taut at once, askew and as stiff as steel: momentum and
// its moment stay within 1e-9, there is never more energy than at first, and they part no farther than the line. Slack
// it takes nothing, and one that is asleep is woken by it. Controls seen: the pull on the first alone; on the second
// where the line begins.
TEST(Contacts, ALineHoldsTwoBodies) {
  for (const double stiffness : {2e3, 1e5, 1e9})
    for (const double heavier : {1.0, 4.0}) {
      ContactSettings settings;
      MooringLine line{0, {0.3, 0.2, 1.0}, {-0.4, 0.1, -1.0}, 3.0, stiffness, 800.0};
      line.other = 1;
      settings.lines = {line};
      BodySpec specs[] = {tub({}, {}), tub({}, {}, 0.5 * rho * heavier)};
      for (BodySpec& spec : specs) spec.mass.added = {};  // so that its momentum is its own, however it turns
      const HullMesh hulls[] = {*specs[0].hull, *specs[1].hull};
      const glm::dvec3 centres[] = {glm::dvec3(0.0), glm::dvec3(0.0)};
      Contacts contacts(settings, hulls, centres);
      BodyMotion motions[2];
      motions[0].velocity.linear = {0.1, 0.0, -1.0};
      motions[1].centre_m = {0.5, 0.3, 4.0}, motions[1].velocity.linear = {0.0, 0.2, 0.8};
      double pulled = 0.0, farthest = 0.0, begun = 0.0;
      for (int n = 0; n < 300; ++n) {
        for (int i = 0; i < 2; ++i) drift(motions[i], specs[i].mass, 0.0, {}, 1.0 / 60.0);
        const Vector6 before[] = {motions[0].velocity, motions[1].velocity};
        Collider colliders[] = {{{&motions[0], &specs[0].mass, 0.0}}, {{&motions[1], &specs[1].mass, 0.0}, n == 0}};
        ContactImpulses impulses[2];
        contacts.step(1.0 / 60.0, colliders, impulses);
        Books had, has;
        for (int i = 0; i < 2; ++i) {
          had.add(motions[i], specs[i].mass, before[i]);
          has.add(motions[i], specs[i].mass, motions[i].velocity);
        }
        ASSERT_LT(glm::length(has.linear - had.linear), 1e-9 * (glm::length(had.linear) + 1.0)) << n;
        ASSERT_LT(glm::length(has.angular - had.angular), 1e-9 * (glm::length(had.angular) + 1.0)) << n;
        const double distance = glm::length(motions[1].centre_m + motions[1].orientation * line.to_m -
                                            motions[0].centre_m - motions[0].orientation * line.from_m);
        if (n == 0) begun = had.energy;
        ASSERT_LE(has.energy, begun * (1.0 + 1e-9)) << n;
        EXPECT_EQ(impulses[0].lines_ns, impulses[1].lines_ns);
        EXPECT_NEAR(contacts.tensions_n()[0], impulses[0].lines_ns * 60.0, 1e-6 * (1.0 + impulses[0].lines_ns));
        if (impulses[0].lines_ns > 0.0) {
          EXPECT_FALSE(colliders[1].asleep);
        } else if (n == 0) {
          EXPECT_TRUE(colliders[1].asleep);
        }
        pulled += impulses[0].lines_ns, farthest = std::max(farthest, distance);
      }
      EXPECT_GT(pulled, 500.0);
      const double m = specs[0].mass.mass_kg;
      EXPECT_LT(farthest, 3.0 + 2.0 * std::sqrt(heavier * m / stiffness) + 0.05) << stiffness;
    }
}

// At 100 m/s against a wall 0.2 m thick, a hatch of 0.3 m and a boat that first runs another down: none comes through,
// and all stay finite and come to rest. Control seen: places looked for at the step's end alone (the hatch is beyond).
TEST(Contacts, NothingComesThroughAWall) {
  for (const bool hatch : {true, false}) {
    ContactSettings settings;
    settings.still = {{"wall", box_hull({20.0, 12.0, 0.2}), {0.0, 0.0, 6.0}}};
    BodySpec ram = tub({0.0, 0.0, 0.0}, {3.0, 0.0, 100.0});
    if (hatch) ram = even_body(box_hull({1.0, 1.0, 0.3}), 0.5 * rho);
    ram.velocity_mps = {3.0, 0.0, 100.0}, ram.at_m.y = hatch ? 3.0 : 0.0;  // through the air
    ram.drag = HullDrag{};
    const double m = ram.mass.mass_kg;
    ram.damping = Matrix6::diagonal({m, m, m, m, m, m});
    std::vector<BodySpec> specs{ram};
    if (!hatch) {
      specs.push_back(ram);
      specs[1].velocity_mps = {}, specs[1].at_m = {0.3, 0.0, 3.2};
    }
    Bodies bodies({}, specs, settings);
    for (int n = 0; n < 60 * 60; ++n) {
      bodies.step((n + 1) / 60.0, 1.0 / 60.0, FormulaWater{});
      for (const BodyState& state : bodies.result()) {
        ASSERT_FALSE(state.lost);
        ASSERT_LT(state.motion.centre_m.z, 6.0) << n;
        ASSERT_LT(std::abs(state.motion.centre_m.y), 10.0) << n;
      }
    }
    for (const BodyState& state : bodies.result()) EXPECT_LT(glm::length(state.motion.velocity.linear), 0.05);
  }
}

// Between two hulls that a current and a pier press together a small boat lies still, whatever is the heavier.
// Control seen: a single sweep of the solver.
TEST(Contacts, BetweenTwoHulls) {
  for (const double density : {20.0, 0.5 * rho, 0.9 * rho}) {
    FormulaWater water;
    water.current_mps = {0.0, 0.5};
    ContactSettings settings;
    settings.still = {{"pier", box_hull({20.0, 4.0, 1.0}), {0.0, 0.0, 4.5}}};
    std::vector<BodySpec> specs;
    for (int n = 0; n < 3; ++n) {
      specs.push_back(tub({0.1 * n, 0.0, 2.9 - 2.2 * n}, {}, n == 1 ? density : 0.5 * rho));
      specs.back().drag = HullDrag{};
      const double m = specs.back().mass.mass_kg;
      specs.back().damping = Matrix6::diagonal({m, 2.0 * m, 0.0, m, m, m});
    }
    Bodies bodies({}, specs, settings);
    double fastest = 0.0;
    for (int n = 0; n < 60 * 60; ++n) {
      bodies.step((n + 1) / 60.0, 1.0 / 60.0, water);
      for (const BodyState& state : bodies.result()) {
        ASSERT_FALSE(state.lost);
        if (n > 60 * 55) fastest = std::max(fastest, glm::length(state.motion.velocity.linear));
      }
      ASSERT_LT(bodies.result()[0].motion.centre_m.z, 3.04);
    }
    EXPECT_LT(fastest, 0.05) << density;
    for (std::size_t n = 0; n < 2; ++n)
      EXPECT_GT(bodies.result()[n].motion.centre_m.z - bodies.result()[n + 1].motion.centre_m.z, 0.9) << density;
  }
}

// What sleeps wakes when it is run into, and goes on sleeping beside what only lies near. Control seen: pairs of which
// one sleeps left out.
TEST(Contacts, SleepersAreWokenByAHit) {
  BodySpec spec = tub({}, {});
  spec.drag = HullDrag{};
  const double m = spec.mass.mass_kg;
  spec.damping = Matrix6::diagonal({0.1 * m, m, 0.1 * m, m, m, m});
  BodySpec comes = spec;
  comes.at_m.z = -5.0;
  Bodies bodies({}, {spec, comes}, ContactSettings{});
  int n = 0;
  const auto run = [&](double seconds) {
    for (const int end = n + int(seconds * 60.0); n < end; ++n) bodies.step((n + 1) / 60.0, 1.0 / 60.0, FormulaWater{});
  };
  run(20.0);
  EXPECT_TRUE(bodies.result()[0].asleep && bodies.result()[1].asleep);
  bodies.hit(1, {0.0, 0.0, 3.0 * m}, bodies.result()[1].motion.centre_m);
  run(0.5);
  EXPECT_TRUE(bodies.result()[0].asleep);
  double met = 0.0;
  for (int k = 0; k < 60 * 20 && met == 0.0; ++k) {
    run(0.017);
    met = bodies.result()[0].contact.hit_ns;
  }
  EXPECT_GT(met, 0.0);
  EXPECT_FALSE(bodies.result()[0].asleep);
  EXPECT_GT(bodies.result()[0].motion.velocity.linear.z, 0.05);
}

// Unfit colliders and lines are refused with a word. Control seen: each check left out.
TEST(Contacts, UnfitOnesAreRefused) {
  const auto refused = [](const char* what, const auto& spoil) {
    ContactSettings settings;
    settings.still = {{"pier", box_hull({1.0, 1.0, 1.0}), {9.0, 0.0, 0.0}}};
    settings.lines = {{0, {}, {}, 3.0}};
    spoil(settings);
    try {
      Bodies bodies({}, {tub({}, {})}, settings);
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  refused("not closed", [](ContactSettings& s) { s.still[0].mesh.triangles.pop_back(); });
  refused("pose", [](ContactSettings& s) { s.still[0].orientation = {0.0, 0.0, 0.0, 0.0}; });
  refused("not there", [](ContactSettings& s) { s.lines[0].body = 1; });
  refused("to itself", [](ContactSettings& s) { s.lines[0].other = 0; });
  refused("no number", [](ContactSettings& s) { s.lines[0].to_m.x = std::nan(""); });
  refused("out of range", [](ContactSettings& s) { s.lines[0].stiffness_n_m = 0.0; });
}

}  // namespace
}  // namespace seascape
