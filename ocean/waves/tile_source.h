// What feeds sea() beside the cascades of waves: a periodic tile that a source fills for any time, laid over the sea at
// one size or several. A new source is one class of this kind, one line in tile_sources(), and one in
// shaders/lib/sea.glsl.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace seascape {

struct PlaneLevel;  // ocean/waves/wave_tiles_simd.h

// One way in which the sea takes a tile: `size` times as long, and displaced as many times as far, as the tile is, so
// that slopes are those of the tile. World place p has the tile coordinates p / side_m + offset on both axes, p turned
// back by the rotation (from x towards z); what texels hold is along the world's axes all the same.
struct Laying {
  double size, side_m, offset;
  double longest_m, shortest_m;  // waves in it: a footprint of half the longest begins to fade it (kept_share)
  double rotation_rad = 0.0;
};
inline constexpr int most_layings = 6, most_sources = 4;  // of all of a sea's sources together
static_assert(most_sources <= most_layings);

// Sums over a source's layings, as SeaStatistics has them.
struct SourceStatistics {
  double height_variance = 0.0;
  glm::dvec3 slope_moments{0.0};  // of one laying: all have the same
  double largest_height_m = 0.0, largest_shift_m = 0.0;
  double largest_curvature_per_m =
      0.0;  // of any component of the displacement along any line, of what may be laid along curves
};

// Immutable once made: any number of threads may evaluate one.
class TileSource {
 public:
  virtual ~TileSource() = default;
  // The effect that it belongs to, a literal.
  virtual std::string_view name() const = 0;
  // Texels a side, a power of two from 16 to 512.
  virtual int samples() const = 0;
  // Nothing of it is to be seen at any time: nobody needs to evaluate or to draw it.
  virtual bool still() const = 0;
  virtual std::span<const Laying> layings() const = 0;
  virtual SourceStatistics statistics() const = 0;
  // Floats that an evaluation works in; they may lie anywhere on a cache line of 64 bytes.
  virtual std::size_t workspace_floats(bool velocity) const = 0;
  // Fills the planes (WavePlane) of every level for a time in ticks, on all cores: levels[0] has samples() texels a
  // side, the last has one. The result depends on the source and the ticks alone. No allocation.
  virtual void evaluate(std::int64_t ticks, bool velocity, std::span<const PlaneLevel> levels,
                        std::span<float> workspace) const = 0;
  // Laid along the curves of a place (ocean/places/shore_lines.h), x along them and -z towards the shore, and nowhere
  // else. Then there is one laying, not turned.
  virtual bool along_curves() const { return false; }
  // Of the processor's memory that it keeps for as long as it lives, where that is more than a few settings.
  virtual std::size_t bytes() const { return 0; }
};
using TileSources = std::vector<std::shared_ptr<const TileSource>>;

// Whether one can take the place of the other in all that is made for its tile: memory, images and shaders.
inline bool alike(const TileSource& a, const TileSource& b) {
  return a.name() == b.name() && a.along_curves() == b.along_curves() && a.samples() == b.samples() &&
         a.layings().size() == b.layings().size();
}

}  // namespace seascape
