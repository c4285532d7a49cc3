// The directional variance spectrum of a sea: wind waves down to capillaries and trains of swell, over water of one
// depth.
#pragma once
#include <array>
#include <glm/glm.hpp>

#include "ocean/waves/elfouhaily.h"
#include "ocean/waves/frequency_spectrum.h"
#include "ocean/waves/sea_state.h"
#include "ocean/waves/spreading.h"

namespace seascape {

// Throws Error naming the key (waves.NAME), the value and the range when a value is not finite or out of range.
void validate(const SeaState& sea);
void validate(const WaveQuality& quality);

// The unit vector (x, z) of a direction in degrees clockwise from -z seen from above.
glm::dvec2 direction_xz(double degrees);

// Length of the longest peak wave of wind sea and swell (m); 0 where there is neither.
double longest_peak_wave_m(const SeaState& sea);

// A sea's spectrum, ready to be evaluated. Immutable; any thread.
//
// The wind sea's long waves follow SeaState::spectrum, its short ones Elfouhaily's tail whatever the former. The
// curvature k^3 S(k) passes from one to the other by a smooth step over ln k, from the longer of 12 m and a tenth of
// the peak wave (ten times its wave number), to 0.3 m or a quarter of where it began, whichever is shorter: the sum of
// both has no step anywhere, and so energy and slope variance have none. The range is wide because both describe it
// well and because saturation at JONSWAP's level up to 0.3 m would miss Cox and Munk's (1954) slopes at either end of
// its fetches. In water of finite depth both are functions of frequency: Elfouhaily's curvature is taken at the
// deep-water wave number k tanh(k h), the similarity that TMA rests on (Bouws et al. 1985). JONSWAP and
// Pierson-Moskowitz stay as they are over frequency.
class Spectrum {
 public:
  // Throws Error as validate() does.
  explicit Spectrum(const SeaState& sea);

  // Variance density over the wave vector (kx, kz) in rad/m: m^4; its integral over the plane is the height's variance.
  // Exact and slow: SpectrumTable has it for many wave vectors.
  double operator()(glm::dvec2 k) const;

  // It is a sum of components, each a density over the wave number times a spreading: the wind sea's long waves, its
  // short waves and the trains of swell.
  static constexpr int components = 2 + swell_trains;
  bool present(int component) const { return train(component).alpha > 0.0; }
  double to_rad(int component) const { return train(component).to_rad; }  // mean direction, clockwise from -z
  // Variance density of wave number k (rad/m) over the wave vector, its spreading left out, suppression counted: m^4
  // rad.
  double radial(int component, double k) const;
  SpreadingShape shape(int component, double k) const;

  // Angular frequency of wave number k (rad/m) with surface tension.
  double frequency(double k) const;
  // The factor on variance that small-wave suppression leaves at wave number k.
  double suppression(double k) const;
  bool flat() const;
  const WaveTrain& wind() const { return wind_; }
  const WaveTrain& swell(int train = 0) const { return swell_[train]; }
  const Elfouhaily& short_waves() const { return short_waves_; }
  // The share of the wind sea's curvature that the short waves' part has, 0 to 1, at a deep-water wave number.
  double short_share(double deep_k) const;

 private:
  const WaveTrain& train(int component) const { return component < 2 ? wind_ : swell_[component - 2]; }
  double over_peak(const WaveTrain& train, double k) const;  // w / wp
  WaveTrain wind_;
  std::array<WaveTrain, swell_trains> swell_;
  Elfouhaily short_waves_;
  WaveSpectrum spectrum_;
  WaveSpreading spreading_;
  double elongation_, inverse_wave_age_ = 1.0, gravity_, depth_, suppression_, wind_share_;
  double short_from_ = 0.0, short_to_ = 0.0;  // deep-water wave numbers of the passage
};

// Mean square slopes of a sea's whole spectrum, waves of all lengths, suppression not counted: E[hx^2], E[hz^2], E[hx
// hz].
glm::dvec3 slope_moments(const SeaState& sea);

}  // namespace seascape
