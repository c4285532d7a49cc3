// Foam step by step: what is gained and spent, carried by a flow, kept while windows move, and what is no number.
#include "ocean/foam/foam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "ocean/foam/foam_pattern.h"
#include "ocean/waves/half_floats.h"
#include "shaders/shared/foam_data.h"
#include "tests/support/expect_error.h"

namespace seascape {
namespace {

FoamSettings small_foam() {
  FoamSettings s;
  s.windows = {.resolution = 64, .slices = 2, .texel_m = 0.5};
  return s;
}
LodPlacement around(const FoamSettings& s, glm::dvec2 viewer, double height_m = 2.0) {
  return lod_placement(s.windows, viewer, lod_scale(s.windows, height_m));
}

// A round patch of so many metres of deviation, as a gain of one short step.
void patch(Foam& foam, glm::dvec2 at, double sigma_m) {
  foam.step(1e-6, [&](const FoamRow& row, std::span<float> per_s) {
    for (std::size_t i = 0; i < per_s.size(); ++i) {
      const glm::dvec2 off = row.first_m + glm::dvec2(double(i) * row.texel_m, 0.0) - at;
      per_s[i] = float(1e6 * 0.9999 * std::exp(-0.5 * glm::dot(off, off) / (sigma_m * sigma_m)));  // 63 % at the middle
    }
  });
}
struct Moments {
  double mass = 0.0, peak = 0.0;
  glm::dvec2 middle{0.0};
};
Moments moments(const Foam& foam, int slice) {
  Moments m;
  const LodField<float>& field = foam.field();
  field.each(slice, [&](LodIndex w) {
    const double f = double(field.texel(slice, w));
    m.mass += f, m.middle += f * field.middle(slice, w), m.peak = std::max(m.peak, f);
  });
  m.middle /= m.mass;
  m.mass *= field.texel_m(slice) * field.texel_m(slice);
  return m;
}

// f(t) = exp(-t / life) without a gain and the exact solution with one, at any rate, within 1e-4 (the bar is 1 %).
// Control seen: f *= 1 - dt / life, which is off by 11 % between 10 and 120 Hz.
TEST(Foam, ComesAndGoesAlikeAtAnyRate) {
  const FoamSettings s = small_foam();
  for (const double rate : {10.0, 15.0, 30.0, 60.0, 72.0, 90.0, 120.0}) {
    Foam decays(s), grows(s);
    decays.follow(around(s, {0.0, 0.0}), 0.0f);
    grows.follow(around(s, {0.0, 0.0}), 0.0f);
    decays.fill(0.8f);
    for (int i = 0; i < int(4.0 * rate); ++i) {
      decays.step(1.0 / rate, nullptr);
      grows.step(1.0 / rate,
                 [](const FoamRow&, std::span<float> per_s) { std::fill(per_s.begin(), per_s.end(), 0.5f); });
    }
    const double k = 0.5 + 1.0 / s.life_s;
    EXPECT_NEAR(decays.covered({1.0, 1.0}, 0.0), 0.8 * std::exp(-4.0 / s.life_s), 1e-4) << rate;
    EXPECT_NEAR(grows.covered({1.0, 1.0}, 0.0), 0.5 / k * (1.0 - std::exp(-4.0 * k)), 1e-4) << rate;
  }
}

// Hard case 43: an hour of more foam than water takes, also as half floats. Control seen: f += g dt without the
// saturation (left [0, 1] at once, and was told of).
TEST(Foam, hard_43_full_for_an_hour_stays_within_one) {
  const FoamSettings s = small_foam();
  Foam foam(s);
  foam.follow(around(s, {0.0, 0.0}), 0.0f);
  foam.set_flow([](glm::dvec2 at, double) { return glm::vec2(-0.3 * at); }, true);  // and drawn together
  foam.follow(around(s, {0.0, 0.0}), 0.0f);
  for (int i = 0; i < 3600 * 4; i += 8)
    foam.step(2.0, [](const FoamRow&, std::span<float> per_s) { std::fill(per_s.begin(), per_s.end(), 100.0f); });
  EXPECT_FALSE(foam.take_fault());
  for (int slice = 0; slice < 2; ++slice) {
    std::vector<std::uint16_t> halves(64 * 64);
    halves_from_floats(foam.field().texels(slice), halves.data(), halves.size());
    for (std::size_t i = 0; i < halves.size(); ++i) {
      ASSERT_GE(foam.field().texels(slice)[i], 0.9f);
      ASSERT_LE(foam.field().texels(slice)[i], 1.0f);
      ASSERT_LE(halves[i], 0x3c00) << "1 as a half float";
    }
  }
}

// A gain or foam that is no number is gone after the step that found it, and told of once. Control seen: the test of
// both left out (NaN stays for ever).
TEST(Foam, WhatIsNoNumberIsGoneWithinAStepAndToldOf) {
  const FoamSettings s = small_foam();
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  const auto finite = [](const Foam& foam) {
    for (int slice = 0; slice < 2; ++slice)
      for (int i = 0; i < 64 * 64; ++i)
        if (!(foam.field().texels(slice)[i] >= 0.0f && foam.field().texels(slice)[i] <= 1.0f)) return false;
    return true;
  };
  // Of what is a number nothing is told, be it none or all. Control: a gain of 0 taken for no number (tests/mutants).
  for (const float covered : {0.0f, 0.5f, 1.0f}) {
    Foam foam(s);
    foam.follow(around(s, {0.0, 0.0}), 0.0f);
    foam.fill(covered);
    foam.step(0.1, [](const FoamRow&, std::span<float> per_s) { per_s[5] = 1.0f; });
    EXPECT_FALSE(foam.take_fault()) << covered;
  }
  for (const float bad : {nan, infinite, -infinite, -1.0f}) {
    Foam foam(s);
    foam.follow(around(s, {0.0, 0.0}), 0.0f);
    foam.step(0.1, [&](const FoamRow&, std::span<float> per_s) { per_s[5] = bad; });
    EXPECT_TRUE(finite(foam)) << bad;
    EXPECT_TRUE(foam.take_fault()) << bad;
    EXPECT_FALSE(foam.take_fault());
    foam.fill(bad);
    foam.step(0.1, [](const FoamRow&, std::span<float> per_s) { per_s[0] = 0.1f; });
    EXPECT_TRUE(finite(foam)) << bad;
    EXPECT_TRUE(foam.take_fault());
    foam.set_flow([&](glm::dvec2, double) { return glm::vec2(bad == -1.0f ? nan : bad, 0.0f); }, true);
    foam.follow(around(s, {0.0, 0.0}), 0.0f);
    foam.step(0.1, [](const FoamRow&, std::span<float> per_s) { per_s[0] = 0.1f; });
    EXPECT_TRUE(finite(foam)) << "a flow of " << bad;
  }
}

// A patch in a uniform flow: its mass within 1 %, its middle within 1.5 % of its way, a tenth of its height lost at
// most, over 26 texels of way at two rates. Controls seen: lines between texels instead of cubics (39 % of the height
// lost); the flow's x and z changed about.
TEST(Foam, AUniformFlowCarriesAPatchWhole) {
  FoamSettings s = small_foam();
  s.life_s = 1000.0;
  for (const double rate : {12.0, 30.0}) {
    Foam foam(s);
    foam.set_flow([](glm::dvec2, double) { return glm::vec2(1.1f, -0.7f); }, true);
    foam.follow(around(s, {0.0, 0.0}), 0.0f);
    patch(foam, {-5.0, 4.0}, 1.2);
    const Moments before = moments(foam, 0);
    ASSERT_GT(before.peak, 0.6);
    for (int i = 0; i < int(10.0 * rate); ++i) foam.step(1.0 / rate, nullptr);
    const Moments after = moments(foam, 0);
    const double left = std::exp(-10.0 / s.life_s);
    EXPECT_NEAR(after.mass / before.mass / left, 1.0, 0.01) << rate;
    EXPECT_NEAR(after.middle.x - before.middle.x, 11.0, 0.17) << rate;
    EXPECT_NEAR(after.middle.y - before.middle.y, -7.0, 0.11) << rate;
    EXPECT_GT(after.peak, 0.9 * before.peak * left) << rate;
  }
}

// Hard case 44: a whirlpool that draws no water down keeps the foam that circles in it within 5 % for a minute; one
// that does gathers it in the middle, and no more than all of the water is covered. Opposed flows pile it up where they
// meet. Control seen: the flow's divergence left out (nothing gathers).
TEST(Foam, hard_44_whirlpools_and_opposed_flows_keep_it_finite) {
  FoamSettings s = small_foam();
  s.life_s = 1000.0;
  const auto whirl = [](double inflow) {
    return [inflow](glm::dvec2 at, double) {
      const double r = glm::length(at), turn = 1.5 * std::min(r / 3.0, 3.0 / std::max(r, 1e-9)),
                   in = -inflow * std::min(r / 3.0, 3.0 / std::max(r, 1e-9));
      return r > 0.0 ? glm::vec2((glm::dvec2(-at.y, at.x) * turn + at * in) / r) : glm::vec2(0.0f);
    };
  };
  for (const double inflow : {0.0, 0.4}) {
    Foam foam(s);
    foam.set_flow(whirl(inflow), true);
    foam.follow(around(s, {0.0, 0.0}), 0.0f);
    patch(foam, {4.0, 0.0}, 1.0);
    const Moments before = moments(foam, 0);
    for (int i = 0; i < 720; ++i) foam.step(1.0 / 12.0, nullptr);
    const Moments after = moments(foam, 0);
    EXPECT_LE(after.peak, 1.0);
    if (inflow == 0.0) {
      EXPECT_NEAR(after.mass / before.mass / std::exp(-60.0 / s.life_s), 1.0, 0.05);
    } else {
      EXPECT_LT(glm::length(after.middle), 0.25) << "in the middle";
      EXPECT_GT(after.peak, 0.9);
      EXPECT_LT(after.mass, 1.02 * before.mass);
    }
  }
  Foam opposed(s);
  opposed.set_flow([](glm::dvec2 at, double) { return glm::vec2(at.x > 0.0 ? -20.0f : 20.0f, 0.0f); }, true);
  opposed.follow(around(s, {0.0, 0.0}), 0.0f);
  opposed.fill(0.1f);
  for (int i = 0; i < 120; ++i) opposed.step(1.0 / 12.0, nullptr);
  for (int i = 0; i < 64 * 64; ++i)
    ASSERT_TRUE(opposed.field().texels(0)[i] >= 0.0f && opposed.field().texels(0)[i] <= 1.0f);
}

// Windows that move keep every texel that they still cover, to the bit; what comes into the finer one lies between the
// coarser one's, and into the coarser one is what the sea has on average. Control seen: fresh foam in every texel that
// comes in.
TEST(Foam, MovingWindowsLoseOnlyWhatLeavesThem) {
  const FoamSettings s = small_foam();
  Foam foam(s);
  foam.follow(around(s, {0.0, 0.0}), 0.0f);
  patch(foam, {3.0, -2.0}, 4.0);
  const LodField<float> before = foam.field();
  for (const glm::dvec2 viewer : {glm::dvec2(5.3, 0.0), glm::dvec2(5.3, -7.9), glm::dvec2(9.0, 3.0)})
    foam.follow(around(s, viewer), 0.25f);
  int kept = 0, fresh = 0;
  for (int slice = 0; slice < 2; ++slice)
    foam.field().each(slice, [&](LodIndex w) {
      const LodIndex was = w - before.first(slice);
      // What has been outside in between is of no account here.
      const LodPlacement between = around(s, {5.3, -7.9});
      const LodIndex then = w - between.first[std::size_t(slice)];
      const auto inside = [](LodIndex i) { return i.x >= 0 && i.y >= 0 && i.x < 64 && i.y < 64; };
      if (inside(was) && inside(then)) {
        ++kept;
        ASSERT_EQ(foam.field().texel(slice, w), before.texel(slice, w));
      } else if (slice == 1) {
        ++fresh;
        ASSERT_EQ(foam.field().texel(slice, w), 0.25f);
      }
    });
  EXPECT_GT(kept, 3000);
  EXPECT_GT(fresh, 500);
  // A patch that only the coarser window holds is handed to the finer one as that comes over it.
  Foam handed(s);
  handed.follow(around(s, {0.0, 0.0}), 0.0f);
  const glm::dvec2 beyond(s.windows.texel_m * 40.0, 0.0);  // the finer one ends at 32 texels
  patch(handed, beyond, s.windows.texel_m * 8.0);
  EXPECT_EQ(handed.covered(beyond, 0.0), 0.0f) << "the coarser one is not read yet";
  handed.follow(around(s, beyond), 0.0f);
  EXPECT_NEAR(handed.covered(beyond, 0.0), 0.63f, 0.05f);
}

TEST(Foam, SettingsOutOfRangeAreRefusedByName) {
  for (const auto& [member, name] : {std::pair{&FoamSettings::life_s, "life_s"},
                                     {&FoamSettings::rate_hz, "rate_hz"},
                                     {&FoamSettings::shore_m, "shore_m"},
                                     {&FoamSettings::breaking, "breaking"},
                                     {&FoamSettings::settle_s, "settle_s"},
                                     {&FoamSettings::shore_per_s, "shore_per_s"}})
    for (const double bad : {-1.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
      FoamSettings s = small_foam();
      s.*member = bad;
      EXPECT_NE(test::error_of([&] { Foam foam(s); }).find(name), std::string::npos) << name << " " << bad;
    }
}

// As much of the tile is covered before a value as the value says, so that the lace of a coverage covers just that; and
// the tile wraps around. Control seen: values as the cells give them (off by 0.2).
TEST(Foam, LaceCoversAsMuchAsItIsAskedFor) {
  constexpr int side = 128;
  const std::vector<std::uint8_t> tile = foam_pattern(side);
  ASSERT_EQ(tile.size(), 4u * (side * side * 4 - 1) / 3);
  for (const double share : {0.05, 0.3, 0.5, 0.8}) {
    int below = 0;
    for (int i = 0; i < side * side; ++i) below += tile[std::size_t(4 * i)] < 255.0 * share;
    EXPECT_NEAR(below / double(side * side), share, 0.005);
  }
  // Across the border neighbours are as alike as elsewhere.
  double across = 0.0, inside = 0.0;
  for (int z = 0; z < side; ++z) {
    const auto at = [&](int x) { return double(tile[std::size_t(4 * (z * side + x))]); };
    across += std::abs(at(0) - at(side - 1)), inside += std::abs(at(64) - at(63));
  }
  EXPECT_LT(across, 2.0 * inside);
  EXPECT_NEAR(tile[tile.size() - 4], 127, 3) << "the last level is the mean";
}

// Of a tile's variance a twenty-fifth at most (seen 0.017) is in waves of one to three periods: with longer patches the
// tile's repetition shows as a grid of squares. Control seen: noise on a lattice, which has all lengths (0.16).
TEST(Foam, LaceHidesItsTile) {
  constexpr int side = 128;
  const std::vector<std::uint8_t> tile = foam_pattern(side);
  const auto value = [&](int x, int z) { return double(tile[std::size_t(4 * (z * side + x))]) - 127.5; };
  double variance = 0.0, of_long = 0.0;
  for (int z = 0; z < side; ++z)
    for (int x = 0; x < side; ++x) variance += value(x, z) * value(x, z) / (side * side);
  for (int kz = -3; kz <= 3; ++kz)
    for (int kx = -3; kx <= 3; ++kx) {
      if (std::hypot(kx, kz) > 3.2) continue;
      std::complex<double> sum = 0.0;
      for (int z = 0; z < side; ++z)
        for (int x = 0; x < side; ++x)
          sum += std::polar(value(x, z) / (side * side), -2.0 * std::numbers::pi * (kx * x + kz * z) / side);
      of_long += std::norm(sum);
    }
  EXPECT_LT(of_long, 0.04 * variance);
}

// Thin at its edges and thick within, foam lets through just as much as its share of the water lacks, so that it is as
// bright from near as from afar, where pixels take its mean. Controls seen: a reach of the share itself (off by 0.1),
// the law of small shares for all (0.02).
TEST(Foam, LaceIsAsBrightAsItsShare) {
  constexpr int numbers = 4000;
  float before = -1.0f;
  for (int n = 0; n <= 100; ++n) {
    const float share = float(n) / 100.0f, reach = gpu::foam_reach(share);
    EXPECT_GT(reach, before) << share;
    before = reach;
    double mean = 0.0;
    for (int i = 0; i < numbers; ++i) {
      const float below = reach - (float(i) + 0.5f) / numbers;
      if (below > 0.0f) mean += std::lerp(gpu::foam_thin, 1.0f, gpu::foam_thickness(below)) / numbers;
    }
    EXPECT_NEAR(mean, share, 1e-3);
  }
  EXPECT_FLOAT_EQ(gpu::foam_reach(0.0f), 0.0f);
  EXPECT_FLOAT_EQ(gpu::foam_reach(1.0f), 1.0f + gpu::foam_depth) << "thick everywhere";
}

}  // namespace
}  // namespace seascape
