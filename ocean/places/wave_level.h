// One level of the dynamic waves: the waves of one octave of lengths on a square that wraps around, each turned by its
// own frequency.
#pragma once
#include <complex>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/places/lod_windows.h"
#include "ocean/places/source_sums.h"
#include "ocean/waves/fft.h"

namespace seascape {

// What lengths of waves a level carries, in texels: all from 8 to 12 on, fading in, to 16 to 24, fading out as the next
// level's fade in; the coarsest to a quarter of its window. Weights of neighbouring levels are 1 in sum, so that a wave
// that two levels share moves as one.
double wave_share(double texels_a_wave, bool coarsest, int samples);

// Linear waves (Airy 1845): with height h and potential p at the surface, h' = G p and p' = -g h - P / rho, G = k
// tanh(k depth) in wave numbers. The field a = h + i q, q = (w / g) p, turns in each wave number by exp(-i w t), w^2 =
// g k tanh(k depth): exactly, for steps of any length, without loss. A pressure head P that lasts for a step moves what
// it turns about to -P, exactly too; water added during a step is turned from the step's middle. The state is kept in
// wave numbers, in double: where no border and no obstacle takes anything away, no rounding adds up (1e-15 a step).
class WaveLevel {
 public:
  // samples: a power of two from 64 to 1024. samples^2 / 16 wave numbers are kept.
  explicit WaveLevel(int samples);

  // For texels of this size. Waves that do not fit any more are lost.
  void shape(double texel_m, bool coarsest, double gravity_mps2, double depth_m);
  void clear();

  // Turns all waves by dt seconds, pushed by the sources; amplitudes fall by exp(-damping / 2 dt). `first`: the
  // window's first texel; sources fade out towards its edges. `head_m`: a pressure besides, in metres of water, of
  // every texel, or none; samples^2, [z][x], texel (x, z) modulo the samples.
  void turn(double dt, double damping_per_s, LodIndex first, std::span<const WaveSource> sources,
            std::span<const float> head_m = {});
  // Multiplies height and potential at texel (x, z), modulo the samples, by along_x[x] along_z[z] open[z][x] (1 where
  // `open` is null), all between 0 and 1. No wave grows by it.
  void take_off(std::span<const float> along_x, std::span<const float> along_z, const float* open);
  // Draws height and potential towards those of another level of as many texels of the same size, which lie at the same
  // places modulo the samples: by `share` along_x[x] along_z[z] of what is between them, all 0 to 1.
  void draw_towards(const WaveLevel& other, float share, std::span<const float> along_x,
                    std::span<const float> along_z);
  // Adds any field: a[z][x], samples^2 each.
  void add(std::span<const float> height_m, std::span<const float> quarter_m);

  // Texel (x, z) then holds what lay at (x + by.x, z + by.y), anywhere between texels.
  void shift_by(glm::dvec2 by);

  // Height, and height a quarter of a period later for waves that run (its potential times w / g), samples^2 each,
  // [z][x], texel (x, z) modulo the samples.
  void surface(std::span<float> height_m, std::span<float> quarter_m) const;

  bool still() const { return still_; }
  double energy_m2() const;  // the mean of height^2 + quarter^2 over the square
  double highest_m() const;  // no height and no quarter is above; infinite or no number where the state is
  double longest_speed_mps() const { return longest_speed_; }  // of the energy of the longest waves
  int samples() const { return n_; }
  double texel_m() const { return texel_m_; }
  double depth_m() const { return depth_m_; }
  // Wave (mx, mz), both from -samples / 8 to samples / 8 - 1, at (mz + samples / 8) (samples / 4) + mx + samples / 8.
  std::span<std::complex<double>> modes() {
    still_ = false;
    return modes_;
  }
  std::span<const std::complex<double>> modes() const { return modes_; }
  SourceSums& sums() { return sums_; }
  std::span<const double> share() const { return share_; }
  std::span<const double> frequency() const { return frequency_; }

 private:
  void turn_table(double dt, double damping_per_s);
  void add_pressure(LodIndex first, std::span<const float> head_m);
  int n_, band_;
  double texel_m_ = 0.0, depth_m_ = 0.0, longest_speed_ = 0.0, table_dt_ = -1.0, table_damping_ = -1.0;
  bool still_ = true;
  FftPlan to_texels_, to_waves_;
  std::vector<std::complex<double>> modes_, turn_, half_turn_;
  std::vector<double> share_, frequency_;
  std::vector<int> row_first_, row_end_;  // of the waves that a row carries, in whole groups of 8
  SourceSums sums_;
  SourceWaves pushed_;
  mutable std::vector<float> re_, im_, spectrum_re_, spectrum_im_, workspace_;
};

}  // namespace seascape
