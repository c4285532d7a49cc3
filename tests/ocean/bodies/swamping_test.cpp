// Water that comes over a gunwale: how fast, where it lies, what it does to the boat, and what is bailed.
#include "ocean/bodies/swamping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/error.h"
#include "tests/support/body_waves.h"

namespace seascape {
namespace {

using namespace test;

// A box of 1.4 x 0.8 x 3 with an inside of 1.2 x 0.7 x 2.8, open above: 2.352 of its 3.36 m3.
constexpr double outer_m3 = 1.4 * 0.8 * 3.0, inner_m3 = 1.2 * 0.7 * 2.8;
std::shared_ptr<const HullMesh> inner() {
  return std::make_shared<HullMesh>(moved(box_hull({1.2, 0.7, 2.8}), {0.0, 0.05, 0.0}));
}
BodySpec open_boat(double kg) {
  BodySpec spec = even_body(box_hull({1.4, 0.8, 3.0}, 2), kg / outer_m3, 0.4 - kg / (rho * 4.2));
  const double m = spec.mass.mass_kg;
  spec.mass.added = Matrix6::diagonal({0.1 * m, 0.8 * m, 0.4 * m, 0.3 * m, 0.3 * m, 0.1 * m});
  spec.damping = Matrix6::diagonal({0.3 * m, 1.5 * m, 0.3 * m, 1.5 * m, 0.5 * m, 0.4 * m});
  spec.drag = HullDrag{};
  spec.inside.hull = inner();
  return spec;
}
void run(Bodies& bodies, double seconds, const BodyWater& water, const glm::dvec3& push = glm::dvec3(0.0),
         const glm::dvec3& from = glm::dvec3(0.0)) {
  for (int n = 0; n < int(seconds * 60.0); ++n) {
    if (push != glm::dvec3(0.0)) bodies.push(0, push, bodies.result()[0].motion.centre_m + from);
    bodies.step((n + 1) / 60.0, 1.0 / 60.0, water);
    ASSERT_FALSE(bodies.result()[0].lost);
  }
}

// Water in a box lies level at any heel: its volume below the level is what was poured in, to 1e-8, and heeled its
// centre moves to the low side by i tan / V (a box's own closed form). Control seen: a centre from a point of its
// level.
TEST(Swamping, APoolLiesLevel) {
  const Inside inside({inner()}, glm::dvec3(0.0), "boat");
  EXPECT_NEAR(inside.volume_m3(), inner_m3, 1e-9);
  for (const double part : {0.02, 0.3, 0.5, 0.9, 1.0})
    for (const double heel : {0.0, 0.1, 1.0, 2.0, 3.0}) {
      const glm::dmat3 to_world = about(glm::normalize(glm::dvec3(0.3, 0.0, 1.0)), heel);
      const Inside::Pool pool = inside.pool(to_world, part * inner_m3);
      const HullMesh mesh = *inner();
      EXPECT_NEAR(below_level(mesh, to_world, pool.level_m).volume_m3, part * inner_m3, 1e-8);
      EXPECT_LT(pool.centre_m.y, pool.level_m);
    }
  const double filled = 0.4 * inner_m3, heel = 0.05;
  const Inside::Pool still = inside.pool(glm::dmat3(1.0), filled);
  EXPECT_NEAR(still.level_m, -0.3 + 0.4 * 0.7, 1e-8);
  EXPECT_NEAR(still.centre_m.y, -0.3 + 0.2 * 0.7, 1e-8);
  const glm::dmat3 to_world = about({0.0, 0.0, 1.0}, heel);
  const glm::dvec3 in_boat = glm::transpose(to_world) * inside.pool(to_world, filled).centre_m;
  const double second = 2.8 * 1.2 * 1.2 * 1.2 / 12.0;
  EXPECT_NEAR(in_boat.x, -second * std::tan(heel) / filled, 1e-6);
}

// The gunwale is a weir: with water h over it 2/3 mu b sqrt(2 g) h^(3/2) comes in (Poleni 1717), nothing where both
// sides are as high, and as much runs out again (Villemonte 1947). Upside down in the water the air stays. Controls
// seen: h to the first power; air that leaves downwards.
TEST(Swamping, TheGunwaleIsAWeir) {
  const Inside inside({inner()}, glm::dvec3(0.0), "boat");
  WaterPatch water;
  water.ask(FormulaWater{}, 0.0, {}, 6);
  const double gunwale = 2.0 * (1.2 + 2.8);
  const auto flow = [&](double head, double filled, const glm::dmat3& turn = glm::dmat3(1.0)) {
    const BodyPose pose{{0.0, -0.4 - head, 0.0}, turn};
    return inside.flow_m3_s(pose, water, inside.pool(turn, filled), filled, g);
  };
  for (const double h : {0.01, 0.1, 0.3})
    EXPECT_NEAR(flow(h, 0.0) / (2.0 / 3.0 * 0.62 * gunwale * std::sqrt(2.0 * g) * std::pow(h, 1.5)), 1.0, 1e-9) << h;
  EXPECT_EQ(flow(-0.05, 0.5 * inner_m3), 0.0);
  EXPECT_GT(flow(0.1, 0.9 * inner_m3), 0.0);
  const glm::dmat3 heeled = about({0.0, 0.0, 1.0}, 0.8), over = about({0.0, 0.0, 1.0}, std::numbers::pi);
  EXPECT_LT(flow(-2.0, 0.9 * inner_m3, heeled), -0.1);  // high above the water it pours out over the low side
  EXPECT_EQ(inside.flow_m3_s({{0.0, 0.2, 0.0}, over}, water, {}, 0.0, g), 0.0);
  EXPECT_LT(inside.flow_m3_s({{0.0, 2.0, 0.0}, over}, water, inside.pool(over, 1.0), 1.0, g), -0.1);
}

// Pressed under for ten seconds a boat fills. With 900 kg more than her reserve she sinks; with less she floats awash,
// where what she and her water displace is what both weigh. Never pressed under she stays dry. Control seen: water
// without weight (she comes up again).
TEST(Swamping, SheFillsAndSinksOrFloatsByHerReserve) {
  const double reserve = rho * (outer_m3 - inner_m3);
  for (const double kg : {0.6 * reserve, 1.4 * reserve})
    for (const bool pressed_under : {true, false}) {
      Bodies bodies({}, {open_boat(kg)});
      if (pressed_under) run(bodies, 10.0, FormulaWater{}, {0.0, -3e4, 0.0});
      run(bodies, 90.0, FormulaWater{});
      const BodyState& state = bodies.result()[0];
      if (!pressed_under) {
        EXPECT_EQ(state.filled_m3, 0.0);
        EXPECT_NEAR(state.submerged_m3, kg / rho, 1e-3);
      } else if (kg > reserve) {
        EXPECT_LT(state.motion.centre_m.y, -20.0);
        EXPECT_NEAR(state.filled_m3, inner_m3, 1e-6);
      } else {
        EXPECT_GT(state.motion.centre_m.y, -1.0);
        EXPECT_GT(state.filled_m3, 0.6 * inner_m3);
        EXPECT_NEAR(state.submerged_m3, kg / rho + state.filled_m3, 0.01);
      }
    }
}

// What is bailed is gone after as long as it takes, and she is at her draught again. Control seen: bailing by the
// volume for its mass.
TEST(Swamping, BailingEmptiesHer) {
  BodySpec spec = open_boat(600.0);
  spec.inside.bail_kg_s = 20.0;
  Bodies bodies({}, {spec});
  bodies.fill(0, 0.4);
  run(bodies, 10.0, FormulaWater{});
  EXPECT_NEAR(bodies.result()[0].filled_m3, 0.4 - 200.0 / rho, 1e-6);
  EXPECT_NEAR(bodies.result()[0].submerged_m3, 600.0 / rho + bodies.result()[0].filled_m3, 0.01);
  run(bodies, 30.0, FormulaWater{});
  EXPECT_EQ(bodies.result()[0].filled_m3, 0.0);
  EXPECT_NEAR(bodies.result()[0].submerged_m3, 600.0 / rho, 0.002);
}

// Water that can shift takes stability away: a weight to one side heels her by M / (W GM), with the metacentric height
// less i / V of the pool, within 3 %. Control seen: a pool that stays amidships.
TEST(Swamping, AFreeSurfaceHeelsHer) {
  const double kg = 1000.0, poured = 0.2, side = 60.0;
  BodySpec spec = open_boat(kg);
  spec.mass_centre_m.y = -0.2;
  Bodies bodies({}, {spec});
  bodies.fill(0, poured);
  run(bodies, 60.0, FormulaWater{}, {0.0, -side * g, 0.0}, {0.05, 0.0, 0.0});
  const double volume = (kg + side) / rho + poured, draught = volume / 4.2;
  const double pool_middle = 0.1 + 0.5 * poured / (1.2 * 2.8);
  const double moments = kg * 0.2 + rho * poured * pool_middle + side * 0.2;
  const double height =
      draught / 2.0 + 1.4 * 1.4 / (12.0 * draught) - moments / (rho * volume) - 2.8 * 1.2 * 1.2 * 1.2 / 12.0 / volume;
  const glm::dvec3 up = glm::mat3_cast(bodies.result()[0].motion.orientation)[1];
  EXPECT_NEAR(std::atan2(up.x, up.y) / (side * 0.05 / (rho * volume * height)), 1.0, 0.03);
}

// Without an inside, and with one that no water reaches, she does the same to the bit. Control seen: the water's mass
// added to the body's where there is none of it.
TEST(Swamping, DryInsidesChangeNoBit) {
  FormulaWater water;
  water.waves = {{0.1, 12.0}};
  BodySpec with = open_boat(900.0), without = with;
  without.inside = {};
  Bodies a({}, {with}), b({}, {without});
  run(a, 10.0, water), run(b, 10.0, water);
  EXPECT_EQ(a.result()[0].filled_m3, 0.0);
  EXPECT_EQ(a.hash(), b.hash());
}

// Water that comes in stood still: a boat that fills under way keeps her momentum and loses speed by what she has
// taken, and in breaking seas of any mass her numbers stay numbers. Controls seen: water that pushes, and water that
// brings as much speed as she has.
TEST(Swamping, FillingTakesSpeed) {
  BodySpec glides = open_boat(1500.0);
  glides.drag = no_drag();
  const double kg_of = 1500.0;  // added mass alike along all axes, so that nothing turns her
  glides.mass.added = Matrix6::diagonal({0.4 * kg_of, 0.4 * kg_of, 0.4 * kg_of, 0.0, 0.0, 0.0});
  glides.damping = Matrix6::diagonal({0.0, 0.0, 0.0, 50.0 * kg_of, 50.0 * kg_of, 50.0 * kg_of});
  glides.velocity_mps.z = 4.0;
  Bodies sinks({}, {glides});
  run(sinks, 5.0, FormulaWater{}, {0.0, -3e4, 0.0});
  const BodyState& state = sinks.result()[0];
  EXPECT_NEAR(state.filled_m3, inner_m3, 0.02);
  const double own = 1.4 * 1500.0;
  EXPECT_NEAR(state.motion.velocity.linear.z / (4.0 * own / (own + rho * state.filled_m3)), 1.0, 0.05);
  for (const double kg : {1.0, 900.0, 1e5}) {
    FormulaWater water;
    water.waves = {{0.7, 9.0}, {0.4, 4.0, {1.0, 0.0}}};
    BodySpec spec = open_boat(kg);
    spec.velocity_mps = {0.0, -5.0, 20.0}, spec.spin_rad_s = {3.0, 0.0, 5.0};
    Bodies bodies({}, {spec});
    run(bodies, 30.0, water);
    EXPECT_LT(glm::length(bodies.result()[0].motion.velocity.linear), 25.0) << kg;
  }
}

// Unfit insides are refused with a word. Control seen: each check left out.
TEST(Swamping, UnfitInsidesAreRefused) {
  const auto refused = [](const char* what, const InsideSpec& inside) {
    try {
      const Inside made(inside, glm::dvec3(0.0), "boat");
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  HullMesh open = *inner();
  open.triangles.pop_back();
  refused("not closed", {std::make_shared<HullMesh>(open)});
  refused("out of range", {inner(), -1.0});
  refused("out of range", {inner(), 0.0, 0.0});
}

}  // namespace
}  // namespace seascape
