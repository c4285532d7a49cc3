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

PlaceSea::PlaceSea(PlaceInputs inputs)
    : inputs_(std::move(inputs)), level_(find(InputTarget::level)), flow_(find(InputTarget::flow)), clip_(find(InputTarget::clip)) {
  validate(inputs_.settings);
}

const Inputs* PlaceSea::find(InputTarget kind) const {
  for (const auto& inputs : inputs_.kinds)
    if (inputs->target() == kind) return inputs.get();
  return nullptr;
}

double PlaceSea::level_m(glm::dvec2 rest, double footprint, double time) const {
  return level_ == nullptr ? 0.0 : double(level_->value(rest, footprint, place_time_s(inputs_.settings, *level_, time), place_outside(inputs_.settings, InputTarget::level)).x);
}

glm::dvec2 PlaceSea::flow_mps(glm::dvec2 rest, double footprint, double time) const {
  return flow_ == nullptr ? glm::dvec2(0.0) : glm::dvec2(flow_->value(rest, footprint, place_time_s(inputs_.settings, *flow_, time), place_outside(inputs_.settings, InputTarget::flow)));
}

bool PlaceSea::clipped(glm::dvec2 place, double time) const {
  return clip_ != nullptr && clip_->value(place, 0.0, place_time_s(inputs_.settings, *clip_, time), place_outside(inputs_.settings, InputTarget::clip)).x > 0.5f;
}

PlaceSea::Carried PlaceSea::carried(const WaveField& field, const WaveField::Filter& filter, glm::dvec2 rest, double footprint, double time) const {
  Carried result{rest, rest, filter, filter, false};
  if (flow_ == nullptr) return result;
  const glm::dvec2 velocity = flow_mps(rest, footprint, time);
  const double period = inputs_.settings.flow_period_s;
  const FlowPhase phase = flow_phase(time, period);
  result.first = rest - velocity * phase.first_s;
  result.second = rest - velocity * phase.second_s;
  result.two = true;
  for (std::size_t i = 0; i < field.places().size(); ++i) {
    const WaveField::Place& place = field.places()[i];
    const double height = flow_height(place.longest_m, place.shortest_m, glm::length(velocity) * 0.5 * period, phase.first);
    result.of_first.share[i] *= float(height * phase.first);
    result.of_second.share[i] *= float(height * (1.0 - phase.first));
  }
  return result;
}

SeaSample PlaceSea::sea(const WaveField& field, const WaveTiles& tiles, glm::dvec2 rest, double footprint) const {
  const double time = seconds(tiles);
  const Carried c = carried(field, field.filter(footprint), rest, footprint, time);
  SeaSample result = field.sea(tiles, c.first, c.of_first);
  if (c.two) {
    const SeaSample second = field.sea(tiles, c.second, c.of_second);
    result.displacement += second.displacement;
    result.height_gradient += second.height_gradient;
    result.shift_gradient += second.shift_gradient;
  }
  result.slope_moments = glm::dvec3(0.0);
  result.divergence_moment = 0.0;
  if (level_ == nullptr) return result;
  result.displacement.y += level_m(rest, footprint, time);
  const double e = std::max(gradient_m, 0.5 * footprint);
  const auto slope = [&](glm::dvec2 way) { return (level_m(rest + e * way, footprint, time) - level_m(rest - e * way, footprint, time)) / (2.0 * e); };
  result.height_gradient += glm::dvec2(slope({1.0, 0.0}), slope({0.0, 1.0}));
  return result;
}

QueryAnswer PlaceSea::answer(const WaveField& field, const WaveTiles& tiles, const WaveField::Filter& filter, glm::dvec2 place, const QueryOptions& options) const {
  QueryAnswer answer;
  if (!std::isfinite(place.x + place.y)) return answer;
  const double time = seconds(tiles), footprint = options.footprint_m;
  const auto moved = [&](glm::dvec2 rest) {
    const Carried c = carried(field, filter, rest, footprint, time);
    glm::dvec3 d = field.displacement(tiles, c.first, c.of_first);
    if (c.two) d += field.displacement(tiles, c.second, c.of_second);
    return d;
  };
  glm::dvec2 rest = place, nearest = place;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= options.most_iterations; ++i) {
    const glm::dvec3 d = moved(rest);
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
  if (tiles.has_velocity()) {
    const Carried c = carried(field, filter, nearest, footprint, time);
    glm::dvec3 v = field.velocity(tiles, c.first, c.of_first);
    if (c.two) v += field.velocity(tiles, c.second, c.of_second);
    const glm::dvec2 flow = flow_mps(nearest, footprint, time);
    answer.orbital_velocity_mps = v + glm::dvec3(flow.x, flow.x * s.height_gradient.x + flow.y * s.height_gradient.y, flow.y);
    answer.eulerian_velocity_mps = answer.orbital_velocity_mps.y - answer.orbital_velocity_mps.x * slope.x - answer.orbital_velocity_mps.z * slope.y;
  }
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
