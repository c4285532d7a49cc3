#include "ocean/waves/dispersion.h"

#include <cmath>

namespace seascape {

namespace {
// Below this k h all waves run alike, at the root of g h, to less than a double holds.
constexpr double shallow = 1e-9;

// tanh, by its limit where that is all that is left of it in long double: the drawn waves' tables ask it often.
template <class Real>
Real tanh_of(Real x) {
  return x > Real(23) ? Real(1) : std::tanh(x);
}

template <class Real>
Real with_tension(Real k, Real gravity, Real depth) {
  if (!(k > 0) || !(depth > 0)) return 0;
  return std::sqrt((gravity * k + Real(water_tension_m3_s2) * k * k * k) * tanh_of(k * depth));
}
}  // namespace

double airy_frequency(double k, double gravity_mps2, double depth_m) {
  if (!(k > 0.0) || !(depth_m > 0.0)) return 0.0;
  return std::sqrt(gravity_mps2 * k * tanh_of(k * depth_m));
}

double airy_group_speed(double k, double gravity_mps2, double depth_m) {
  if (!(depth_m > 0.0)) return 0.0;
  if (!(k > 0.0)) return std::sqrt(gravity_mps2 * depth_m);
  const double kh = k * depth_m, t = tanh_of(kh);
  if (kh < shallow) return std::sqrt(gravity_mps2) * std::sqrt(depth_m);  // k t may be less than any double
  if (t == 1.0) return 0.5 * std::sqrt(gravity_mps2 / k);                 // deep: k h may be more than any double
  // sech^2 = 1 - tanh^2 loses its digits in deep water, where it no longer counts.
  return 0.5 * std::sqrt(gravity_mps2 / (k * t)) * (t + kh * (1.0 - t) * (1.0 + t));
}

double airy_wave_number(double w, double gravity_mps2, double depth_m) {
  if (!(w > 0.0) || !(depth_m > 0.0)) return 0.0;
  const double x2 = w * w * depth_m / gravity_mps2;
  if (x2 < shallow * shallow)
    return w / std::sqrt(gravity_mps2) /
           std::sqrt(depth_m);                       // below, powers of x2 lose their digits, and then all of it
  if (!(x2 < 1e300)) return w * (w / gravity_mps2);  // and above, all of them
  constexpr double beta = 2.4908;
  // 1 - exp(-x^beta), with its digits kept where the water is very shallow.
  double kh = x2 * std::pow(-std::expm1(-std::pow(x2, 0.5 * beta)), -1.0 / beta);
  const double t = tanh_of(kh);
  kh -= (kh * t - x2) / (t + kh * (1.0 - t) * (1.0 + t));
  return kh / depth_m;
}

double orbit_width(double k, double depth_m) {
  constexpr double most = 8.0;
  if (!(k > 0.0)) return 1.0;
  const double t = std::tanh(k * depth_m);
  return t > 1.0 / most ? 1.0 / t : most;
}

double wave_frequency(double k, double gravity_mps2, double depth_m) { return with_tension(k, gravity_mps2, depth_m); }

long double wave_frequency(long double k, long double gravity_mps2, long double depth_m) {
  return with_tension(k, gravity_mps2, depth_m);
}

}  // namespace seascape
