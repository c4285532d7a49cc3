// A source's tile as images that the surface samples, filled by the processor and copied.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ocean/drawn/drawn_piece.h"
#include "ocean/waves/tile_source.h"

namespace seascape {

class DrawnSource final : public DrawnPiece {
 public:
  // Everything is made under the source's name. `half`: texels are 16-bit floats.
  DrawnSource(Device& device, std::shared_ptr<const TileSource> source, bool half);

  const char* stage() const override { return "sources"; }
  void take(const Sea& sea) override;
  void update(Frame& frame, const DrawnMoment& moment) override;
  void declare(SurfaceSlots& slots, std::size_t copy) const override;
  void describe(gpu::FrameData& data, glm::dvec2 grid_origin_m) const override;
  void add_uses(Uses& uses) const override { add_uses(uses, Access::surface_read); }
  const TileSource& source() const { return *source_; }
  const Image& displacement() const { return images_[0]; }
  const Image& derivatives() const { return images_[1]; }
  const Image& moments() const { return images_[2]; }

 private:
  void add_uses(Uses& uses, Access access, bool whole = false) const;
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
