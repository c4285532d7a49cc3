// The dynamic waves as images that the surface samples, filled by the processor and copied.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "ocean/drawn/drawn_piece.h"
#include "ocean/mesh/surface_selection.h"

namespace seascape {

class DrawnDynamicWaves final : public DrawnPiece {
 public:
  // Of at most gpu::max_dynamic_levels slices.
  DrawnDynamicWaves(Device& device, const DynamicSeaSettings& settings);

  const char* stage() const override { return "dynamic_waves"; }
  // Records nothing where all rest.
  void update(Frame& frame, const DrawnMoment& moment) override;
  void declare(SurfaceSlots& slots, std::size_t copy) const override;
  void describe(gpu::FrameData& data, glm::dvec2 grid_origin_m) const override;
  void add_uses(Uses& uses) const override { add_uses(uses, Access::surface_read); }
  // Of all levels together.
  WaterReach reach() const override { return reach_; }

  // Null before the first update.
  const DynamicSurface* surface() const { return surface_.get(); }
  // What meshes miss of each level that moves, as far as its window is read. In steps of a factor two, so that it
  // seldom changes. Until the next update.
  std::span<const NearMeshError> mesh_errors() const { return mesh_errors_; }
  const Image& shift() const { return images_[0]; }  // a layer a level: Dx, h, Dz, dDx/dz
  const Image& slope() const { return images_[1]; }  // dh/dx, dh/dz, dDx/dx, dDz/dz

 private:
  void add_uses(Uses& uses, Access access) const;
  std::shared_ptr<const DynamicSurface> surface_;
  std::uint64_t version_ = 0;  // of the sea's that is in the images
  std::array<Image, 2> images_;
  std::array<Buffer, Frame::slots> staging_;
  std::vector<VkBufferImageCopy> regions_;
  WaterReach reach_;
  std::vector<NearMeshError> mesh_errors_;
  void find_mesh_errors();
};

}  // namespace seascape
