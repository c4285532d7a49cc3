// What water on a lens shows: light that it bends. No picture of what lies behind is at hand, so that rays meet sky, a
// sea of the scene's mean slopes, or the open water. Included after lib/sea_light.glsl.

layout(binding = slot_point_sides) uniform usampler2DArray sides;
layout(binding = slot_point_depths) uniform sampler2DArray depths;
layout(constant_id = value_depth_sampled) const bool depth_sampled = false;  // sides are a picture, not this pass's

// Whether the eye is in the water in this pixel, or nobody sees it (hidden.vert).
bool not_in_air() {
  if (!depth_sampled) return false;
  const ivec3 at = ivec3(gl_FragCoord.xy, eye_index());
  return texelFetch(sides, at, 0).r < side_in_air || texelFetch(depths, at, 0).r == 1.0;
}

// Variances and covariance of the slopes of all waves.
vec3 mean_slopes() {
  vec3 sum = frame.sea.tail.xyz;
  for (int i = 0; i < cascade_count; ++i) sum += frame.sea.cascade[i].moments.xyz;
  const float most = 0.06;  // of a gale's: the formulas are for slopes that are small
  return max(sum * min(1.0, most / max(sum.x + sum.y, 1e-6)), vec3(1e-4, 1e-4, -1.0));
}

// Radiance that reaches the lens along `ray`, of unit length, through air.
vec3 light_of_air(vec3 ray, ViewData view) {
  if (ray.y >= 0.0) return sky_light(ray, view.eye.w);
  float mirrored, seen;
  const vec3 var = mean_slopes(), v = -ray;
  vec3 lit = sky_in_facets(v, vec2(0.0), var, mirrored, seen);
  lit += (1.0 - mirrored) * frame.water_reflectance.rgb * water_lit();
  lit += sun_glitter(v, frame.sun.xyz, vec2(0.0), var, seen);
  return through_air(lit, v, 1.0 / max(v.y, 1e-4));
}

// As the picture shows it.
vec3 shown_light(vec3 lit) { return lit * light.exposure.x * exp2(frame.air.y); }
