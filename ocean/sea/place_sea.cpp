#include "ocean/sea/place_sea.h"

#include <algorithm>
#include <cmath>

namespace seascape {

PlaceSea::PlaceSea(PlaceInputs inputs, const WaveField& field)
    : PlaceSea(inputs, field,
               ShallowsMix{make_shallows(field.state(), field.bins(), field.others(), inputs), nullptr}) {}

PlaceSea::PlaceSea(PlaceInputs inputs, const WaveField& field, ShallowsMix shallows)
    : settings_(inputs.settings),
      open_depth_m_(field.state().depth_m),
      volumes_(inputs.volumes),
      shore_(field.has_curved() ? inputs.shore : nullptr),
      cascades_(field.quality().cascades),
      has_others_(field.places().size() > std::size_t(field.quality().cascades)) {
  validate(settings_);
  for (const auto& [kind, values] : {std::pair(InputTarget::level, &level_), std::pair(InputTarget::flow, &flow_),
                                     std::pair(InputTarget::clip, &clip_)})
    if (auto of_kind = inputs.of(kind)) *values = place_values(std::move(of_kind), settings_);
  follow(std::move(shallows));
}

void PlaceSea::follow(ShallowsMix shallows) {
  shallows_ = std::move(shallows);
  if (shallows_) bed_ = bed_values(shallows_, shallows_.from->depth_m());
  if (shore_ != nullptr) along_curves_ = shore_values(shore_, shallows_.from);
  renew();
}

double PlaceSea::level_m(glm::dvec2 rest, double footprint, double time) const {
  return level_ ? double(PlaceReader(*level_, settings_, time)(
                             place_reading(settings_.windows, rest, footprint, nullptr), rest)
                             .x)
                : 0.0;
}

glm::dvec2 PlaceSea::flow_mps(glm::dvec2 rest, double footprint, double time) const {
  return flow_ ? glm::dvec2(PlaceReader(*flow_, settings_, time)(
                     place_reading(settings_.windows, rest, footprint, nullptr), rest))
               : glm::dvec2(0.0);
}

StillWater PlaceSea::still_water(glm::dvec2 place, double texel, double time, const ClipVolumes* volumes) const {
  const auto value = [&](const PlaceValues<glm::vec4>& of) {
    return of.value(place, texel, place_time_s(settings_, of.still, time)).x;
  };
  StillWater water;
  water.depth_m = open_depth_m_;
  if (level_) water.height_m = double(value(*level_));
  if (shallows_) {
    water.depth_m = water.height_m - shallows_.bed_m(place, texel, time);
    const PlaceWaves waves = shallows_.waves(place, water.depth_m);
    water.waves = double(waves.share[0]);
    water.swash = double(waves.swash);
    water.surf = shallows_.surf(place, water.depth_m);
    const Shallows::Placed placed = shallows_.placed(place, water.depth_m);
    water.placed = placed.share;
    water.placed_surf = placed.surf;
  }
  if (!clips()) return water;
  water.clipped = clipped({place.x, water.height_m, place.y}, clip_ && value(*clip_) > 0.5f, volumes);
  return water;
}

}  // namespace seascape
