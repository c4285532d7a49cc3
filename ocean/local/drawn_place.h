// Data that belong to places as images that the surface samples: windows that move with the viewer, of which only what has changed is copied.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "engine/frame.h"
#include "ocean/local/place_sea.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

class DrawnPlace {
 public:
  // Every field is made under the name of its effect. Throws as validate() does.
  DrawnPlace(Device& device, const PlaceInputs& inputs);

  // Has the data around a viewer (m) at a time in the images; records nothing where nothing has changed.
  void update(Frame& frame, double time_s, const glm::dvec3& viewer_m);
  // What shaders are told; `grid_origin_m` is the world x, z that rest positions count from.
  void describe(gpu::PlaceData& data, glm::dvec2 grid_origin_m, double time_s) const;
  void add_uses(Uses& uses, Access access) const;

  // The images of a kind; null where there is none.
  const Image* image(InputTarget kind) const;
  VkSampler sampler() const { return sampler_.get(); }
  const PlaceField* field(InputTarget kind) const;
  // How far the still water stands above or below y = 0 at most, of what has been around the viewer, m.
  double level_m() const;

 private:
  struct Drawn {
    InputTarget kind;
    std::unique_ptr<PlaceField> field;  // from the first update on
    std::shared_ptr<const Inputs> inputs;
    int channels;
    bool half;
    Image image;
    std::array<Buffer, Frame::slots> staging;
  };
  const Drawn* drawn(InputTarget kind) const;
  void copy(Frame& frame, Drawn& drawn, std::uint32_t slices);
  PlaceSettings settings_;
  LodPlacement placement_;
  std::vector<Drawn> drawn_;
  Owned<VkSampler> sampler_;
};

}  // namespace seascape
