#include "ocean/waves/dispersion.h"

#include <gtest/gtest.h>

#include "tests/support/spectrum_truth.h"

namespace seascape {
namespace {

constexpr double g = 9.81;

TEST(Dispersion, airy_is_met_at_every_depth) {
  // Bar 1e-6. Control: tanh(kh) left out misses by 4e-4 at kh = 4 and by 100 % at 1e-3.
  double worst = 0;
  for (double h = 1e-3; h < 2e4; h *= 1.7)
    for (double wave_m = 0.01; wave_m < 5000; wave_m *= 1.31) {
      const double k = 2 * truth::pi / wave_m;
      worst = std::max(worst, std::abs(airy_frequency(k, g, h) / truth::airy(k, g, h) - 1));
    }
  EXPECT_LE(worst, 1e-6);
  RecordProperty("worst", std::to_string(worst));
}

TEST(Dispersion, orbits_are_as_wide_as_airy_has_them) {
  // coth(k h) by exponentials, to 1e-12, up to 8; a circle in the deep, and where there is no wave. Control: circles at
  // every depth (seen).
  for (const double kh : {0.1, 0.13, 0.2, 0.5, 1.0, 3.0, 8.0, 30.0}) {
    const double e = std::exp(-2 * kh);
    EXPECT_NEAR(orbit_width(kh / 7, 7) / std::min((1 + e) / (1 - e), 8.0), 1, 1e-12) << kh;
  }
  EXPECT_EQ(orbit_width(1, 1e-6), 8);
  EXPECT_EQ(orbit_width(1e-3, 1e6), 1);
  for (const double nothing : {0.0, -1.0}) EXPECT_EQ(orbit_width(nothing, 10), 1);
}

TEST(Dispersion, hard_7_depths_of_1e_6_and_1e6) {
  // The limits of tanh: w = k sqrt(g h) and w = sqrt(g k), to 1e-6. Control: tanh(x) as x - x^3 / 3 fails in the deep.
  for (const double wave_m : {0.1, 1.0, 30.0, 3000.0}) {
    const double k = 2 * truth::pi / wave_m;
    EXPECT_NEAR(airy_frequency(k, g, 1e-6) / (k * std::sqrt(g * 1e-6)), 1, 1e-6) << wave_m;
    EXPECT_NEAR(airy_frequency(k, g, 1e6) / std::sqrt(g * k), 1, 1e-6) << wave_m;
    EXPECT_NEAR(airy_group_speed(k, g, 1e-6) / std::sqrt(g * 1e-6), 1, 1e-6) << wave_m;
    EXPECT_NEAR(airy_group_speed(k, g, 1e6) / (0.5 * std::sqrt(g / k)), 1, 1e-6) << wave_m;
    EXPECT_NEAR(airy_wave_number(airy_frequency(k, g, 1e-6), g, 1e-6) / k, 1, 3e-5) << wave_m;
    EXPECT_NEAR(airy_wave_number(airy_frequency(k, g, 1e6), g, 1e6) / k, 1, 3e-5) << wave_m;
  }
}

TEST(Dispersion, hard_6_dry_land_and_no_wave) {
  // Depths of 0 and less, and k = 0, give exactly 0 without a division. Control: a depth of -1 let through gives the
  // root of a negative number.
  for (const double h : {0.0, -1.0, -1e6}) {
    EXPECT_EQ(airy_frequency(1, g, h), 0);
    EXPECT_EQ(airy_group_speed(1, g, h), 0);
    EXPECT_EQ(airy_wave_number(1, g, h), 0);
    EXPECT_EQ(wave_frequency(1.0, g, h), 0);
  }
  EXPECT_EQ(airy_frequency(0, g, 10), 0);
  EXPECT_EQ(airy_wave_number(0, g, 10), 0);
  EXPECT_EQ(wave_frequency(0.0, g, 10.0), 0);
  EXPECT_NEAR(airy_group_speed(0, g, 10), std::sqrt(g * 10), 1e-12);
}

TEST(Dispersion, group_speed_is_the_derivative) {
  // Against differences of the truth. Control: c / 2, deep water's, misses by half in the shallows.
  for (double h = 0.1; h < 1e4; h *= 3)
    for (double wave_m = 0.1; wave_m < 3000; wave_m *= 2.3) {
      const double k = 2 * truth::pi / wave_m, d = 1e-4 * k;
      const double truth = (truth::airy(k + d, g, h) - truth::airy(k - d, g, h)) / (2 * d);
      EXPECT_NEAR(airy_group_speed(k, g, h) / truth, 1, 1e-6) << h << " " << wave_m;
    }
}

TEST(Dispersion, inverse_within_3e_5) {
  // Against bisection. Control: Guo's form without the Newton step misses by 0.75 %.
  double worst = 0;
  for (double x = 1e-4; x < 1e3; x *= 1.013) {  // w sqrt(h / g)
    const double h = 7.3, w = x * std::sqrt(g / h);
    worst = std::max(worst, std::abs(airy_wave_number(w, g, h) / truth::airy_inverse(w, g, h) - 1));
  }
  EXPECT_LE(worst, 3e-5);
  RecordProperty("worst", std::to_string(worst));
}

TEST(Dispersion, surface_tension_hurries_short_waves) {
  // The wave of 17 mm is the slowest, 0.23 m/s; a metre's is untouched to 1e-4. Control: sigma / rho taken as 0.0735.
  for (double k = 1; k < 3000; k *= 1.1)
    EXPECT_NEAR(wave_frequency(k, g, 1.0) / truth::airy(k, g, 1.0, 7.17e-5), 1, 1e-12);
  double slowest = 1e9, at = 0;
  for (double k = 10; k < 3000; k *= 1.001)
    if (wave_frequency(k, g, 1e4) / k < slowest) slowest = wave_frequency(k, g, 1e4) / k, at = k;
  EXPECT_NEAR(slowest, 0.23, 0.002);
  EXPECT_NEAR(at, 370, 2);
  EXPECT_NEAR(wave_frequency(2 * truth::pi, g, 1e4) / airy_frequency(2 * truth::pi, g, 1e4), 1, 2e-4);
  EXPECT_NEAR(double(wave_frequency(100.0L, 9.81L, 5.0L)), wave_frequency(100.0, 9.81, 5.0), 1e-10);
}

}  // namespace
}  // namespace seascape
