// Levels of waves that windows hold as images that the surface samples, filled by the processor and copied.
#pragma once
#include <array>
#include <vector>

#include "engine/frame.h"
#include "ocean/mesh/surface_selection.h"
#include "ocean/places/dynamic_surface.h"

namespace seascape {

class LevelImages {
 public:
  // A level a layer, of this many samples a side. `effect` names its objects and its pass: a literal. `joined`: in one
  // image, slopes in layers behind all shifts, for a device allows few images a stage.
  LevelImages(Device& device, const char* effect, int samples, int layers, bool joined = false);

  // Levels of surfaces for the layers; those of levels that rest need none. Copied before the next draw.
  struct Level {
    const DynamicSurface* surface;
    int level, layer;
  };
  // Records nothing where there are no levels.
  void fill(Frame& frame, std::span<const Level> levels);
  void add_uses(Uses& uses, Access access) const;

  const Image& shift() const { return images_.front(); }  // Dx, h, Dz, dDx/dz; of Dx and Dz before the surface's share
  const Image& slope() const { return images_.back(); }  // dh/dx, dh/dz, dDx/dx, dDz/dz; where they are joined, shift()
  int layers() const { return layers_; }

 private:
  const char* effect_;
  int layers_;
  std::vector<Image> images_;
  std::array<Buffer, Frame::slots> staging_;
  std::vector<VkBufferImageCopy> regions_;
};

// What meshes miss of waves bent and as high as this, in so many steps an octave so that it seldom changes; as far as
// `reach_m` from the viewer. None of waves that are too low to see.
std::optional<NearMeshError> near_mesh_error(const DynamicSurface::Extent& waves, double reach_m,
                                             int steps_an_octave = 1);

}  // namespace seascape
