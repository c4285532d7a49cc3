// Wave particles on a torus: bumps of one shape that each run straight on at one speed for ever, known at any time from
// seed and time alone.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "ocean/waves/tile_source.h"
#include "ocean/waves/wave_particle_settings.h"
#include "shaders/shared/wave_particles.h"

namespace seascape {

class DirectSum;  // ocean/waves/particle_sums.h
class SplinedSum;

// Where a particle starts, in turns of the tile times 2^32, and how far it runs a tick, in turns times 2^64 (two's
// complement).
struct WaveParticle {
  std::uint32_t x = 0, z = 0;
  std::uint64_t turns_x = 0, turns_z = 0;
  bool trough = false;  // its height is negative
};

// The tile of Yuksel, House and Keyser (2007, eq. 8 and 9): h = sum of a W(|x - x_i| / r), W(u) = (1 + cos pi u) / 2
// below u = 1 and 0 beyond. Horizontally the water is moved by kappa grad h, kappa = chop 2 r / pi: for a front of
// particles that is along its way, as their longitudinal deviation is, and at the crest it draws together as fast (-a
// pi / r); of a single particle it is radial, and free of rotation, so that a tile's one shear describes it. All slopes
// are central differences of the height over texels.
class WaveParticles final : public TileSource {
 public:
  static constexpr int tile_samples = 256;
  // Up to this many particles of the default radius (the limit goes with their area) are summed texel by texel, more as
  // splines on half the grid.
  static constexpr int most_on_texels = 2048;

  // `settings.count` particles at random places, in directions of which each 1 / count of a turn holds one, crests and
  // troughs by turns. With `loop_s` above 0 they repeat after that time, their ways rounded to whole tiles. Throws
  // Error as validate() does.
  explicit WaveParticles(const WaveParticleSettings& settings, double gravity_mps2 = 9.81, double loop_s = 0.0);
  // Particles of one's own, of height `amplitude_m` (before the layings' sizes); the settings' count, height, speed and
  // seed do not matter.
  WaveParticles(const WaveParticleSettings& settings, std::vector<WaveParticle> particles, double amplitude_m);

  std::string_view name() const override { return "wave_particles"; }
  int samples() const override { return tile_samples; }
  bool still() const override { return amplitude_m_ == 0.0 || particles_.empty(); }
  std::span<const Laying> layings() const override { return {layings_.data(), std::size_t(settings_.scales)}; }
  SourceStatistics statistics() const override;
  std::size_t workspace_floats(bool velocity) const override;
  void evaluate(std::int64_t ticks, bool velocity, std::span<const PlaneLevel> levels,
                std::span<float> workspace) const override;

  const std::vector<WaveParticle>& particles() const { return particles_; }
  double amplitude_m() const { return amplitude_m_; }  // of a particle in the largest laying
  double height_m() const { return settings_.height_m; }
  double speed_mps() const { return speed_mps_; }
  bool splined() const { return splined_ != nullptr; }  // summed as splines

 private:
  WaveParticles(const WaveParticleSettings& settings, std::vector<WaveParticle> particles, double amplitude_m,
                double speed_mps);
  WaveParticleSettings settings_;
  std::vector<WaveParticle> particles_;
  double amplitude_m_, speed_mps_, mean_m_;
  int grid_ = tile_samples;                    // texels a side of the sum
  std::shared_ptr<const DirectSum> direct_;    // either this
  std::shared_ptr<const SplinedSum> splined_;  // or this
  std::array<Laying, gpu::max_particle_layings> layings_;
};

// A particle's share of height variance: the integral of W^2 over the plane is this times r^2; of (r dW/dx)^2 and of W
// likewise.
inline constexpr double particle_variance = 0.5414774727, particle_slope_variance = 1.9378922925,
                        particle_volume = 0.9341765544;
// The integral of (r^2 (W_xx + W_zz))^2 over r^2.
inline constexpr double particle_bend_variance = 57.14809949;

// Variance of the gradient by which the displacement of such particles, with a chop of 1, draws the water together: of
// all layings. It goes with the square of the height.
double drawn_together(const WaveParticleSettings& settings);

}  // namespace seascape
