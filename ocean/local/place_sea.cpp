#include "ocean/local/place_sea.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "ocean/local/flow_phase.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {
constexpr double gradient_m = 0.25;  // a level's slope is taken over it to either side

double seconds(const WaveTiles& tiles) { return double(tiles.ticks()) / double(gpu::ticks_per_second); }
}  // namespace

double flow_height(double longest_m, double shortest_m, double way_m, double first) {
  const double way = 2.0 * std::numbers::pi / std::sqrt(longest_m * shortest_m) * way_m, second = 1.0 - first;
  return 1.0 / std::sqrt(first * first + second * second + 2.0 * first * second * std::exp(-0.5 * way * way));
}

PlaceSea::PlaceSea(PlaceInputs inputs, const WaveField& field) : PlaceSea(inputs, ShallowsMix{make_shallows(field.state(), field.bins(), field.others(), inputs), nullptr}) {}

PlaceSea::PlaceSea(PlaceInputs inputs, ShallowsMix shallows)
    : inputs_(std::move(inputs)), level_(inputs_.of(InputTarget::level)), flow_(inputs_.of(InputTarget::flow)), clip_(inputs_.of(InputTarget::clip)), shallows_(std::move(shallows)) {
  validate(inputs_.settings);
}

double PlaceSea::level_m(glm::dvec2 rest, double footprint, double time) const {
  return level_ == nullptr ? 0.0 : double(level_->value(rest, footprint, place_time_s(inputs_.settings, level_->still(), time), place_outside(inputs_.settings, InputTarget::level)).x);
}

glm::dvec2 PlaceSea::flow_mps(glm::dvec2 rest, double footprint, double time) const {
  return flow_ == nullptr ? glm::dvec2(0.0) : glm::dvec2(flow_->value(rest, footprint, place_time_s(inputs_.settings, flow_->still(), time), place_outside(inputs_.settings, InputTarget::flow)));
}

bool PlaceSea::clipped(glm::dvec2 flat_m, glm::dvec3 point, double time) const {
  if (clip_ == nullptr && inputs_.volumes == nullptr) return false;
  const glm::vec4 outside = place_outside(inputs_.settings, InputTarget::clip);
  const bool flat = (clip_ == nullptr ? outside : clip_->value(flat_m, 0.0, place_time_s(inputs_.settings, clip_->still(), time), outside)).x > 0.5f;
  return inputs_.volumes == nullptr ? flat : inputs_.volumes->clipped(point, flat);
}

bool PlaceSea::dry(const Here& here, glm::dvec3 d, double time) const {
  return shallows_ && clipped(here.rest, {here.rest.x + d.x, d.y, here.rest.y + d.z}, time);
}

namespace {
// d f / d x and d f / d z of what lies at a place, over `e` to either side.
template <class Value>
glm::dvec2 gradient(const Value& value, glm::dvec2 at, double e) {
  return glm::dvec2(value(at + glm::dvec2(e, 0.0)) - value(at - glm::dvec2(e, 0.0)), value(at + glm::dvec2(0.0, e)) - value(at - glm::dvec2(0.0, e))) / (2.0 * e);
}

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Of a cascade, or of the other sources from the number of cascades on.
double lifted(const PlaceWaves& waves, int cascade, int cascades) {
  if (cascade >= cascades) return double(waves.others);
  const double share = double(waves.share[std::size_t(cascade)]);
  return cascade < Shallows::swash_cascades ? std::hypot(share, double(waves.swash)) : share;
}
}  // namespace

PlaceSea::Here PlaceSea::here(const WaveField& field, const WaveField::Filter& filter, glm::dvec2 rest, double footprint, double time, bool gradients) const {
  Here result;
  result.rest = rest;
  result.parts.push_back({rest, filter});
  result.level_m = level_m(rest, footprint, time);
  const double e = std::max(gradient_m, 0.5 * footprint);
  if (gradients && level_ != nullptr) result.level_gradient = gradient([&](glm::dvec2 at) { return level_m(at, footprint, time); }, rest, e);
  if (shallows_) add_shallows(field, result, rest, footprint, time, gradients);
  if (flow_ != nullptr) add_current(field, result, rest, footprint, time);
  return result;
}

