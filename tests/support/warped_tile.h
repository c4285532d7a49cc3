// The autocorrelation of a periodic tile that is warped by waves of shift, over the infinite plane. Includes nothing
// of the code it judges.
#pragma once
#include <functional>
#include <vector>

#include "tests/support/autocorrelation.h"

namespace truth {

// J0 of any number, within 1e-5.
double bessel_j0(double x);

// Of waves of the tile, for a lag r: the mean over the plane of cos(k . (r + shift(x + r) - shift(x))), which is
// cos(k . r) times the product over the waves of shift of J0(2 k . way sin(pi along . r)): the mean of exp(i a sin t)
// over t is J0(a) (Jacobi and Anger), and the phases of waves of no common period are independent over the plane.
class WarpedTile {
 public:
  // Shares are of `all`. The weakest bins, of 5 % together, are left out: they are the shortest waves, whose products
  // are the smallest.
  WarpedTile(const SpectralTile& tile, double all);
  double at(double x_m, double z_m) const;
  // The length of the wave of which half of the variance is longer, m.
  double middle_wave_m() const { return middle_wave_m_; }
  // How far the copies at a whole tile (ix, iz) are shifted against each other at most, m.
  double most_shift_m(int ix, int iz) const;

  // The lags of a square around a whole tile (ix, iz), `reach_m` to each side, about `step_m` apart: calls put(x, z,
  // value) for each. The products of J0 are taken in the middle of nine parts of it; a part where even the sum of their
  // sizes is at most least() is left out.
  void around(int ix, int iz, double reach_m, double step_m, const std::function<double()>& least,
              const std::function<void(double, double, double)>& put) const;

 private:
  struct Bin {
    double kx, kz, share;  // of the wave and of that which runs against it
    int mx, mz;
  };
  double product(const Bin& bin, const std::vector<WarpWave>& ways) const;
  std::vector<WarpWave> ways_at(double x_m, double z_m) const;  // with way times 2 sin(pi along . r)
  double side_m_, cosine_, sine_, middle_wave_m_ = 0.0;
  std::vector<WarpWave> warp_;
  std::vector<Bin> bins_;  // row by row
};

}  // namespace truth
