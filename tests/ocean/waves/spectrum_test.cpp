#include "ocean/waves/spectrum.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/error.h"
#include "ocean/waves/ladder.h"
#include "tests/support/truth.h"

namespace seascape {
namespace {

double variance_of(const SeaState& sea) {
  const Spectrum spectrum(sea);
  return truth::integral(
      [&](double s) {
        const double w = std::exp(s);
        return w * (frequency_density(spectrum.wind(), sea.gravity_mps2, w) + frequency_density(spectrum.swell(), sea.gravity_mps2, w));
      },
      std::log(1e-2), std::log(1e4), 1e-9);
}

TEST(Spectrum, airy_frequency_of_deep_water) {
  // Control: gravity 9.80 instead of the sea's misses by 5e-4 and fails.
  SeaState sea;
  sea.gravity_mps2 = 9.81;
  for (const double wave_m : {0.1, 1.0, 10.0, 100.0, 1000.0}) {
    const double k = 2 * truth::pi / wave_m, w = Spectrum(sea).frequency(k);
    EXPECT_NEAR(w * w / (9.81 * k), 1.0, 1e-6);
  }
}

TEST(Spectrum, jonswap_has_152495_times_the_energy_of_gamma_1) {
  // Control: sigma 0.07 on both sides of the peak misses by 0.06.
  const auto energy = [](double gamma) {
    const WaveTrain train{0.0081, 0.8, gamma, 0.0};
    return truth::integral([&](double w) { return frequency_density(train, 9.81, w); }, 0.05, 80.0, 1e-9, 4096);
  };
  EXPECT_NEAR(energy(3.3) / energy(1.0), 1.52495, 1.5e-4);
  EXPECT_NEAR(4 * std::sqrt(energy(1.0)), 4 * std::sqrt(0.0081 * 9.81 * 9.81 / (5 * std::pow(0.8, 4))), 1e-4);
  for (double w = 0.3; w < 6; w += 0.0713)
    EXPECT_NEAR(frequency_density({0.01, 0.8, 3.3, 0.0}, 9.81, w), truth::jonswap(w, 0.01, 0.8, 3.3, 9.81), 1e-12);
}

TEST(Spectrum, young_sea_follows_hasselmann_1973) {
  // Control: exponent -0.30 instead of -1/3 moves the peak by 25 % and fails.
  SeaState sea;
  sea.wind_speed_mps = 15;
  sea.fetch_m = 30e3;
  const double x = 9.81 * 30e3 / 225, g = 9.81;
  const Spectrum spectrum(sea);
  EXPECT_NEAR(spectrum.wind().peak_rad_s, 22 * g / 15 / std::cbrt(x), 1e-9);
  const double alpha = 0.076 * std::pow(x, -0.22), peak = 22 * g / 15 / std::cbrt(x);
  const double m0 = truth::integral([&](double w) { return truth::jonswap(w, alpha, peak, 3.3, g); }, 0.1, 200.0, 1e-9, 4096);
  EXPECT_NEAR(variance_of(sea) / m0, 1.0, 1e-4);
}

TEST(Spectrum, long_fetch_is_the_fully_developed_sea) {
  // Control: without the cap on alpha it is passed by half its energy; with alpha falling on with fetch the sea of
  // 1e9 m was half as high (seen).
  for (const double wind : {3.0, 10.0, 25.0, 60.0}) {
    double before = 0;
    for (const double fetch : {1e3, 1e4, 1e5, 1e6, 1e7, 1e9}) {
      SeaState sea;
      sea.wind_speed_mps = wind;
      sea.fetch_m = fetch;
      const double hs = 4 * std::sqrt(variance_of(sea)), most = truth::pierson_moskowitz_hs(1.026 * wind, 9.81);
      EXPECT_LE(hs, most * 1.0001) << wind << " m/s " << fetch << " m";
      EXPECT_GE(hs, before * 0.9999);
      before = hs;
    }
    EXPECT_NEAR(before / truth::pierson_moskowitz_hs(1.026 * wind, 9.81), 1.0, 1e-4);
  }
}

TEST(Spectrum, swell_has_its_height_and_period) {
  // Control: 1/5, the shape integral of gamma 1, in place of gamma 6's.
  SeaState sea;
  sea.wind_speed_mps = 0;
  sea.swell_height_m = 2.5;
  sea.swell_period_s = 14;
  EXPECT_NEAR(4 * std::sqrt(variance_of(sea)), 2.5, 2.5e-4);
  EXPECT_NEAR(2 * truth::pi / Spectrum(sea).swell().peak_rad_s, 14, 1e-9);
}

TEST(Spectrum, spreading_integrates_to_one) {
  // Control: without tanh(pi beta) the tail of the wind sea fails.
  for (double r = 0.2; r < 60; r *= 1.07)
    EXPECT_NEAR(truth::integral([&](double a) { return wind_spreading(a, r); }, -truth::pi, truth::pi, 1e-8), 1.0, 1e-3) << r;
  EXPECT_NEAR(truth::integral(swell_spreading, -truth::pi, truth::pi, 1e-8), 1.0, 1e-3);
}

TEST(Spectrum, plane_integral_is_the_frequency_integral) {
  // Control: the factor dw/dk = w/k instead of w/2k doubles it.
  SeaState sea;
  sea.swell_height_m = 1.0;
  const Spectrum spectrum(sea);
  const double plane = truth::integral(
      [&](double s) {
        const double k = std::exp(s);
        return k * k * truth::integral([&](double a) { return spectrum(k * glm::dvec2(std::sin(a), -std::cos(a))); }, -truth::pi, truth::pi, 1e-7, 32);
      },
      std::log(1e-3), std::log(1e3), 1e-6);
  EXPECT_NEAR(plane / variance_of(sea), 1.0, 1e-3);
}

TEST(Spectrum, waves_go_to_where_the_wind_goes) {
  // Control: degrees counted from +x, or anticlockwise, put the largest density elsewhere.
  SeaState sea;
  sea.wind_to_deg = 90;  // towards +x
  const Spectrum spectrum(sea);
  const double k = 0.1;
  EXPECT_GT(spectrum({k, 0}), 5 * spectrum({0, k}));
  EXPECT_GT(spectrum({k, 0}), 1000 * spectrum({-k, 0}));
  EXPECT_NEAR(spectrum({0, k}), spectrum({0, -k}), 1e-12 * spectrum({k, 0}));
  EXPECT_NEAR(direction_xz(0).y, -1, 1e-12);
  sea.wind_to_deg = 0;  // towards -z; a turn about x would pass the lines above (seen)
  EXPECT_GT(Spectrum(sea)({0, -k}), 1000 * Spectrum(sea)({0, k}));
}

TEST(Spectrum, suppression_damps_only_short_waves) {
  // Control: a corner at 20 m would take a tenth of the waves of 10 m.
  SeaState sea;
  sea.small_wave_suppression = 1;
  const Spectrum spectrum(sea);
  EXPECT_NEAR(spectrum.suppression(2 * truth::pi / 20), 1, 1e-3);
  EXPECT_LT(spectrum.suppression(2 * truth::pi / 0.5), 0.01);
}

TEST(Spectrum, refuses_what_is_no_sea_by_name) {
  // Control: a check written as `value < least` lets NaN through.
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const struct {
    double SeaState::*member;
    const char* key;
  } rows[] = {{&SeaState::wind_speed_mps, "waves.wind_speed_mps"}, {&SeaState::fetch_m, "waves.fetch_m"},
              {&SeaState::wind_to_deg, "waves.wind_to_deg"},       {&SeaState::peak_enhancement, "waves.peak_enhancement"},
              {&SeaState::swell_height_m, "waves.swell_height_m"}, {&SeaState::swell_period_s, "waves.swell_period_s"},
              {&SeaState::chop, "waves.chop"},                     {&SeaState::gravity_mps2, "waves.gravity_mps2"},
              {&SeaState::swell_to_deg, "waves.swell_to_deg"},     {&SeaState::small_wave_suppression, "waves.small_wave_suppression"}};
  for (const auto& row : rows)
    for (const double bad : {nan, inf, -inf, -1e6}) {
      SeaState sea;
      sea.*row.member = bad;
      try {
        validate(sea);
        ADD_FAILURE() << row.key << " took " << bad;
      } catch (const Error& error) {
        EXPECT_EQ(error.where(), row.key);
      }
      EXPECT_THROW(Spectrum{sea}, Error);
      EXPECT_THROW(ladder(sea), Error);
    }
  EXPECT_NO_THROW(validate(SeaState{}));
  EXPECT_THROW(validate(WaveQuality{.resolution = 100}), Error);
  EXPECT_THROW(validate(WaveQuality{.cascades = 6}), Error);
}

TEST(Ladder, shares_add_to_one_and_vanish_inside_the_tile) {
  // Hard case 34. Control: a band that rises but does not fall counts the overlaps twice.
  for (const double wind : {0.0, 3.0, 6.0, 10.0, 20.0, 40.0}) {
    SeaState sea;
    sea.wind_speed_mps = wind;
    const Ladder l = ladder(sea);
    for (double k = 1e-4; k < l.back().k_out[0]; k *= 1.013) {
      double sum = 0;
      for (int i = 0; i < gpu::max_cascades; ++i) {
        const double share = band_share(l, i, k);
        EXPECT_GE(share, 0);
        sum += share;
        if (k * l[i].side_m / (2 * truth::pi) >= 31) {
          EXPECT_EQ(share, 0);
        }
      }
      EXPECT_NEAR(sum, 1, 1e-12);
    }
    for (int i = 1; i < gpu::max_cascades; ++i) {
      const double ratio = l[i - 1].side_m / l[i].side_m;
      EXPECT_GT(ratio, 3.4);
      EXPECT_LT(ratio, 4.6);
      EXPECT_GT(std::abs(ratio - std::round(ratio)), 0.004) << "sides " << i - 1 << " and " << i << " are commensurate";
      EXPECT_GT(l[i].k_in[0] * l[i].side_m / (2 * truth::pi), 5.0);
    }
  }
}

}  // namespace
}  // namespace seascape
