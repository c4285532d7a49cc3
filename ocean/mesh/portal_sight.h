// What eyes may see through a frame's portals. Pure.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

#include "shaders/shared/frame_data.h"

namespace seascape {

// A cone around each portal from each eye before which it is. Places are in metres relative to the viewer.
class PortalSight {
 public:
  // A portal in the ball `middle`, `radius_m`, before an eye at `eye`. At most gpu::most_portals for each of two eyes.
  void add(const glm::dvec3& eye, const glm::dvec3& middle, double radius_m) {
    const glm::dvec3 to = middle - eye;
    const double far_m = glm::length(to);
    if (far_m <= radius_m || count_ == cones_.size()) {
      all_ = true;
      return;
    }
    const double sine = radius_m / far_m;
    cones_[count_++] = {eye, to / far_m, sine, std::sqrt(1.0 - sine * sine)};
  }
  // Whether any portal is before an eye.
  bool any() const { return all_ || count_ > 0; }
  // Whether something in a ball may be seen through one.
  bool may_show(const glm::dvec3& middle, double radius_m) const {
    return all_ || std::any_of(cones_.begin(), cones_.begin() + std::ptrdiff_t(count_), [&](const Cone& cone) {
             const glm::dvec3 off = middle - cone.apex;
             const double along = glm::dot(off, cone.axis),
                          across = std::sqrt(std::max(glm::dot(off, off) - along * along, 0.0));
             return across * cone.cosine - along * cone.sine <= radius_m;  // how far outside the cone's side
           });
  }

 private:
  struct Cone {
    glm::dvec3 apex, axis;
    double sine, cosine;  // of half its angle
  };
  std::array<Cone, 2 * gpu::most_portals> cones_{};
  std::size_t count_ = 0;
  bool all_ = false;  // an eye is in one, or there are too many
};

}  // namespace seascape
