// The directional spectrum of a whole sea and the statistics that follow from it: formulas of spectrum_truth.h joined
// and integrated by quadrature. Includes nothing of the code it judges.
#pragma once
#include <array>
#include <vector>

#include "tests/support/spectrum_truth.h"

namespace truth {

struct Vector {
  double x = 0.0, z = 0.0;
};
struct Tensor {  // symmetric
  double xx = 0.0, zz = 0.0, xz = 0.0;
  double trace() const { return xx + zz; }
  double determinant() const { return xx * zz - xz * xz; }
};

// A sea by its causes. Directions are where waves go to, in degrees clockwise from -z: (sin, -cos) in x, z.
struct SeaCauses {
  double u10 = 10.0, fetch = 300e3, gamma = 3.3, wind_to_deg = 30.0, depth = 1e4, g = 9.81;
  bool tma = false;  // JONSWAP over frequency times Kitaigorodskii's factor
  struct Swell {
    double height, period_s, to_deg;
  };
  std::vector<Swell> swell;
};

// Moments of the variance S(k) D(k, angle) over k and angle, waves of the band alone. w: Airy's with tension.
struct SeaMoments {
  double m0 = 0.0;  // E[h^2]
  double w2 = 0.0;  // E[(dh/dt)^2]
  double u2 = 0.0;  // E[u^2] of the water's horizontal velocity at the surface, coth(k depth) as much as the vertical's
  Vector w1;        // integral of w times the unit wave vector and that width: E[h u]
  Tensor k1, k2;    // integrals of k^n times the unit wave vector twice: k2 is E[grad h grad h]
  Tensor k0_wide, k1_wide, k2_wide;  // the same times that width, k0 and k2 times its square: k0_wide is E[D D]
};

// JONSWAP (or TMA) spread as Donelan and Banner have it, Elfouhaily's tail, trains of swell of gamma 6 spread as cos^50
// of half the angle.
class SeaSpectrum {
 public:
  explicit SeaSpectrum(const SeaCauses& causes);
  // Variance over the wave number (m^3) of a component: wind's long waves, its short ones, then each swell.
  double over_k(int component, double k) const;
  int components() const { return 2 + int(causes_.swell.size()); }
  // Variance over the wave vector (m^4): over_k and spreadings' norms from straight lines over ln k, a component that
  // has less than 1e-4 of a wave number's variance left out.
  double over_vector(double kx, double kz) const;
  // Waves to which `share` leaves something; by trapezoids over ln k and the angle, which for these smooth functions
  // that end in nothing converge at once.
  template <class Share>
  SeaMoments moments(const Share& share) const {
    SeaMoments sum;
    for (int c = 0; c < components(); ++c)
      for (int i = 0; i < nodes; ++i) add(sum, c, i, share(k_of(i)));
    return sum;
  }
  SeaMoments moments() const {
    return moments([](double) { return 1.0; });
  }

 private:
  static constexpr int nodes = 2000, angles = 180;  // of ln k from 1e-4 to 3e3 rad/m; over a turn
  static double k_of(int node) { return 1e-4 * std::exp(step * node); }
  static constexpr double step = 17.2 / nodes;
  double spread(int component, double k, double angle) const;  // without its norm
  double to_rad(int component) const;
  void add(SeaMoments& sum, int component, int node, double share) const;
  struct Fourier {  // at a node: over_k, and of the spreading 1 / integral, means of cos and cos 2
    double variance = 0.0, norm = 0.0, first = 0.0, second = 0.0;
  };
  SeaCauses causes_;
  Jonswap wind_;
  Elfouhaily short_waves_;
  std::vector<double> swell_alpha_;
  std::vector<std::vector<Fourier>> fourier_;  // [component][node]
};

// What the moments say of the drawn surface, whose horizontal displacement is chop times the unit wave vector times the
// height's at a quarter of a wave away, and coth(k depth) as wide as that is high (Airy 1845).
//
// Heights over the displaced surface: of a first-order Lagrangian sea, x = a + D(a), a mean over the plane of x weighs
// places a by the Jacobian J = det(I + G), G = grad D. h and G are jointly Gaussian with E[h G] = -chop k1_wide, and J
// is a polynomial, so Isserlis' (1918) theorem gives the moments with no remainder (the "choppy wave" model of
// Nouguier, Guerin and Chapron 2009): E[h] = -T, E[h^2] = m0 + 2 d, E[h^3] = -3 m0 T with T = chop tr k1_wide, d =
// chop^2 det k1_wide. To second order (Longuet-Higgins 1963) the skewness about the mean is 0: sharp crests and the
// lower mean level under high groups cancel.
struct Heights {
  double mean, square, cube;  // about the still sea
};
inline Heights chopped_heights(const SeaMoments& m, double chop) {
  const double t = chop * m.k1_wide.trace(), d = chop * chop * m.k1_wide.determinant();
  return {-t, m.m0 + 2.0 * d, -3.0 * m.m0 * t};
}
// Slope variance, both directions together, over the displaced surface. J times the slope is (1 + tr G) grad h - G grad
// h; 1 / J to second order in G leaves E = tr S + E[grad h . G^2 grad h] = tr S + chop^2 tr S W, S = k2, W = k2_wide
// (det G's mean is 0); what is left out is of third order in S.
inline double chopped_slopes(const SeaMoments& m, double chop) {
  const Tensor &s = m.k2, &w = m.k2_wide;
  return s.trace() + chop * chop * (s.xx * w.xx + s.zz * w.zz + 2.0 * s.xz * w.xz);
}

}  // namespace truth
