// How a footprint fades a cascade out: shared by the wave field and the shaders, which surface_gpu_test.cpp holds
// together.
#include "ocean/waves/ladder.h"

#include <gtest/gtest.h>

#include <numbers>

namespace seascape {
namespace {

// Control: k_in[1] taken for k_in[0] in longest_wave leaves waves longer than it, and this fails.
TEST(Ladder, NoWaveOfACascadeIsLongerThanItsLongest) {
  for (double wind_mps : {3.0, 10.0, 25.0}) {
    SeaState sea;
    sea.wind_speed_mps = wind_mps;
    const Ladder cascades = ladder(sea);
    for (int i = 0; i < int(cascades.size()); ++i) {
      const double longest = longest_wave(cascades[i]);
      EXPECT_LE(longest, cascades[i].side_m * (1.0 + 1e-12)) << wind_mps << " m/s, cascade " << i;
      if (i > 0) {
        EXPECT_EQ(band_share(cascades, i, 2.0 * std::numbers::pi / (1.001 * longest)), 0.0)
            << wind_mps << " m/s, cascade " << i;
      }
    }
  }
}

// Control: 2.0 - footprint / longest in kept_share still keeps all at the longest wave, and this fails.
TEST(Ladder, AFootprintFadesACascadeFromHalfItsLongestWaveToAllOfIt) {
  for (const Cascade& cascade : ladder(SeaState{})) {
    const double longest = longest_wave(cascade);
    EXPECT_EQ(kept_share(cascade, 0.0), 1.0);
    EXPECT_EQ(kept_share(cascade, 0.5 * longest), 1.0);
    EXPECT_NEAR(kept_share(cascade, 0.75 * longest), 0.5, 1e-12);
    EXPECT_EQ(kept_share(cascade, longest), 0.0);
    EXPECT_EQ(kept_share(cascade, 1e9), 0.0);
    double before = 1.0;
    for (int step = 1; step <= 1000; ++step) {  // never rises, never jumps
      const double now = kept_share(cascade, step * longest / 900.0);
      EXPECT_LE(now, before);
      EXPECT_LE(before - now, 2.5e-3);
      before = now;
    }
  }
}

}  // namespace
}  // namespace seascape
