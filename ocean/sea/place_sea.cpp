#include "ocean/sea/place_sea.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "ocean/places/flow_phase.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {
double seconds(const WaveTiles& tiles) { return double(tiles.ticks()) / double(gpu::ticks_per_second); }
}  // namespace

double flow_height(double longest_m, double shortest_m, double way_m, double first) {
  const double way = 2.0 * std::numbers::pi / std::sqrt(longest_m * shortest_m) * way_m, second = 1.0 - first;
  return 1.0 / std::sqrt(first * first + second * second + 2.0 * first * second * std::exp(-0.5 * way * way));
}

PlaceSea::PlaceSea(PlaceInputs inputs, const WaveField& field)
    : PlaceSea(inputs, field,
               ShallowsMix{make_shallows(field.state(), field.bins(), field.others(), inputs), nullptr}) {}

PlaceSea::PlaceSea(PlaceInputs inputs, const WaveField& field, ShallowsMix shallows)
    : settings_(inputs.settings), volumes_(inputs.volumes), shore_(field.has_curved() ? inputs.shore : nullptr) {
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
}

PlaceSea::Readers::Readers(const PlaceSea& sea, double time, const DynamicSurface* waves)
    : flow_time_s(time), dynamic(waves) {
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

bool PlaceSea::clipped(glm::dvec3 point, double time) const {
  Readers readers(*this, time, nullptr);
  return clipped(point, readers);
}

bool PlaceSea::clipped(glm::dvec3 point, Readers& readers) const {
  if (!clips() || !std::isfinite(point.x + point.z)) return false;
  const glm::dvec2 place(point.x, point.z);
  const bool flat = readers.clip && (*readers.clip)(reading({place, 0.0, nullptr, false}), place).x > 0.5f;
  return volumes_ == nullptr ? flat : volumes_->clipped(point, flat);
}

bool PlaceSea::dry(const Here& here, glm::dvec3 d) const {
  if (!shallows_) return false;
  return volumes_ == nullptr ? here.flat_clipped
                             : volumes_->clipped({here.rest.x + d.x, d.y, here.rest.y + d.z}, here.flat_clipped);
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
  result.parts.push_back({asked.rest, filter});
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
  const WaveField::Filter all = here.parts.front().filter;
  here.parts.clear();
  for (int i = 0; i <= cascades; ++i) {
    if (i == cascades && field.places().size() == std::size_t(cascades)) break;
    Part part{asked.rest, all};
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
  const FlowPhase phase = flow_phase(readers.flow_time_s, period);
  const std::size_t count = here.parts.size();
  for (std::size_t n = 0; n < count; ++n) {
    Part second = here.parts[n];
    Part& first = here.parts[n];
    first.place -= velocity * phase.first_s;
    second.place -= velocity * phase.second_s;
    for (std::size_t i = 0; i < field.places().size(); ++i) {
      const WaveField::Place& place = field.places()[i];
      const double height =
          flow_height(place.longest_m, place.shortest_m, glm::length(velocity) * 0.5 * period, phase.first);
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

glm::dvec3 PlaceSea::displacement(const WaveField& field, const WaveTiles& tiles, const Here& here) const {
  glm::dvec3 sum(0.0, here.level_m, 0.0);
  for (const Part& part : here.parts)
    sum += glm::dvec3(part.share, part.lift, part.share) * field.displacement(tiles, part.place, part.filter);
  for (const ShorePart& part : here.shore) sum += part.displacement(field, tiles);
  sum += here.dynamic.displacement;
  if (!shallows_) return sum;
  sum = {here.wet * sum.x, std::max(sum.y, here.bed_m), here.wet * sum.z};
  return dry(here, sum) ? glm::dvec3(0.0, here.bed_m, 0.0) : sum;
}

SeaSample PlaceSea::sea(const WaveField& field, const WaveTiles& tiles, glm::dvec2 rest, double footprint,
                        const LodPlacement* seen, const DynamicSurface* dynamic) const {
  Readers readers(*this, seconds(tiles), dynamic);
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
  if (!dry(here, result.displacement)) return result;
  result = {};
  result.displacement.y = here.bed_m;
  result.height_gradient = here.bed_gradient;
  return result;
}

QueryAnswer PlaceSea::answer(const WaveField& field, const WaveTiles& tiles, const WaveField::Filter& filter,
                             glm::dvec2 place, const QueryOptions& options, Readers& readers) const {
  QueryAnswer answer;
  answer.depth_m = field.state().depth_m;
  if (!std::isfinite(place.x + place.y)) return answer;
  const double footprint = options.footprint_m;
  glm::dvec2 rest = place, nearest = place;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= options.most_iterations; ++i) {
    const glm::dvec3 d = displacement(field, tiles, here(field, filter, {rest, footprint, nullptr, false}, readers));
    const double residual = glm::length(rest + glm::dvec2(d.x, d.z) - place);
    if (residual < least) least = residual, nearest = rest;
    answer.iterations = i;
    if (residual <= options.tolerance_m) break;
    rest = place - glm::dvec2(d.x, d.z);
  }
  const SeaSample s = sea(field, tiles, {nearest, footprint, nullptr, true}, readers);
  const glm::dvec2 slope = s.slope(), missed = place - nearest - glm::dvec2(s.displacement.x, s.displacement.z);
  answer.displacement = s.displacement;
  answer.residual_m = least;
  // Over the residual along the slope, by at most the residual.
  answer.height_m = s.displacement.y + std::clamp(glm::dot(slope, missed), -least, least);
  answer.normal = glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
  const double half = 0.5 * (s.shift_gradient.x - s.shift_gradient.y),
               middle = 0.5 * (s.shift_gradient.x + s.shift_gradient.y);
  answer.contraction = std::abs(middle) + std::hypot(half, s.shift_gradient.z);
  answer.converged = least <= options.tolerance_m && s.jacobian() > 0.0;
  add_velocity(field, tiles, {nearest, footprint, nullptr, false}, filter, s, readers, answer);
  return answer;
}

void PlaceSea::add_velocity(const WaveField& field, const WaveTiles& tiles, const Asked& found,
                            const WaveField::Filter& filter, const SeaSample& surface, Readers& readers,
                            QueryAnswer& answer) const {
  const Here there = here(field, filter, found, readers);
  if (readers.flow) answer.flow_mps = glm::dvec2((*readers.flow)(reading(found), found.rest));
  answer.still_m = there.level_m;
  if (shallows_) answer.depth_m = there.level_m - there.bed_m;
  if (!tiles.has_velocity()) return;
  if (shallows_ && surface.displacement.y <= there.bed_m) return;  // land stands still
  glm::dvec3 water(0.0);
  for (const Part& part : there.parts)
    water += glm::dvec3(there.wet * part.share, part.lift, there.wet * part.share) *
             field.velocity(tiles, part.place, part.filter);
  for (const ShorePart& part : there.shore)
    water += glm::dvec3(there.wet, 1.0, there.wet) * part.velocity(field, tiles);
  // How the surface moves at a fixed rest position: as its waves do, and as the current carries their patterns and lets
  // one pass into the next, by differences of the patterns' places at this moment's waves.
  glm::dvec3 surface_moves = water;
  if (readers.flow) {
    constexpr double apart_s = 1e-3;
    const double now_s = readers.flow_time_s;
    readers.flow_time_s = now_s + apart_s;
    const glm::dvec3 later = displacement(field, tiles, here(field, filter, found, readers));
    readers.flow_time_s = now_s - apart_s;
    const glm::dvec3 earlier = displacement(field, tiles, here(field, filter, found, readers));
    readers.flow_time_s = now_s;
    surface_moves += (later - earlier) / (2.0 * apart_s);
  }
  const glm::dvec2 slope = surface.slope();
  const double rises = surface_moves.y - surface_moves.x * slope.x - surface_moves.z * slope.y;
  // The water goes along with the current, and up and down with the surface.
  const glm::dvec2 along = glm::dvec2(water.x, water.z) + answer.flow_mps;
  answer.eulerian_velocity_mps = rises;
  answer.orbital_velocity_mps = {along.x, readers.flow ? rises + glm::dot(along, slope) : water.y, along.y};
}

void PlaceSea::query(const WaveField& field, const WaveTiles& tiles, std::span<const glm::dvec2> places,
                     std::span<QueryAnswer> answers, const QueryOptions& options, const DynamicSurface* dynamic) const {
  assert(places.size() == answers.size());
  const double time_s = seconds(tiles);
  const bool waves_alone = !moves() && dynamic == nullptr;
  if (waves_alone) {
    seascape::query(field, tiles, places, answers, options);
    for (QueryAnswer& answer : answers) answer.depth_m = field.state().depth_m;
    if (!clips()) return;
  }
  const WaveField::Filter filter = field.filter(options.footprint_m);
  constexpr std::size_t block = 64;
  tbb::parallel_for(std::size_t(0), (places.size() + block - 1) / block, [&](std::size_t n) {
    Readers readers(*this, time_s, dynamic);
    for (std::size_t i = n * block; i < std::min(places.size(), (n + 1) * block); ++i) {
      if (!waves_alone) answers[i] = answer(field, tiles, filter, places[i], options, readers);
      if (clips()) answers[i].clipped = clipped({places[i].x, answers[i].height_m, places[i].y}, readers);
    }
  });
}

}  // namespace seascape
