// Gerstner waves along curves: their tile, laid so that x runs along a curve and -z across it towards the shore. Part
// of lib/sea.glsl; the C++ twins are ocean/places/shore_lines.cpp, which says where a place lies, and, for
// queries, ocean/sea/place_layers-inl.h.

layout(binding = slot_shore) uniform texture2DArray shore_displacement;  // as those of gerstner, along the tile's axes
layout(binding = slot_shore + 1) uniform texture2DArray shore_derivatives;
layout(binding = slot_shore + 2) uniform texture2DArray shore_moments;
layout(binding = slot_shore_lines) uniform texture2DArray shore_line_windows;  // ShoreTexel (ocean/drawn/drawn_shore.h)
layout(binding = slot_shore_ways) uniform texture2DArray shore_way_windows;

float shore_share;    // of the waves at the place that was read last; 0: nothing else is known
float shore_stretch;  // what the pattern's x grows by in a metre along the curve
vec2 shore_forward;   // along the curve
vec2 shore_bent;      // the place in the pattern, m
vec2 shore_flow;      // the water's velocity on the plane, m/s

// The angle of a vector in turns, -1/2 to 1/2; off by less than 1e-8 (Abramowitz and Stegun 1964, 4.4.49). What drivers
// have for it may be off by 1e-4.
float shore_turns(vec2 v) {
  const float least = min(abs(v.x), abs(v.y)), most = max(max(abs(v.x), abs(v.y)), 1e-20), x = least / most, y = x * x;
  float angle =
      x *
      (1.0 + y * (-0.3333314528 +
                  y * (0.1999355085 +
                       y * (-0.1420889944 +
                            y * (0.1065626393 +
                                 y * (-0.0752896400 + y * (0.0429096138 + y * (-0.0161657367 + y * 0.0028662257))))))));
  if (abs(v.y) > abs(v.x)) angle = 1.5707963268 - angle;
  if (v.x < 0.0) angle = 3.1415926536 - angle;
  return (v.y < 0.0 ? -angle : angle) / 6.2831853072;
}

void shore_read(LodRead read, vec2 place) {
  vec4 line = place_value(shore_line_windows, read, place, vec4(0.0));
  shore_share = line.w;
  if (shore_share <= 0.0) return;
  line /= read.present;  // towards the edge of all windows the share fades, and nothing else
  const vec2 way = place_value(shore_way_windows, read, place, vec4(0.0)).xy / read.present;
  const float size = max(length(way), 1.0);
  shore_stretch = size - 1.0;
  shore_forward = way / size;
  shore_bent = vec2(shore_turns(line.yz) / frame.sea.shore.tile_from_rest.x, line.x);
}

vec2 shore_right() { return vec2(-shore_forward.y, shore_forward.x); }

// A way on the plane, in the pattern.
vec2 shore_vector(vec2 way) { return vec2(shore_stretch * dot(shore_forward, way), dot(shore_right(), way)); }

vec4 shore_pattern(float footprint) {
  vec4 d = vec4(0.0);
  add_displacement(d, shore_displacement, frame.sea.shore, 6, 0.0, vec4(1.0), shore_bent, footprint);
  return d;
}

// Its shear is the pixels' (add_shore_slopes), for it takes more than vertices hand on.
void add_shore_displacement(inout vec4 sum, float footprint) {
  if (shore_share <= 0.0) return;
  const vec4 d = shore_pattern(footprint);
  const vec2 level = d.x * shore_forward + d.z * shore_right();
  sum.xyz += shore_share * vec3(level.x, d.y, level.y);
}
