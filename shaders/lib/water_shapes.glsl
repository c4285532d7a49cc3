// Shapes that hold air under water, and those through which alone water is seen, before an eye. Included after the
// uniform block `frame`; the C++ twin is ocean/surface/water_line.cpp.
#ifndef SEASCAPE_WATER_SHAPES_GLSL
#define SEASCAPE_WATER_SHAPES_GLSL
#include "shared/water_line.h"

layout(constant_id = value_air_pockets) const int air_pockets = 0;
layout(constant_id = value_portals) const int portals = 0;

// Of a line (metres relative to the viewer), within a volume.
vec2 volume_span(WaterShape s, vec3 from, vec3 ray) {
  const vec3 d = vec3(dot(s.row[0].xyz, ray), dot(s.row[1].xyz, ray), dot(s.row[2].xyz, ray)),
             o = vec3(dot(s.row[0], vec4(from, 1.0)), dot(s.row[1], vec4(from, 1.0)), dot(s.row[2], vec4(from, 1.0)));
  if (s.form.x == shape_box) return box_span(o, d);
  if (s.form.x == shape_sphere) return sphere_span(o, d);
  if (s.form.x != shape_planes) return sheet_span(o, d, s.form.x == shape_disc);
  vec2 span = vec2(-line_endless, line_endless);
  for (int i = 0; i < s.form.z; ++i) {
    const vec4 plane = frame.shapes.plane[s.form.y + i];
    span = span_under(span, dot(plane.xyz, o) - plane.w, dot(plane.xyz, d));
  }
  return span;
}

// Of a line, where a pocket's air is; `level`: where it passes the pocket's own water, below 0 where it does not.
vec2 air_span(WaterShape s, vec3 from, vec3 ray, out float level) {
  const vec2 whole = volume_span(s, from, ray), span = span_under(whole, s.water.x - from.y, -ray.y);
  level = -1.0;
  if (span.y != whole.y) level = span.y;
  if (span.x != whole.x) level = span.x;
  return span;
}

// Of a line, where water may be seen through a portal.
vec2 portal_span(WaterShape s, vec3 from, vec3 ray) {
  const vec2 span = volume_span(s, from, ray), none = vec2(line_endless, -line_endless);
  if (s.form.w != portal_fly_through && span.x <= 0.0) return none;
  if (s.form.w == portal_front && span.y > span.x) return vec2(span.x, line_endless);
  return span;
}

// A line of sight among all of them.
struct LineThrough {
  vec2 dry[most_air_pockets];
  float level[most_air_pockets];
  vec2 seen[most_portals];
};
LineThrough line_through(vec3 from, vec3 ray) {
  LineThrough line;
  for (int i = 0; i < air_pockets; ++i) line.dry[i] = air_span(frame.shapes.air[i], from, ray, line.level[i]);
  for (int i = 0; i < portals; ++i) line.seen[i] = portal_span(frame.shapes.portal[i], from, ray);
  return line;
}

// Whether a place before the eye is in a pocket of air.
bool in_air_pocket(vec3 place) {
  bool within = false;
  for (int i = 0; i < air_pockets; ++i) {
    float level;
    const vec2 span = air_span(frame.shapes.air[i], place, vec3(0.0, 1.0, 0.0), level);
    within = within || (span.x <= 0.0 && span.y > 0.0);
  }
  return within;
}

// Whether the eye sees no water at a place, were it there: not through a portal, where there are any.
bool hidden_by_portals(vec3 place, vec3 eye) {
  if (portals == 0) return false;
  const float way = max(length(place - eye), 1e-6);
  const LineThrough line = line_through(eye, (place - eye) / way);
  return spans_until(line.seen, portals, way) <= way;
}

// Whether the sea's surface is cut away at a place.
bool surface_is_cut(vec3 place, vec3 eye) { return in_air_pocket(place) || hidden_by_portals(place, eye); }

// Whether a place is below the sea, which about a shape is taken for a plane.
float below_sea(WaterShape s, vec3 place) {
  return place.y < s.water.y + dot(s.water.zw, place.xz - s.middle.xz) ? 1.0 : 0.0;
}
#endif
