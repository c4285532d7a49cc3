// What sources come to in the wave numbers of one level: summed wave by wave where they are few, through a texture that
// they share where they are many.
#pragma once
#include <complex>
#include <span>
#include <vector>

#include "ocean/places/lod_windows.h"
#include "ocean/places/wave_source.h"
#include "ocean/waves/fft.h"

namespace seascape {

// Fourier coefficients of a level's texels, [mz + band / 2][mx + band / 2].
struct SourceWaves {
  std::vector<std::complex<double>> head, rise;
  bool heads = false, rises = false;  // whether there are any; else the list means nothing
};

// The texture is a type-1 non-uniform transform (Greengard and Lee 2004): each profile is widened by a Gaussian of 5
// texels, so that the texels show it with 5e-9 of its strength wrong, and their transform is divided by that Gaussian,
// no more than 1.5 times for waves of 8 texels and longer. With the transform's floats and the profile's cut-off tail:
// 1e-6 of the strongest wave of all sources. A source's waves below 1e-6 of its own strength are left out.
class SourceSums {
 public:
  explicit SourceSums(int samples);
  // Texels' side, and the longest waves carried, in texels.
  void shape(double texel_m, double longest_texels) { texel_m_ = texel_m, longest_ = longest_texels; }

  // Room that the level has for its transforms: samples rows of `stride`, band^2 and forward_band_floats().
  struct Room {
    const FftPlan& to_waves;
    std::span<float> re, im, spectrum_re, spectrum_im, workspace;
    int stride;
  };
  // Adds what sources push in dt seconds that end with them at their places: head (m) and rise dt (m). `first`: the
  // window's first texel, towards whose edges sources fade out. Each row of waves carries those from row_first to
  // row_end, whole groups of 8; only these are summed. One thread.
  void add(std::span<const WaveSource> sources, double dt, LodIndex first, std::span<const int> row_first,
           std::span<const int> row_end, const Room& room, SourceWaves& waves);

  // For tests and benchmarks: -1 as is quicker, 0 always wave by wave, 1 always through the texture.
  int by = -1;

 private:
  // A Gaussian of texels: its transform is (head, rise) exp(-(length m / samples)^2) at its place.
  struct Hump {
    double x, z, length2, head, rise;
  };
  void gather(const WaveSource& source, double dt, LodIndex first);
  void sum_waves(std::span<const Hump> humps, std::span<const int> row_first, std::span<const int> row_end,
                 SourceWaves& waves);
  void sum_rows(std::span<const Hump> humps, bool heads, std::span<const int> row_first, std::span<const int> row_end,
                std::vector<std::complex<double>>& to);
  void sum_texels(const Room& room, std::span<const int> row_first, std::span<const int> row_end, SourceWaves& waves);
  struct Run {
    int first, count;  // of texels that wrap around
  };
  Run profile(double at, double width2, std::vector<float>& to) const;

  int n_, band_;
  double texel_m_ = 1.0, longest_ = 24.0;
  std::vector<Hump> humps_;
  std::vector<double> narrow_;      // of each wave of an axis: what undoes the common Gaussian
  std::vector<float> of_x_, of_z_;  // a hump's profile along each axis
  // A few humps at a time, so that all they need stays in the cache while every row of waves takes them.
  std::vector<double> x_re_, x_im_, z_re_, z_im_;  // [hump][m + band / 2]
  std::vector<double> row_re_, row_im_;
};

}  // namespace seascape
