#include "ocean/surface/water_line.h"

#include <algorithm>

namespace seascape {

namespace {
constexpr double endless = double(gpu::line_endless);
constexpr glm::dvec2 nowhere{endless, -endless};
}  // namespace

glm::dvec2 WaterLines::span(const gpu::WaterShape& s, const glm::dvec3& from, const glm::dvec3& ray) const {
  glm::dvec3 o, d;
  for (int i = 0; i < 3; ++i) {
    o[i] = glm::dot(glm::dvec4(s.row[i]), glm::dvec4(from, 1.0));
    d[i] = glm::dot(glm::dvec3(s.row[i]), ray);
  }
  if (s.form.x == gpu::shape_box) return gpu::box_span(o, d);
  if (s.form.x == gpu::shape_sphere) return gpu::sphere_span(o, d);
  if (s.form.x != gpu::shape_planes) return gpu::sheet_span(o, d, s.form.x == gpu::shape_disc);
  glm::dvec2 span(-endless, endless);
  for (int i = 0; i < s.form.z; ++i) {
    const glm::dvec4 plane(shapes.plane[s.form.y + i]);
    const glm::dvec3 normal(plane);
    span = gpu::span_under(span, glm::dot(normal, o) - plane.w, glm::dot(normal, d));
  }
  return span;
}

glm::dvec2 WaterLines::air_span(const gpu::WaterShape& s, const glm::dvec3& from, const glm::dvec3& ray) const {
  return gpu::span_under(span(s, from, ray), double(s.water.x) - from.y, -ray.y);
}

glm::dvec2 WaterLines::portal_span(const gpu::WaterShape& s, const glm::dvec3& from, const glm::dvec3& ray) const {
  const glm::dvec2 within = span(s, from, ray);
  if (s.form.w != gpu::portal_fly_through && within.x <= 0.0) return nowhere;
  if (s.form.w == gpu::portal_front && within.y > within.x) return {within.x, endless};
  return within;
}

bool WaterLines::in_air(const glm::dvec3& at) const {
  for (int i = 0; i < air; ++i) {
    const glm::dvec2 up = air_span(shapes.air[i], at, {0.0, 1.0, 0.0});
    if (up.x <= 0.0 && up.y > 0.0) return true;
  }
  return false;
}

bool WaterLines::keep_dry(const glm::dvec3& at) const {
  bool dry = portals > 0;
  for (int i = 0; i < portals; ++i) {
    if (shapes.portal[i].form.w != gpu::portal_fly_through) continue;
    const glm::dvec2 up = span(shapes.portal[i], at, {0.0, 1.0, 0.0});
    if (up.x <= 0.0 && up.y > 0.0) dry = false;
  }
  return dry || in_air(at);
}

std::vector<glm::dvec2> WaterLines::wet_parts(const glm::dvec3& from, const glm::dvec3& ray, double way) const {
  glm::dvec2 dry[gpu::most_air_pockets], seen[gpu::most_portals];
  for (int i = 0; i < air; ++i) dry[i] = air_span(shapes.air[i], from, ray);
  for (int i = 0; i < portals; ++i) seen[i] = portal_span(shapes.portal[i], from, ray);
  std::vector<glm::dvec2> parts;
  double at = 0.0;
  for (int i = 0; i <= air + portals; ++i) {
    const glm::dvec2 part = gpu::next_wet_part(dry, air, seen, portals, at);
    if (part.x >= way) break;
    parts.push_back({part.x, std::min(part.y, way)});
    at = part.y;
  }
  return parts;
}

}  // namespace seascape
