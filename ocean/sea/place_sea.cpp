#include "ocean/sea/place_sea.h"

#include <algorithm>
#include <cmath>

#include "ocean/places/flow_phase.h"
#include "ocean/waves/wave_tiles.h"
#include "shaders/shared/flow_height.h"

namespace seascape {

namespace {
double seconds(const WaveTiles& tiles) { return double(tiles.ticks()) / double(gpu::ticks_per_second); }
}  // namespace

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

PlaceSea::Readers::Readers(const PlaceSea& sea, double time, const DynamicSurface* waves, const ClipVolumes* now)
    : time_s(time), dynamic(waves), volumes(now) {
  if (sea.level_) level.emplace(*sea.level_, sea.settings_, time);
  if (sea.flow_) flow.emplace(*sea.flow_, sea.settings_, time);
  if (sea.clip_) clip.emplace(*sea.clip_, sea.settings_, time);
  if (sea.bed_) bed.emplace(*sea.bed_, sea.settings_, time);
  if (sea.along_curves_) shore.emplace(*sea.along_curves_, sea.settings_, time);
}

double PlaceSea::level_m(glm::dvec2 rest, double footprint, double time) const {
  return level_ ? double(PlaceReader(*level_, settings_, time)(reading({rest, footprint, nullptr, false}), rest).x)
                : 0.0;
}

glm::dvec2 PlaceSea::flow_mps(glm::dvec2 rest, double footprint, double time) const {
  return flow_ ? glm::dvec2(PlaceReader(*flow_, settings_, time)(reading({rest, footprint, nullptr, false}), rest))
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

namespace {
// d f / d x and d f / d z of what is read at a place, over `e` to either side.
template <class T>
struct Around {
  T east, west, south, north;
  double e;
  template <class Of>
  glm::dvec2 gradient(const Of& of) const {
    return glm::dvec2(double(of(east)) - double(of(west)), double(of(south)) - double(of(north))) / (2.0 * e);
  }
};
template <class T>
Around<T> around(PlaceReader<T>& reader, const PlaceReading& reading, glm::dvec2 at) {
  const double e = reading.fine_texel_m();
  return {reader(reading, at + glm::dvec2(e, 0.0)), reader(reading, at - glm::dvec2(e, 0.0)),
          reader(reading, at + glm::dvec2(0.0, e)), reader(reading, at - glm::dvec2(0.0, e)), e};
}

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// A cascade's share; the other sources' from the number of cascades on.
double share_of(const BedTexel& texel, int cascade, int cascades) {
  return double(cascade >= cascades ? texel.more.y : cascade < 4 ? texel.share[cascade] : texel.more.x);
}

double lifted(const BedTexel& texel, int cascade, int cascades) {
  const double share = share_of(texel, cascade, cascades);
  return cascade < std::min(Shallows::swash_cascades, cascades) ? std::hypot(share, double(texel.more.z)) : share;
}
}  // namespace

PlaceSea::Here PlaceSea::here(const WaveField& field, const WaveField::Filter& filter, const Asked& asked,
                              Readers& readers) const {
  Here result;
  result.rest = asked.rest;
  result.parts.push_back({.place = asked.rest, .filter = filter});
  if (readers.level) {
    const PlaceReading at = reading(asked);
    result.level_m = double((*readers.level)(at, asked.rest).x);
    if (asked.gradients)
      result.level_gradient =
          around(*readers.level, at, asked.rest).gradient([](const glm::vec4& value) { return value.x; });
  }
  if (readers.bed) add_shallows(field, result, asked, readers);
  if (readers.shore) add_shore(result, filter, asked, readers);
  if (readers.flow) add_current(field, result, asked, readers);
  if (readers.dynamic != nullptr) result.dynamic = readers.dynamic->sea(asked.rest, asked.footprint_m);
  return result;
}

// A pattern for each cascade and one for all that is no cascade, for each counts for something else.
void PlaceSea::add_shallows(const WaveField& field, Here& here, const Asked& asked, Readers& readers) const {
  const PlaceReading at = reading(asked);
  const BedTexel waves = (*readers.bed)(at, asked.rest);
  here.bed_m = double(waves.bed.x);
  here.flat_clipped =
      readers.clip && (*readers.clip)(reading({asked.rest, 0.0, asked.seen, false}), asked.rest).x > 0.5f;
  here.wet = smoothstep(gpu::dry_depth_m, gpu::wet_depth_m, here.level_m - here.bed_m);
  Around<BedTexel> beside{};
  if (asked.gradients) {
    beside = around(*readers.bed, at, asked.rest);
    here.bed_gradient = beside.gradient([](const BedTexel& texel) { return texel.bed.x; });
  }
  const int cascades = field.quality().cascades;
  const WaveField::Filter all = here.parts[0].filter;
  here.parts.clear();
  for (int i = 0; i <= cascades; ++i) {
    if (i == cascades && field.places().size() == std::size_t(cascades)) break;
    Part part{.place = asked.rest, .filter = all};
    for (std::size_t place = 0; place < field.places().size(); ++place)
      if (std::min(int(place), cascades) != i) part.filter.share[place] = 0.0f;
    part.share = share_of(waves, i, cascades);
    part.lift = lifted(waves, i, cascades);
    if (asked.gradients)
      part.lift_gradient = beside.gradient([&](const BedTexel& texel) { return lifted(texel, i, cascades); });
    if (i < std::min(Refraction::bent_cascades, cascades)) {
      part.along = shallows_.direction(i);
      part.place += double(waves.bed[i + 1]) * part.along;
      if (asked.gradients) part.bend = beside.gradient([&](const BedTexel& texel) { return texel.bed[i + 1]; });
    }
    here.parts.push_back(part);
  }
}

void PlaceSea::add_shore(Here& here, const WaveField::Filter& filter, const Asked& asked, Readers& readers) const {
  const PlaceReading at = reading(asked);
  ShorePart part{shore_place((*readers.shore)(at, asked.rest), shore_->period_m(), at.read.present), filter};
  part.share = double(part.at.share);
  if (asked.gradients) {
    part.share_gradient =
        around(*readers.shore, at, asked.rest).gradient([](const ShoreTexel& texel) { return texel.line.w; });
    part.at.turning_per_m = shore_->at(asked.rest, asked.footprint_m).turning_per_m;
  }
  if (part.share != 0.0) here.shore.push_back(part);
}

// Two of each pattern, which the current has brought from elsewhere.
void PlaceSea::add_current(const WaveField& field, Here& here, const Asked& asked, Readers& readers) const {
  const glm::dvec2 velocity((*readers.flow)(reading(asked), asked.rest));
  const double period = settings_.flow_period_s;
  const FlowPhase phase = flow_phase(readers.time_s, period);
  const std::size_t count = here.parts.size();
  for (std::size_t n = 0; n < count; ++n) {
    Part second = here.parts[n];
    Part& first = here.parts[n];
    first.place -= velocity * phase.first_s;
    second.place -= velocity * phase.second_s;
    for (std::size_t i = 0; i < field.places().size(); ++i) {
      const WaveField::Place& place = field.places()[i];
      const double height =
          gpu::flow_height(place.longest_m, place.shortest_m, glm::length(velocity) * 0.5 * period, phase.first);
      first.filter.share[i] *= float(height * phase.first);
      second.filter.share[i] *= float(height * (1.0 - phase.first));
    }
    here.parts.push_back(second);
  }
  for (std::size_t n = 0, all = here.shore.size(); n < all; ++n) {
    const auto [first, second] = here.shore[n].carried(field, velocity, phase);
    here.shore[n] = first;
    here.shore.push_back(second);
  }
}

SeaSample PlaceSea::sea(const WaveField& field, const WaveTiles& tiles, glm::dvec2 rest, double footprint,
                        const LodPlacement* seen, const DynamicSurface* dynamic, const ClipVolumes* volumes) const {
  Readers readers(*this, seconds(tiles), dynamic, volumes);
  return sea(field, tiles, {rest, footprint, seen, true}, readers);
}

SeaSample PlaceSea::sea(const WaveField& field, const WaveTiles& tiles, const Asked& asked, Readers& readers) const {
  const Here here = this->here(field, field.filter(asked.footprint_m), asked, readers);
  SeaSample result;
  result.height_gradient = here.level_gradient;
  result.displacement.y = here.level_m;
  for (const Part& part : here.parts) {
    const SeaSample s = field.sea(tiles, part.place, part.filter);
    result.displacement += glm::dvec3(part.share, part.lift, part.share) * s.displacement;
    // A pattern's phase is bent by what its shift changes by; along x and z its shift's two halves of shear then
    // differ, and have their mean.
    const auto bent = [&](glm::dvec2 gradient) { return gradient + glm::dot(gradient, part.along) * part.bend; };
    const glm::dvec3& d = s.shift_gradient;
    const glm::dvec2 of_x = bent({d.x, d.z}), of_z = bent({d.z, d.y});
    result.height_gradient += part.lift * bent(s.height_gradient) + s.displacement.y * part.lift_gradient;
    result.shift_gradient += part.share * glm::dvec3(of_x.x, of_z.y, 0.5 * (of_x.y + of_z.x));
  }
  for (const ShorePart& part : here.shore) part.add(field, tiles, result);
  result.displacement += here.dynamic.displacement;
  result.height_gradient += here.dynamic.height_gradient;
  result.shift_gradient += here.dynamic.shift_gradient;
  if (!shallows_) return result;
  result.displacement.x *= here.wet;
  result.displacement.z *= here.wet;
  result.shift_gradient *= here.wet;
  if (result.displacement.y < here.bed_m) {
    result.displacement.y = here.bed_m;
    result.height_gradient = here.bed_gradient;
  }
  const glm::dvec3 point = glm::dvec3(here.rest.x, 0.0, here.rest.y) + result.displacement;
  if (!clipped(point, here.flat_clipped, readers.volumes)) return result;
  result = {};
  result.displacement.y = here.bed_m;
  result.height_gradient = here.bed_gradient;
  return result;
}

}  // namespace seascape
