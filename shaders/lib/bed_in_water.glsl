// The bed as an eye in the water sees it. Included after lib/sea_light.glsl.

// Where a line of sight from the eye meets the bed: how far off, metres; below 0 where it does not within what can be
// seen. The line steps by a share of its height over the bed, which few beds rise to meet, then halves the last step.
float bed_met(vec3 ray, ViewData view) {
  const vec3 eye = view.eye.xyz + vec3(frame.viewer.x, frame.viewer.z, frame.viewer.y);
  const vec3 dims = frame.water_absorption.rgb + frame.water_backscatter.rgb;
  const float farthest = min(7.0 / min(dims.r, min(dims.g, dims.b)), 400.0);
  float before = 0.0, t = 0.0;
  for (int i = 0; i < 96 && t < farthest; ++i) {
    const vec3 at = eye + t * ray;
    const float over = at.y - bed_height(at.xz, t * view.eye.w);
    if (over <= 0.0) break;
    before = t;
    t += max(0.6 * over, 0.02 * t + 0.02);
  }
  if (t >= farthest || t == 0.0) return -1.0;
  float beyond = t;
  for (int i = 0; i < 10; ++i) {
    const float middle = 0.5 * (before + beyond);
    const vec3 at = eye + middle * ray;
    if (at.y > bed_height(at.xz, middle * view.eye.w))
      before = middle;
    else
      beyond = middle;
  }
  return beyond;
}

// Radiance of the bed that a pixel's line of sight meets, exposed, and how near it is. Discards others.
vec3 bed_in_water(vec3 pixel_ray, out float near) {
  const ViewData view = frame.view[eye_index()];
  const vec3 ray = normalize(pixel_ray);
  const float way = bed_met(ray, view);
  if (way < 0.0) discard;
  const vec3 at = view.eye.xyz + way * ray;
  if (hidden_by_portals(at, view.eye.xyz)) discard;
  const vec2 place = at.xz + frame.viewer.xy;
  const float pixel = way * view.eye.w, footprint = pixel / max(abs(ray.y), 0.2);
  const vec4 clip = view.clip_from_relative * vec4(at, 1.0);
  near = clip.z / clip.w;
  const vec3 sent =
      bed_albedo(place, -depth_in_water(at.y) - 1e-3, bed_slope(place, pixel), footprint) / pi * water_lit();
  return light_in_water(sent, vec3(0.0), at, view) * light.exposure.x * exp2(frame.air.y);
}