// A pattern for each cascade and one for all that is no cascade, for each counts for something else.
void PlaceSea::add_shallows(const WaveField& field, Here& here, glm::dvec2 rest, double footprint, double time, bool gradients) const {
  const auto bed = [&](glm::dvec2 at) { return shallows_.bed_m(at, footprint, time); };
  const auto waves_at = [&](glm::dvec2 at) { return shallows_.waves(at, level_m(at, footprint, time) - bed(at)); };
  const double e = std::max(gradient_m, 0.5 * footprint);
  here.bed_m = bed(rest);
  here.wet = smoothstep(gpu::dry_depth_m, gpu::wet_depth_m, here.level_m - here.bed_m);
  const PlaceWaves waves = waves_at(rest);
  std::array<PlaceWaves, 4> around;
  if (gradients) {
    here.bed_gradient = gradient(bed, rest, e);
    around = {waves_at(rest + glm::dvec2(e, 0.0)), waves_at(rest - glm::dvec2(e, 0.0)), waves_at(rest + glm::dvec2(0.0, e)), waves_at(rest - glm::dvec2(0.0, e))};
  }
  const int cascades = field.quality().cascades;
  const WaveField::Filter all = here.parts.front().filter;
  here.parts.clear();
  for (int i = 0; i <= cascades; ++i) {
    if (i == cascades && field.places().size() == std::size_t(cascades)) break;
    Part part{rest, all};
    for (std::size_t place = 0; place < field.places().size(); ++place)
      if (std::min(int(place), cascades) != i) part.filter.share[place] = 0.0f;
    part.share = i < cascades ? double(waves.share[std::size_t(i)]) : double(waves.others);
    part.lift = lifted(waves, i, cascades);
    const auto slope = [&](const auto& value) { return glm::dvec2(value(around[0]) - value(around[1]), value(around[2]) - value(around[3])) / (2.0 * e); };
    if (gradients) part.lift_gradient = slope([&](const PlaceWaves& w) { return lifted(w, i, cascades); });
    if (i < std::min(Refraction::bent_cascades, cascades)) {
      part.along = shallows_.direction(i);
      part.place += double(waves.shift_m[std::size_t(i)]) * part.along;
      if (gradients) part.bend = slope([&](const PlaceWaves& w) { return double(w.shift_m[std::size_t(i)]); });
    }
    here.parts.push_back(part);
  }
}

// Two of each pattern, which the current has brought from elsewhere.
void PlaceSea::add_current(const WaveField& field, Here& here, glm::dvec2 rest, double footprint, double time) const {
  const glm::dvec2 velocity = flow_mps(rest, footprint, time);
  const double period = inputs_.settings.flow_period_s;
  const FlowPhase phase = flow_phase(time, period);
  const std::size_t count = here.parts.size();
  for (std::size_t n = 0; n < count; ++n) {
    Part second = here.parts[n];
    Part& first = here.parts[n];
    first.place -= velocity * phase.first_s;
    second.place -= velocity * phase.second_s;
    for (std::size_t i = 0; i < field.places().size(); ++i) {
      const WaveField::Place& place = field.places()[i];
      const double height = flow_height(place.longest_m, place.shortest_m, glm::length(velocity) * 0.5 * period, phase.first);
      first.filter.share[i] *= float(height * phase.first);
      second.filter.share[i] *= float(height * (1.0 - phase.first));
    }
    here.parts.push_back(second);
  }
}

glm::dvec3 PlaceSea::displacement(const WaveField& field, const WaveTiles& tiles, const Here& here) const {
  glm::dvec3 sum(0.0, here.level_m, 0.0);
  for (const Part& part : here.parts) sum += glm::dvec3(part.share, part.lift, part.share) * field.displacement(tiles, part.place, part.filter);
  if (!shallows_) return sum;
  sum = {here.wet * sum.x, std::max(sum.y, here.bed_m), here.wet * sum.z};
  return dry(here, sum, seconds(tiles)) ? glm::dvec3(0.0, here.bed_m, 0.0) : sum;
}

