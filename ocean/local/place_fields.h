// Data that belong to places, kept in windows around the viewer: what the scene's inputs make of each kind, as the shaders read it.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "ocean/inputs/inputs.h"
#include "ocean/local/lod_field.h"
#include "ocean/local/place_settings.h"

namespace seascape {

// What there is beyond all windows, and where no input is.
glm::vec4 place_outside(const PlaceSettings& settings, InputTarget kind);

// The time as of which inputs are taken: in steps of 1 / rate where they change with it.
double place_time_s(const PlaceSettings& settings, const Inputs& inputs, double time_s);

// One kind. Texels hold the inputs' value at their middle, for a footprint of their side.
class PlaceField {
 public:
  PlaceField(std::shared_ptr<const Inputs> inputs, const PlaceSettings& settings, const LodPlacement& placement, double time_s);

  // Moves the windows to the placement, and takes what changes with time as it is at `time_s` (place_time_s). Gives the slices that
  // have changed: bit i for slice i, all of them after a change of the octave.
  std::uint32_t follow(const LodPlacement& placement, double time_s);

  const Inputs& inputs() const { return *inputs_; }
  const LodField<glm::vec4>& field() const { return field_; }
  // Of all that has ever been in it, the outside included; of the first channel.
  double least() const { return least_; }
  double most() const { return most_; }

 private:
  glm::vec4 value(glm::dvec2 middle, double texel_m);
  std::shared_ptr<const Inputs> inputs_;
  glm::vec4 outside_;
  PlaceSettings settings_;
  double time_s_;  // of what is in the field
  double least_, most_;
  LodField<glm::vec4> field_;
};

}  // namespace seascape
