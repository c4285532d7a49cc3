// A source's tile as images that the surface samples, filled by the processor and copied.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/frame.h"
#include "ocean/waves/tile_source.h"
#include "ocean/waves/wave_tiles_simd.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

class DrawnSource {
 public:
  // Everything is made under the source's name. `half`: texels are 16-bit floats.
  DrawnSource(Device& device, std::shared_ptr<const TileSource> source, bool half);

  // Evaluates the tile for the time and copies it; nothing when the images already hold it.
  void update(Frame& frame, std::int64_t ticks);

  // What shaders are told of its layings; `grid_origin_m` is the world x, z that rest positions count from.
  void describe(std::span<gpu::CascadeData> layings, glm::dvec2 grid_origin_m) const;
  void add_uses(Uses& uses, Access access, bool whole = false) const;
  const TileSource& source() const { return *source_; }
  const Image& displacement() const { return images_[0]; }
  const Image& derivatives() const { return images_[1]; }
  const Image& moments() const { return images_[2]; }

 private:
  static constexpr int planes = 3;
  std::shared_ptr<const TileSource> source_;
  bool half_;
  std::array<Image, planes> images_;
  std::array<Buffer, Frame::slots> staging_;
  std::array<std::vector<VkBufferImageCopy>, planes> regions_;
  std::vector<float> workspace_;
  std::vector<glm::vec4> texels_;  // what halves are made of
  std::size_t plane_texels_ = 0;
  std::vector<std::size_t> offsets_;  // of each level in a plane, texels
  bool uploaded_ = false;
  std::int64_t ticks_ = 0;
};

}  // namespace seascape
