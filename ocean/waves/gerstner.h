// Gerstner waves that cover the sea or run along its shores: a few trochoidal waves of given length, direction and
// height, on one periodic tile.
#pragma once
#include <span>
#include <vector>

#include "ocean/waves/fft.h"
#include "ocean/waves/gerstner_settings.h"
#include "ocean/waves/tile_source.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

// A wave of the tile: m is whole, so that the tile closes.
struct GerstnerWave {
  int mx = 0, mz = 0;  // waves on the tile's two sides
  double amplitude_m = 0.0;
  double phase_turns = 0.0;  // at the origin and time 0: 0 is a crest there
  glm::dvec2 asked{0.0};     // wave vector as the settings have it, rad/m
};

// The surface of Gerstner (1804) and, for many waves, Fournier and Reeves (1986): water whose rest position is p stands
// at p + sum of a (-chop c k/|k| sin T, cos T), T = k.p - w t + phase, w by linear dispersion (airy_frequency and
// tension) and c = coth |k| h, the orbits' width in water of depth h. A wave's velocity is the displacement's own.
// While the sum of chop c |k| a is 1 or less the surface cannot fold over; settings beyond that are refused.
//
// The waves lie on the lattice of one tile, whose side and rotation let the highest wave be exactly what was asked and
// the others least off (mean square by energy): two waves by less than 3 % of their length and direction (as a vector;
// mostly by less than 1 %), many by about half a step of the lattice each, up to 6 %. Along curves the tile is not
// turned, so that it closes along the crests: the highest wave then has its length, and is off in direction by half a
// step.
class Gerstner final : public TileSource {
 public:
  static constexpr int tile_samples = 256;
  // Waves on a tile's side at most: the shortest of a set with octaves has eight texels and more, of single waves
  // seventeen.
  static constexpr int most_m = 31, most_m_alone = 15;

  // Throws Error as validate() does, and where the surface would fold. With `loop_s` above 0 the waves repeat after
  // that time, their periods rounded to whole fractions of it. A depth of 0 or less is dry land: still(). Of the sets
  // it takes those that are (not) for shores.
  explicit Gerstner(const GerstnerSettings& settings, double gravity_mps2 = 9.81, double depth_m = 1e6,
                    double loop_s = 0.0, bool shore = false);

  std::string_view name() const override { return "gerstner"; }
  int samples() const override { return tile_samples; }
  bool still() const override { return waves_.empty(); }
  bool along_curves() const override { return shore_; }
  std::span<const Laying> layings() const override { return {&laying_, 1}; }
  SourceStatistics statistics() const override { return statistics_; }
  std::size_t workspace_floats(bool velocity) const override;
  void evaluate(std::int64_t ticks, bool velocity, std::span<const PlaneLevel> levels,
                std::span<float> workspace) const override;

  std::span<const GerstnerWave> waves() const { return waves_; }
  double side_m() const { return laying_.side_m; }
  // The wave vector that it has, rad/m along the world's axes.
  glm::dvec2 drawn(const GerstnerWave& wave) const;
  // What the sum of chop c |k| a comes to.
  double steepness() const { return steepness_; }

 private:
  bool shore_;
  std::vector<GerstnerWave> waves_;
  FftPlan plan_;
  WaveTable table_;
  Laying laying_{};
  SourceStatistics statistics_;
  double steepness_ = 0.0;
};

// Throws Error where the waves of both would fold the surface over together.
void validate_together(const Gerstner& everywhere, const Gerstner& shore, double chop);

}  // namespace seascape
