// The bed as an eye in the water sees it. Included after lib/sea_light.glsl.

// Where a line of sight from the eye meets the bed: how far off, metres; below 0 where it does not within what can be
// seen. It is looked for from `from` metres on. The line steps as far as a bed of slope `steep_bed` cannot rise to meet
// it; what is steeper is met where it is as thick as a step. (With 0.5 reefs had teeth along their far edges.) The last
// step is searched by the rule of false position (of Illinois: Dowell and Jarratt 1971).
const float steep_bed = 0.75;
float bed_met(vec3 ray, float from, ViewData view) {
  const vec3 eye = view.eye.xyz + vec3(frame.viewer.x, frame.viewer.z, frame.viewer.y);
  const vec3 dims = frame.water_absorption.rgb + frame.water_backscatter.rgb;
  float farthest = min(7.0 / min(dims.r, min(dims.g, dims.b)), 400.0);
  // Over the highest water, where that is level, there is no bed: land there is drawn with the surface.
  if (!sea_level && ray.y > 0.0)
    farthest = min(farthest, (depth_in_water(view.eye.y) + 2.0 * frame.sea.footprint.w + 0.5) / ray.y);
  const float closes = clamp(steep_bed - ray.y, 0.3, 1.67);  // by which bed and line come nearer at most, a metre
  float before = 0.0, before_over = 1.0, t = from, over = 1.0;
  for (int i = 0; i < 96 && t < farthest; ++i) {
    const vec3 at = eye + t * ray;
    over = at.y - bed_height(at.xz, t * view.eye.w);
    if (over <= 0.0) break;
    before = t;
    before_over = over;
    t += max(over / closes, 0.02 * t + 0.02);
  }
  if (t >= farthest || t == 0.0) return -1.0;
  float beyond = t, beyond_over = over;
  for (int i = 0; i < 8 && beyond - before > 5e-4 * beyond; ++i) {
    const float middle = mix(before, beyond, before_over / max(before_over - beyond_over, 1e-6));
    const vec3 at = eye + middle * ray;
    const float there = at.y - bed_height(at.xz, middle * view.eye.w);
    if (abs(there) < 2e-4 * middle) return middle;  // a fraction of a pixel
    if (there > 0.0) {
      before = middle;
      before_over = there;
      beyond_over *= 0.5;
    } else {
      beyond = middle;
      beyond_over = there;
      before_over *= 0.5;
    }
  }
  return beyond;
}

// Radiance of the bed that a pixel's line of sight meets, exposed, and how near it is. Discards others.
vec3 bed_in_water(vec3 pixel_ray, out float near) {
  const ViewData view = frame.view[eye_index()];
  const vec3 ray = normalize(pixel_ray);
  // Where portals alone show water, most lines of sight pass none.
  float from = portals > 0 ? line_endless : 0.0;
  if (portals > 0) {
    const LineThrough line = line_through(view.eye.xyz, ray);
    for (int i = 0; i < portals; ++i)
      if (line.seen[i].y > max(line.seen[i].x, 0.0)) from = min(from, max(line.seen[i].x, 0.0));
  }
  if (from >= line_endless) discard;
  const float way = bed_met(ray, from, view);
  if (way < 0.0) discard;
  const vec3 at = view.eye.xyz + way * ray;
  if (hidden_by_portals(at, view.eye.xyz)) discard;
  const vec2 place = at.xz + frame.viewer.xy;
  const float pixel = way * view.eye.w, footprint = pixel / max(abs(ray.y), 0.2);
  const vec4 clip = view.clip_from_relative * vec4(at, 1.0);
  near = clip.z / clip.w;
  const vec2 slope = bed_slope(place, pixel);
  const vec3 white = bed_albedo(place, -depth_in_water(at.y) - 1e-3, slope, footprint) / pi;
  vec3 of_lamp = vec3(0.0);
  if (lamp_carried && lamp_shines()) of_lamp = white * lamp_on(at, normalize(vec3(-slope.x, 1.0, -slope.y)));
  return light_in_water(white * water_lit(), vec3(0.0), of_lamp, at, view) * light.exposure.x * exp2(frame.air.y);
}
