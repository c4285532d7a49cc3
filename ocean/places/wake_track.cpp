#include "ocean/places/wake_track.h"

namespace seascape {

void WakeTrack::go_to(const glm::dvec2& at, double piece_m, double longest_m) {
  if (places_.empty()) begin(at);
  now_ = at;
  if (glm::distance(at, places_.back()) < piece_m) return;
  places_.push_back(at);
  // Pieces are no shorter than piece_m.
  while (double(places_.size()) > longest_m / piece_m + 2.0) places_.pop_front();
}

glm::dvec2 WakeTrack::behind(double way) const {
  glm::dvec2 from = now_;
  for (auto at = places_.rbegin(); at != places_.rend(); ++at) {
    const double piece = glm::distance(from, *at);
    if (way < piece) return glm::mix(from, *at, way / piece);
    way -= piece;
    from = *at;
  }
  return from;
}

double WakeTrack::length_m() const {
  double sum = 0.0;
  glm::dvec2 from = now_;
  for (auto at = places_.rbegin(); at != places_.rend(); ++at) sum += glm::distance(from, *at), from = *at;
  return sum;
}

}  // namespace seascape
