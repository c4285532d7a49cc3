// Foam as images that the surface samples: windows of which what has changed is copied, and the lace that it breaks up
// into.
#pragma once
#include <array>
#include <vector>

#include "ocean/drawn/drawn_piece.h"
#include "ocean/foam/foam_sea.h"

namespace seascape {

class DrawnFoam final : public DrawnPiece {
 public:
  DrawnFoam(Device& device, std::unique_ptr<FoamSea> foam);

  const char* stage() const override { return "foam"; }
  // Of the foam as it has been stepped; records nothing where there is and was none.
  void update(Frame& frame, const DrawnMoment& moment) override;
  void declare(SurfaceSlots& slots, std::size_t copy) const override;
  void describe(gpu::FrameData& data, glm::dvec2 grid_origin_m) const override;
  void add_uses(Uses& uses) const override;

  FoamSea& sea() { return *sea_; }
  const FoamSea& sea() const { return *sea_; }
  // For another drawing of the same sea; nothing is drawn with this one any more.
  std::unique_ptr<FoamSea> give_up() { return std::move(sea_); }
  const Image& windows() const { return windows_; }
  const Image& lace() const { return lace_; }

 private:
  // Foam is drawn out into streaks along the wind: from Beaufort 6 on, and to the full in a storm (Beaufort 11, 2.5 and
  // 6 times).
  void follow_wind(const Sea& sea);
  void fill_lace(Device& device);
  std::unique_ptr<FoamSea> sea_;
  LodWindowSettings settings_;
  Image windows_, lace_;
  std::array<Buffer, Frame::slots> staging_;
  std::vector<VkBufferImageCopy> regions_;
  glm::dvec4 wind_{0.0};     // gpu::FoamData::wind
  std::uint64_t waves_ = 0;  // Sea::waves_version that it is of
  std::uint32_t drawn_ = 0;  // slices whose images may have foam
  bool begun_ = false;       // or else nothing is in them yet
};

}  // namespace seascape
