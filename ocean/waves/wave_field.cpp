#include "ocean/waves/wave_field.h"

#include <tbb/parallel_for.h>

#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "ocean/waves/spectrum.h"
#include "ocean/waves/wave_tiles.h"
#include "ocean/waves/wave_tiles_simd.h"

namespace seascape {

namespace {
WaveTable make_table(const SeaState& sea, const WaveBins& bins, int index, int band) {
  constexpr int n = gpu::wave_bins;
  const Cascade& cascade = bins.ladder[index];
  const double step = 2.0 * std::numbers::pi / cascade.side_m;
  WaveTable table;
  table.shear_length_m = std::exp2(std::round(std::log2(float(1.0 / (12.0 * step)))));
  for (int mx = -band / 2; mx < band / 2; ++mx)
    for (int mz = -band / 2; mz < band / 2; ++mz) {
      const gpu::WaveBin& bin = bins.bins[(std::size_t(index) * n + mz + n / 2) * n + mx + n / 2];
      const glm::dvec2 k = step * rotate_xz({mx, mz}, cascade.rotation_rad);
      const double length = glm::length(k);
      const glm::dvec2 towards = length > 0.0 ? sea.chop / length * k : glm::dvec2(0.0);
      table.amplitude_re.push_back(bin.amplitude.x);
      table.amplitude_im.push_back(bin.amplitude.y);
      table.turns.push_back((std::uint64_t(bin.turns_high) << 32) | bin.turns_low);
      table.kx.push_back(float(k.x));
      table.kz.push_back(float(k.y));
      table.shift_x.push_back(float(towards.x));
      table.shift_z.push_back(float(towards.y));
      // From the turns that it runs by, so that velocity is the displacement's rate of change at every depth and in a loop.
      table.frequency.push_back(float(double(table.turns.back()) * 0x1p-64 * gpu::ticks_per_second * 2.0 * std::numbers::pi));
    }
  return table;
}
}  // namespace

WaveField::WaveField(const SeaState& sea, const WaveQuality& quality) : WaveField(sea, quality, make_wave_bins(sea, quality)) {}

WaveField::WaveField(const SeaState& sea, const WaveQuality& quality, WaveBins bins)
    : sea_(sea), quality_(quality), bins_(std::move(bins)), statistics_(sea_statistics(sea, bins_)),
      plan_(make_fft_plan(quality.resolution)) {
  for (int i = 0; i < quality.cascades; ++i) {
    const Cascade& cascade = bins_.ladder[i];
    tables_.push_back(make_table(sea, bins_, i, plan_.band));
    places_.push_back({std::cos(cascade.rotation_rad), std::sin(cascade.rotation_rad), 1.0 / cascade.side_m,
                       cascade.side_m / quality.resolution});
  }
}

WaveTileLayout::WaveTileLayout(int cascades_kept, int texels_a_side) : cascades(cascades_kept), resolution(texels_a_side) {
  for (int size = resolution; size >= 1; size /= 2) {
    const int stride = size >= 32 ? size + 4 : size;
    levels.push_back({size, stride, plane_texels});
    plane_texels += std::size_t(cascades) * std::size_t(stride) * std::size_t(size);
  }
}

void WaveTiles::shape(int cascades, int resolution) {
  const bool same = cascades == layout_.cascades && resolution == layout_.resolution;
  if (!same) layout_ = WaveTileLayout(cascades, resolution);
  const std::size_t texels = layout_.plane_texels * std::size_t(planes_);
  assert(given_.empty() || given_.size() >= texels);
  if (given_.empty() && texels_.size() != texels) {
    texels_.assign(texels, glm::vec4(0.0f));
    first_ = texels_.data();
  }
  if (same) return;
  workspace_.assign(workspace_floats(make_fft_plan(resolution), has_velocity()) * cascades, 0.0f);
}

void WaveField::evaluate(std::int64_t ticks, WaveTiles& tiles) const {
  const bool velocity = tiles.has_velocity();
  const int n = quality_.resolution, cascades = quality_.cascades, strips = n / strip_width;
  tiles.shape(cascades, n);
  tiles.ticks_ = ticks;
  const std::size_t floats = tiles.workspace_.size() / cascades;
  const auto plane_level = [&](int cascade, int level) {
    PlaneLevel result{};
    for (int plane = 0; plane < tiles.planes_; ++plane) result.texels[plane] = tiles.writable(cascade, WavePlane(plane), level);
    result.stride = tiles.stride(level);
    return result;
  };
  // Each piece of work writes texels of its own from inputs that are complete: any division into threads gives the same bits.
  tbb::parallel_for(0, cascades, [&](int i) { waves_along_x(tables_[i], plan_, ticks, velocity, &tiles.workspace_[i * floats]); });
  tbb::parallel_for(0, cascades * strips, [&](int i) {
    const int cascade = i / strips;
    PlaneLevel levels[strip_levels + 1];
    for (int level = 0; level <= strip_levels; ++level) levels[level] = plane_level(cascade, level);
    strip_along_z(tables_[cascade], plan_, &tiles.workspace_[cascade * floats], velocity, i % strips * strip_width, levels);
  });
  for (int cascade = 0; cascade < cascades; ++cascade)
    for (int level = strip_levels + 1; level < tiles.levels(); ++level)
      average_down(plane_level(cascade, level - 1), plane_level(cascade, level), tiles.planes_, 0, n >> level, n >> level);
}

}  // namespace seascape
