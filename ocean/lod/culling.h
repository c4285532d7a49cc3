// Decides what at least one of several eyes may see: bounds against the union of their frusta, without a far plane.
#pragma once
#include <array>
#include <vector>

#include "engine/view.h"

namespace seascape {

class EyeFrusta {
 public:
  // Takes the eyes' poses (unit quaternions) and fields of view; positions below are relative to `origin_m`, world axes.
  // No eyes: everything counts as seen. No allocation once as many eyes have been set before.
  void set(const std::vector<View>& eyes, const glm::dvec3& origin_m);

  // False only if no eye can see any point of the box (`half_m`: half its sides).
  bool may_see_box(const glm::dvec3& centre_m, const glm::dvec3& half_m) const;

  // The same for the upright prism over the convex hull of four points (x, z), grown by `grow_m` to every side, between
  // the heights `low_m` and `high_m`.
  bool may_see_prism(const std::array<glm::dvec2, 4>& corners_m, double grow_m, double low_m, double high_m) const;

 private:
  // dot(normal, p) + offset >= 0 on the seen side. Left, right, up, down, and the plane through the eye: the near plane's
  // distance belongs to the drawing, and zero is on the safe side of it.
  struct Plane {
    glm::dvec3 normal;
    double offset;
  };
  static constexpr std::size_t planes_per_eye = 5;
  // The eye and, per axis, whether its corner rays all go up or all go down along it: then nothing beyond the eye on the
  // other side is seen. The planes alone let through boxes beside and behind the eye; these axes complete the separating
  // axes in the plane of the sea.
  struct Eye {
    std::array<Plane, planes_per_eye> planes;
    glm::dvec3 position;
    glm::bvec3 all_up, all_down;
    bool may_see_span(const glm::dvec3& low, const glm::dvec3& high) const;
  };
  std::vector<Eye> eyes_;
};

}  // namespace seascape
