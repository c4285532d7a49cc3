// Boats as they are driven: engine, rudder, sails and oars on a body in flat water.
#include "ocean/bodies/boat.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/body_waves.h"

namespace seascape {
namespace {

// A boat of 6 m on flat water.
struct Afloat {
  explicit Afloat(BoatSpec spec, const glm::dvec3& wind = glm::dvec3(0.0)) : boat(std::move(spec)) {
    BodySpec body = test::even_body(test::wigley_hull(6.0, 2.0, 0.6, 0.6, 12, 6), 0.4 * test::rho);
    body.mass_centre_m.y = -0.3;
    body.drag = HullDrag{};
    const double m = body.mass.mass_kg;
    const glm::dmat3& i = body.mass.inertia_kg_m2;
    body.mass.added = Matrix6::diagonal({m, m, 0.1 * m, 0.5 * i[0][0], i[1][1], 0.2 * i[2][2]});
    body.damping = Matrix6::diagonal({m, 2.0 * m, 0.1 * m, 2.0 * i[0][0], 2.0 * i[1][1], i[2][2]});
    BodySettings settings;
    media.wind_mps = wind;
    settings.media = media;
    bodies = std::make_unique<Bodies>(settings, std::vector<BodySpec>{body});
    run(3.0);
  }
  void run(double seconds) {
    for (int i = 0; i < int(seconds * 60.0 + 0.5); ++i) {
      time += 1.0 / 60.0;
      boat.step(*bodies, 0, water, media, time, 1.0 / 60.0);
      bodies->step(time, 1.0 / 60.0, water);
    }
  }
  const BodyState& state() const { return bodies->result()[0]; }
  double ahead_mps() const {
    return glm::dot(state().motion.velocity.linear, state().motion.orientation * glm::dvec3(0.0, 0.0, -1.0));
  }
  double to_starboard_rad_s() const { return -state().motion.velocity.angular.y; }
  HullMedia media;
  test::FormulaWater water;
  Boat boat;
  std::unique_ptr<Bodies> bodies;
  double time = 0.0;
};

BoatSpec with_engine() {
  BoatSpec spec;
  BoatEngine engine;
  engine.propeller.diameter_m = 0.4;
  engine.at_m = {0.0, -0.4, 2.4};
  engine.most_power_w = 1e4;
  spec.engine = engine;
  BoatRudder rudder;
  rudder.at_m = {0.0, -0.3, 3.0};
  spec.rudder = rudder;
  return spec;
}

// Full throttle drives her ahead to a steady speed, astern to a lower one; the propeller turns faster with more
// throttle and never takes more than the engine's power; in the air it pushes nothing. Controls seen: the power's limit
// left out; wetness left out.
TEST(Boat, GoesAheadAndAsternByItsEngine) {
  Afloat afloat(with_engine());
  afloat.boat.ask({.throttle = 1.0});
  afloat.run(40.0);
  const double speed = afloat.ahead_mps();
  EXPECT_GT(speed, 2.0);
  EXPECT_LT(speed, 8.0);
  const double turns = afloat.boat.parts().turns_per_s;
  const PropellerForce force = propeller(with_engine().engine->propeller, speed, turns);
  EXPECT_LE(2.0 * std::numbers::pi * turns * force.torque_nm, 1.02e4);
  afloat.run(5.0);
  EXPECT_NEAR(afloat.ahead_mps(), speed, 0.02);
  EXPECT_NEAR(afloat.to_starboard_rad_s(), 0.0, 1e-3) << "but for how her sides are cut";
  afloat.boat.ask({.throttle = 0.3});
  afloat.run(20.0);
  EXPECT_LT(afloat.ahead_mps(), 0.8 * speed);
  EXPECT_LT(afloat.boat.parts().turns_per_s, turns);
  afloat.boat.ask({.throttle = -1.0});
  afloat.run(30.0);
  EXPECT_LT(afloat.ahead_mps(), -0.5);

  Afloat in_air(with_engine());
  in_air.boat.ask({.throttle = 1.0});
  BodyMotion motion = in_air.state().motion;
  motion.centre_m.y += 3.0;
  in_air.bodies->place(0, motion);
  in_air.run(0.5);
  EXPECT_NEAR(in_air.ahead_mps(), 0.0, 1e-3);
}

// The helm turns her to the side that it says, ahead; the other way round when she goes astern; a helm at rest neither.
// The rudder takes time. Control seen: the rudder's normal turned.
TEST(Boat, TurnsByItsHelm) {
  for (const double helm : {0.6, -0.6}) {
    Afloat afloat(with_engine());
    afloat.boat.ask({.throttle = 0.7, .helm = helm});
    afloat.run(0.1);
    EXPECT_LT(std::abs(afloat.boat.parts().helm), 0.2);
    afloat.run(15.0);
    EXPECT_EQ(afloat.boat.parts().helm, helm);
    EXPECT_GT(afloat.to_starboard_rad_s() * helm, 0.02);
    EXPECT_GT(afloat.ahead_mps(), 0.5);
  }
  Afloat astern(with_engine());
  astern.boat.ask({.throttle = -0.8, .helm = 0.0});
  astern.run(20.0);
  astern.boat.ask({.throttle = 0.0, .helm = 1.0});  // coasting: no jet over the rudder
  astern.run(2.0);
  EXPECT_LT(astern.ahead_mps(), -0.1);
  EXPECT_LT(astern.to_starboard_rad_s(), -1e-3);
}

// An outboard needs no rudder. Control seen: its thrust kept ahead.
TEST(Boat, AnOutboardSteersByItsThrust) {
  BoatSpec spec = with_engine();
  spec.rudder.reset();
  spec.engine->most_turn_rad = 0.6;
  Afloat afloat(spec);
  afloat.boat.ask({.throttle = 0.5, .helm = 1.0});
  afloat.run(3.0);
  EXPECT_GT(afloat.to_starboard_rad_s(), 0.02);
}

// With the wind abeam she gathers way, heels to lee, and swings her boom there; head to wind her sails flog and drive
// her not. Control seen: the side force's sign.
TEST(Boat, SailsByTheWind) {
  BoatSpec spec;
  BoatSail main;
  main.sail.area_m2 = 8.0;
  main.centre_m = {0.0, 2.0, 0.0};
  spec.sails = {main};
  Afloat beam(spec, {7.0, 0.0, 0.0});  // from port to starboard
  beam.boat.ask({.sheet = 0.2});
  beam.run(10.0);
  EXPECT_GT(beam.ahead_mps(), 0.3);
  EXPECT_GT(beam.boat.parts().boom_rad[0], 0.8) << "to starboard";
  EXPECT_LT((beam.state().motion.orientation * glm::dvec3(1.0, 0.0, 0.0)).y, -0.01) << "her starboard side is down";
  Afloat head(spec, {0.0, 0.0, 7.0});
  head.boat.ask({.sheet = 1.0});
  head.run(5.0);
  EXPECT_LT(head.ahead_mps(), 0.05);
  EXPECT_GT(head.boat.parts().luffing[0], 0.9);
}

// When the wind goes over to her other side the boom swings there in a second, slack as it passes amidships; trimmed at
// once it stands where it comes to rest. Controls seen: a boom that jumps; a sail that stays full as it swings.
TEST(Boat, TheBoomSwingsOver) {
  BoatSpec spec;
  BoatSail main;
  main.sail.area_m2 = 1.0;
  main.centre_m = {0.0, 2.0, 0.0};
  spec.sails = {main};
  Afloat afloat(spec, {7.0, 0.0, 0.0});
  afloat.boat.ask({.sheet = 0.2});
  afloat.run(3.0);
  const double before = afloat.boat.parts().boom_rad[0];
  EXPECT_GT(before, 0.8);
  afloat.media.wind_mps.x = -7.0;
  double last = before, amidships_s = 0.0;
  for (int i = 0; i < 150; ++i) {
    afloat.run(1.0 / 60.0);
    const double now = afloat.boat.parts().boom_rad[0];
    EXPECT_LE(std::abs(now - last), 2.0 / 60.0 + 1e-9);
    if (std::abs(now) < 0.1) {
      amidships_s += 1.0 / 60.0;
      EXPECT_GT(afloat.boat.parts().luffing[0], 0.99);
    }
    last = now;
  }
  EXPECT_GT(amidships_s, 0.05);
  EXPECT_LT(last, -0.8);
  EXPECT_LT(afloat.boat.parts().luffing[0], 0.1);
  Boat trimmed(spec);
  trimmed.ask({.sheet = 0.2});
  trimmed.trim(afloat.state(), afloat.media);
  EXPECT_NEAR(trimmed.parts().boom_rad[0], last, 0.01);
}

// Both oars drive her ahead by strokes, one turns her to the other side, backing drives her astern; let go they are out
// of the water and drive nothing. An arm's strength bounds a stroke. Controls seen: recovery in the water; the left
// oar's side.
TEST(Boat, IsRowed) {
  BoatSpec spec;
  for (const bool port : {true, false}) {
    BoatOar oar;
    oar.pivot_m = {port ? -0.8 : 0.8, 0.35, 0.0};
    oar.to_port = port;
    spec.oars.push_back(oar);
  }
  Afloat both(spec);
  both.boat.ask({.oar_left = 1.0, .oar_right = 1.0});
  both.run(20.0);
  EXPECT_GT(both.ahead_mps(), 0.1);
  EXPECT_NEAR(both.to_starboard_rad_s(), 0.0, 1e-4);
  Afloat left(spec);
  left.boat.ask({.oar_left = 1.0});
  left.run(6.0);
  EXPECT_GT(left.to_starboard_rad_s(), 0.003);
  EXPECT_FALSE(left.boat.parts().oar_in_water[1]);
  Afloat back(spec);
  back.boat.ask({.oar_left = -1.0, .oar_right = -1.0});
  back.run(20.0);
  EXPECT_LT(back.ahead_mps(), -0.1);
  back.boat.ask({});
  back.run(1.0);
  EXPECT_FALSE(back.boat.parts().oar_in_water[0]);
}

// What is no number, or beyond a range, does no harm; at rest with nothing asked she falls asleep and stays so, and the
// throttle wakes her in the next step. Control seen: asking for NaN passed on.
TEST(Boat, SleepsUntilShePlays) {
  Afloat afloat(with_engine());
  afloat.boat.ask({.throttle = std::nan(""), .helm = 7.0, .sheet = -3.0});
  EXPECT_EQ(afloat.boat.asked().throttle, 0.0);
  EXPECT_EQ(afloat.boat.asked().helm, 1.0);
  EXPECT_EQ(afloat.boat.asked().sheet, 0.0);
  afloat.boat.ask({});
  afloat.run(60.0);
  EXPECT_TRUE(afloat.state().asleep);
  afloat.boat.ask({.throttle = 0.2});
  afloat.run(0.1);
  EXPECT_FALSE(afloat.state().asleep);
}

}  // namespace
}  // namespace seascape
