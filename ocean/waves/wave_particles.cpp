#include "ocean/waves/wave_particles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/text.h"
#include "ocean/waves/particle_sums.h"
#include "ocean/waves/split_mix.h"
#include "ocean/waves/wave_field.h"
#include "shaders/shared/wave_particles.h"

namespace seascape {

namespace {
constexpr int tile = WaveParticles::tile_samples;

constexpr double sizes[gpu::max_particle_layings] = {1.0, double(gpu::particle_size_1), double(gpu::particle_size_2)};
static_assert(gpu::max_particle_layings <= most_layings);
constexpr double offsets[gpu::max_particle_layings] = {
    0.0, 0.3713, 0.7219};  // so that no place has the same tile around it at several sizes

void require(double value, double least, double most, const std::string& name) {
  if (!(value >= least && value <= most))
    throw Error(name, text_from(value) + " is not in the range " + text_from(least) + " to " + text_from(most),
                "give a value in that range");
}

// Uniform in [0, 1), by counter.
double uniform(std::uint32_t seed, int particle, int which) {
  std::uint64_t v = (std::uint64_t(seed) << 32 | std::uint64_t(which) << 24 | std::uint64_t(particle)) + split_mix_step;
  for (int i = 0; i < 2; ++i) v = split_mix(v) + split_mix_step;
  return share_of(v);
}

// Turns a tick times 2^64 of a particle that runs `tiles_per_s` tiles a second; of whole tiles in a loop.
std::uint64_t turns_of(double tiles_per_s, double loop_s) {
  const std::int64_t loop = std::llround(loop_s * double(gpu::ticks_per_second)),
                     whole = std::llround(std::abs(tiles_per_s) * loop_s);
  const std::uint64_t turns =
      loop > 0 ? loop_turns(whole, loop)
               : std::uint64_t(std::llround(std::abs(tiles_per_s) * 0x1p64 / double(gpu::ticks_per_second)));
  return tiles_per_s < 0.0 ? std::uint64_t(0) - turns : turns;
}

double speed_of(const WaveParticleSettings& s, double gravity_mps2) {
  validate(s);
  return s.speed_mps > 0.0 ? s.speed_mps : std::sqrt(gravity_mps2 * s.radius_m / std::numbers::pi);
}

std::vector<WaveParticle> made(const WaveParticleSettings& s, double speed_mps, double loop_s) {
  std::vector<WaveParticle> list(std::size_t(s.count));
  for (int i = 0; i < s.count; ++i) {
    WaveParticle& p = list[std::size_t(i)];
    p.x = std::uint32_t(uniform(s.seed, i, 0) * 0x1p32);
    p.z = std::uint32_t(uniform(s.seed, i, 1) * 0x1p32);
    const double angle = 2.0 * std::numbers::pi * (i + uniform(s.seed, i, 2)) / s.count;
    p.turns_x = turns_of(speed_mps / s.tile_m * std::cos(angle), loop_s);
    p.turns_z = turns_of(speed_mps / s.tile_m * std::sin(angle), loop_s);
    p.trough = i % 2 == 1;
  }
  return list;
}

// Of a particle in the largest laying, so that all layings together have the significant height.
double amplitude_of(const WaveParticleSettings& s) {
  double squares = 0.0;
  for (int i = 0; i < s.scales; ++i) squares += sizes[i] * sizes[i];
  const double share = particle_variance * s.count * s.radius_m * s.radius_m / (s.tile_m * s.tile_m);
  return 0.25 * s.height_m / std::sqrt(share * squares);
}

}  // namespace

void validate(const WaveParticleSettings& s) {
  require(s.count, 1, 100000, "wave_particles.count");
  require(s.tile_m, 0.25, 4000.0, "wave_particles.tile_m");
  require(s.radius_m, s.tile_m / 64.0, s.tile_m / 4.0,
          "wave_particles.radius_m (of tile_m " + text_from(s.tile_m) + ")");
  require(s.height_m, 0.0, 20.0, "wave_particles.height_m");
  require(s.speed_mps, 0.0, 100.0, "wave_particles.speed_mps");
  require(s.chop, 0.0, 2.0, "wave_particles.chop");
  require(s.scales, 1, gpu::max_particle_layings, "wave_particles.scales");
}

double drawn_together(const WaveParticleSettings& s) {
  const double in_tile = amplitude_of(s) * 2.0 / std::numbers::pi / s.tile_m;
  return s.scales * s.count * in_tile * in_tile * particle_bend_variance;
}

WaveParticles::WaveParticles(const WaveParticleSettings& settings, double gravity_mps2, double loop_s)
    : WaveParticles(settings, made(settings, speed_of(settings, gravity_mps2), loop_s), amplitude_of(settings),
                    speed_of(settings, gravity_mps2)) {}

WaveParticles::WaveParticles(const WaveParticleSettings& settings, std::vector<WaveParticle> particles,
                             double amplitude_m)
    : WaveParticles((validate(settings), settings), std::move(particles), amplitude_m, 0.0) {}

WaveParticles::WaveParticles(const WaveParticleSettings& settings, std::vector<WaveParticle> particles,
                             double amplitude_m, double speed_mps)
    : settings_(settings), particles_(std::move(particles)), amplitude_m_(amplitude_m), speed_mps_(speed_mps) {
  double crests = 0.0;
  for (const WaveParticle& p : particles_) crests += p.trough ? -1.0 : 1.0;
  const double radius = settings.radius_m / settings.tile_m;
  // The finest grid that gives a particle no more than 16 texels for a radius, or 8 as splines.
  double texels = radius * tile;
  const bool many = double(particles_.size()) * texels * texels > most_on_texels * 64.0;
  for (; many ? texels >= 8.0 : texels > 16.0; texels /= 2.0) grid_ /= 2;
  if (many)
    splined_ = std::make_shared<SplinedSum>(ParticleGrid{grid_, texels}, particles_.size());
  else
    direct_ = std::make_shared<DirectSum>(ParticleGrid{grid_, texels}, particles_.size());
  mean_m_ = crests * amplitude_m * particle_volume * radius * radius;
  for (std::size_t i = 0; i < layings_.size(); ++i) {
    const double side = settings.tile_m * sizes[i];
    layings_[i] = {sizes[i], side, offsets[i], side, settings.radius_m * sizes[i]};
  }
}

SourceStatistics WaveParticles::statistics() const {
  // Places are drawn at random, so that variances add (Campbell 1909). Of many particles crests pass 5.26 deviations
  // once in a million (SeaStatistics); of few they are the chance meeting of some.
  constexpr double crest_deviations = 5.26, met = 2.0;
  const double squares =
      double(particles_.size()) * amplitude_m_ * amplitude_m_ / (settings_.tile_m * settings_.tile_m);
  const double variance = squares * particle_variance * settings_.radius_m * settings_.radius_m,
               slope = squares * particle_slope_variance;
  const double towards = settings_.chop * 2.0 * settings_.radius_m / std::numbers::pi;
  const double highest =
      std::min(crest_deviations * std::sqrt(variance) + met * amplitude_m_, double(particles_.size()) * amplitude_m_);
  const double steepest = amplitude_m_ * std::numbers::pi / (2.0 * settings_.radius_m);
  const double furthest = towards * std::min(crest_deviations * std::sqrt(2.0 * slope) + met * steepest,
                                             double(particles_.size()) * steepest);
  SourceStatistics result;
  result.slope_moments = {slope, slope, 0.0};
  for (const Laying& laying : layings()) {
    result.height_variance += laying.size * laying.size * variance;
    result.largest_height_m += laying.size * highest;
    result.largest_shift_m += laying.size * furthest;
  }
  return result;
}

std::size_t WaveParticles::workspace_floats(bool velocity) const {
  std::size_t floats = splined_ ? splined_->floats(velocity) : direct_->floats(velocity);
  for (int size = grid_; size <= tile; size *= 2) floats += (velocity ? 2 : 1) * TorusField::floats(size);
  return floats;
}

void WaveParticles::evaluate(std::int64_t ticks, bool velocity, std::span<const PlaneLevel> levels,
                             std::span<float> workspace) const {
  assert(workspace.size() >= workspace_floats(velocity) &&
         levels.size() == std::size_t(std::bit_width(unsigned(tile))));
  float* memory = workspace.data();
  const auto field = [&](int size) {
    const TorusField result{size, memory};
    memory += TorusField::floats(size);
    return result;
  };
  TorusField height = field(grid_), rate = velocity ? field(grid_) : TorusField{};
  const auto refined = [&](const TorusField& from) {
    const TorusField fine = field(2 * from.size);
    tbb::parallel_for(0, fine.size / 16, [&](int k) { refine_rows(from, fine, 16 * k, 16 * k + 16); });
    return fine;
  };
  float* const work = workspace.data() + (workspace_floats(velocity) -
                                          (splined_ ? splined_->floats(velocity) : direct_->floats(velocity)));
  if (splined_)
    splined_->sum(particles_, ticks, float(amplitude_m_), work, height, rate);
  else
    direct_->sum(particles_, ticks, float(amplitude_m_), work, height, rate);
  while (height.size < tile) {
    height = refined(height);
    if (velocity) rate = refined(rate);
  }

  const int planes = velocity ? 4 : 3;
  const ParticleTexels texels{float(tile / settings_.tile_m),
                              float(settings_.chop * 2.0 * settings_.radius_m / std::numbers::pi), float(mean_m_),
                              velocity};
  // Sixteen rows and the four levels above that are theirs alone.
  tbb::parallel_for(0, tile / 16, [&](int k) {
    particle_rows(height, rate, texels, 16 * k, 16 * k + 16, levels[0]);
    for (int level = 1; level <= 4; ++level) {
      const auto from_row = [&](const PlaneLevel& of, int row) {
        PlaneLevel result = of;
        for (int p = 0; p < planes; ++p) result.texels[p] += std::ptrdiff_t(row) * of.stride;
        return result;
      };
      const int rows = 16 >> level;
      average_down(from_row(levels[std::size_t(level) - 1], 2 * rows * k),
                   from_row(levels[std::size_t(level)], rows * k), 0, tile >> level, rows);
    }
  });
  for (std::size_t level = 5; level < levels.size(); ++level)
    average_down(levels[level - 1], levels[level], 0, tile >> level, tile >> level);
}

}  // namespace seascape
