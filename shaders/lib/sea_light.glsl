// The light that comes from a point of the sea. Included after the uniform block `frame` has been declared.
#ifndef SEASCAPE_SEA_LIGHT_GLSL
#define SEASCAPE_SEA_LIGHT_GLSL
#include "shared/facets.h"
#include "lib/mesh.glsl"
#include "lib/sea.glsl"
#include "lib/sky_light.glsl"
#include "lib/sun_map.glsl"
#include "lib/water_light.glsl"

layout(constant_id = value_foam) const bool foam = false;
// Data of places (lib/sea.glsl).
layout(constant_id = value_albedo) const int water_albedo = 0;
layout(binding = slot_albedo) uniform texture2DArray
    water_albedo_windows;  // a colour that lies on the water, times its cover; the cover
layout(constant_id = value_shadow) const int water_shadow = 0;
layout(binding = slot_shadow) uniform texture2DArray
    water_shadow_windows;  // light kept away from within the water, and from its surface

#include "lib/albedo.glsl"

// What the drawn surface says of one pixel.
struct SurfacePoint {
  vec3 relative;       // metres from the viewer, world axes
  vec2 rest;           // rest position, metres from the grid origin
  vec2 place;          // where it stands, metres from the grid origin
  vec2 along, across;  // of the rest position, a pixel to the right and a pixel down
  vec2 height_shear;   // x: above the curved still sea, metres; y: dDx/dz
  vec4 derivatives;    // of the cascades that vertices carry
  bool ramp;           // of a triangle that joins water and land
};

#include "lib/underwater.glsl"
#include "lib/foam.glsl"
#include "lib/sea_bed_light.glsl"
#include "lib/solids_in_water.glsl"

// The sun in the facets that mirror it (Cox and Munk 1954): slopes are Gaussian, and its disc widens them. `v` and `l`:
// to the eye and to the sun; `var`: the slopes' variances and covariance; `seen`: of the facets, what the eye sees.
vec3 sun_glitter(vec3 v, vec3 l, vec2 slope, vec3 var, float seen) {
  const vec3 half_way = normalize(v + l);
  if (half_way.y <= 0.01 || l.y <= -0.02) return vec3(0.0);
  const vec2 d = -half_way.xz / half_way.y - slope;
  const float disc = 6e-6;
  const float xx = var.x + disc, zz = var.y + disc;
  const float xz = clamp(var.z, -0.98 * sqrt(xx * zz), 0.98 * sqrt(xx * zz));
  const float determinant = xx * zz - xz * xz;
  const float exponent = -0.5 * (zz * d.x * d.x - 2.0 * xz * d.x * d.y + xx * d.y * d.y) / determinant;
  if (exponent <= -16.0) return vec3(0.0);
  const float density = exp(exponent) / (2.0 * pi * sqrt(determinant));
  const float hidden = 1.0 + smith_lambda(max(l.y, 0.0), 0.5 * (xx + zz));
  const float h2 = half_way.y * half_way.y;
  return light.sun_irradiance.rgb * frame.water_backscatter.w * density * fresnel(dot(v, half_way)) /
         (4.0 * max(seen, 0.02) * h2 * h2 * hidden) * min(seen * 50.0, 1.0);  // none from the backs of crests
}

// Sunlight through a crest: it enters the far side and leaves towards the eye, dimmed by the water between. The
// thickness shrinks towards the crest and on steep faces. `height`: above the still water, m.
vec3 light_through_crest(float height, vec3 v, vec3 l, vec3 normal) {
  const float hs = frame.sea.footprint.w, shown = smoothstep(-0.4, 0.8, height / max(hs, 0.05)) *
                                                  smoothstep(-0.05, 0.15, l.y) * frame.water_absorption.w;
  if (shown <= 0.0 || hs <= 0.05) return vec3(0.0);
  const vec3 absorption = frame.water_absorption.rgb, backscatter = frame.water_backscatter.rgb;
  const vec3 inside = refract(-v, normal, 1.0 / water_index);
  const float tilt = max(dot(normal.xz, v.xz), 0.0);
  const float thickness = 0.9 * hs * exp2(-2.0 * height / hs) / (0.25 + 2.0 * tilt);
  const float cosine = dot(normalize(inside + vec3(0.0, 0.2, 0.0)), l);
  const vec3 scattering = 14.0 * backscatter;  // all of it, not only what turns back
  return shown * light.sun_irradiance.rgb * henyey_greenstein(cosine, 0.72) * scattering * thickness *
         exp(-(absorption + 2.0 * backscatter) * 2.5 * thickness);
}

// The sky in the facets that the eye sees, by two of them in the plane of sight: this lifts the horizon as the sea
// does. `var`: the slopes' variances and covariance; `mirrored`: the share of light that they mirror; `seen`: of the
// facets, what the eye sees.
vec3 sky_in_facets(vec3 v, vec2 slope, vec3 var, out float mirrored, out float seen) {
  const float level = max(length(v.xz), 1e-4);
  const vec2 sight = v.xz / level;
  const float spread2 =
      max(sight.x * sight.x * var.x + sight.y * sight.y * var.y + 2.0 * sight.x * sight.y * var.z, 2e-6);
  const float lean = dot(slope, sight);
  const vec3 facets = visible_facets(v.y / level, lean, sqrt(spread2));
  seen = level * facets.z;
  mirrored = 0.0;
  vec3 sky = vec3(0.0);
  for (int i = 0; i < 2; ++i) {
    const vec2 q = slope + (facets[i] - lean) * sight;
    const vec3 n = normalize(vec3(-q.x, 1.0, -q.y));
    const float f = 0.5 * fresnel(dot(v, n));
    vec3 r = reflect(-v, n);
    r.y = abs(r.y);  // a ray that goes down meets another wave, which shows the sky in turn
    sky += f * textureLod(sky_map, sky_coordinate(r), 0.0).rgb;
    mirrored += f;
  }
  return sky;
}

