// A hand in the water: what it displaces, and the rings that it leaves in dynamic waves. Controls are named beside each
// test; each was seen to fail.
#include "ocean/sea/hand_in_water.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "ocean/sea/sea.h"
#include "tests/support/own_sea.h"

namespace seascape {
namespace {

constexpr double r = HandInWater::radius_m;

constexpr double texel_m = 0.03125;

SeaSpec calm_spec() {
  SeaState state;
  state.wind_speed_mps = 2.0;
  SeaSpec spec = test::spec_of(state, {.resolution = 32, .cascades = 3});
  spec.felt.cascades = 3;
  spec.dynamic_waves.emplace();
  spec.dynamic_waves->waves.windows = {.resolution = 64, .slices = 3, .texel_m = texel_m};
  spec.dynamic_waves->settle_s = 0.0;
  return spec;
}

struct Stroke {
  double depth_m = 0.0;  // of the hand's middle below the still water
  double speed_mps = 0.0;
  double from_s = 0.0, to_s = 10.0;  // while it is tracked
  double dip_m = 0.0;                // how far it goes down and up, once a second
};

// The highest of what a stroke adds to the water around it, m, after `end_s`.
double ripples_m(const Stroke& stroke, double end_s = 1.5, double ring_m = 0.3) {
  Sea still(calm_spec()), stirred(calm_spec());
  const auto hand = std::make_shared<HandInWater>(texel_m);
  stirred.add(hand);
  const glm::dvec3 viewer(0.0, 1.7, 0.0);
  double highest = 0.0;
  for (double time_s = 0.0; time_s < end_s; time_s += 1.0 / 90.0) {
    if (time_s >= stroke.from_s && time_s < stroke.to_s) {
      const double way_m = stroke.speed_mps * (time_s - 0.5 * end_s), w = 2.0 * glm::pi<double>();
      hand->set(HandInWater::At{time_s,
                                {way_m, -stroke.depth_m - stroke.dip_m * std::cos(w * time_s), 0.0},
                                {stroke.speed_mps, stroke.dip_m * w * std::sin(w * time_s), 0.0}});
    } else {
      hand->set(std::nullopt);
    }
    still.advance(time_s, viewer);
    stirred.advance(time_s, viewer);
  }
  const SeaView without = still.view_at(still.time_s(), SeaDetail::felt),
                with = stirred.view_at(stirred.time_s(), SeaDetail::felt);
  for (int i = 0; i < 48; ++i) {
    const double angle = i * glm::pi<double>() / 24.0;
    const glm::dvec2 at = ring_m * glm::dvec2(std::cos(angle), std::sin(angle));
    highest = std::max(highest, std::abs(with.query(at).height_m - without.query(at).height_m));
  }
  return highest;
}

// Controls: a cap's volume without its third; half a disc for a disc.
TEST(HandInWater, DisplacesWhatIsOfItUnderWater) {
  const double pi = glm::pi<double>();
  EXPECT_EQ(HandInWater::volume_m3(-r), 0.0);
  EXPECT_EQ(HandInWater::volume_m3(-5.0), 0.0);
  EXPECT_NEAR(HandInWater::volume_m3(0.0), 2.0 / 3.0 * pi * r * r * r, 1e-15);
  EXPECT_NEAR(HandInWater::volume_m3(7.0), 4.0 / 3.0 * pi * r * r * r, 1e-15);
  EXPECT_NEAR(HandInWater::section_m2(0.0), 0.5 * pi * r * r, 1e-15);
  EXPECT_NEAR(HandInWater::section_m2(7.0), pi * r * r, 1e-15);
  EXPECT_EQ(HandInWater::section_m2(-7.0), 0.0);
}

// Controls: a depth that counts for nothing; a hand over the water that presses it all the same.
TEST(HandInWater, MakesRipplesByItsDepthAndSpeed) {
  const double slow = ripples_m({.depth_m = 0.05, .speed_mps = 0.4}),
               fast = ripples_m({.depth_m = 0.05, .speed_mps = 0.8}),
               deep = ripples_m({.depth_m = 0.5, .speed_mps = 0.8});
  EXPECT_GT(slow, 5e-4);
  EXPECT_LT(fast, 0.1);
  EXPECT_GT(fast, 1.3 * slow);
  EXPECT_LT(deep, 0.3 * fast);
  EXPECT_EQ(ripples_m({.depth_m = -0.3, .speed_mps = 0.8}), 0.0);
  EXPECT_EQ(ripples_m({.depth_m = 0.3}), 0.0) << "a hand held still";
}

// What a step's sources give together, m^3/s, and where the strongest lies.
struct Pressed {
  double flow_m3ps = 0.0, ahead_m = 0.0;
};
Pressed pressed_by(HandInWater& hand, Sea& sea, double time_s) {
  constexpr double step_s = 1.0 / 60.0;
  std::vector<WaveSource> sources;
  SeaStep step(sea, time_s, step_s, sources);
  hand.step(step);
  Pressed pressed;
  double most = 0.0;
  for (const WaveSource& source : sources) {
    pressed.flow_m3ps += source.rise_mps * source.length_m * source.length_m / glm::pi<double>();
    if (source.rise_mps > most) {
      most = source.rise_mps;
      pressed.ahead_m = source.place_m.x;
    }
  }
  return pressed;
}

// Controls: no sink; source and sink changed round.
TEST(HandInWater, PushesAsMuchAheadAsItDrawsInBehind) {
  Sea sea(calm_spec());
  sea.advance(0.0, {0.0, 1.7, 0.0});
  HandInWater hand(texel_m);
  hand.set(HandInWater::At{0.0, {0.0, -0.3, 0.0}, {0.5, 0.0, 0.0}});
  const Pressed pressed = pressed_by(hand, sea, 0.0);
  EXPECT_NEAR(pressed.flow_m3ps, 0.0, 1e-15);
  EXPECT_NEAR(pressed.ahead_m, r, 1e-9);
}

// Control: what goes in lowers the water.
TEST(HandInWater, LiftsTheWaterThatItGoesInto) {
  Sea sea(calm_spec());
  sea.advance(0.0, {0.0, 1.7, 0.0});
  HandInWater hand(texel_m);
  const auto at = [&](double depth_m) {
    hand.set(HandInWater::At{0.0, {0.0, -depth_m, 0.0}});
    return pressed_by(hand, sea, 0.0).flow_m3ps;
  };
  EXPECT_EQ(at(-0.3), 0.0);
  EXPECT_GT(at(0.0), 0.0);
  EXPECT_LT(at(-0.3), 0.0);
}

// Dipped in and out, it makes rings. Control: the volume's rate left out.
TEST(HandInWater, MakesRingsWhereItIsDipped) { EXPECT_GT(ripples_m({.depth_m = -0.05, .dip_m = 0.15}), 1e-3); }

// A hand that is found again under water, or lost there, has displaced nothing in that moment. Control: its volume from
// nothing at once.
TEST(HandInWater, AppearsWithoutASplash) { EXPECT_EQ(ripples_m({.depth_m = 0.3, .from_s = 0.5, .to_s = 1.0}), 0.0); }

}  // namespace
}  // namespace seascape
