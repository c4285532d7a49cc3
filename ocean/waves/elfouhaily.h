// Short wind waves, down to capillaries: the unified spectrum of Elfouhaily, Chapron, Katsaros and Vandemark (1997).
#pragma once

namespace seascape {

// Inverse wave age U10 / cp of a sea by its fetch over U10^2 / g: 0.84 tanh((X / 2.2e4)^0.4)^-0.75 (eq. 37), held below
// 5, up to which the spectrum is meant.
double inverse_wave_age(double fetch_over_wind_length);

// Curvature spectra are B(k) = k^3 S(k), S(k) the variance density over the wave number (m^3), without dimension.
class Elfouhaily {
 public:
  Elfouhaily() = default;
  // `age` is the inverse wave age, held between 0.84 and 5; wind at 10 m above 0.
  Elfouhaily(double wind_mps, double age, double gravity_mps2);
  // The spectrum as it was published (eq. 30), with the factor of the peak on both parts (McDaniel 2001).
  double curvature(double k) const;
  // Its tail as it is drawn: the part that long waves feed (B_l) is left only where the wind feeds a wave faster than
  // viscosity drains it, since below about 3 m/s it would overrun what Cox and Munk (1954) saw.
  double tail_curvature(double k) const;
  // Delta of the spreading (1 + Delta cos 2 angle) / 2 pi (eq. 57).
  double delta(double k) const;
  double peak() const { return peak_; }  // wave number, rad/m

 private:
  struct Parts {
    double low, high, speed;  // B_l, B_h and the phase speed (m/s)
  };
  Parts parts(double k) const;
  double age_ = 0.84, gravity_ = 9.81, peak_ = 1.0, peak_speed_ = 1.0;
  double friction_ = 0.0;                       // u*, m/s
  double slowest_ = 1.0, slowest_speed_ = 1.0;  // km, cm: the wave of least phase speed
  double alpha_p_ = 0.0, alpha_m_ = 0.0, gamma_ = 1.7, width_ = 1.0;
};

}  // namespace seascape
