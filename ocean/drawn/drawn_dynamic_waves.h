// The dynamic waves as the surface samples them.
#pragma once
#include <span>
#include <vector>

#include "ocean/drawn/drawn_piece.h"
#include "ocean/drawn/level_images.h"

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
  void add_uses(Uses& uses) const override { images_.add_uses(uses, Access::surface_read); }
  // Of all levels together.
  WaterReach reach() const override { return reach_; }

  // Null before the first update.
  const DynamicSurface* surface() const { return surface_.get(); }
  // What meshes miss of each level that moves, as far as its window is read; nearest first. Until the next update.
  std::span<const NearMeshError> mesh_errors() const { return mesh_errors_; }
  const LevelImages& images() const { return images_; }  // a layer a level

 private:
  std::shared_ptr<const DynamicSurface> surface_;
  std::uint64_t version_ = 0;  // of the sea's that is in the images
  LevelImages images_;
  std::vector<LevelImages::Level> levels_;
  WaterReach reach_;
  std::vector<NearMeshError> mesh_errors_;
};

}  // namespace seascape
