// The foam and spray of hulls: where and when there is any, and the trail that lasts.
#include "ocean/bodies/wake_foam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "ocean/foam/foam_sea.h"
#include "tests/support/body_waves.h"
#include "tests/support/own_sea.h"
#include "tests/support/truth.h"

namespace seascape {
namespace {

using namespace test;

struct Boat {
  HullMesh hull;
  double length_m = 6.0;
  HullMotion motion;
  std::optional<PropellerWash> wash;
};

Boat wigley(double speed_mps, double beam_m = 2.0) {
  Boat boat{wigley_hull(6.0, beam_m, 0.6, 0.5, 40, 12), 6.0, {}, {}};
  boat.motion.velocity.linear = {0.0, 0.0, -speed_mps};
  return boat;
}

Boat barge(double speed_mps) {
  Boat boat{box_hull({2.0, 1.0, 6.0}, 4), 6.0, {}, {}};
  boat.motion.velocity.linear = {0.0, 0.0, -speed_mps};
  return boat;
}

// What is made in some seconds, summed: rates times steps of 1/60 s.
struct Sum {
  double bow = 0.0, stern = 0.0, trail = 0.0, spray = 0.0;
  double highest_throw_mps = 0.0;
  std::size_t discs = 0;
};
Sum made_by(const Boat& boat, double seconds = 1.0) {
  const HullWake wake(boat.hull, 20);
  WakeFoam foam;
  WakeFoam::Made made;
  std::vector<HullSection> cut(20);
  Sum sum;
  HullMotion motion = boat.motion;
  for (int i = 0; i < int(seconds * 60.0); ++i) {
    motion.pose.centre_m += motion.velocity.linear / 60.0;
    wake.cut(
        motion, [](const glm::dvec2&) { return 0.0; }, cut);
    made.clear();
    foam.step(1.0 / 60.0, motion, cut, boat.length_m / 20.0, boat.wash, g, rho, made);
    for (const FoamDisc& d : made.foam) {
      const double z = d.at_m.y - motion.pose.centre_m.z;  // aft
      (d.lasting ? sum.trail : z < 0.0 ? sum.bow : sum.stern) += d.per_s / 60.0;
      EXPECT_GT(d.radius_m, 0.0);
      EXPECT_LE(d.per_s, 100.0);
    }
    for (const SprayThrow& t : made.spray) {
      sum.spray += t.per_s / 60.0;
      sum.highest_throw_mps = std::max(sum.highest_throw_mps, t.velocity_mps.y);
      EXPECT_LT(t.at_m.z, motion.pose.centre_m.z - 2.0) << "at the bow";
    }
    sum.discs += made.foam.size();
  }
  return sum;
}

// Control: a trail of a hull that does not move; seen.
TEST(WakeFoam, NoneAtRestNorInTheAir) {
  Boat boat = wigley(0.0);
  EXPECT_EQ(made_by(boat).discs, 0u);
  boat = wigley(5.0);
  boat.motion.water_mps = boat.motion.velocity.linear;
  EXPECT_EQ(made_by(boat).discs, 0u) << "adrift";
  boat = wigley(5.0);
  boat.motion.pose.centre_m.y = 3.0;
  EXPECT_EQ(made_by(boat).discs, 0u) << "in the air";
}

// The bow throws more water the faster and the blunter it is, and spray at speed; a bow that comes down hard throws
// spray at low speed too. Controls: spray of any bow wave; one
// entrance for all hulls; what comes down left out; all seen.
TEST(WakeFoam, OfTheBow) {
  const Sum slow = made_by(wigley(0.5)), cruising = made_by(wigley(1.6)), fast = made_by(wigley(7.0)),
            fine = made_by(wigley(1.6, 0.6));
  EXPECT_EQ(slow.bow, 0.0);
  EXPECT_EQ(slow.spray, 0.0);
  EXPECT_GT(cruising.bow, 0.5);
  EXPECT_GT(fast.bow, 1.2 * cruising.bow);
  EXPECT_LT(fine.bow, 0.5 * cruising.bow);
  EXPECT_GT(fast.spray, 50.0);
  EXPECT_GT(fast.spray, 2.0 * cruising.spray);
  Boat slamming = wigley(0.7);
  slamming.motion.velocity.linear.y = -3.0;
  slamming.motion.pose.centre_m.y = 0.05;
  EXPECT_GT(made_by(slamming, 0.15).spray, 1.0);
  // Noblesse's formula: 2.2 / (1 + F) tan a / cos a U^2 / g at 3 m/s, 0.6 m and a half angle of 20 degrees.
  EXPECT_NEAR(bow_wave_m(3.0, std::tan(20.0 * truth::pi / 180.0), 0.6, g),
              2.2 / (1.0 + 3.0 / std::sqrt(9.81 * 0.6)) * 0.36397 / 0.93969 * 9.0 / 9.81, 1e-4);
}

// A hull that has leapt throws spray to both sides behind its bow where it comes down, the more the harder; what heaves
// in the water, sinks through it or flies throws none. Controls seen: hulls that lie as deep as ever; the usual draught
// left at 0; one side alone.
TEST(WakeFoam, WhereTheHullSlaps) {
  struct Thrown {
    double left = 0.0, right = 0.0;
  };
  // Two seconds in the water, then as `height` has it.
  const auto thrown = [](const std::function<double(double)>& height, double seconds) {
    const Boat boat = wigley(0.0);
    const HullWake wake(boat.hull, 20);
    WakeFoam foam;
    WakeFoam::Made made;
    std::vector<HullSection> cut(20);
    Thrown sum;
    HullMotion motion = boat.motion;
    for (double t = -2.0; t < seconds; t += 1.0 / 60.0) {
      const double before = t > 0.0 ? height(t - 1.0 / 60.0) : 0.0, now = t > 0.0 ? height(t) : 0.0;
      motion.pose.centre_m.y = now, motion.velocity.linear.y = 60.0 * (now - before);
      wake.cut(
          motion, [](const glm::dvec2&) { return 0.0; }, cut);
      made.clear();
      foam.step(1.0 / 60.0, motion, cut, 0.3, {}, g, rho, made);
      for (const SprayThrow& s : made.spray)
        if (s.at_m.z > -2.0) (s.at_m.x < 0.0 ? sum.left : sum.right) += s.per_s / 60.0;
    }
    return sum;
  };
  const auto falls_at = [](double mps) {
    return [mps](double t) { return t < 0.5 ? 2.0 * t : std::max(1.0 - mps * (t - 0.5), 0.0); };
  };
  const Thrown hard = thrown(falls_at(5.0), 1.2), softly = thrown(falls_at(2.5), 1.2);
  EXPECT_GT(hard.left, 5.0);
  EXPECT_NEAR(hard.right, hard.left, 1e-6);
  EXPECT_LT(softly.left, 0.5 * hard.left);
  EXPECT_EQ(thrown([](double t) { return 0.15 * std::sin(6.0 * t); }, 4.0).left, 0.0) << "heaves";
  EXPECT_EQ(thrown([](double t) { return -3.0 * t; }, 1.0).left, 0.0) << "sinks";
  EXPECT_EQ(thrown([](double t) { return 2.0 * t; }, 4.0).left, 0.0) << "flies";
}

// A transom leaves a roller behind, a pointed stern none; a propeller its jet, at rest too, of momentum theory's speed.
// Controls: every stern a transom; a depth that counts for nothing; both seen.
TEST(WakeFoam, OfTransomAndPropeller) {
  EXPECT_GT(made_by(barge(3.0)).stern, 1.0);
  EXPECT_EQ(made_by(wigley(3.0)).stern, 0.0);
  EXPECT_EQ(made_by(barge(0.8)).stern, 0.0) << "slow water clings to it";
  Boat boat = wigley(0.0);
  boat.wash = PropellerWash{{0.0, -0.5, 3.0}, 0.4, 2000.0};
  const Sum pulling = made_by(boat);
  EXPECT_GT(pulling.stern, 1.0);
  boat.wash->at_m.y = -4.0;
  EXPECT_LT(made_by(boat).stern, 0.2 * pulling.stern) << "deep";
  // facts/boats.md: 1834 N of 0.45 m at 3 m/s.
  EXPECT_NEAR(jet_speed({{}, 0.45, 1834.0}, 3.0, rho), std::sqrt(9.0 + 2.0 * 1834.0 / (1025.0 * 0.159043)) - 3.0, 1e-3);
}

// A hull that runs along z.
class Runner : public SeaActor {
 public:
  explicit Runner(const Boat& boat) : boat_(boat), wake_(boat.hull, 20), cut_(20) {}
  void step(SeaStep& step) override {
    HullMotion motion = boat_.motion;
    motion.pose.centre_m = {0.0, 0.0, 20.0 + (step.time_s - 5.0) * motion.velocity.linear.z};
    wake_.cut(
        motion, [](const glm::dvec2&) { return 0.0; }, cut_);
    made_.clear();
    foam_.step(step.dt_s, motion, cut_, boat_.length_m / 20.0, {}, g, rho, made_);
    for (const FoamDisc& disc : made_.foam) EXPECT_TRUE(step.foam(disc));
  }

