// The bed as an eye in the water sees it. Included after lib/sea_light.glsl.

// Radiance of the bed at `at` (metres from the viewer), exposed. Discards what portals hide.
vec3 bed_in_water(vec3 at) {
  const ViewData view = frame.view[eye_index()];
  if (hidden_by_portals(at, view.eye.xyz)) discard;
  const vec3 line = at - view.eye.xyz;
  const float way = max(length(line), 1e-3), pixel = way * view.eye.w, footprint = pixel / max(abs(line.y) / way, 0.2);
  const vec2 place = at.xz + frame.viewer.xy, slope = bed_slope(place, pixel);
  const vec3 white = bed_albedo(place, -depth_in_water(at.y) - 1e-3, slope, footprint) / pi;
  vec3 of_lamp = vec3(0.0);
  if (lamp_carried && lamp_shines()) of_lamp = white * lamp_on(at, normalize(vec3(-slope.x, 1.0, -slope.y)));
  return light_in_water(white * water_lit(), vec3(0.0), of_lamp, at, view) * light.exposure.x * exp2(frame.air.y);
}
