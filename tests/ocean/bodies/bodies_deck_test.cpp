// Things that lie on the deck of others that float.
#include <gtest/gtest.h>

#include <cmath>

#include "ocean/bodies/bodies.h"
#include "tests/support/body_waves.h"

namespace seascape {
namespace {

using namespace test;

// A crate on the deck of a barge, each with a mesh to run into: on flat water and on waves it stays where it was put,
// the barge comes to lie deeper by its weight and no more, nothing is thrown about, and momentum between the two makes
// no way (boats.md, hard case (h): a collider on deck shakes the ship). Controls seen: no contacts (the crate falls
// through); half of the contact's impulse on the barge.
TEST(BodiesOnDeck, h_ACrateStaysWhereItWasPut) {
  for (const double amplitude : {0.0, 0.15}) {
    BodySpec barge = even_body(box_hull({3.0, 1.0, 8.0}, 2), 0.3 * rho);
    BodySpec crate = even_body(box_hull({0.8, 0.8, 0.8}, 2), 800.0);
    for (BodySpec* spec : {&barge, &crate}) {
      spec->drag = HullDrag{};
      const double m = spec->mass.mass_kg;
      const glm::dmat3& i = spec->mass.inertia_kg_m2;
      spec->mass.added = Matrix6::diagonal({m, m, 0.5 * m, i[0][0], i[1][1], 0.3 * i[2][2]});
      spec->damping = Matrix6::diagonal({m, 3.0 * m, m, 3.0 * i[0][0], i[1][1], 3.0 * i[2][2]});
    }
    const double alone = 0.3, load = crate.mass.mass_kg / (rho * 3.0 * 8.0);
    barge.at_m.y = 0.5 - alone - load;
    crate.at_m = {0.0, barge.at_m.y + 0.5 + 0.4 + 0.002, 0.6};
    FormulaWater water;
    if (amplitude > 0.0) water.waves = {{amplitude, 18.0, {0.6, 0.8}}};
    Bodies bodies({}, {barge, crate}, ContactSettings{});
    double fastest = 0.0, height = 0.0, strayed = 0.0, lifted = 0.0;
    int count = 0;
    for (int n = 1; n <= 60 * 20; ++n) {
      bodies.step(n / 60.0, 1.0 / 60.0, water);
      const BodyState &under = bodies.result()[0], &over = bodies.result()[1];
      ASSERT_FALSE(under.lost || over.lost);
      const glm::dvec3 on = glm::conjugate(under.motion.orientation) * (over.at_m - under.at_m);
      strayed = std::max(strayed, std::hypot(on.x, on.z - 0.6));
      lifted = std::max(lifted, std::abs(on.y - 0.9));
      if (n > 60 * 5)
        height += under.at_m.y, ++count, fastest = std::max(fastest, glm::length(under.motion.velocity.linear));
    }
    EXPECT_LT(strayed, 0.2) << amplitude;
    EXPECT_LT(lifted, 0.03) << amplitude;
    EXPECT_NEAR(height / count, 0.5 - alone - load, 0.01) << amplitude;
    EXPECT_LT(fastest, amplitude == 0.0 ? 0.01 : 0.6) << amplitude;
    if (amplitude == 0.0) {
      EXPECT_LT(std::hypot(bodies.result()[0].at_m.x, bodies.result()[0].at_m.z), 0.02);
    }
  }
}

}  // namespace
}  // namespace seascape
