// A colour that lies on the water. Part of lib/sea_light.glsl.

// `white`: the light that a white cloth there would send to the eye.
void lay_albedo(inout vec3 lit, vec2 place, vec3 white) {
  const vec4 laid = place_value(water_albedo_windows, place_read(place, 0.0), place, vec4(0.0));
  lit = lit * (1.0 - laid.a) + laid.rgb * white;
}
