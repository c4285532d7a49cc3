// Foam as images that the surface samples: windows of which what has changed is copied, and the lace that it breaks up
// into.
#pragma once
#include <array>
#include <vector>

#include "engine/frame.h"
#include "ocean/foam/foam_sea.h"
#include "shaders/shared/foam_data.h"

namespace seascape {

class DrawnFoam {
 public:
  // As FoamSea is made.
  DrawnFoam(Device& device, const FoamSpec& spec, Sea& sea, std::shared_ptr<const ShoreLines> shore);

  // Has the foam, which has been stepped, in the images; records nothing where it has not changed, or where there is
  // and was none.
  void update(Frame& frame);
  // Foam is drawn out into streaks along the wind: from Beaufort 6 on, and to the full in a storm (Beaufort 11, 2.5 and
  // 6 times).
  void set_wind(const SeaState& sea);
  // What shaders are told; `grid_origin_m` is the world x, z that rest positions count from.
  void describe(gpu::FoamData& data, glm::dvec2 grid_origin_m) const;
  void add_uses(Uses& uses, Access access) const;

  FoamSea& sea() { return sea_; }
  const FoamSea& sea() const { return sea_; }
  const Image& windows() const { return windows_; }
  const Image& lace() const { return lace_; }

 private:
  void fill_lace(Device& device);
  FoamSea sea_;
  LodWindowSettings settings_;
  Image windows_, lace_;
  std::array<Buffer, Frame::slots> staging_;
  std::vector<VkBufferImageCopy> regions_;
  glm::dvec4 wind_{0.0};     // gpu::FoamData::wind
  std::uint32_t drawn_ = 0;  // slices whose images may have foam
  bool begun_ = false;       // or else nothing is in them yet
};

}  // namespace seascape
