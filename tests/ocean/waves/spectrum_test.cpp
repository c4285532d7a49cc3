#include "ocean/waves/spectrum.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/error.h"
#include "ocean/waves/ladder.h"
#include "tests/support/spectrum_truth.h"

namespace seascape {
namespace {

// Of the trains over frequency, deep water.
double variance_of(const SeaState& sea) {
  const Spectrum spectrum(sea);
  return truth::integral(
      [&](double s) {
        const double w = std::exp(s);
        double sum = frequency_density(spectrum.wind(), sea.gravity_mps2, w);
        for (int i = 0; i < swell_trains; ++i) sum += frequency_density(spectrum.swell(i), sea.gravity_mps2, w);
        return w * sum;
      },
      std::log(1e-2), std::log(1e4), 1e-9);
}

// Of the whole spectrum over wave numbers, at any depth.
double whole_variance(const SeaState& sea) {
  const Spectrum spectrum(sea);
  return truth::integral(
      [&](double s) {
        const double k = std::exp(s);
        double sum = 0;
        for (int c = 0; c < Spectrum::components; ++c) sum += spectrum.radial(c, k);
        return k * k * sum;
      },
      std::log(1e-4), std::log(1e4), 1e-9, 400);
}

TEST(Spectrum, drawn_waves_run_by_gravity_and_surface_tension) {
  // Control: gravity 9.80 instead of the sea's misses by 5e-4 and fails.
  SeaState sea;
  for (const double depth : {0.5, 20.0, 10000.0}) {
    sea.depth_m = depth;
    for (const double wave_m : {0.1, 1.0, 10.0, 100.0, 1000.0}) {
      const double k = 2 * truth::pi / wave_m;
      EXPECT_NEAR(Spectrum(sea).frequency(k) / truth::airy(k, 9.81, depth, 7.17e-5), 1.0, 1e-6);
    }
  }
}

TEST(Spectrum, pierson_moskowitz_is_the_fully_developed_sea) {
  // Integral 1e-4, at any fetch. Control: U10 in place of U19.5 misses by 5 %.
  for (const double wind : {3.0, 10.0, 25.0, 60.0})
    for (const double fetch : {1e3, 1e9}) {
      SeaState sea;
      sea.spectrum = WaveSpectrum::pierson_moskowitz;
      sea.wind_speed_mps = wind;
      sea.fetch_m = fetch;
      const double u19 = 1.026 * wind;
      EXPECT_NEAR(4 * std::sqrt(variance_of(sea)) / truth::pierson_moskowitz_hs(u19, 9.81), 1, 1e-4);
      const Spectrum spectrum(sea);
      EXPECT_NEAR(spectrum.wind().peak_rad_s * u19 / 9.81, 0.8772, 1e-4);
      for (double r = 0.5; r < 10; r *= 1.2) {
        const double w = r * 9.81 / u19, truth = truth::pierson_moskowitz(w, u19, 9.81);
        EXPECT_NEAR(frequency_density(spectrum.wind(), 9.81, w), truth, 1e-6 * truth);
      }
      const double m0 = truth::integral([&](double w) { return truth::pierson_moskowitz(w, u19, 9.81); },
                                        0.2 * 9.81 / u19, 60 * 9.81 / u19, 1e-9, 4096);
      EXPECT_NEAR(variance_of(sea) / m0, 1, 1e-4);
    }
}

TEST(Spectrum, tma_is_jonswap_limited_by_depth) {
  // The factor is in [0, 1], continuous, the parabolas' to 1e-6 and the exact one's to 4 %; the sea is JONSWAP times
  // it, and its energy over wave numbers is that over frequency. Control: wh = w sqrt(h g).
  double before = 0;
  for (double x = 1e-4; x < 20; x *= 1.003) {
    const double h = 4.0, w = x * std::sqrt(9.81 / h), factor = kitaigorodskii_factor(w, 9.81, h);
    EXPECT_GE(factor, before - 1e-15);
    EXPECT_LE(factor, 1);
    EXPECT_LE(factor - before, 0.004);
    EXPECT_NEAR(factor, truth::depth_factor(w, 9.81, h), 1e-6);
    EXPECT_NEAR(factor / truth::depth_factor_exact(w, 9.81, h), 1, 0.045) << x;
    before = factor;
  }
  EXPECT_EQ(kitaigorodskii_factor(1, 9.81, 0), 0);
  EXPECT_EQ(kitaigorodskii_factor(1, 9.81, -3), 0);
  EXPECT_EQ(kitaigorodskii_factor(0, 9.81, 3), 0);
  double shallower = 0;
  for (const double depth : {2.0, 5.0, 15.0, 40.0, 1e4}) {
    SeaState sea;
    sea.wind_speed_mps = 20;
    sea.spectrum = WaveSpectrum::tma;
    sea.depth_m = depth;
    const truth::Jonswap jonswap(20, sea.fetch_m, 9.81);
    // Of the waves longer than those that pass into Elfouhaily's.
    const double k = 2 * truth::pi / 12, w = truth::airy(k, 9.81, depth);
    const double m0 = truth::integral([&](double v) { return jonswap.at(v) * truth::depth_factor(v, 9.81, depth); },
                                      0.1, w, 1e-9, 2000);
    const Spectrum spectrum(sea);
    const double ours = truth::integral([&](double s) { return std::exp(2 * s) * spectrum.radial(0, std::exp(s)); },
                                        std::log(1e-3), std::log(k), 1e-9, 2000);
    // In shallow water the passage begins at shorter waves still, never at longer.
    EXPECT_NEAR(ours / m0, 1, 1e-4) << depth;
    EXPECT_GT(whole_variance(sea), shallower);
    shallower = whole_variance(sea);
  }
  SeaState deep, tma;
  tma.spectrum = WaveSpectrum::tma;
  EXPECT_NEAR(whole_variance(tma) / whole_variance(deep), 1, 1e-9);
}

TEST(Spectrum, finite_depth_keeps_the_energy_over_frequency) {
  // JONSWAP and swell over 8 m of water. Control: deep water's dw/dk loses a third of the swell.
  SeaState deep, shallow;
  deep.wind_speed_mps = shallow.wind_speed_mps = 0;
  deep.swell_height_m = shallow.swell_height_m = 2;
  shallow.depth_m = 8;
  EXPECT_NEAR(whole_variance(shallow) / whole_variance(deep), 1, 1e-4);
  EXPECT_NEAR(whole_variance(deep) / variance_of(deep), 1, 1e-4);
  EXPECT_NEAR(longest_peak_wave_m(shallow) / (2 * truth::pi / truth::airy_inverse(2 * truth::pi / 12, 9.81, 8)), 1,
              3e-5);
}

TEST(Spectrum, elfouhaily_has_its_own_long_waves) {
  // Control: the share of short waves left at 0 below 12 m loses Cox and Munk's slopes; here, densities against the
  // published.
  SeaState sea;
  sea.spectrum = WaveSpectrum::elfouhaily;
  const Spectrum spectrum(sea);
  const double x = 9.81 * sea.fetch_m / 100, age = 0.84 * std::pow(std::tanh(std::pow(x / 2.2e4, 0.4)), -0.75);
  const truth::Elfouhaily truth(10, age, 9.81);
  for (double k = 0.05; k < 0.5; k *= 1.1)
    EXPECT_NEAR(spectrum.radial(0, k) * std::pow(k, 4), truth.low(k) + truth.high(k), 1e-9);
  for (double k = 25; k < 1500; k *= 1.1)
    EXPECT_NEAR(spectrum.radial(1, k) * std::pow(k, 4), truth.low(k) * truth.fed(k) + truth.high(k), 1e-9);
  EXPECT_NEAR(spectrum.wind().peak_rad_s, age * 9.81 / 10, 1e-9);
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
  const double m0 =
      truth::integral([&](double w) { return truth::jonswap(w, alpha, peak, 3.3, g); }, 0.1, 200.0, 1e-9, 4096);
  EXPECT_NEAR(variance_of(sea) / m0, 1.0, 1e-4);
}

TEST(Spectrum, hard_5_long_fetch_is_the_fully_developed_sea) {
  // Hard case 5: at fetches up to 1e9 m the sea is the fully developed one, and no higher. Control: without the cap on
  // alpha it is passed by half its energy; with alpha falling on with fetch the sea of 1e9 m was half as high (seen).
  // The short waves' part moves it by 0.2 % at most.
  for (const double wind : {3.0, 10.0, 25.0, 60.0}) {
    double before = 0;
    for (const double fetch : {1e3, 1e4, 1e5, 1e6, 1e7, 1e9}) {
      SeaState sea;
      sea.wind_speed_mps = wind;
      sea.fetch_m = fetch;
      const double hs = 4 * std::sqrt(variance_of(sea)), most = truth::pierson_moskowitz_hs(1.026 * wind, 9.81);
      EXPECT_LE(hs, most * 1.0001) << wind << " m/s " << fetch << " m";
      EXPECT_LE(4 * std::sqrt(whole_variance(sea)), most * 1.002) << wind << " m/s " << fetch << " m";
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
  // Its short waves are left behind: slopes are finite and small. Control: a w^-5 tail, whose slopes have no end.
  EXPECT_LT(slope_moments(sea).x + slope_moments(sea).y, 0.002);
  EXPECT_EQ(frequency_density(Spectrum(sea).swell(), 9.81, 6.4 * 2 * truth::pi / 14), 0);
}

TEST(Spectrum, three_swells_add_up) {
  // Control: the second train's height given to the third.
  SeaState sea;
  sea.wind_speed_mps = 0;
  sea.swell_height_m = 1, sea.swell2_height_m = 2, sea.swell3_height_m = 0.5;
  EXPECT_NEAR(16 * variance_of(sea), 1 + 4 + 0.25, 1e-3);
  const Spectrum spectrum(sea);
  const double periods[] = {12, 9, 16}, heights[] = {1, 2, 0.5}, to[] = {80, 320, 200};
  for (int i = 0; i < swell_trains; ++i) {
    const double energy =
        truth::integral([&](double s) { return std::exp(s) * frequency_density(spectrum.swell(i), 9.81, std::exp(s)); },
                        -3, 4, 1e-9, 400);
    EXPECT_NEAR(4 * std::sqrt(energy), heights[i], 1e-4);
    EXPECT_NEAR(spectrum.swell(i).peak_rad_s, 2 * truth::pi / periods[i], 1e-12);
    EXPECT_NEAR(spectrum.swell(i).to_rad, to[i] * truth::pi / 180, 1e-12);
  }
  EXPECT_NEAR(longest_peak_wave_m(sea), 9.81 * 256 / (2 * truth::pi), 0.02);
}

TEST(Spectrum, plane_integral_is_the_frequency_integral) {
  // Control: the factor dw/dk = w/k instead of w/2k doubles it.
  SeaState sea;
  sea.swell_height_m = 1.0;
  const Spectrum spectrum(sea);
  const double plane = truth::integral(
      [&](double s) {
        const double k = std::exp(s);
        return k * k *
               truth::integral([&](double a) { return spectrum(k * glm::dvec2(std::sin(a), -std::cos(a))); },
                               -truth::pi, truth::pi, 1e-7, 32);
      },
      std::log(1e-3), std::log(1e3), 1e-6);
  EXPECT_NEAR(plane / whole_variance(sea), 1.0, 1e-3);
  EXPECT_NEAR(plane / variance_of(sea), 1.0, 2e-3);  // which Elfouhaily's short waves move by 8e-4
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
  } rows[] = {{&SeaState::wind_speed_mps, "waves.wind_speed_mps"},
              {&SeaState::fetch_m, "waves.fetch_m"},
              {&SeaState::wind_to_deg, "waves.wind_to_deg"},
              {&SeaState::peak_enhancement, "waves.peak_enhancement"},
              {&SeaState::swell_height_m, "waves.swell_height_m"},
              {&SeaState::swell_period_s, "waves.swell_period_s"},
              {&SeaState::chop, "waves.chop"},
              {&SeaState::gravity_mps2, "waves.gravity_mps2"},
              {&SeaState::swell_to_deg, "waves.swell_to_deg"},
              {&SeaState::small_wave_suppression, "waves.small_wave_suppression"},
              {&SeaState::swell2_height_m, "waves.swell2_height_m"},
              {&SeaState::swell2_period_s, "waves.swell2_period_s"},
              {&SeaState::swell2_to_deg, "waves.swell2_to_deg"},
              {&SeaState::swell3_height_m, "waves.swell3_height_m"},
              {&SeaState::swell3_period_s, "waves.swell3_period_s"},
              {&SeaState::swell3_to_deg, "waves.swell3_to_deg"},
              {&SeaState::swell_elongation, "waves.swell_elongation"},
              {&SeaState::loop_s, "waves.loop_s"},
              {&SeaState::depth_m, "waves.depth_m"}};
  for (const auto& row : rows)
    for (const double bad : {nan, inf, -inf, -1e7}) {
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
  for (const int choice : {-1, 4}) {
    SeaState spectrum, spreading;
    spectrum.spectrum = WaveSpectrum(choice);
    spreading.spreading = WaveSpreading(choice);
    EXPECT_THROW(validate(spectrum), Error);
    EXPECT_THROW(validate(spreading), Error);
  }
  EXPECT_NO_THROW(validate(SeaState{}));
  EXPECT_THROW(validate(WaveQuality{.resolution = 100}), Error);
  EXPECT_THROW(validate(WaveQuality{.cascades = 6}), Error);
}

TEST(Ladder, hard_34_shares_add_to_one_and_vanish_inside_the_tile) {
  // Hard case 34: the shares of all cascades add to 1 at every wave number, and vanish before a tile ends. Control: a
  // band that rises but does not fall counts the overlaps twice.
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
        if (k * l[i].side_m / (2 * truth::pi) >= (i == 0 ? 127 : 31)) {
          EXPECT_EQ(share, 0);
        }
      }
      EXPECT_NEAR(sum, 1, 1e-12);
    }
    for (int i = 1; i < gpu::max_cascades; ++i) {
      const double ratio = l[i - 1].side_m / l[i].side_m;
      // The first tile has four times as many bins. The shorter it is, the nearer are all others to each other.
      EXPECT_GT(ratio, l[0].warped ? (i == 1 ? 8 : 2.0) : (i == 1 ? 20 : 4.7));
      EXPECT_LT(ratio, i == 1 ? 30 : 6.8);
      EXPECT_GT(std::abs(ratio - std::round(ratio)), 0.004) << "sides " << i - 1 << " and " << i << " are commensurate";
      EXPECT_GT(l[i].k_in[0] * l[i].side_m / (2 * truth::pi), 4.0);
    }
  }
}

}  // namespace
}  // namespace seascape
