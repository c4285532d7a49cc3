#include "app/water_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace seascape {

namespace {

constexpr double atmosphere_m = 10.08;   // of sea water
constexpr double portal_margin_m = 0.1;  // a near plane's

struct SeaPlane {
  double height_m = 0.0, still_m = 0.0;
  glm::dvec2 slopes{0.0};
};
SeaPlane sea_at(const SeaView* sea, const glm::dvec3& at_m) {
  if (sea == nullptr) return {};
  const QueryAnswer water = sea->query({at_m.x, at_m.z});
  return {water.height_m, water.still_m, glm::dvec2(-water.normal.x, -water.normal.z) / std::max(water.normal.y, 0.1)};
}

Pose pose_of(const PlacedShape& shape, const SceneObjects& objects) {
  return shape.on ? composed(objects.things[*shape.on].pose, shape.pose) : shape.pose;
}

// Without the water of its own.
gpu::WaterShape placed(const PlacedShape& shape, const Pose& pose, const glm::dvec3& viewer_m, const SeaPlane& sea,
                       int& planes, gpu::WaterShapes& all) {
  gpu::WaterShape s{};
  const glm::dvec3 middle = pose.position_m - viewer_m;
  const glm::dmat3 own = glm::transpose(glm::dmat3(glm::mat3_cast(pose.orientation)));
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 axis = glm::dvec3(own[0][i], own[1][i], own[2][i]) / shape.half_m[i];
    s.row[i] = glm::vec4(glm::dvec4(axis, -glm::dot(axis, middle)));
  }
  s.water = glm::vec4(gpu::no_water_level, float(sea.height_m - viewer_m.y), glm::vec2(sea.slopes));
  s.middle = glm::vec4(glm::vec3(middle), 0.0f);
  s.form = {shape.form, planes, int(shape.planes.size()), shape.mode};
  for (const glm::dvec4& plane : shape.planes) all.plane[planes++] = glm::vec4(plane);
  return s;
}

// How much of each column of a shape lies above a height, for its volume.
struct Columns {
  static constexpr int side = 32;
  std::array<glm::dvec2, std::size_t(side* side)> heights;
  double above(double height) const {
    double sum = 0.0;
    for (const glm::dvec2& h : heights) sum += std::max(h.y - std::max(h.x, height), 0.0);
    return sum;
  }
};

}  // namespace

double level_by_boyle_m(const WaterLines& lines, int number, double radius_m, double sea_m) {
  const gpu::WaterShape& shape = lines.shapes.air[number];
  const glm::dvec3 middle(shape.middle);
  Columns columns;
  double lowest = middle.y + radius_m, highest = middle.y - radius_m;
  for (int i = 0; i < Columns::side; ++i)
    for (int k = 0; k < Columns::side; ++k) {
      const double x = (2.0 * (i + 0.5) / Columns::side - 1.0) * radius_m,
                   z = (2.0 * (k + 0.5) / Columns::side - 1.0) * radius_m;
      const glm::dvec3 from(middle.x + x, middle.y, middle.z + z);
      glm::dvec2 up = lines.span(shape, from, {0.0, 1.0, 0.0});
      if (up.y <= up.x) up = glm::dvec2(0.0);
      columns.heights[std::size_t(i * Columns::side + k)] = middle.y + up;
      if (up.y > up.x) lowest = std::min(lowest, middle.y + up.x), highest = std::max(highest, middle.y + up.y);
    }
  const double whole = columns.above(lowest);
  if (whole <= 0.0) return lowest;
  double below = lowest, above = highest;  // the air that is there shrinks as water rises, that which there is grows
  for (int i = 0; i < 40; ++i) {
    const double middle_m = 0.5 * (below + above), depth_m = std::max(sea_m - middle_m, 0.0);
    (columns.above(middle_m) / whole > atmosphere_m / (atmosphere_m + depth_m) ? below : above) = middle_m;
  }
  return below;
}

