// Where a clip field leaves surely no water: asked of whole patches, which then need not be drawn.
#pragma once
#include <cstdint>
#include <vector>

#include "ocean/places/place_fields.h"

namespace seascape {

// Keeps the least value of the field's texels over blocks of 1, 2, 4, ... texels a side of each slice.
class ClipMask {
 public:
  // Takes the slices anew that have changed: bit i for slice i.
  void follow(const PlaceField<glm::vec4>& field, std::uint32_t changed);

  // Whether every place of a rectangle (m, x and z in the world) reads as clipped whichever slices it is read from
  // (lod_read), that is whether all texels are that it could be read between. A rectangle of no size or that is no
  // number is not.
  bool clipped(glm::dvec2 least_m, glm::dvec2 most_m) const;

 private:
  float least(int slice, LodIndex from, LodIndex to) const;
  struct Slice {
    LodIndex first{0};
    double texel_m = 1.0;
    std::vector<std::vector<float>> levels;  // (side >> n)^2 each
  };
  std::vector<Slice> slices_;
  glm::dvec2 viewer_m_{0.0};
  glm::vec4 reach_{0.0f};  // LodWindows::reach
  bool outside_ = false;   // whether that is clipped
  int side_ = 0;
};

}  // namespace seascape
