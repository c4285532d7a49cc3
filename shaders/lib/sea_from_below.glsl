// The sea's surface as an eye in the water sees it: the sky through it, refracted, and the deep that it mirrors. Part
// of lib/sea_light.glsl.

// The sun through the facets that refract it towards the eye (Walter et al. 2007, eq. 21; over the square of the
// index). `ray`: up to the surface; `l`: to the sun; `var`: the slopes' variances and covariance.
vec3 sun_through_facets(vec3 ray, vec3 l, vec2 slope, vec3 var) {
  const vec3 half_way = normalize(water_index * ray - l);
  const float out_cosine = dot(l, half_way), in_cosine = dot(ray, half_way);
  if (half_way.y <= 0.01 || out_cosine <= 0.0 || in_cosine <= 0.0 || l.y <= -0.02) return vec3(0.0);
  const vec2 d = -half_way.xz / half_way.y - slope;
  const float disc = 5e-5;  // a facet's tilt turns the ray by a third of it
  const float xx = var.x + disc, zz = var.y + disc, xz = clamp(var.z, -0.98 * sqrt(xx * zz), 0.98 * sqrt(xx * zz)),
              determinant = xx * zz - xz * xz;
  const float exponent = -0.5 * (zz * d.x * d.x - 2.0 * xz * d.x * d.y + xx * d.y * d.y) / determinant;
  if (exponent <= -16.0) return vec3(0.0);
  const float density = exp(exponent) / (2.0 * pi * sqrt(determinant)), h2 = half_way.y * half_way.y,
              across = out_cosine - water_index * in_cosine;
  return light.sun_irradiance.rgb * density * (1.0 - fresnel(out_cosine)) * out_cosine * in_cosine /
         (h2 * h2 * max(ray.y, 0.02) * across * across);
}

#include "lib/sea_bed_mirrored.glsl"
#include "lib/solids_above.glsl"

// Radiance of the facets in the water (over the square of the index), by three of them in the plane of sight (Gauss and
// Hermite's nodes). `hidden`: how much things above the water hide of the sky behind it.
vec3 facets_from_below(vec3 ray, vec2 slope, vec3 var, SurfacePoint p, SeaPlace here, float footprint,
                       out float hidden) {
  const float level = max(length(ray.xz), 1e-4);
  const vec2 sight = ray.xz / level;
  const float spread =
      sqrt(max(sight.x * sight.x * var.x + sight.y * sight.y * var.y + 2.0 * sight.x * sight.y * var.z, 0.0));
  vec3 sky = vec3(0.0);
  float seen = 0.0, mirrored = 0.0, passed = 0.0;
  SolidAbove thing = no_solid_above;
  vec3 way = vec3(0.0);  // on which the mirrored light comes
  for (int i = -1; i <= 1; ++i) {
    const vec2 q = slope + 1.7320508 * spread * float(i) * sight;
    const vec3 n = normalize(vec3(-q.x, 1.0, -q.y));
    const float cosine = dot(ray, n), weight = (i == 0 ? 0.6666667 : 0.1666667) * max(cosine, 1e-3) / n.y;
    const vec3 leaves = refract(ray, -n, water_index);
    float f = 1.0;
    if (cosine > 0.0 && leaves != vec3(0.0)) {
      f = fresnel(dot(leaves, n));
      sky += weight * (1.0 - f) *
             textureLod(sky_map, sky_coordinate(vec3(leaves.x, max(leaves.y, 0.0), leaves.z)), 0.0).rgb;
      if (solids_above) passed += weight * (1.0 - f);
      if (solids_above && i == 0) thing = solid_met_above(p.relative, leaves);
    }
    mirrored += weight * f;
    seen += weight;
    way += weight * f * reflect(ray, n);
  }
  if (solids_above) sky = mix(sky, passed / light.exposure.x * thing.lit, thing.cover);
  hidden = thing.cover;
  way.y = -abs(way.y);
  way = normalize(way + vec3(0.0, -1e-4, 0.0));
  vec3 met = open_water(0.0, way);
  if (sea_bed) met = sea_bed_mirrored(met, way, p, here, footprint);
  return (sky + mirrored * met) / seen;
}

// Radiance towards the eye, in the water before it; `normal` is the one it was lit by.
vec3 sea_from_below(SurfacePoint p, ViewData view, out vec3 normal) {
  const vec3 way = p.relative - view.eye.xyz, l = frame.sun.xyz;
  const float range = max(length(way), 1e-3);
  const vec3 ray = way / range;
  const SeaFootprint over = sea_footprint(p.along, p.across);
  const SeaPlace here = sea_place(p.rest, over.blur);
  const CarriedSlopes have =
      CarriedSlopes(p.derivatives, p.height_shear.y, mesh_spacing(p.rest), level_blur(-way, view.eye.w));
  const SeaSlopes s = sea_slopes(here, over, have);
  const vec2 slope = sea_slope(s) - p.relative.xz * frame.viewer.w;
  normal = normalize(vec3(-slope.x, 1.0, -slope.y));
  const vec3 var = max(s.variance, vec3(0.0, 0.0, -1.0));
  float hidden;
  vec3 lit = facets_from_below(ray, slope, var, p, here, max(length(p.along), length(p.across)), hidden);
  float covered = 0.0;
  if (foam) covered = foam_cover(p, s, var);
  // Bubbles let about half of the light through, evenly to all sides.
  if (foam) lit = mix(lit, 0.4 * water_lit() / (pi * water_index * water_index), 0.94 * covered);
  const vec3 attenuation = frame.water_absorption.rgb + frame.water_backscatter.rgb,
             u = frame.water_backscatter.rgb / attenuation;
  float wet = range;
  SeenThrough seen;
  if (air_pockets + portals > 0) seen = seen_through(view.eye.xyz, ray, range);
  if (air_pockets + portals > 0) wet = seen.wet;
  lit *= exp(-1.03 * sqrt(1.0 + 2.4 * u) * attenuation * wet);
  lit += (1.0 - covered) * (1.0 - hidden) * sun_through_facets(ray, l, slope, var) *
         exp(-(frame.water_absorption.rgb + frame.water_scattering.rgb) * wet);
  if (air_pockets + portals > 0) return seen.share * lit + seen.added;
  return lit + water_added_to_eye(view.eye.xyz, ray, 0.0, range, 0.0);
}