 private:
  Boat boat_;
  HullWake wake_;
  std::vector<HullSection> cut_;
  WakeFoam foam_;
  WakeFoam::Made made_;
};

// The trail of a boat at 4 m/s as the sea's foam keeps it, on a line across its way: it is there a minute after at a
// third and less of what it was, and as wide as a beam and growing as the distance to the power of 1/5, within a
// quarter. Controls: a trail that never widens; one that widens on one side; both seen.
TEST(WakeFoam, TrailLastsAndSpreads) {
  SeaState state;
  state.wind_speed_mps = 0.0;
  SeaSpec spec = spec_of(state, {.resolution = 32, .cascades = 3});
  spec.actors_foam = true;
  Sea sea(spec);
  FoamSpec foam_spec;
  foam_spec.settings.windows = {.resolution = 128, .slices = 3, .texel_m = 0.25};
  foam_spec.settings.settle_s = 0.0;
  FoamSea foam(foam_spec, sea);
  const Boat boat = wigley(4.0);
  sea.add(std::make_shared<Runner>(boat));
  const glm::dvec3 viewer(0.0, 1.7, 0.0);
  const auto across = [&] {
    std::vector<double> covered;
    for (double x = -6.0; x <= 6.0; x += 0.125) {
      double sum = 0.0;
      for (double z = -1.0; z <= 1.0; z += 0.25) sum += double(foam.foam().covered({x, z}, 0.0));
      covered.push_back(sum / 9.0);
    }
    return covered;
  };
  double first = 0.0;
  int asked = 0;
  for (double t = 5.0; t < 80.0; t += 1.0 / 30.0) {
    sea.advance(t, viewer), foam.update(t, viewer);
    const double behind = 4.0 * (t - 5.0) - 20.0 - 3.0;  // of the stern
    for (const double want_at : {14.0, 40.0, 100.0, 160.0, 240.0}) {
      if (!(behind >= want_at && behind < want_at + 4.0 / 30.0)) continue;
      ++asked;
      const std::vector<double> covered = across();
      const double most = *std::max_element(covered.begin(), covered.end());
      double wide = 0.0;
      for (const double c : covered) wide += c > 0.5 * most ? 0.125 : 0.0;
      if (first == 0.0) first = most;
      EXPECT_NEAR(wide, WakeFoam::trail_width_m(2.0, behind), 0.25 * WakeFoam::trail_width_m(2.0, behind)) << behind;
      if (want_at == 160.0) {
        EXPECT_GT(most, 0.25 * first) << "40 s";
      }
      if (want_at == 240.0) {
        EXPECT_LT(most, 0.5 * first) << "60 s";
        EXPECT_GT(most, 0.08);
      }
    }
  }
  EXPECT_EQ(asked, 5);
  EXPECT_GT(first, 0.4);
}

}  // namespace
}  // namespace seascape
