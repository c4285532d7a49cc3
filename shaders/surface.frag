#version 460
// The light that comes from a pixel of the sea.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "shared/facets.h"
#include "shared/patch_instance.h"
#include "lib/view.glsl"

layout(binding = 0) uniform Frame { FrameData frame; };
#include "lib/sea.glsl"
#include "lib/sky.glsl"
#include "lib/tone.glsl"
#include "lib/water_light.glsl"

layout(binding = 4) uniform sampler2D sky_map;
layout(binding = 5) uniform Light { SkyLight light; };

layout(constant_id = 2) const bool tile_shape = false;  // tone mapping here, in the tile
layout(constant_id = 3) const bool foam = false;
layout(constant_id = 4) const bool debug = false;
layout(constant_id = 5) const float anisotropy = 1.0;

// Centroid: at the edge of a crest a multisampled pixel would else extrapolate past it, to places without sense.
layout(location = 0) centroid in vec3 relative;
layout(location = 1) centroid in vec2 rest;
layout(location = 2) centroid in vec2 height_shear;
layout(location = 3) centroid in vec4 derivatives;
layout(location = 4) flat in uint flags;

layout(location = 0) out vec4 colour;

vec3 debug_colour(vec3 lit, vec3 normal) {
  if (frame.grid.w == debug_lod) {
    const uint level = patch_level(flags);
    const vec3 tint = (flags & patch_skirt) != 0u ? vec3(0.5) : 0.5 + 0.5 * cos(vec3(0.0, 2.1, 4.2) + float(level) * 1.7);
    return mix(vec3(luminance(lit)), tint, 0.6);
  }
  if (frame.grid.w == debug_normals) return 0.5 + 0.5 * normal;
  if (frame.grid.w == debug_wireframe) return vec3(0.9);
  if (frame.grid.w == debug_slices) {  // the displacement of each cascade's tile, side by side on the water
    const int i = int(mod(floor(rest.x / 16.0), float(cascade_count)));
    vec3 d = texture(sea_longest_displacement, vec3(fract(rest / 16.0), 0.0)).xyz;
    if (cascade_count > 1 && i > 0) d = texture(sea_displacement_tiles, vec3(fract(rest / 16.0), float(i - 1))).xyz;
    return 0.5 + 0.5 * d / max(frame.sea.footprint.w, 0.1);
  }
  return lit;
}

