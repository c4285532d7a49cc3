// The directional variance spectrum of a sea: JONSWAP wind waves and a swell train over deep water.
#pragma once
#include <array>
#include <glm/glm.hpp>

#include "ocean/waves/sea_state.h"

namespace seascape {

// Throws Error naming the key (waves.NAME), the value and the range when a value is not finite or out of range.
void validate(const SeaState& sea);
void validate(const WaveQuality& quality);

// The unit vector (x, z) of a direction in degrees clockwise from -z seen from above.
glm::dvec2 direction_xz(double degrees);

// Length of the longest peak wave of wind sea and swell (m); 0 where there is neither.
double longest_peak_wave_m(const SeaState& sea);

// One train of waves: S(w) = alpha g^2 w^-5 exp(-5/4 (wp/w)^4) gamma^r (Hasselmann et al. 1973).
struct WaveTrain {
  double alpha = 0.0;       // 0: no waves
  double peak_rad_s = 1.0;  // wp
  double gamma = 3.3;
  double to_rad = 0.0;      // direction it travels to, clockwise from -z
};

// Variance density of one train over angular frequency w (rad/s), m^2 s.
double frequency_density(const WaveTrain& train, double gravity_mps2, double w);

// Spreading functions: density over the angle (1/rad), integral 1 over a turn.
// Donelan, Hamilton and Hui (1985) with Banner's (1990) tail: beta / (2 tanh(pi beta)) sech^2(beta angle).
double wind_spreading(double angle_rad, double w_over_peak);
// cos^2s(angle / 2) with s = 25 (Longuet-Higgins et al. 1963): about 16 degrees either side.
double swell_spreading(double angle_rad);

// A sea's spectrum, ready to be evaluated. Immutable; any thread.
class Spectrum {
 public:
  // Wind sea: alpha = 0.076 X^-0.22, wp = 22 (g/U10) X^-1/3, X = g F / U10^2 (Hasselmann et al. 1973), with X held
  // where wp meets the fully developed peak and alpha such that the energy never passes the fully developed sea's (Pierson and
  // Moskowitz 1964, U19.5 = 1.026 U10: wp = 0.8772 g/U19.5, Hs = 0.20925 U19.5^2 / g). Throws Error as validate() does.
  explicit Spectrum(const SeaState& sea);

  // Variance density over the wave vector (kx, kz) in rad/m: m^4; its integral over the plane is the height's variance.
  double operator()(glm::dvec2 k) const;
  // Angular frequency of wave number k (rad/m) over deep water: w^2 = g k.
  double frequency(double k) const;
  // The factor on variance that small-wave suppression leaves at wave number k.
  double suppression(double k) const;
  bool flat() const { return wind_.alpha == 0.0 && swell_.alpha == 0.0; }
  const WaveTrain& wind() const { return wind_; }
  const WaveTrain& swell() const { return swell_; }

 private:
  WaveTrain wind_, swell_;
  double gravity_ = 9.81, suppression_ = 0.0;
};

}  // namespace seascape