gpu::WaterShapes placed_shapes(const SceneShapes& shapes, const SceneObjects& objects, const glm::dvec3& viewer_m,
                               const SeaView* sea) {
  gpu::WaterShapes all{};
  int planes = 0;
  const WaterLines lines{all, int(shapes.air.size()), int(shapes.portals.size())};
  for (std::size_t i = 0; i < shapes.air.size(); ++i) {
    const PlacedShape& shape = shapes.air[i];
    const Pose pose = pose_of(shape, objects);
    const SeaPlane around = sea_at(sea, pose.position_m);
    all.air[i] = placed(shape, pose, viewer_m, around, planes, all);
    if (shape.level_m)
      all.air[i].water.x = float((composed(pose, Pose{{0.0, *shape.level_m, 0.0}}).position_m - viewer_m).y);
    if (shape.open_below)
      all.air[i].water.x = float(level_by_boyle_m(lines, int(i), shape.radius_m, around.still_m - viewer_m.y));
  }
  for (std::size_t i = 0; i < shapes.portals.size(); ++i) {
    const Pose pose = pose_of(shapes.portals[i], objects);
    all.portal[i] = placed(shapes.portals[i], pose, viewer_m, sea_at(sea, pose.position_m), planes, all);
  }
  return all;
}

bool kept_dry(const SceneShapes& shapes, const SceneObjects& objects, const glm::dvec3& at_m, const SeaView& sea) {
  const gpu::WaterShapes placed = placed_shapes(shapes, objects, at_m, &sea);
  return WaterLines{placed, int(shapes.air.size()), int(shapes.portals.size())}.keep_dry(glm::dvec3(0.0));
}

namespace {

// Whether a portal, whose water is `placed`, is before an eye: in its picture, and not turned away from it.
bool before_eye(const PlacedShape& shape, const gpu::WaterShape& placed, const View& eye, const glm::dvec3& at) {
  if (shape.mode == gpu::portal_front &&
      !(glm::dot(glm::dvec4(placed.row[2]), glm::dvec4(at, 1.0)) > -1e-3))  // floats round
    return false;
  const glm::dvec3 to = glm::dvec3(placed.middle) - at, ahead = eye.pose.orientation * glm::dvec3(0.0, 0.0, -1.0);
  double wide = 0.0;  // tangent of a corner
  for (const double across : {eye.fov.left, eye.fov.right})
    for (const double up : {eye.fov.up, eye.fov.down}) wide = std::max(wide, std::hypot(across, up));
  const double far_m = glm::length(to), radius_m = shape.radius_m + portal_margin_m;
  if (far_m <= radius_m) return true;
  const double off = std::acos(std::clamp(glm::dot(to, ahead) / far_m, -1.0, 1.0));
  return off <= std::atan(wide) + std::asin(radius_m / far_m);
}

// Whether a shape comes up to where the surface may stand: troughs are no deeper than crests are high.
bool reaches_surface(const PlacedShape& shape, const gpu::WaterShape& placed, const Viewpoint& viewpoint,
                     double highest_m) {
  return double(placed.middle.y) + viewpoint.viewer.position_m.y + shape.radius_m > -highest_m;
}

}  // namespace

EyesAmongShapes eyes_among(EyesIn eyes, const SceneShapes& shapes, const gpu::WaterShapes& placed,
                           const Viewpoint& viewpoint, double highest_m) {
  EyesAmongShapes side{eyes};
  for (std::size_t i = 0; i < shapes.air.size(); ++i)
    side.high_air = side.high_air || reaches_surface(shapes.air[i], placed.air[i], viewpoint, highest_m);
  if (shapes.portals.empty()) {
    if (side.eyes == EyesIn::water && side.high_air) side.eyes = EyesIn::either;
    side.from_above = side.eyes != EyesIn::water;
    return side;
  }
  bool high_portal = false;
  for (const View& eye : viewpoint.eyes) {
    const glm::dvec3 at = eye.pose.position_m - viewpoint.viewer.position_m;
    for (std::size_t i = 0; i < shapes.portals.size(); ++i) {
      const PlacedShape& portal = shapes.portals[i];
      if (!before_eye(portal, placed.portal[i], eye, at)) continue;
      side.portals.add(at, glm::dvec3(placed.portal[i].middle), portal.radius_m + portal_margin_m);
      high_portal = high_portal || reaches_surface(portal, placed.portal[i], viewpoint, highest_m);
    }
  }
  side.eyes = side.portals.any() ? EyesIn::either : EyesIn::air;
  side.from_above = side.eyes != EyesIn::air && (high_portal || side.high_air);
  return side;
}

}  // namespace seascape
