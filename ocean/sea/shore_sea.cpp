#include "ocean/sea/shore_sea.h"

#include <cmath>

#include "shaders/shared/flow_height.h"

namespace seascape {

glm::dvec3 ShorePart::turned(const glm::dvec3& d) const {
  const glm::dvec2 level = d.x * at.forward + d.z * at.right();
  return {level.x, d.y, level.y};
}

void ShorePart::add(const WaveField& field, const WaveTiles& tiles, SeaSample& to) const {
  const SeaSample s = field.sea_curved(tiles, at.bent_m, filter);
  const glm::dvec3 d = turned(s.displacement);
  to.displacement += share * d;
  to.divergence_moment += share * share * s.divergence_moment;
  // Where x and z of the pattern grow.
  const glm::dvec2 along = double(at.stretch) * at.forward, across = at.right();
  to.height_gradient +=
      share * (s.height_gradient.x * along + s.height_gradient.y * across) + s.displacement.y * share_gradient;
  // D = share (Dx forward + Dz right); forward turns by `turning_per_m` to the right, right as much against forward.
  const glm::dvec2 shift(d.x, d.z),
      of_forward =
          s.shift_gradient.x * along + s.shift_gradient.z * across - s.displacement.z * at.turning_per_m * at.forward,
      of_right =
          s.shift_gradient.z * along + s.shift_gradient.y * across + s.displacement.x * at.turning_per_m * at.forward;
  const auto part = [&](int of, int by) {
    return share * (at.forward[of] * of_forward[by] + across[of] * of_right[by]) + shift[of] * share_gradient[by];
  };
  to.shift_gradient += glm::dvec3(part(0, 0), part(1, 1), 0.5 * (part(0, 1) + part(1, 0)));
}

std::array<ShorePart, 2> ShorePart::carried(const WaveField& field, glm::dvec2 velocity, const FlowPhase& phase) const {
  const glm::dvec2 bent(double(at.stretch) * glm::dot(velocity, at.forward), glm::dot(velocity, at.right()));
  const WaveField::Place& place = field.curved_place();
  const double height = gpu::flow_height(place.longest_m, place.shortest_m,
                                         glm::length(bent) * std::abs(phase.second_s - phase.first_s), phase.first);
  const auto part = [&](double way_s, double counts) {
    ShorePart result = *this;
    result.at.bent_m -= way_s * bent;
    result.share *= counts;
    result.share_gradient *= counts;
    return result;
  };
  return {part(phase.first_s, height * phase.first), part(phase.second_s, height * (1.0 - phase.first))};
}

}  // namespace seascape
