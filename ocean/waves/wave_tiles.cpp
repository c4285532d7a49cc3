#include "ocean/waves/wave_tiles.h"

#include <algorithm>
#include <cassert>

#include "ocean/waves/half_floats.h"
#include "ocean/waves/wave_tiles_simd.h"

namespace seascape {

WaveTileLayout::WaveTileLayout(const WaveQuality& quality, const TileSources& others)
    : cascades(quality.cascades), resolution(quality.resolution), sources(int(others.size())) {
  for (int i = 0; i < cascades + sources; ++i) {
    Tile& tile = tiles[std::size_t(i)];
    tile.samples = i < cascades ? tile_samples(quality, i) : others[std::size_t(i - cascades)]->samples();
    for (int size = tile.samples; size >= 1; size /= 2) {
      const int stride = size >= 32 ? size + 4 : size;
      tile.level[std::size_t(tile.levels++)] = {size, stride, plane_texels};
      plane_texels += (std::size_t(stride) * std::size_t(size) + 3) / 4 * 4;  // whole cache lines
    }
  }
}

void WaveTiles::keep_in(const Lent& memory, const WaveTileLayout& layout, int count) {
  lent_ = memory;
  lent_layout_ = layout;
  lent_tiles_ = count;
  own_layout_ = {};
}

void WaveTiles::shape(const WaveQuality& quality, const TileSources& others) {
  bool same = quality.cascades == own_layout_.cascades && quality.resolution == own_layout_.resolution &&
              int(others.size()) == own_layout_.sources;
  for (std::size_t i = 0; same && i < others.size(); ++i)
    same = own_layout_.tiles[std::size_t(quality.cascades) + i].samples == others[i]->samples();
  if (!same) {
    own_layout_ = WaveTileLayout(quality, others);
    // Tiles that lie elsewhere are the first: memory of their own is not taken.
    const std::size_t first_own = lent_.in_halves() ? 0 : std::size_t(lent_tiles_),
                      all = std::size_t(own_layout_.cascades + own_layout_.sources);
    assert(first_own <= all);
    const std::size_t begin = first_own < all ? own_layout_.tiles[first_own].level[0].offset : own_layout_.plane_texels;
    const std::size_t plane_texels = own_layout_.plane_texels - begin;
    texels_.assign(plane_texels * std::size_t(planes_), glm::vec4(0.0f));
    for (std::size_t tile = 0; tile < all; ++tile) {
      if (tile < first_own) {
        own_first_[tile] = lent_.floats[tile];
        own_layout_.tiles[tile] = lent_layout_.tiles[tile];
        continue;
      }
      for (auto& level : own_layout_.tiles[tile].level) level.offset -= std::min(begin, level.offset);
      for (std::size_t plane = 0; plane < std::size_t(planes_); ++plane)
        own_first_[tile][plane] = texels_.data() + plane * plane_texels;
    }
  }
  layout_ = own_layout_;
  first_ = own_first_;
}

PlaneLevel WaveTiles::plane_level(int tile, int level, const TileFields& fields) {
  const bool there[] = {true, fields.slopes, fields.slopes, fields.velocity};
  PlaneLevel result{};
  for (int plane = 0; plane < 4; ++plane)
    if (there[plane]) result.texels[plane] = writable(tile, WavePlane(plane), level);
  result.stride = stride(tile, level);
  return result;
}

StripPlaces WaveTiles::strip_places(int tile, const TileFields& fields, bool lent) {
  StripPlaces to{};
  for (int level = 0; level <= strip_levels; ++level) {
    to.floats[level] = plane_level(tile, level, fields);
    if (!lent || !in_halves()) continue;
    to.halves[level] = lent_.halves[std::size_t(tile)][std::size_t(level)];
    if (level == strip_levels) continue;  // smaller ones are averaged from it
    for (const WavePlane plane : {WavePlane::slope, WavePlane::moments}) to.floats[level].texels[int(plane)] = nullptr;
  }
  return to;
}

void WaveTiles::finish_halves(int tile) {
  for (int level = strip_levels + 1; level < levels(tile); ++level)
    for (int plane = 0; plane < 3; ++plane) {
      const HalfRows& to = lent_.halves[std::size_t(tile)][std::size_t(level)][std::size_t(plane)];
      const int size = samples(tile) >> level;
      for (int z = 0; z < size; ++z)
        halves_from_floats(&texels(tile, WavePlane(plane), level)[z * stride(tile, level)].x, to.first + z * to.row,
                           4 * std::size_t(size));
    }
}

}  // namespace seascape
