// Bubbles of a diver's breath. Controls are named beside each test; each was
// seen to fail.
#include "ocean/surface/breath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/support/allocations.h"

namespace seascape {
namespace {

Pose swims(double t) { return {{0.4 * t, -18.0 + 0.1 * t, -0.2 * t}, {1.0, 0.0, 0.0, 0.0}}; }

// Speeds that were measured in water: 5 mm 0.23 m/s, 10 mm 0.25 m/s, 40 mm 0.45 m/s (Clift, Grace and Weber 1978,
// figures 7.3 and 8.3), within 15 %. Control: the radius for the diameter.
TEST(Breath, BubblesRiseAsTheyWereMeasuredTo) {
  for (const auto& [d, mps] : {std::pair(0.005, 0.23), {0.010, 0.25}, {0.040, 0.45}})
    EXPECT_NEAR(bubble_rises_mps(d), mps, 0.15 * mps) << d;
  EXPECT_NEAR(bubble_flatness(0.001), 1.0, 0.05);
  EXPECT_LT(bubble_flatness(0.03), 0.25);
}

// From 18 m to just under the surface air takes (10.08 + 18) / 10.08 times its room, and its sphere 1.407 times the
// width. The widest of a breath on its way: its width by Boyle at each depth, its time by the sum of dy / U(y).
// Controls: the square root for the cube root; steps of a fixed size of speed (the speed at birth kept).
TEST(Breath, BubblesGrowByBoyleAndRiseByTheirWidth) {
  EXPECT_NEAR(bubble_grows(18.0, 0.0), std::cbrt(28.08 / 10.08), 1e-12);
  Breath breath({.every_s = 30.0, .litres = 0.1});
  const Pose still{{0.0, -18.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  double t = 0.0;
  for (; t < 9.5; t += 0.02) breath.advance(t, still, 0.0);
  const auto wider = [](const Breath::Bubble& a, const Breath::Bubble& b) { return a.born_m < b.born_m; };
  ASSERT_GT(breath.bubbles().size(), 5u);
  const Breath::Bubble born = *std::ranges::max_element(breath.bubbles(), wider);
  const auto it = [&] {
    return *std::ranges::find_if(breath.bubbles(), [&](const auto& b) { return b.born_s == born.born_s; });
  };
  for (; t < born.born_s + 25.0; t += 0.02) {
    breath.advance(t, still, 0.0);
    const Breath::Bubble now = it();
    ASSERT_NEAR(now.diameter_m, born.born_m * std::cbrt((10.08 + born.from_m) / (10.08 - now.at_m.y)), 1e-9);
  }
  const double from_m = -born.from_m, to_m = it().at_m.y;
  ASSERT_GT(to_m, from_m + 5.0);
  ASSERT_GT(born.born_m, 0.03);
  double takes_s = 0.0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double y = from_m + (to_m - from_m) * (i + 0.5) / steps;
    takes_s += (to_m - from_m) / steps / bubble_rises_mps(born.born_m * bubble_grows(born.from_m, -y));
  }
  EXPECT_NEAR(takes_s, t - born.born_s, 0.06);  // of 25 s; they are born on even steps
}

// A breath's bubbles hold a breath's air, within the chance of their sizes. Control: every second bubble left out.
TEST(Breath, HoldsItsAir) {
  double litres = 0.0;
  std::vector<double> born;
  Breath breath({.every_s = 4.0, .litres = 0.8});
  double last_s = -1.0;
  for (double t = 0.0; t < 200.0; t += 0.25) {
    breath.advance(t, Pose{{0.0, -10.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, 0.0);
    double latest_s = last_s;
    for (const Breath::Bubble& bubble : breath.bubbles())
      if (bubble.born_s > last_s) {
        litres += 1e3 * 3.14159265358979 / 6.0 * std::pow(bubble.born_m, 3.0);
        latest_s = std::max(latest_s, bubble.born_s);
      }
    last_s = latest_s;
  }
  EXPECT_NEAR(litres / 50.0, 0.8, 0.08);
}

// The same bubbles at any rate of frames, for the same seed, and others for another; none of an eye in the air, none
// above the water, none when it is off, and time that jumps begins anew. Controls: frames in place of even steps; the
// seed not taken; a mouth's depth not looked at.
TEST(Breath, FollowsFromTimesPosesAndSeed) {
  const auto run = [](double rate_hz, std::uint32_t seed) {
    Breath breath({.seed = seed});
    for (int frame = 0; frame <= int(20.0 * rate_hz); ++frame)
      breath.advance(frame / rate_hz, swims(frame / rate_hz), 0.0);
    return std::vector(breath.bubbles().begin(), breath.bubbles().end());
  };
  const auto wanted = run(60.0, 1);
  ASSERT_GT(wanted.size(), 100u);
  for (const double rate_hz : {10.0, 72.0, 90.0, 240.0}) {
    const auto found = run(rate_hz, 1);
    ASSERT_EQ(found.size(), wanted.size()) << rate_hz;
    for (std::size_t n = 0; n < found.size(); ++n) {
      EXPECT_LT(glm::length(found[n].at_m - wanted[n].at_m), 1e-6) << rate_hz;
      EXPECT_NEAR(found[n].diameter_m, wanted[n].diameter_m, 1e-9);
    }
  }
  EXPECT_NE(run(60.0, 2).front().born_m, wanted.front().born_m);

  Breath breath;
  std::size_t most = 0;
  for (double t = 0.0; t < 30.0; t += 0.1) {
    breath.advance(t, Pose{{0.0, 0.5, 0.0}}, 0.0);
    most = std::max(most, breath.bubbles().size());
  }
  EXPECT_EQ(most, 0u) << "in the air";
  for (double t = 30.0; t < 60.0; t += 0.1) breath.advance(t, Pose{{0.0, -2.0, 0.0}}, 0.0);
  EXPECT_FALSE(breath.bubbles().empty());
  for (const Breath::Bubble& bubble : breath.bubbles()) EXPECT_LT(bubble.at_m.y, 1.1);
  breath.advance(10.0, Pose{{0.0, -2.0, 0.0}}, 0.0);
  EXPECT_TRUE(breath.bubbles().empty()) << "time ran back";
  breath.apply({.on = false});
  for (double t = 10.0; t < 30.0; t += 0.1) breath.advance(t, Pose{{0.0, -2.0, 0.0}}, 0.0);
  EXPECT_TRUE(breath.bubbles().empty()) << "off";
}

// Farthest first, no more than there is room for, as wide as a bubble of that volume and flatness is. Control: sorted
// the other way.
TEST(Breath, IsDrawnFarthestFirst) {
  Breath breath;
  for (double t = 0.0; t < 20.0; t += 0.05) breath.advance(t, Pose{{0.0, -8.0, 0.0}}, 0.0);
  std::vector<gpu::BubbleInstance> list(Breath::most);
  const glm::dvec3 viewer(0.5, -3.0, 2.0);
  const std::size_t count = breath.drawn(viewer, list);
  ASSERT_EQ(count, breath.bubbles().size());
  double before = 1e9;
  for (std::size_t n = 0; n < count; ++n) {
    const double off = std::hypot(double(list[n].place.x), double(list[n].place.z), double(list[n].place.y) - viewer.y);
    EXPECT_LE(off, before + 1e-5);
    before = off;
    EXPECT_GT(list[n].place.w, 0.5 * Breath::least_m);
    EXPECT_LT(list[n].place.w, 0.2);
  }
  EXPECT_EQ(breath.drawn(viewer, std::span(list).first(7)), 7u);
}

}  // namespace
}  // namespace seascape
