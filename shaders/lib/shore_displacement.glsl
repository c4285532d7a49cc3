// What waves along curves add to sea_displacement(). Part of lib/sea.glsl.

vec4 shore_pattern(SeaPlace place, float footprint) {
  vec4 d = vec4(0.0);
  add_displacement(d, shore_displacement, frame.sea.shore, 6, 0.0, vec4(1.0), shore_place(place), footprint);
  return d;
}

// Its shear is the pixels' (add_shore_slopes), for it takes more than vertices hand on.
void add_shore_displacement(inout vec4 sum, SeaPlace place, float footprint) {
  const SeaShore shore = place.shore;
  if (shore.share <= 0.0) return;
  const vec4 d = shore_pattern(place, footprint);
  const vec2 level = d.x * shore.forward + d.z * shore_right(shore);
  sum.xyz += shore.share * vec3(level.x, d.y, level.y);
}
