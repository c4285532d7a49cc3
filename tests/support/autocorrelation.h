// How alike a sea of periodic tiles is to itself at a distance, over the infinite plane, beside the continuous
// spectrum's likeness: what tiling is measured by. Includes nothing of the code it judges.
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace truth {

// A wave of shift that a tile is warped by: its pattern at x is taken at x + way sin(2 pi (along . x + a phase)).
struct WarpWave {
  double along_x, along_z;  // turns a metre
  double way_x, way_z;      // m
};

// A square periodic tile's variance by whole wave numbers |mx|, |mz| < half: [mz + half][mx + half], (2 half)^2 of
// them, m^2. The world wave vector of (mx, mz) is (2 pi / side_m) (mx, mz) turned by rotation_rad from x towards z.
struct SpectralTile {
  double side_m = 1.0, rotation_rad = 0.0;
  int half = 32;
  std::vector<double> variance;
  std::vector<WarpWave> warp = {};  // none: it lies straight
  double total() const;
};

// A function periodic on a grid of size x size cells, a power of two: sum over m of variance cos(2 pi m . u), u in
// tiles.
class PeriodicField {
 public:
  PeriodicField() = default;
  // `at_m(mx, mz)` for |mx|, |mz| < half; size >= 2 half.
  PeriodicField(int half, int size, const std::function<double(int, int)>& at_m);
  double linear(double u, double v) const;  // straight lines between cells
  double cubic(double u, double v) const;   // Catmull and Rom's (1974) cubics
 private:
  float cell(int x, int y) const {
    return values_[std::size_t(y & mask_) * std::size_t(size_) + std::size_t(x & mask_)];
  }
  int size_ = 1, mask_ = 0;
  std::vector<float> values_;
};

// The continuous spectrum's: integral of density cos(k . r) over its variance, from samples of the density on a grid of
// wave vectors, whose sum repeats far outside the lags asked for. Waves too short for the grid are left out: from 1 km
// on they have none.
class ContinuousAutocorrelation {
 public:
  // Density in m^4 over the wave vector (kx, kz), variance its integral; longest_wave_m: of its peaks.
  ContinuousAutocorrelation(const std::function<double(double, double)>& density, double variance,
                            double longest_wave_m);
  double at(double x_m, double z_m) const { return field_.cubic(x_m / side_m_, z_m / side_m_); }

 private:
  double side_m_;
  PeriodicField field_;
};

struct Excess {
  double value = -2.0;          // of the tiles' autocorrelation over the continuous one
  double x_m = 0.0, z_m = 0.0;  // at this lag
  double tiles = 0.0, continuous = 0.0;
  int lattice = -1;  // found at a whole-tile vector of this tile, -1 by the dense search
};

// The largest excess over all lags of from_m to to_m: a dense search at a sixth of the wave of which nine tenths of the
// variance are longer (at least 3 m), every whole-tile vector of every tile, and a climb from the best of both. Tiles
// that are warped (warped_tile.h) are searched as far around every whole-tile vector as their copies are shifted, and
// at 1,000 lags between.
Excess largest_excess(std::span<const SpectralTile> tiles, const ContinuousAutocorrelation& continuous,
                      double from_m = 1000.0, double to_m = 4000.0);

}  // namespace truth
