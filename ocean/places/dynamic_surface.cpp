#include "ocean/places/dynamic_surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "ocean/waves/dispersion.h"

namespace seascape {

namespace {
constexpr double most_squeeze = 0.8;
}  // namespace

DynamicSurface::DynamicSurface(const DynamicWavesSettings& settings) : settings_(settings) {
  validate(settings);
  plan_ = make_fft_plan(settings.windows.resolution, settings.windows.resolution / 4);
  levels_.resize(std::size_t(settings.windows.slices));
  const std::size_t n = std::size_t(settings.windows.resolution);
  for (Level& level : levels_) {
    level.shift.assign(n * n, glm::vec4(0.0f));
    level.slope.assign(n * n, glm::vec4(0.0f));
  }
}

void DynamicSurface::make_table(const WaveLevel& waves, Level& level) const {
  if (level.table_texel_m == level.texel_m && level.table_depth_m == waves.depth_m() &&
      level.table_sharpening == settings_.sharpening)
    return;
  level.table_texel_m = level.texel_m, level.table_depth_m = waves.depth_m();
  level.table_sharpening = settings_.sharpening;
  const int band = plan_.band;
  const double step = 2.0 * std::numbers::pi / (plan_.n * level.texel_m);
  LevelTable& table = level.table;
  for (auto* list : {&table.half, &table.width}) list->assign(waves.modes().size(), 0.0f);
  table.k.resize(std::size_t(band));
  for (int i = 0; i < band; ++i) table.k[std::size_t(i)] = float(step * (i - band / 2));
  for (int j = 1; j < band; ++j)
    for (int i = 1; i < band; ++i) {
      const std::size_t at = std::size_t(j) * std::size_t(band) + std::size_t(i);
      const double k = step * std::hypot(double(i - band / 2), double(j - band / 2));
      if (!(waves.share()[at] > 0.0)) continue;
      table.half[at] = 0.5f;
      table.width[at] = float(settings_.sharpening * orbit_width(k, waves.depth_m()) / k);
    }
}

void DynamicSurface::evaluate(const WaveLevel& waves, Level& level, double border_m, double ahead_s) {
  make_table(waves, level);
  const LevelMost most =
      fill_level(plan_, level.table, {waves.modes(), waves.frequency(), settings_.damping_per_s, ahead_s},
                 {level.shift.data(), level.slope.data(), velocity_ ? level.velocity.data() : nullptr});
  // The most that the water is squeezed in any direction; the fading of the window adds at most the shift over its
  // width.
  level.squeeze = double(most.squeeze) + double(most.shift_m) / border_m;
  level.extent = {most.height_m, most.shift_m, double(most.squeeze), double(most.slope_step) / level.texel_m,
                  most.slope_moments};
}

void DynamicSurface::evaluate(const DynamicWaves& waves, double ahead_s, bool velocity) {
  assert(waves.settings().windows == settings_.windows);
  settings_ = waves.settings();
  velocity_ = velocity;
  placement_ = waves.placement();
  windows_ = lod_windows(settings_.windows, placement_, placement_.viewer);
  tbb::parallel_for(0, int(levels_.size()), [&](int i) {
    Level& level = levels_[std::size_t(i)];
    level.texel_m = waves.level(i).texel_m();
    level.still = waves.level(i).still();
    level.squeeze = 0.0;
    level.extent = {};
    if (velocity) level.velocity.resize(level.shift.size());
    if (!level.still) evaluate(waves.level(i), level, gpu::lod_border * windows_.reach.x * std::exp2(i), ahead_s);
  });
  double squeeze = 0.0;
  for (const Level& level : levels_) squeeze += level.squeeze;
  share_ = squeeze > most_squeeze ? most_squeeze / squeeze : 1.0;
}

DynamicSurface::Extent DynamicSurface::extent(int level) const {
  Extent result = levels_[std::size_t(level)].extent;
  result.shift_m *= share_;
  return result;
}

}  // namespace seascape
