// What a source of tiles makes of a time, in memory of a test's own.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "ocean/waves/tile_source.h"
#include "ocean/waves/wave_tiles.h"
#include "ocean/waves/wave_tiles_simd.h"

namespace seascape::test {

// A source's tile with its own memory.
struct SourceTile {
  explicit SourceTile(const TileSource& source, std::int64_t ticks, bool with_velocity = false)
      : samples(source.samples()), velocity(with_velocity), workspace(source.workspace_floats(velocity)) {
    for (int size = samples; size >= 1; size /= 2)
      for (int plane = 0; plane < 4; ++plane)
        texels.emplace_back(std::size_t(size) * std::size_t(size), glm::vec4(-1e30f));
    for (int size = samples, level = 0; size >= 1; size /= 2, ++level) {
      PlaneLevel l{};
      l.stride = size;
      for (int plane = 0; plane < (velocity ? 4 : 3); ++plane)
        l.texels[plane] = texels[std::size_t(4 * level + plane)].data();
      levels.push_back(l);
    }
    evaluate(source, ticks);
  }
  void evaluate(const TileSource& source, std::int64_t ticks) { source.evaluate(ticks, velocity, levels, workspace); }
  const glm::vec4& at(WavePlane plane, int x, int z, int level = 0) const {
    const int size = samples >> level;
    return texels[std::size_t(4 * level) + std::size_t(plane)][std::size_t((z & (size - 1)) * size + (x & (size - 1)))];
  }
  double height(int x, int z) const { return at(WavePlane::shift, x, z).y; }
  int samples;
  bool velocity;
  std::vector<float> workspace;
  std::vector<std::vector<glm::vec4>> texels;
  std::vector<PlaneLevel> levels;
};

}  // namespace seascape::test
