// Gerstner waves along curves: their tile, laid so that x runs along a curve and -z across it towards the shore. Part
// of lib/sea.glsl; the C++ twins are ocean/places/shore_lines.cpp, which says where a place lies, and, for
// queries, ocean/sea/place_layers-inl.h.

layout(binding = slot_shore) uniform texture2DArray shore_displacement;  // as those of gerstner, along the tile's axes
layout(binding = slot_shore + 1) uniform texture2DArray shore_derivatives;
layout(binding = slot_shore + 2) uniform texture2DArray shore_moments;
layout(binding = slot_shore_lines) uniform texture2DArray shore_line_windows;  // ShoreTexel (ocean/drawn/drawn_shore.h)
layout(binding = slot_shore_ways) uniform texture2DArray shore_way_windows;

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

SeaShore shore_read(LodRead read, vec2 place) {
  SeaShore shore = SeaShore(0.0, 0.0, vec2(0.0), vec2(0.0));
  vec4 line = place_value(shore_line_windows, read, place, vec4(0.0));
  shore.share = line.w;
  if (shore.share <= 0.0) return shore;
  line /= read.present;  // towards the edge of all windows the share fades, and nothing else
  const vec2 way = place_value(shore_way_windows, read, place, vec4(0.0)).xy / read.present;
  const float size = max(length(way), 1.0);
  shore.stretch = size - 1.0;
  shore.forward = way / size;
  shore.bent = vec2(shore_turns(line.yz) / frame.sea.shore.tile_from_rest.x, line.x);
  return shore;
}

vec2 shore_right(SeaShore shore) { return vec2(-shore.forward.y, shore.forward.x); }

// A way on the plane, in the pattern.
vec2 shore_vector(SeaShore shore, vec2 way) {
  return vec2(shore.stretch * dot(shore.forward, way), dot(shore_right(shore), way));
}

// The place in the pattern, where the water moves along the pattern's axes.
SeaPlace shore_place(SeaPlace place) {
  place.rest = place.shore.bent;
  place.flow = shore_vector(place.shore, place.flow);
  return place;
}
