#include "tests/support/gpu/solid_shot.h"

#include <algorithm>

namespace seascape::test {

ShotOptions solid_options(const FrameLook& look, const SceneObjects& objects, std::uint32_t width, std::uint32_t height,
                          const Set& set) {
  ShotOptions options{.scene = "calm", .preset = "medium", .width = width, .height = height, .set = set};
  options.set.insert(options.set.end(), look.set.begin(), look.set.end());
  options.set.emplace_back("waves.resolution", "32");
  options.effects = {{"waves", "models"}};
  options.objects = objects;
  return options;
}

glm::dvec3 pixel_ray(const View& eye, double x, double y, std::uint32_t width, std::uint32_t height) {
  const Fov& f = eye.fov;
  return glm::normalize(eye.pose.orientation *
                        glm::dvec3(f.left + (f.right - f.left) * x / width, f.up - (f.up - f.down) * y / height, -1.0));
}

bool meets_box(const glm::dvec3& from, const glm::dvec3& d, const glm::dvec3& middle, const glm::dvec3& half,
               double more) {
  double near = -1e30, far = 1e30;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = std::max(half[axis] + more, 1e-4);
    const double s = (middle[axis] - size - from[axis]) / d[axis], t = (middle[axis] + size - from[axis]) / d[axis];
    near = std::max(near, std::min(s, t));
    far = std::min(far, std::max(s, t));
  }
  return near < far && far > 0.0;
}

}  // namespace seascape::test
