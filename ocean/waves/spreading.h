// How waves of one frequency spread over directions: densities over the angle from their mean direction, integral 1
// over a turn.
#pragma once
#include <span>

#include "ocean/waves/sea_state.h"

namespace seascape {

// A density's shape at one frequency.
struct SpreadingShape {
  enum class Form {
    cosine_power,     // cos^2s(angle / 2) (Longuet-Higgins, Cartwright and Smith 1963), s = parameter
    sech_squared,     // sech^2(beta angle), beta = parameter
    second_harmonic,  // (1 + Delta cos 2 angle) (1 + o(angle)), Delta = parameter; o below
  } form = Form::cosine_power;
  double parameter = 0.0;
  // A further factor cos^2s(angle / 2), s = elongation: Horvath's (2015, eq. 44) swell.
  double elongation = 0.0;
};
// o = (15 c - 10 c^3 + 3 c^5) / 8, c = cos(angle), gives Elfouhaily's spreading, whose two opposite directions are
// alike since it describes a frozen surface, a sense of travel: waves go with the wind. Being odd under a turn of 180
// degrees it leaves the sum of both directions, and so every slope moment, as published; it is ours.

// Density (1/rad) at an angle from the mean direction (rad).
double spreading(const SpreadingShape& shape, double angle_rad);
// Densities at angles pi i / (n - 1), i = 0 to n - 1, such that the straight lines between them integrate to 1 over a
// turn to rounding. n = values.size(), 2 to 513; costs some 10 ns a value.
void tabulate_spreading(const SpreadingShape& shape, std::span<double> values);
// The mean of cos(2 angle), -1 to 1: of a slope variance (1 + it) / 2 lies along the mean direction.
double second_moment(const SpreadingShape& shape);

// Shape of a wind sea at w / wp for an inverse wave age U10 / cp. `delta` is Elfouhaily's Delta there
// (Elfouhaily::delta); elongation is Horvath's swell parameter, 0 to 1.
//   cosine_power    s = 11.5 (U10 / cp)^-2.5 (w/wp)^5 up to the peak, (w/wp)^-2.5 above it (Mitsuyasu et al. 1975)
//   hasselmann      s = 6.97 (w/wp)^4.06 up to 1.05, 9.77 (w/wp)^(-2.33 - 1.45 (U10/cp - 1.17)) above (Hasselmann et
//   al. 1980) donelan_banner  beta = 2.61 (w/wp)^1.3 up to 0.95, 2.28 (w/wp)^-1.3 up to 1.6 (Donelan, Hamilton and Hui
//   1985), above it
//                   10^(-0.4 + 0.8393 exp(-0.567 ln (w/wp)^2)) (Banner 1990); held below 0.56
SpreadingShape wind_spreading(WaveSpreading model, double w_over_peak, double inverse_wave_age, double delta,
                              double elongation);
// Swell: cos^2s(angle / 2) with s = 25, about 16 degrees either side.
SpreadingShape swell_spreading(double w_over_peak, double elongation);

}  // namespace seascape
