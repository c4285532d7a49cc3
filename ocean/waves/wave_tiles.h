// The sea's tiles on the CPU at one time: displacement, its derivatives and their second moments, with mip chains, laid
// out texel for texel as the GPU holds them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/large_pages.h"
#include "ocean/waves/fft.h"
#include "ocean/waves/tile_source.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

struct PlaneLevel;  // ocean/waves/wave_tiles_simd.h
struct StripPlaces;

enum class WavePlane {
  shift,     // Dx, h, Dz, dDx/dz
  slope,     // dh/dx, dh/dz, dDx/dx, dDz/dz
  moments,   // (dh/dx)^2, (dh/dz)^2, dh/dx dh/dz, (dDx/dx + dDz/dz)^2, times WaveTable::moment_share: averaged, not
             // recomputed, in the mip chain
  velocity,  // dDx/dt, dh/dt, dDz/dt of the water at its rest position, 0; only where asked for
};

// What the tiles of cascades are filled with besides displacements; those of other sources have it all but where there
// is no velocity.
struct TileFields {
  bool slopes = true;  // planes slope and moments
  bool velocity = false;
};

// Where the texels of tiles lie, counted from their first: plane after plane, in it tile after tile (those of the
// cascades, then those of other sources), in it level after level.
struct WaveTileLayout {
  struct Level {
    int size,
        stride;  // rows are `stride` texels apart, a little more than `size`: power-of-two strides cost cache aliasing
    std::size_t offset;  // from the plane's first texel
  };
  struct Tile {
    int samples = 0, levels = 0;  // a side of level 0; log2(samples) + 1
    std::array<Level, 10> level{};
  };
  int cascades = 0, resolution = 0, sources = 0;  // that it was made for
  std::array<Tile, gpu::max_cascades + most_sources> tiles;
  std::size_t plane_texels = 0;  // from one plane to the next

  WaveTileLayout() = default;
  explicit WaveTileLayout(const WaveQuality& quality, const TileSources& others = {});
  const Level& level(int tile, int level) const { return tiles[std::size_t(tile)].level[std::size_t(level)]; }
  std::size_t offset(int tile, WavePlane plane, int level_index) const {
    return std::size_t(plane) * plane_texels + level(tile, level_index).offset;
  }
};
static_assert(longest_tile_samples < 1 << 10, "a tile has at most ten levels");

// Filled by WaveField::evaluate. Texel (x, z) of level 0 holds the field at tile coordinates (x, z) / samples, its
// waves raised by what sampling between texels takes (sampled_share); each level after it holds averages of two by two
// texels, down to one texel.
class WaveTiles {
 public:
  explicit WaveTiles(bool with_velocity = false) : planes_(with_velocity ? 4 : 3) {}
  WaveTiles(const WaveTiles&) = delete;
  WaveTiles& operator=(const WaveTiles&) = delete;
  int cascades() const { return layout_.cascades; }
  // Tiles are numbered from 0: the cascades' first, then the other sources'.
  int samples(int tile) const { return layout_.tiles[std::size_t(tile)].samples; }
  int levels(int tile) const { return layout_.tiles[std::size_t(tile)].levels; }
  const WaveTileLayout& layout() const { return layout_; }
  bool has_velocity() const { return planes_ == 4; }
  std::int64_t ticks() const { return ticks_; }
  // First texel of a level, whose rows are `stride(tile, level)` texels apart.
  const glm::vec4* texels(int tile, WavePlane plane, int level) const {
    return first_[std::size_t(tile)][std::size_t(plane)] + layout_.level(tile, level).offset;
  }
  int stride(int tile, int level) const { return layout_.level(tile, level).stride; }
  using Places = std::array<std::array<glm::vec4*, 4>, gpu::max_cascades + most_sources>;
  // Rows of texels of four 16-bit floats.
  struct HalfRows {
    std::uint16_t* first = nullptr;
    std::ptrdiff_t row = 0;  // from one row to the next, in numbers
  };
  // Memory of others that takes tiles, such as an image that the processor writes. It is written once and past the
  // caches; it outlives its use, and what it held is not kept.
  struct Lent {
    // Either whole floats, instead of the tiles' own: a first texel for each plane.
    Places floats{};
    // Or 16-bit floats besides (halves_from_floats), by tile, level and plane (shift, slope, moments). Then the tiles'
    // own memory has shifts alone.
    std::array<std::array<std::array<HalfRows, 3>, 10>, gpu::max_cascades> halves{};
    bool in_halves() const { return halves[0][0][0].first != nullptr; }
  };
  // From the next evaluation on the first `count` tiles, which are cascades, go there. Of whole floats levels lie as
  // `layout` says (its plane_texels do not count). Tiles with velocities are not lent memory.
  void keep_in(const Lent& memory, const WaveTileLayout& layout, int count);
  // Whether texels go to memory of others as 16-bit floats.
  bool in_halves() const { return lent_.in_halves(); }

 private:
  friend class WaveField;
  void shape(const WaveQuality& quality, const TileSources& others);
  PlaneLevel plane_level(int tile, int level, const TileFields& fields);    // of the planes of these fields
  StripPlaces strip_places(int tile, const TileFields& fields, bool lent);  // of memory that is lent
  void finish_halves(int tile);                                             // of the levels that no strip has
  glm::vec4* writable(int tile, WavePlane plane, int level) {
    return const_cast<glm::vec4*>(texels(tile, plane, level));
  }
  int planes_;
  std::array<bool, gpu::max_cascades + most_sources> borrowed_{};
  std::int64_t ticks_ = 0;
  WaveTileLayout layout_;
  Places first_{};  // what the levels' offsets count from
  // Where the tiles lie that no evaluation has borrowed.
  WaveTileLayout own_layout_, lent_layout_;
  Places own_first_{};
  Lent lent_;
  int lent_tiles_ = 0;
  std::vector<glm::vec4, LargePages<glm::vec4>> texels_;
  std::vector<float, LargePages<float>>
      workspace_;  // of the transforms, cascade after cascade; then of the other sources
};

// A tile that an evaluation takes over from other tiles of the same time and waves instead of computing it again.
struct BorrowedTile {
  int tile;
  const WaveTiles* from;  // has as many planes or more, and stays as it is while the borrower is read
  int from_tile;          // of as many samples
};

}  // namespace seascape
