// A source's tile as images that the surface samples, filled by the processor and copied.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/frame.h"
#include "ocean/sea/sea_view.h"
#include "ocean/waves/tile_source.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

class DrawnSource {
 public:
  // Everything is made under the source's name. `half`: texels are 16-bit floats.
  DrawnSource(Device& device, std::shared_ptr<const TileSource> source, bool half);

  // Copies the source's tile of a time; nothing when the images already hold it. `view`: of any detail, all of which
  // have the sources' tiles.
  void update(Frame& frame, const SeaView& view);

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
  std::size_t plane_texels_ = 0;
  // A level as it lies in a plane of the staging memory: texels from the plane's first, and their rows.
  struct Level {
    std::size_t offset;
    int size;
  };
  std::vector<Level> levels_;
  bool uploaded_ = false;
  std::int64_t ticks_ = 0;
};

}  // namespace seascape
