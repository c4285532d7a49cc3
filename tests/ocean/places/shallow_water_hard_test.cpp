// Hard cases of shallow water: 6 land, 7 depths of 1e-6 and 1e6 m, 1 no wind, and depths that are no numbers.
#include <gtest/gtest.h>

#include <limits>

#include "ocean/places/shallow_water.h"

namespace seascape {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Sea {
  explicit Sea(double wind, double depth = deep_water_m, OtherWaves others = {30.0, 0.2})
      : water(state(wind, depth), make_wave_bins(state(wind, depth), {.resolution = 64, .cascades = 5}), others) {}
  static SeaState state(double wind, double depth) {
    SeaState sea;
    sea.wind_speed_mps = wind, sea.depth_m = depth;
    return sea;
  }
  template <class Work>
  void each(const Work& work) const {
    for (int i = 0; i < 5; ++i) work([&, i](double h) { return water.factor(i, h); });
    work([&](double h) { return water.others(h); });
  }
  ShallowWater water;
};

TEST(ShallowWaterHard, hard_6_land_is_dry) {
  // In no depth, in negative ones and in NaN every factor and height is exactly 0 and all waves break. Controls, seen:
  // what is no depth taken as the thinnest water (7e-6 on land), and only 0 taken for land (-0.7).
  for (const double wind : {0.0, 3.0, 10.0, 60.0}) {
    const Sea sea(wind);
    for (const double h : {0.0, -0.0, -1e-300, -1.0, -1e6, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
      sea.each([&](const auto& factor) { EXPECT_EQ(factor(h), 0.0f) << h; });
      EXPECT_EQ(sea.water.height_m(h), 0.0f);
      EXPECT_EQ(sea.water.breaking(h), 1.0f);
      EXPECT_TRUE(std::isfinite(sea.water.steepening(0, h)));
    }
  }
  // A sea made for no depth at all has no waves, and makes none.
  const Sea dry(10.0, 0.0);
  dry.each([&](const auto& factor) { EXPECT_LE(factor(5.0), 1.0f); });
  EXPECT_EQ(dry.water.height_m(5.0), 0.0f);
}

TEST(ShallowWaterHard, hard_7_the_thinnest_and_the_deepest_water) {
  // 1e-6 m: less than a film's worth; 1e6 m and infinity: the sea as it is, to 1e-6. Controls, seen: a table that ends
  // at 100 m (1.4e-4 off), a flat sea that never breaks (a factor of 0.1 in 1e-6 m).
  for (const double wind : {3.0, 10.0, 25.0}) {
    const Sea sea(wind);
    sea.each([&](const auto& factor) {
      EXPECT_GE(factor(1e-6), 0.0f);
      EXPECT_LE(factor(1e-6), 0.595e-6f * 4.0f / 1e-3f);
      EXPECT_NEAR(factor(1e-300), 0.0f, 1e-30f);
      for (const double h : {3e3, 1e4, 1e6, 1e300, infinity}) EXPECT_NEAR(factor(h), 1.0f, 1e-6f) << wind << " " << h;
    });
    EXPECT_LE(sea.water.height_m(1e-6), 0.595e-6f);
    EXPECT_NEAR(sea.water.breaking(1e6), 0.0f, 1e-6f);
  }
  const Sea flat(0.0, deep_water_m, {});
  flat.each([](const auto& factor) {
    EXPECT_LE(factor(1e-6), 0.6e-3f);
    EXPECT_NEAR(factor(1e6), 1.0f, 1e-6f);
  });
}

TEST(ShallowWaterHard, FactorsAreContinuousAndBoundedAtAnyDepth) {
  // Near the shore a factor falls with the depth, so by no more than a thousandth of its bound, 4, where the depth
  // does; nowhere else is it steeper, the table's ends included. Control, seen: a table read with its two neighbours'
  // shares exchanged (steps of 0.0081).
  for (const double wind : {0.0, 3.0, 10.0, 60.0})
    for (const double made_for : {deep_water_m, 5.0}) {
      const Sea sea(wind, made_for);
      sea.each([&](const auto& factor) {
        float before = factor(1e-12);
        for (double h = 1e-12; h < 1e6; h *= 1.001) {
          const float now = factor(h);
          ASSERT_TRUE(now >= 0.0f && now <= float(ShallowWater::most_shoaling)) << h;
          ASSERT_LE(std::abs(now - before), 0.005f) << wind << " " << h;
          before = now;
        }
      });
    }
}

}  // namespace
}  // namespace seascape
