// Waves in the windows of bodies as the surface samples them.
#pragma once
#include <span>
#include <vector>

#include "ocean/drawn/drawn_piece.h"
#include "ocean/drawn/level_images.h"

namespace seascape {

class DrawnWakes final : public DrawnPiece {
 public:
  DrawnWakes(Device& device, const WakeSettings& settings);

  const char* stage() const override { return "wakes"; }
  // Records nothing where all windows rest, and copies nothing of those that do.
  void update(Frame& frame, const DrawnMoment& moment) override;
  void declare(SurfaceSlots& slots, std::size_t copy) const override;
  void describe(gpu::FrameData& data, glm::dvec2 grid_origin_m) const override;
  void add_uses(Uses& uses) const override { images_.add_uses(uses, Access::surface_read); }
  // Of all levels together.
  WaterReach reach() const override { return reach_; }

  // Null where all windows rest, and before the first update.
  const WakeSurface* surface() const { return surface_.get(); }
  // What meshes miss of each level in each window, as far as the farthest of them lies from the viewer of the last
  // update; nearest first. Until the next one.
  std::span<const NearMeshError> mesh_errors() const { return mesh_errors_; }
  const LevelImages& images() const { return images_; }  // level l of window i: layer i max_wake_levels + l

 private:
  void find_mesh_errors(glm::dvec2 viewer_m);
  std::shared_ptr<const WakeSurface> surface_;
  std::uint64_t version_ = 0;  // of the sea's that is in the images
  int levels_of_window_;
  LevelImages images_;
  std::vector<LevelImages::Level> levels_;
  WaterReach reach_;
  std::vector<NearMeshError> mesh_errors_;
};

}  // namespace seascape
