// Variance of trains of waves over frequency: Pierson-Moskowitz, JONSWAP and TMA for the wind sea, JONSWAP's shape for
// swell.
#pragma once
#include <array>

#include "ocean/waves/sea_state.h"

namespace seascape {

inline constexpr int swell_trains = 3;

// One train of waves: S(w) = alpha g^2 w^-5 exp(-5/4 (wp/w)^4) gamma^r (Hasselmann et al. 1973, eq. 2.4.4).
struct WaveTrain {
  double alpha = 0.0;       // 0: no waves
  double peak_rad_s = 1.0;  // wp
  double gamma = 3.3;
  double to_rad = 0.0;  // direction it travels to, clockwise from -z
  // Swell has left its short waves behind (Snodgrass et al. 1966): the train fades out from sqrt(10) to sqrt(40) peak
  // frequencies.
  bool fades = false;
};

// Variance density of one train over angular frequency w (rad/s) in deep water, m^2 s.
double frequency_density(const WaveTrain& train, double gravity_mps2, double w);

// Kitaigorodskii's factor, by which depth limits a spectrum over frequency, as Thompson and Vincent (1983) approximate
// it for TMA (Bouws et al. 1985): wh = w sqrt(h / g); wh^2 / 2 up to 1, 1 - (2 - wh)^2 / 2 up to 2, then 1. Within 4 %
// of the exact tanh^2(kh) / (1 + 2 kh / sinh 2kh). 0 on dry land.
double kitaigorodskii_factor(double w, double gravity_mps2, double depth_m);

// The wind sea's train; alpha 0 without wind, fetch or water. JONSWAP and TMA: alpha = 0.076 X^-0.22, wp = 22 (g/U10)
// X^-1/3, X = g F / U10^2 (Hasselmann et al. 1973), with X held where wp meets the fully developed peak and alpha such
// that the energy never passes the fully developed sea's (Pierson and Moskowitz 1964, U19.5 = 1.026 U10: wp = 0.8772
// g/U19.5, Hs = 0.20925 U19.5^2 / g). Pierson-Moskowitz: that sea at any fetch but 0. Elfouhaily: its peak alone
// counts.
WaveTrain wind_train(const SeaState& sea);
std::array<WaveTrain, swell_trains> swell_of(const SeaState& sea);

}  // namespace seascape
