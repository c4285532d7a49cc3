// The sea's tiles on the CPU at one time: displacement, its derivatives and their second moments, with mip chains, laid out
// texel for texel as the GPU holds them.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ocean/waves/fft.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

enum class WavePlane {
  shift,     // Dx, h, Dz, dDx/dz
  slope,     // dh/dx, dh/dz, dDx/dx, dDz/dz
  moments,   // (dh/dx)^2, (dh/dz)^2, dh/dx dh/dz, (dDx/dx + dDz/dz)^2: averaged, not recomputed, in the mip chain
  velocity,  // dDx/dt, dh/dt, dDz/dt of the water at its rest position, 0; only where asked for
};

// Filled by WaveField::evaluate. Texel (x, z) of level 0 holds the field at tile coordinates (x, z) / resolution; each level
// after it holds averages of two by two texels, down to one texel.
class WaveTiles {
 public:
  explicit WaveTiles(bool with_velocity = false) : planes_(with_velocity ? 4 : 3) {}
  int cascades() const { return cascades_; }
  int resolution() const { return resolution_; }
  int levels() const { return int(levels_.size()); }  // log2(resolution) + 1
  bool has_velocity() const { return planes_ == 4; }
  std::int64_t ticks() const { return ticks_; }
  // First texel of a level. Rows are `stride(level)` texels apart, a little more than the level's width: power-of-two strides
  // cost cache aliasing.
  const glm::vec4* texels(int cascade, WavePlane plane, int level) const {
    return texels_.data() + (std::size_t(cascade) * planes_ + int(plane)) * plane_texels_ + levels_[level].offset;
  }
  int stride(int level) const { return levels_[level].stride; }

 private:
  friend class WaveField;
  struct Level {
    int size, stride;
    std::size_t offset;  // texels from the plane's first
  };
  void shape(int cascades, int resolution);
  glm::vec4* writable(int cascade, WavePlane plane, int level) {
    return const_cast<glm::vec4*>(texels(cascade, plane, level));
  }
  int planes_, cascades_ = 0, resolution_ = 0;
  std::int64_t ticks_ = 0;
  std::size_t plane_texels_ = 0;
  std::vector<Level> levels_;
  std::vector<glm::vec4> texels_;
  std::vector<float> workspace_;  // of the transforms, workspace_floats(...) a cascade
};

}  // namespace seascape
