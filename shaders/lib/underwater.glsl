// The water before an eye that is in it. Radiances here are those in the water over the square of its refractive index,
// so that they join those above it where the eye comes out. Included after the uniform block `frame` and
// lib/sky_light.glsl.
#ifndef SEASCAPE_UNDERWATER_GLSL
#define SEASCAPE_UNDERWATER_GLSL
#include "shared/water_volume.h"
#include "lib/water_light.glsl"

layout(constant_id = value_underwater) const bool underwater = false;  // an eye may be in the water

// Whether a line of sight that meets nothing ends in the sky. At the horizon, where the last triangles of the sea may
// miss a pixel, its beginning says it, on the near plane, over the water as it is felt at the eye. `pixel_ray`: of the
// pixel, as long as its part along the line of sight's axis is 1.
bool ends_in_air(vec3 pixel_ray, ViewData view) {
  if (frame.shown.y == eyes_in_water) return false;
  const float h = max(frame.viewer.z + view.eye.y, 0.0), c = frame.viewer.w;
  const float dip = sqrt(2.0 * h * c + h * h * c * c) / (1.0 + h * c);  // sine of the dip (0 when flat)
  const float over_horizon = normalize(pixel_ray).y + dip;
  if (abs(over_horizon) > view.eye.w) return over_horizon >= 0.0;
  const vec3 from = frame.air.z * pixel_ray;
  const vec4 water = frame.water_at_eye[eye_index()];
  return from.y >= water.x + dot(water.yz, from.xz);
}

// Metres below the still water; `height`: relative to the viewer.
float depth_in_water(float height) { return max(frame.water_scattering.w - frame.viewer.z - height, 0.0); }

// How irradiance fades with depth, 1/m.
vec3 water_fading() { return (frame.water_absorption.rgb + frame.water_backscatter.rgb) / sun_cosine_in_water(); }

// Irradiance that has come through a level surface.
vec3 water_lit() { return 0.93 * light.sky_irradiance.rgb + light.sun_irradiance.rgb * frame.water_reflectance.w; }

// What of a thing's radiance is left after `way` metres: as from above (water_column()).
vec3 water_passed(float way) {
  const vec3 attenuation = frame.water_absorption.rgb + frame.water_backscatter.rgb,
             u = frame.water_backscatter.rgb / attenuation;
  return exp(-1.04 * sqrt(1.0 + 5.4 * u) * attenuation * way);
}

// What `way` metres of water add to a line of sight that begins `depth` metres below the surface. Looking down it comes
// to what deep water sends up (water_reflectance), as seen from above. Light that comes straight down is scattered
// forwards more than back, so upwards there is more of it (one scattering: Henyey and Greenstein's ratio to what is
// seen from above), and most around the sun.
vec3 water_added(float depth, vec3 ray, float way) {
  const vec3 absorption = frame.water_absorption.rgb, backscatter = frame.water_backscatter.rgb,
             scattering = frame.water_scattering.rgb, total = absorption + backscatter, fading = water_fading();
  const float falls = -ray.y, g = water_forward, seen_from_above = 0.66;
  const vec3 attenuation = 1.03 * sqrt(1.0 + 2.4 * backscatter / total) * total, k = attenuation + fading * falls;
  const float forwards = pow(
      (1.0 + g * g + 2.0 * g * seen_from_above) / (1.0 + g * g + 2.0 * g * clamp(falls, -0.2, seen_from_above)), 1.5);
  const vec3 deep = frame.water_reflectance.rgb * water_lit();
  const vec3 spread = deep * (attenuation + fading * max(falls, 0.0)) * forwards;

  const vec3 to_sun = -refract(-frame.sun.xyz, vec3(0.0, 1.0, 0.0), 1.0 / water_index);
  const float around = henyey_greenstein(dot(to_sun, ray), g) - henyey_greenstein(0.0, g);
  const vec3 on_plane = light.sun_irradiance.rgb * (frame.water_reflectance.w / (to_sun.y * water_index * water_index));
  const vec3 glow = scattering * max(around, 0.0) * on_plane, beam = absorption + scattering + fading * falls;
  vec3 sum;
  for (int i = 0; i < 3; ++i) sum[i] = spread[i] * path_sum(k[i], way) + glow[i] * path_sum(beam[i], way);
  return sum * exp(-fading * depth);
}

// What a line of sight that meets nothing shows; upwards it would leave the water in the end.
vec3 open_water(float depth, vec3 ray) { return water_added(depth, ray, min(1e4, (depth + 0.1) / max(ray.y, 1e-5))); }

// Light of a thing that lies `depth` metres deep and would send `sent` just under the surface (of solid_in_water(), or
// of the bed), after `way` metres on a line of sight along `ray`, which begins `from` metres deep; `own`: what it
// shines by itself.
vec3 light_in_water(vec3 sent, vec3 own, float depth, float from, vec3 ray, float way) {
  const vec3 arrives = sent * exp(-water_fading() * depth);
  // What the surface throws back lights it again (light_out_of_water()).
  const vec3 up = sent * water_column(depth, max(-ray.y, 0.3)).passed;
  const vec3 again = min(1.5 * up / max(water_lit(), vec3(1e-9)), vec3(0.48));
  return (arrives / (1.0 - again) + own) / (water_index * water_index) * water_passed(way) +
         water_added(from, ray, way);
}

// The same as an eye sees it, at `place`.
vec3 light_in_water(vec3 sent, vec3 own, vec3 place, ViewData view) {
  const vec3 line = place - view.eye.xyz;
  const float way = max(length(line), 1e-3);
  return light_in_water(sent, own, depth_in_water(place.y), depth_in_water(view.eye.y), line / way, way);
}
#endif