// Radiance towards the eye, haze included; `normal` is the one it was lit by.
vec3 sea_light(SurfacePoint p, ViewData view, out vec3 normal) {
  const vec3 to_eye = view.eye.xyz - p.relative, l = frame.sun.xyz;
  const float range = length(to_eye);
  const vec3 v = to_eye / range;
  const SeaFootprint over = sea_footprint(p.along, p.across);
  const SeaPlace here = sea_place(p.rest, over.blur);
  const float above = p.height_shear.x - here.level.x;  // the drawn water over the still one, metres
  vec2 sunlit = vec2(1.0);                              // within the water, on its surface
  if (water_shadow > 0)
    sunlit = max(sunlit - laid_sum(place_laid(water_shadow_windows, water_shadow, p.place, p.rest)).xy, 0.0);
  if (sun_map_there)
    sunlit *= sun_reaches(vec3(p.place.x - frame.viewer.x, p.height_shear.x, p.place.y - frame.viewer.y), vec3(0.0));
  const float sea_bed_footprint = max(length(p.along), length(p.across));
  Bed sea_bed_below;
  if (sea_bed) sea_bed_below = bed_at(p, here, above, v, sea_bed_footprint);
  if (sea_bed && water_clip &&
      water_clip_dries(
          p.rest,
          vec3(p.place.x, above < 0.02 - sea_bed_below.still_depth ? here.level.x : p.height_shear.x, p.place.y)))
    sea_bed_below.water = 0.0;
  float water = 1.0;  // the share of the pixel that is no land
  if (sea_bed) water = sea_bed_below.water;

  vec3 lit = vec3(0.0), white = vec3(0.0);  // white: what a white cloth on the water would send to the eye
  normal = vec3(0.0, 1.0, 0.0);
  if (water > 0.0) {
    const CarriedSlopes have =
        CarriedSlopes(p.derivatives, p.height_shear.y, mesh_spacing(p.rest), level_blur(to_eye, view.eye.w));
    const SeaSlopes s = sea_slopes(here, over, have);
    // Slopes are over the still sea, which itself leans away with the earth's curve.
    const vec2 slope = sea_slope(s) - p.relative.xz * frame.viewer.w;
    normal = normalize(vec3(-slope.x, 1.0, -slope.y));
    const vec3 var = max(s.variance, vec3(2e-6, 2e-6, -1.0));
    float mirrored, seen;
    const vec3 sky = sky_in_facets(v, slope, var, mirrored, seen);
    const vec3 glitter = sun_glitter(v, l, slope, var, seen);

    // Light from below: irradiance that enters, scattered back and out again.
    const vec3 down = light.sky_irradiance.rgb * 0.93 + sunlit.x * light.sun_irradiance.rgb * frame.water_reflectance.w;
    const vec3 deep = frame.water_reflectance.rgb * down, inside = refract(-v, normal, 1.0 / water_index);
    vec3 below = deep;
    float ground = 1e9;  // how deep it lies where the eye sees it, m
    if (sea_bed)
      below =
          bed_through_water(sea_bed_below, here.level.x, deep, down, p.place, inside, above, sea_bed_footprint, ground);
    if (solids_in_water) lay_solids_in_water(below, ground, p.relative, inside, deep, down, view);
    const float height = clamp(above, -2.0 * frame.sea.footprint.w, 2.0 * frame.sea.footprint.w);
    const vec3 through = light_through_crest(height, v, l, normal);
    lit = sky + (1.0 - mirrored) * (below + sunlit.x * through) + sunlit.y * glitter;

    white = (light.sky_irradiance.rgb + sunlit.y * light.sun_irradiance.rgb * max(dot(normal, l), 0.0)) / pi;
    if (lamp_carried && lamp_shines()) white += lamp_on(p.relative, normal) / pi;
    FoamWay foam_way = FoamWay(vec2(0.0), vec2(0.0), 1.0);
    if (foam_kept && sea_flow)
      foam_way =
          FoamWay(here.flow * frame.sea.place.flow.x, here.flow * frame.sea.place.flow.y, frame.sea.place.flow.z);
    if (foam) lay_foam(lit, p, s, var, normal, sunlit.y, white, foam_way);
  }
  if (sea_bed && water <= 0.0) normal = normalize(vec3(-sea_bed_below.slope.x, 1.0, -sea_bed_below.slope.y));
  if (sea_bed && water <= 0.0)
    white = (light.sky_irradiance.rgb + sunlit.y * light.sun_irradiance.rgb * max(l.y, 0.0)) / pi;
  if (sea_bed && water < 1.0)
    lit = mix(bed_land(sea_bed_below, p.place, p.relative, v, sunlit.y, sea_bed_footprint), lit, water);

  if (water_albedo > 0) lay_albedo(lit, p.place, p.rest, white);
  return through_air(lit, v, range);
}
#include "lib/sea_from_below.glsl"
#endif