void main() {
  const ViewData view = frame.view[eye_index()];
  const float height = clamp(height_shear.x, -2.0 * frame.sea.footprint.w, 2.0 * frame.sea.footprint.w);
  const vec3 to_eye = view.eye.xyz - relative;
  const float range = length(to_eye);
  const vec3 v = to_eye / range;
  const CarriedSlopes have = CarriedSlopes(derivatives, height_shear.y, vertex_footprint(rest), level_blur(to_eye, view.eye.w, anisotropy));
  const SeaSlopes s = sea_slopes(rest, dFdx(rest), dFdy(rest), anisotropy, have);
  // Slopes are over the still sea, which itself leans away with the earth's curve.
  const vec2 slope = sea_slope(s) - relative.xz * frame.skirt.w;
  const vec3 normal = normalize(vec3(-slope.x, 1.0, -slope.y));

  // The facets that the eye sees, by two of them in the plane of sight: this lifts the horizon as the sea does.
  const float level = max(length(v.xz), 1e-4);
  const vec2 sight = v.xz / level;
  const vec3 var = max(s.variance, vec3(2e-6, 2e-6, -1.0));
  const float spread2 = max(sight.x * sight.x * var.x + sight.y * sight.y * var.y + 2.0 * sight.x * sight.y * var.z, 2e-6);
  const float lean = dot(slope, sight);
  const vec3 facets = visible_facets(v.y / level, lean, sqrt(spread2));
  const float seen = level * facets.z;
  vec3 reflected = vec3(0.0);
  float mean_fresnel = 0.0;
  for (int i = 0; i < 2; ++i) {
    const vec2 q = slope + (facets[i] - lean) * sight;
    const vec3 n = normalize(vec3(-q.x, 1.0, -q.y));
    const float f = 0.5 * fresnel(dot(v, n));
    vec3 r = reflect(-v, n);
    r.y = abs(r.y);  // a ray that goes down meets another wave, which shows the sky in turn
    reflected += f * textureLod(sky_map, sky_coordinate(r), 0.0).rgb;
    mean_fresnel += f;
  }

  // The sun in the facets that mirror it (Cox and Munk 1954): slopes are Gaussian, and its disc widens them.
  const vec3 l = frame.sun.xyz;
  const vec3 half_way = normalize(v + l);
  vec3 glitter = vec3(0.0);
  if (half_way.y > 0.01 && l.y > -0.02) {
    const vec2 d = -half_way.xz / half_way.y - slope;
    const float disc = 6e-6;
    const float xx = var.x + disc, zz = var.y + disc;
    const float xz = clamp(var.z, -0.98 * sqrt(xx * zz), 0.98 * sqrt(xx * zz));
    const float determinant = xx * zz - xz * xz;
    const float exponent = -0.5 * (zz * d.x * d.x - 2.0 * xz * d.x * d.y + xx * d.y * d.y) / determinant;
    if (exponent > -16.0) {
      const float density = exp(exponent) / (2.0 * pi * sqrt(determinant));
      const float hidden = 1.0 + smith_lambda(max(l.y, 0.0), 0.5 * (xx + zz));
      const float h2 = half_way.y * half_way.y;
      glitter = light.sun_irradiance.rgb * frame.water_backscatter.w * density * fresnel(dot(v, half_way)) /
                (4.0 * max(seen, 0.02) * h2 * h2 * hidden) * min(seen * 50.0, 1.0);  // none from the backs of crests
    }
  }

  // Light from below: irradiance that enters, scattered back and out again.
  const vec3 down = light.sky_irradiance.rgb * 0.93 + light.sun_irradiance.rgb * frame.water_reflectance.w;
  const vec3 absorption = frame.water_absorption.rgb, backscatter = frame.water_backscatter.rgb;
  const vec3 below = frame.water_reflectance.rgb * down;

  // Sunlight through a crest: it enters the far side and leaves towards the eye, dimmed by the water between. The thickness
  // shrinks towards the crest and on steep faces.
  const float hs = frame.sea.footprint.w;
  vec3 through = vec3(0.0);
  if (frame.water_absorption.w > 0.0 && hs > 0.05) {
    const vec3 inside = refract(-v, normal, 1.0 / water_index);
    const float tilt = max(dot(normal.xz, v.xz), 0.0);
    const float thickness = 0.9 * hs * exp2(-2.0 * height / hs) / (0.25 + 2.0 * tilt);
    const float cosine = dot(normalize(inside + vec3(0.0, 0.2, 0.0)), l);
    const vec3 scattering = 14.0 * backscatter;  // all of it, not only what turns back
    through = frame.water_absorption.w * light.sun_irradiance.rgb * henyey_greenstein(cosine, 0.72) * scattering * thickness *
              exp(-(absorption + 2.0 * backscatter) * 2.5 * thickness) * smoothstep(-0.4, 0.8, height / hs) *
              smoothstep(-0.05, 0.15, l.y);
  }

  vec3 lit = reflected + (1.0 - mean_fresnel) * (below + through) + glitter;

  if (foam) {
    // Share of the footprint whose Jacobian is below the threshold, taken as Gaussian (Dupuy and Bruneton 2012). The spread
    // of the divergence of a linear choppy sea is chop times that of its slope.
    const float sigma = frame.sea.tail.w * sqrt(max(var.x + var.y - frame.sea.tail.x - frame.sea.tail.y, 0.0)) + 0.06;
    const float cover = 0.5 * erfc_approx((sea_jacobian(s) - frame.whitecap.y) / (1.4142136 * sigma));
    const vec3 white = 0.7 * (light.sky_irradiance.rgb + light.sun_irradiance.rgb * max(dot(normal, l), 0.0)) / pi;
    lit = mix(lit, white, clamp(cover * frame.whitecap.x, 0.0, 0.9));
  }

  // Air between: what it takes away, and what it adds: far off the sky's light from just above the horizon, beneath the
  // viewer, where no horizon lies behind, the mean of the sky's.
  // Its first half per cent is left out, so that near water need not look at the sky.
  const float haze = 1.0 - exp(-frame.air.x * range) - 0.005;
  if (haze > 0.0) {
    const vec3 horizon = textureLod(sky_map, sky_coordinate(normalize(vec3(-v.x, 0.012, -v.z))), 0.0).rgb;
    lit = mix(lit, mix(horizon, light.sky_irradiance.rgb * (0.5 / pi), smoothstep(0.05, 0.6, v.y)), haze / 0.995);
  }

  lit *= light.exposure.x * exp2(frame.air.y);
  if (debug) lit = debug_colour(lit, normal);
  if (tile_shape && !(debug && frame.grid.w > debug_lod)) lit = tone_map(lit);
  colour = vec4(min(lit, vec3(6e4)), 1.0);
}
