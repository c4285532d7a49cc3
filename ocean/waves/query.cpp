#include "ocean/waves/query.h"

#include <cassert>

#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {
QueryAnswer answer_at(const WaveField& field, const WaveTiles& tiles, glm::dvec2 place, const QueryOptions& options,
                      const WaveField::Filter& filter) {
  QueryAnswer answer;
  glm::dvec2 rest = place;
  for (; answer.iterations < options.most_iterations; ++answer.iterations) {
    const glm::dvec3 d = field.displacement(tiles, rest, filter);
    const glm::dvec2 next = place - glm::dvec2(d.x, d.z);
    const double step = glm::length(next - rest);
    rest = next;
    if (step <= 0.25 * options.tolerance_m) {
      ++answer.iterations;
      break;
    }
  }
  const SeaSample sample = field.sea(tiles, rest, filter);
  answer.displacement = sample.displacement;
  answer.height_m = sample.displacement.y;
  answer.residual_m = glm::length(rest + glm::dvec2(sample.displacement.x, sample.displacement.z) - place);
  const double jacobian = sample.jacobian();
  answer.converged = answer.residual_m <= options.tolerance_m && jacobian > 0.0;
  const glm::dvec2 slope = sample.slope();
  answer.normal = glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
  if (tiles.has_velocity()) answer.velocity_mps = field.velocity(tiles, rest, filter);
  return answer;
}
}  // namespace

void query(const WaveField& field, const WaveTiles& tiles, std::span<const glm::dvec2> places, std::span<QueryAnswer> answers,
           const QueryOptions& options) {
  assert(places.size() == answers.size());
  const WaveField::Filter filter = field.filter(options.footprint_m);
  for (std::size_t i = 0; i < places.size(); ++i) answers[i] = answer_at(field, tiles, places[i], options, filter);
}

}  // namespace seascape
