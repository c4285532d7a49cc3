// A moving body in which there is no water, as an actor of the sea says it in a step. Plain values, in SI units.
#pragma once
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <vector>

#include "ocean/inputs/input_spec.h"

namespace seascape {

struct ClipBody {
  static constexpr int no_hull = -1;
  VolumeInput::Form form = VolumeInput::Form::sphere;  // sizes as in VolumeInput
  glm::dvec3 size_m{10.0};
  double round_m = 0.0, radius_m = 5.0, length_m = 20.0;
  int hull = no_hull;  // in place of the form: which of ClipRoom::hulls
  double scale = 1.0;  // of a hull

  glm::dvec3 at_m{0.0};  // x, height, z in the world of its origin: a form's middle, the origin of a hull's model
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  // from its own axes to the world's; of length 1
  glm::dvec3 velocity_mps{0.0};                // of its origin
  glm::dvec3 spin_rad_s{0.0};                  // about its origin, along the world's axes

  bool operator==(const ClipBody&) const = default;
};

// The body as it is dt_s later at its velocity and spin, and at rest there.
ClipBody carried(const ClipBody& body, double dt_s);

inline constexpr int most_clip_bodies = 64;

// What has to be known of bodies before any of them comes.
struct ClipRoom {
  int most_bodies = 0;                              // at once, 0 to most_clip_bodies
  std::vector<std::shared_ptr<const Model>> hulls;  // closed models
  std::vector<ClipBody> still;                      // stand where they are, beside the scene's volumes and after them
};

}  // namespace seascape
