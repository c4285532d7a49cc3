// A rigid body with added mass: Kirchhoff's motion keeps its books, added mass has no weight, and what is entered
// slows a body by what it takes and no more.
#include "ocean/bodies/rigid_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/body_waves.h"

namespace seascape {
namespace {

using namespace test;

BodyMass odd_mass() {
  BodyMass mass{50.0, glm::dmat3(8.0, 0.5, 0.2, 0.5, 12.0, -0.3, 0.2, -0.3, 5.0), {}};
  mass.added = Matrix6::diagonal({20.0, 90.0, 60.0, 3.0, 2.0, 9.0});
  const auto couple = [&](std::size_t i, std::size_t j, double value) {
    mass.added.rows[i][j] = mass.added.rows[j][i] = value;
  };
  couple(0, 4, 2.0), couple(1, 3, -5.0), couple(1, 5, 8.0), couple(2, 3, 4.0);
  return mass;
}

// Without forces the energy and the momentum of body and water stay over 10,000 steps, for added masses larger than
// the body's own and coupled (boats.md, hard cases (c) and (d): v.C(v) v = 0). Control seen: without the Munk moment
// p x v (a fiftieth of the energy is left).
TEST(RigidBody, d_KirchhoffKeepsItsBooks) {
  const BodyMass mass = odd_mass();
  BodyMotion m;
  m.velocity = {{3.0, -1.0, 2.0}, {0.7, 1.5, -0.4}};
  const auto momentum = [&] {
    return turned(mass.added, glm::mat3_cast(m.orientation)) * m.velocity +
           rigid_mass(mass, glm::mat3_cast(m.orientation)) * m.velocity;
  };
  const double energy = kinetic_energy(m, mass, 1.0);
  const Vector6 first = momentum();
  for (int i = 0; i < 10000; ++i) drift(m, mass, 1.0, {}, 1.0 / 240.0);
  EXPECT_NEAR(kinetic_energy(m, mass, 1.0) / energy, 1.0, 1e-9);
  EXPECT_LT(glm::length(momentum().linear - first.linear), 0.02 * glm::length(first.linear));
  EXPECT_NEAR(glm::length(momentum().linear) / glm::length(first.linear), 1.0, 1e-9);
  EXPECT_NEAR(glm::length(m.orientation), 1.0, 1e-14);
}

// In a current the same motion is carried along, to rounding. Control seen: Coriolis terms of the velocity over ground.
TEST(RigidBody, ACurrentCarriesAll) {
  const BodyMass mass = odd_mass();
  const glm::dvec3 current{1.5, 0.0, -2.0};
  BodyMotion still, carried;
  still.velocity = {{3.0, -1.0, 2.0}, {0.7, 1.5, -0.4}};
  carried.velocity = still.velocity + Vector6{current, {}};
  for (int i = 0; i < 600; ++i) {
    drift(still, mass, 1.0, {}, 1.0 / 60.0);
    drift(carried, mass, 1.0, current, 1.0 / 60.0);
  }
  EXPECT_LT(glm::length(carried.centre_m - still.centre_m - 10.0 * current), 1e-9);
  EXPECT_LT(glm::length(carried.velocity.angular - still.velocity.angular), 1e-9);
}

// Damping as stiff as one likes brings a body to rest within a step and never beyond, for any mass and step. Control
// seen: the resistance taken at the step's beginning.
TEST(RigidBody, DampingIsNeverTooStiff) {
  for (const double kg : {1e-3, 1.0, 1e6})
    for (const double rate : {1e-2, 1.0, 1e9})
      for (const double dt : {1e-4, 1.0 / 60.0, 10.0}) {
        const BodyMass mass{kg, glm::dmat3(kg), {}};
        BodyMotion m;
        m.velocity = {{1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}};
        const double before = dot(m.velocity, m.velocity);
        kick(m, mass, 0.0, {}, Matrix6::diagonal({rate, rate, rate, rate, rate, rate}), dt);
        EXPECT_LE(dot(m.velocity, m.velocity), before * (1.0 + 1e-12));
        EXPECT_GE(m.velocity.linear.x, 0.0);
      }
}

// Coming into the water keeps (m + a) V, of what goes down alone, and takes no more than there was; what leaves keeps
// its velocity (boats.md, hard case (e): slamming as a brake). Controls seen: momentum kept on leaving too, and the
// speed along the water slowed (a boat at 10 m/s in chop loses its way).
TEST(RigidBody, e_SlammingTakesOnlyWhatItMay) {
  BodyMass mass{100.0, glm::dmat3(50.0), {}};
  mass.added = Matrix6::diagonal({10.0, 300.0, 20.0, 40.0, 40.0, 40.0});
  BodyMotion m;
  m.velocity = {{0.0, -4.0, 10.0}, {}};
  for (int i = 0; i < 10; ++i) slam(m, mass, 0.1 * i, 0.1 * (i + 1), {});
  EXPECT_NEAR(m.velocity.linear.y, -1.0, 1e-12);
  EXPECT_EQ(m.velocity.linear.z, 10.0);
  slam(m, mass, 1.0, 0.2, {});
  EXPECT_NEAR(m.velocity.linear.y, -1.0, 1e-12);
  m.velocity.linear.y = 2.0;  // up: it comes out of the water, whatever wets it
  slam(m, mass, 0.0, 1.0, {});
  EXPECT_EQ(m.velocity.linear.y, 2.0);
  for (int n = 0; n < 100; ++n) {  // with coupled masses too the body's own energy never grows
    const auto of = [&](int i) { return std::sin(3.7 * n + 1.3 * i); };
    const BodyMass odd = odd_mass();
    BodyMotion tilted;
    tilted.orientation = glm::normalize(glm::dquat(of(0), of(1), of(2), of(3)));
    tilted.velocity = {{of(4), -std::abs(of(5)) - 0.01, of(6)}, {of(7), of(8), of(9)}};
    const double before = kinetic_energy(tilted, odd, 0.0);
    slam(tilted, odd, 0.0, 1.0, {});
    EXPECT_LE(kinetic_energy(tilted, odd, 0.0), before * (1.0 + 1e-12)) << n;
  }
}

// A wedge of 20 degrees dropped at 5 m/s, 100 kg a metre, without weight: V = V0 / (1 + a / m) with von Karman's added
// mass, hardest at 5/6 of V0 with 140.9 m/s2 (facts/boats.md; rho 1000), within 1 %. Control seen: added mass with the
// wetted width, not its square.
TEST(RigidBody, AWedgeEntersAsVonKarmanSays) {
  const double tangent = std::tan(20.0 * std::numbers::pi / 180.0), half = 1.0,
               full = 0.5 * std::numbers::pi * 1000.0 * half * half;
  BodyMass mass{100.0, glm::dmat3(100.0), {}};
  mass.added = Matrix6::diagonal({0.0, full, 0.0, 0.0, 0.0, 0.0});
  BodyMotion m;
  m.velocity.linear.y = -5.0;
  double depth = 0.0, share = 0.0, hardest = 0.0, at = 0.0;
  constexpr double dt = 1e-5;
  while (depth < half * tangent) {
    const double before = -m.velocity.linear.y;
    depth += before * dt;
    const double width = std::min(depth / tangent / half, 1.0), now = width * width;
    slam(m, mass, share, now, {});
    share = now;
    const double deceleration = (before + m.velocity.linear.y) / dt;
    if (deceleration > hardest) hardest = deceleration, at = before;
    EXPECT_NEAR(-m.velocity.linear.y, 5.0 / (1.0 + full * share / 100.0), 1e-9);
  }
  EXPECT_NEAR(hardest, 140.9, 1.41);
  EXPECT_NEAR(at, 5.0 * 5.0 / 6.0, 0.05);
}

}  // namespace
}  // namespace seascape
