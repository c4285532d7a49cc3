#include "ocean/sea/sea_view.h"

#include <algorithm>
#include <cmath>

#include "ocean/places/dynamic_surface.h"

namespace seascape {

SeaSample SeaView::at(glm::dvec2 rest, double footprint) const {
  return places().at(field(), tiles(), rest, {.footprint_m = footprint}, beside());
}

PlaceSea::Beside SeaView::beside() const {
  return {.dynamic = dynamic(),
          .wakes = wakes(),
          .volumes = volumes(),
          .finest_m = detail() == SeaDetail::felt ? felt_place_texel_m : 0.0,
          .left_out_m = left_out_m()};
}

void SeaView::query(std::span<const glm::dvec2> points, std::span<QueryAnswer> answers, QueryOptions options) const {
  PlaceSea::Beside beside = this->beside();
  if (!options.history) beside.dynamic = nullptr, beside.wakes = nullptr, beside.volumes = nullptr;
  if (!options.viewer_waves) beside.dynamic = nullptr;
  if (!options.actors_bodies) beside.volumes = nullptr;
  places().query(field(), tiles(), points, answers, options, beside);
}

WaterSide SeaView::side(const glm::dvec3& at_m) const { return places().side(field(), tiles(), at_m, beside()); }

StillWater SeaView::still_water(glm::dvec2 place, double texel_m) const {
  return places().still_water(place, texel_m, double(ticks()) / double(gpu::ticks_per_second), volumes());
}

QueryAnswer SeaView::query(glm::dvec2 place, const QueryOptions& options) const {
  QueryAnswer answer;
  query({&place, 1}, {&answer, 1}, options);
  return answer;
}

}  // namespace seascape