SeaSample PlaceSea::sea(const WaveField& field, const WaveTiles& tiles, glm::dvec2 rest, double footprint) const {
  const Here here = this->here(field, field.filter(footprint), rest, footprint, seconds(tiles), true);
  SeaSample result;
  result.height_gradient = here.level_gradient;
  result.displacement.y = here.level_m;
  for (const Part& part : here.parts) {
    const SeaSample s = field.sea(tiles, part.place, part.filter);
    result.displacement += glm::dvec3(part.share, part.lift, part.share) * s.displacement;
    // A pattern's phase is bent by what its shift changes by; along x and z its shift's two halves of shear then differ, and have their mean.
    const auto bent = [&](glm::dvec2 gradient) { return gradient + glm::dot(gradient, part.along) * part.bend; };
    const glm::dvec3& d = s.shift_gradient;
    const glm::dvec2 of_x = bent({d.x, d.z}), of_z = bent({d.z, d.y});
    result.height_gradient += part.lift * bent(s.height_gradient) + s.displacement.y * part.lift_gradient;
    result.shift_gradient += part.share * glm::dvec3(of_x.x, of_z.y, 0.5 * (of_x.y + of_z.x));
  }
  if (!shallows_) return result;
  result.displacement.x *= here.wet;
  result.displacement.z *= here.wet;
  result.shift_gradient *= here.wet;
  if (result.displacement.y < here.bed_m) {
    result.displacement.y = here.bed_m;
    result.height_gradient = here.bed_gradient;
  }
  if (!dry(here, result.displacement, seconds(tiles))) return result;
  result = {};
  result.displacement.y = here.bed_m;
  result.height_gradient = here.bed_gradient;
  return result;
}

QueryAnswer PlaceSea::answer(const WaveField& field, const WaveTiles& tiles, const WaveField::Filter& filter, glm::dvec2 place, const QueryOptions& options) const {
  QueryAnswer answer;
  if (!std::isfinite(place.x + place.y)) return answer;
  const double time = seconds(tiles), footprint = options.footprint_m;
  glm::dvec2 rest = place, nearest = place;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= options.most_iterations; ++i) {
    const glm::dvec3 d = displacement(field, tiles, here(field, filter, rest, footprint, time, false));
    const double residual = glm::length(rest + glm::dvec2(d.x, d.z) - place);
    if (residual < least) least = residual, nearest = rest;
    answer.iterations = i;
    if (residual <= options.tolerance_m) break;
    rest = place - glm::dvec2(d.x, d.z);
  }
  const SeaSample s = sea(field, tiles, nearest, footprint);
  const glm::dvec2 slope = s.slope(), missed = place - nearest - glm::dvec2(s.displacement.x, s.displacement.z);
  answer.displacement = s.displacement;
  answer.residual_m = least;
  // Over the residual along the slope, by at most the residual.
  answer.height_m = s.displacement.y + std::clamp(glm::dot(slope, missed), -least, least);
  answer.normal = glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
  const double half = 0.5 * (s.shift_gradient.x - s.shift_gradient.y), middle = 0.5 * (s.shift_gradient.x + s.shift_gradient.y);
  answer.contraction = std::abs(middle) + std::hypot(half, s.shift_gradient.z);
  answer.converged = least <= options.tolerance_m && s.jacobian() > 0.0;
  if (!tiles.has_velocity()) return answer;
  const Here there = here(field, filter, nearest, footprint, time, false);
  if (shallows_ && s.displacement.y <= there.bed_m) return answer;  // land stands still
  glm::dvec3 v(0.0);
  for (const Part& part : there.parts) v += glm::dvec3(there.wet * part.share, part.lift, there.wet * part.share) * field.velocity(tiles, part.place, part.filter);
  const glm::dvec2 flow = flow_mps(nearest, footprint, time);
  answer.orbital_velocity_mps = v + glm::dvec3(flow.x, flow.x * s.height_gradient.x + flow.y * s.height_gradient.y, flow.y);
  answer.eulerian_velocity_mps = answer.orbital_velocity_mps.y - answer.orbital_velocity_mps.x * slope.x - answer.orbital_velocity_mps.z * slope.y;
  return answer;
}

void PlaceSea::query(const WaveField& field, const WaveTiles& tiles, std::span<const glm::dvec2> places, std::span<QueryAnswer> answers, const QueryOptions& options) const {
  assert(places.size() == answers.size());
  if (!moves()) return seascape::query(field, tiles, places, answers, options);
  const WaveField::Filter filter = field.filter(options.footprint_m);
  constexpr std::size_t block = 64;
  tbb::parallel_for(std::size_t(0), (places.size() + block - 1) / block, [&](std::size_t n) {
    for (std::size_t i = n * block; i < std::min(places.size(), (n + 1) * block); ++i) answers[i] = answer(field, tiles, filter, places[i], options);
  });
}

}  // namespace seascape
