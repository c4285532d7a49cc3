// How the exposure follows an eye into the water.
#include "app/eye_adaptation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace seascape {
namespace {

constexpr LightInWater ocean{{0.0008, 0.004, 0.012}, {0.35, 0.07, 0.03}, 0.0};

LightInWater at(double depth_m) { return {ocean.sent_up, ocean.fading, depth_m}; }

// With all of what is lost made up for, what is about the eye is as bright as in the air. Control seen: the loss by the
// natural logarithm.
TEST(EyeAdaptation, MakesUpForWhatIsLost) {
  for (const double depth_m : {1.0, 5.0, 20.0}) {
    const double seen =
        std::numbers::pi * (0.2126 * 0.0008 * std::exp(-0.35 * depth_m) + 0.7152 * 0.004 * std::exp(-0.07 * depth_m) +
                            0.0722 * 0.012 * std::exp(-0.03 * depth_m));
    EXPECT_NEAR(seen * std::exp2(adaptation_stops(at(depth_m), 1.0)), 1.0, 1e-9) << depth_m;
    EXPECT_NEAR(adaptation_stops(at(depth_m), 0.3), 0.3 * adaptation_stops(at(depth_m), 1.0), 1e-12);
  }
}

// None in the air and at the surface, and no jump on the way: a millimetre is less than a fiftieth of a stop. Control
// seen: in full from the surface on.
TEST(EyeAdaptation, NothingJumpsAtTheSurface) {
  EXPECT_EQ(adaptation_stops(at(-2.0), 1.0), 0.0);
  EXPECT_EQ(adaptation_stops(at(0.0), 1.0), 0.0);
  EXPECT_EQ(adaptation_stops(at(std::nan("")), 1.0), 0.0);
  double last = 0.0;
  for (double depth_m = 0.0; depth_m < 3.0; depth_m += 1e-3) {
    const double stops = adaptation_stops(at(depth_m), 1.0);
    EXPECT_GE(stops, last);
    EXPECT_LT(stops - last, 0.02) << depth_m;
    last = stops;
  }
}

// Where nothing is seen, the picture does not become noise. Control seen: the bound left out.
TEST(EyeAdaptation, IsBounded) {
  EXPECT_EQ(adaptation_stops(at(3000.0), 1.0), 10.0);
  EXPECT_EQ(adaptation_stops({{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 5.0}, 0.5), 5.0);
  EXPECT_EQ(adaptation_stops({{2.0, 2.0, 2.0}, {0.1, 0.1, 0.1}, 1.0}, 1.0), 0.0) << "milk";
}

}  // namespace
}  // namespace seascape
