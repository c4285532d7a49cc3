// The dynamic waves as images that the surface samples, filled by the processor and copied.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "engine/frame.h"
#include "ocean/mesh/surface_selection.h"
#include "ocean/sea/sea.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

class DrawnDynamicWaves {
 public:
  // Of at most gpu::max_dynamic_levels slices.
  DrawnDynamicWaves(Device& device, const DynamicSeaSettings& settings);

  // Has the sea's dynamic waves in the images; records nothing where they have not changed, or all rest.
  void update(Frame& frame, Sea& sea);

  // What shaders are told; `grid_origin_m` is the world x, z that rest positions count from.
  void describe(gpu::DynamicData& data, glm::dvec2 grid_origin_m) const;
  void add_uses(Uses& uses, Access access) const;

  // Null before the first update.
  const DynamicSurface* surface() const { return surface_.get(); }
  // How high and how far sideways they move the water, of all levels together, m.
  double height_m() const { return height_m_; }
  double shift_m() const { return shift_m_; }
  // What meshes miss of each level that moves, as far as its window is read. In steps of a factor two, so that it
  // seldom changes. Until the next update.
  std::span<const NearMeshError> mesh_errors() const { return mesh_errors_; }
  const Image& shift() const { return images_[0]; }  // a layer a level: Dx, h, Dz, dDx/dz
  const Image& slope() const { return images_[1]; }  // dh/dx, dh/dz, dDx/dx, dDz/dz

 private:
  std::shared_ptr<const DynamicSurface> surface_;
  std::uint64_t version_ = 0;  // of the sea's that is in the images
  std::array<Image, 2> images_;
  std::array<Buffer, Frame::slots> staging_;
  std::vector<VkBufferImageCopy> regions_;
  double height_m_ = 0.0, shift_m_ = 0.0;
  std::vector<NearMeshError> mesh_errors_;
  void find_mesh_errors();
};

}  // namespace seascape
