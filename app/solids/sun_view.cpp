#include "app/solids/sun_view.h"

#include <cmath>

namespace seascape {

namespace {

// In reaches: how far towards the sun a thing may stand that throws its shadow into the map, and how far behind the
// middle what receives it.
constexpr double ahead = 6.0, behind = 1.5;

}  // namespace

SunView sun_view(const glm::dvec3& to_sun, const glm::dvec3& viewer_m, int texels, double reach_m) {
  SunView view;
  view.shines = to_sun.y > 0.0;
  view.near = to_sun;
  const glm::dvec3 beside =
      std::abs(to_sun.y) > 0.999 ? glm::dvec3(1.0, 0.0, 0.0) : glm::cross(glm::dvec3(0.0, 1.0, 0.0), to_sun);
  view.row = glm::normalize(glm::cross(to_sun, beside));
  view.column = glm::cross(view.row, to_sun);
  view.reach_m = reach_m;
  view.texel_m = 2.0 * reach_m / texels;
  const glm::dvec3 stands(viewer_m.x, 0.0, viewer_m.z);
  const auto whole = [&](const glm::dvec3& axis) {
    return std::floor(glm::dot(stands, axis) / view.texel_m) * view.texel_m;
  };
  view.middle = whole(view.column) * view.column + whole(view.row) * view.row + glm::dot(stands, to_sun) * to_sun;
  return view;
}

bool SunView::may_shade(const glm::dvec3& at, double radius) const {
  const glm::dvec3 off = at - middle;
  const double towards = glm::dot(off, near), most = reach_m + radius;
  return shines && std::abs(glm::dot(off, column)) < most && std::abs(glm::dot(off, row)) < most &&
         towards > -behind * reach_m - radius && towards < ahead * reach_m - radius;
}

void SunView::describe(gpu::FrameData& data, const glm::dvec3& viewer_m) const {
  const glm::dvec3 from_middle = glm::dvec3(viewer_m.x, 0.0, viewer_m.z) - middle;
  const double deep = (ahead + behind) * reach_m;
  const auto told = [&](const glm::dvec3& axis, double size, double at_middle) {
    return glm::vec4(glm::vec3(axis / size), float(glm::dot(from_middle, axis) / size + at_middle));
  };
  data.sun_map_column = told(column, 2.0 * reach_m, 0.5);
  data.sun_map_row = told(row, 2.0 * reach_m, 0.5);
  data.sun_map_near = told(near, deep, behind / (ahead + behind));
  data.sun_map = {float(texel_m), float(reach_m), float(deep), float(share)};
}

}  // namespace seascape
