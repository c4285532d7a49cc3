// Where a straight line is in water: between shapes that hold air under water and, in a scene with portals, only within
// what those show. Shared by C++ and GLSL.
#ifndef SEASCAPE_WATER_LINE_H
#define SEASCAPE_WATER_LINE_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
using glm::dot;
using glm::max;
using glm::min;
using glm::sqrt;
#define SEASCAPE_REAL3 glm::vec<3, Real>
#else
#define SEASCAPE_REAL3 vec3
#endif

SEASCAPE_CONST int most_air_pockets = 8;
SEASCAPE_CONST int most_portals = 8;
SEASCAPE_CONST int most_shape_planes = 64;  // of all shapes together

// Forms. Boxes reach from -1 to 1 along their own axes, spheres have a radius of 1 there. Discs and rectangles lie at
// z = 0, and their front is seen from where z is above 0.
SEASCAPE_CONST int shape_box = 0;
SEASCAPE_CONST int shape_sphere = 1;
SEASCAPE_CONST int shape_planes = 2;
SEASCAPE_CONST int shape_disc = 3;
SEASCAPE_CONST int shape_rectangle = 4;

// How water is seen through a portal: behind its front, however far; between front and back, from outside; the same for
// eyes within, too.
SEASCAPE_CONST int portal_front = 0;
SEASCAPE_CONST int portal_volume = 1;
SEASCAPE_CONST int portal_fly_through = 2;

struct WaterShape {
  vec4 row[3];  // to its own axes from metres relative to the viewer
  vec4 water;   // x: height of the water of its own over the viewer, m: what is below it is no air; y: height of the
                // sea at its middle over the viewer, m; z, w: the sea's slopes there
  vec4 middle;  // xyz: relative to the viewer, m; w: unused
  ivec4 form;   // x: its form; y, z: its first plane and how many; w: how water is seen through it
};
struct WaterShapes {
  WaterShape air[most_air_pockets];
  WaterShape portal[most_portals];
  vec4 plane[most_shape_planes];  // xyz: normal in the shape's own axes, outwards; w: distance of its origin
};

SEASCAPE_CONST float no_water_level = -1e30f;  // of a shape without water of its own
SEASCAPE_CONST float line_endless = 1e30f;

// A span is the part of a line between two distances from its beginning. Empty where the second is not the larger.

// What of a span lies where `over` + `rises` t <= 0.
SEASCAPE_REAL_FUNCTION SEASCAPE_REAL2 span_under(SEASCAPE_REAL2 span, Real over, Real rises) {
  if (abs(rises) < Real(1e-20))
    return over > Real(0.0) ? SEASCAPE_REAL2(Real(line_endless), -Real(line_endless)) : span;
  Real t = -over / rises;
  return rises > Real(0.0) ? SEASCAPE_REAL2(span.x, min(span.y, t)) : SEASCAPE_REAL2(max(span.x, t), span.y);
}

// Of the line o + t d within forms, in their own axes.
SEASCAPE_REAL_FUNCTION SEASCAPE_REAL2 box_span(SEASCAPE_REAL3 o, SEASCAPE_REAL3 d) {
  SEASCAPE_REAL2 span = SEASCAPE_REAL2(-Real(line_endless), Real(line_endless));
  for (int i = 0; i < 3; ++i) {
    span = span_under(span, o[i] - Real(1.0), d[i]);
    span = span_under(span, -o[i] - Real(1.0), -d[i]);
  }
  return span;
}
SEASCAPE_REAL_FUNCTION SEASCAPE_REAL2 sphere_span(SEASCAPE_REAL3 o, SEASCAPE_REAL3 d) {
  Real square = dot(d, d), nearest = -dot(o, d) / square;
  SEASCAPE_REAL3 off = o + nearest * d;  // from the middle: its square loses no digits far off
  Real left = Real(1.0) - dot(off, off);
  if (left <= Real(0.0)) return SEASCAPE_REAL2(Real(line_endless), -Real(line_endless));
  Real half_chord = sqrt(left / square);
  return SEASCAPE_REAL2(nearest - half_chord, nearest + half_chord);
}
// Of the line behind a sheet that it meets from the front.
SEASCAPE_REAL_FUNCTION SEASCAPE_REAL2 sheet_span(SEASCAPE_REAL3 o, SEASCAPE_REAL3 d, bool is_round) {
  SEASCAPE_REAL2 none = SEASCAPE_REAL2(Real(line_endless), -Real(line_endless));
  if (o.z <= Real(0.0) || d.z >= -Real(1e-20)) return none;
  Real t = -o.z / d.z, x = o.x + t * d.x, y = o.y + t * d.y;
  if (is_round ? x * x + y * y >= Real(1.0) : max(abs(x), abs(y)) >= Real(1.0)) return none;
  return SEASCAPE_REAL2(t, Real(line_endless));
}

// How far from t on a line stays within spans that hold t, or more of them in their order; t itself where none does.
SEASCAPE_REAL_FUNCTION Real spans_until(SEASCAPE_REAL2 span[most_air_pockets], int count, Real t) {
  for (int k = 0; k < count; ++k)
    if (span[k].x <= t && span[k].y > t) t = span[k].y;
  return t;
}
// Where after t the next span begins.
SEASCAPE_REAL_FUNCTION Real spans_next(SEASCAPE_REAL2 span[most_air_pockets], int count, Real t) {
  Real next = Real(line_endless);
  for (int k = 0; k < count; ++k)
    if (span[k].x > t && span[k].y > span[k].x) next = min(next, span[k].x);
  return next;
}

// The first part of a line from t on that is in water, where the sea is all around: in none of `dry`, and where there
// are portals in one of `seen`. It begins at line_endless where there is none, and another part may go on at its end.
SEASCAPE_REAL_FUNCTION SEASCAPE_REAL2 next_wet_part(SEASCAPE_REAL2 dry[most_air_pockets], int air,
                                                    SEASCAPE_REAL2 seen[most_portals], int portals, Real t) {
  for (int i = 0; i <= air + portals; ++i) {  // each round leaves a span at least, in whatever order they are
    Real from = spans_until(dry, air, t);
    if (portals > 0 && spans_until(seen, portals, from) <= from) from = spans_next(seen, portals, from);
    if (from <= t) break;
    t = from;
  }
  if (t >= Real(line_endless)) return SEASCAPE_REAL2(Real(line_endless), Real(line_endless));
  Real end = spans_next(dry, air, t);
  if (portals > 0) end = min(end, spans_until(seen, portals, t));
  return SEASCAPE_REAL2(t, end);
}

SEASCAPE_SHARED_END
#endif
