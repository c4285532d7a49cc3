// Where somebody looks from: poses and fields of view, as a display hands them out and culling and drawing take them.
#pragma once
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace seascape {

// A position in world metres (double: a sea has no end) and an orientation; -z is forward, +y up, +x right.
struct Pose {
  glm::dvec3 position_m{0.0, 0.0, 0.0};
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
};

// Where a pose lies that is given as seen from another.
Pose composed(const Pose& from, const Pose& pose);
// composed(inverse(p), p) is the origin.
Pose inverse(const Pose& pose);
// The turn about +y that faces where an orientation looks; where it looks straight up or down, by its right ear.
glm::dquat heading(const glm::dquat& orientation);

// Tangents of the four half angles, as OpenXR has them: left and down are negative for a usual view.
struct Fov {
  double left = -1.0, right = 1.0, up = 1.0, down = -1.0;
};

struct View {
  Pose pose;
  Fov fov;
};

// The viewer (head) that selects and simulates, and the eyes that draw. One eye: a mono picture.
struct Viewpoint {
  Pose viewer;
  std::vector<View> eyes;
  double pixels_per_radian = 0.0;  // in the middle of the picture, of the eye that has most; 0: not known, no picture
};

// Of these eyes' pictures, `height_px` high each.
double pixels_per_radian(const std::vector<View>& eyes, double height_px);
// Of an eye of 1680 x 1760 pixels and 100 degrees, upwards as well as sideways: where no picture says.
inline constexpr double reference_pixels_per_radian = 738.4;

// Symmetric field of view of `vertical_deg` for a picture of `aspect` = width / height.
Fov symmetric_fov(double vertical_deg, double aspect);

// The two eyes of a head: `eye_distance_m` apart along the head's x, both with the head's orientation and `fov`.
// Left first. Distance 0 gives two equal views.
std::vector<View> stereo_views(const Pose& head, const Fov& fov, double eye_distance_m);

// Clip from eye space, reversed depth (near plane at 1, infinity at 0), Vulkan's y downwards.
glm::dmat4 projection(const Fov& fov, double near_m);

// Eye space from positions relative to `origin_m` (metres, world axes).
glm::dmat4 eye_from_relative(const Pose& eye, const glm::dvec3& origin_m);

}  // namespace seascape
