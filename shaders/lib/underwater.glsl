// The water before an eye that is in it. Radiances here are those in the water over the square of its refractive index,
// so that they join those above it where the eye comes out. Included after the uniform block `frame` and
// lib/sky_light.glsl.
#ifndef SEASCAPE_UNDERWATER_GLSL
#define SEASCAPE_UNDERWATER_GLSL
#include "shared/water_volume.h"
#include "lib/water_light.glsl"
#include "lib/water_shapes.glsl"

layout(constant_id = value_underwater) const bool underwater = false;  // an eye may be in the water

// Sine of the angle by which a line of sight passes over the horizon; below 0 it ends in the water, if it meets
// nothing.
float over_horizon(vec3 sight, ViewData view) {
  const float h = max(frame.viewer.z + view.eye.y, 0.0), c = frame.viewer.w;
  const float dip = sqrt(2.0 * h * c + h * h * c * c) / (1.0 + h * c);  // sine of the dip (0 when flat)
  return normalize(sight).y + dip;
}

// Among shapes of air or portals: whether a line of sight that meets nothing ends in the sky, where none is in its way.
// At the horizon, where the last triangles of the sea may miss a pixel, its beginning says it, on the near plane, over
// the water as it is felt at the eye. `pixel_ray`: of the pixel, as long as its part along the line of sight's axis is
// 1.
bool ends_in_sky(vec3 pixel_ray, ViewData view) {
  if (frame.shown.y == eyes_in_water) return false;
  const float over = over_horizon(pixel_ray, view);
  if (abs(over) > view.eye.w) return over >= 0.0;
  const vec3 from = frame.air.z * pixel_ray;
  const vec4 water = frame.water_at_eye[eye_index()];
  return from.y >= water.x + dot(water.yz, from.xz);
}

// Among them: whether a line of sight that meets nothing shows no water. Where the surface is cut away within shapes or
// outside of portals, its end alone does not say it. The surface that is drawn is counted from here on
// (docs/underwater.md).
bool ends_in_air(vec3 pixel_ray, ViewData view) {
  const vec3 eye = view.eye.xyz, ray = normalize(pixel_ray);
  const LineThrough line = line_through(eye, ray);
  float wet = 0.0, out_of_it = 0.0;  // 1 in the water; how often the line leaves it in sight
  if (portals == 0) wet = ends_in_sky(pixel_ray, view) ? 0.0 : 1.0;
  float nearest = line_endless;
  for (int i = 0; i < portals; ++i) {
    const vec2 span = vec2(max(line.seen[i].x, 0.0), line.seen[i].y);
    if (span.y <= span.x) continue;
    const WaterShape s = frame.shapes.portal[i];
    const float from = below_sea(s, eye + span.x * ray), over = over_horizon(pixel_ray, view);
    float to = from;  // at the horizon, likewise
    if (span.y < 0.5 * line_endless)
      to = below_sea(s, eye + span.y * ray);
    else if (abs(over) > view.eye.w)
      to = over < 0.0 ? 1.0 : 0.0;
    out_of_it += from - to;
    if (from + to < 0.5 || span.x > nearest) continue;
    nearest = span.x;
    wet = from;
  }
  if (portals > 0) wet -= out_of_it;
  if (frame.shown.y != eyes_in_water)
    for (int i = 0; i < air_pockets; ++i) {
      const vec2 span = line.dry[i];
      if (span.x <= 0.0 || span.y <= span.x) continue;
      wet += below_sea(frame.shapes.air[i], eye + span.x * ray) - below_sea(frame.shapes.air[i], eye + span.y * ray);
    }
  return wet < 0.5;
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
// seen from above), and most around the sun. `before`: metres of water before it.
vec3 water_added(float depth, vec3 ray, float way, float before) {
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
  vec3 passed = vec3(1.0), beam_passed = vec3(1.0);
  if (before > 0.0) passed = exp(-attenuation * before);
  if (before > 0.0) beam_passed = exp(-(absorption + scattering) * before);
  vec3 sum;
  for (int i = 0; i < 3; ++i)
    sum[i] = passed[i] * spread[i] * path_sum(k[i], way) + beam_passed[i] * glow[i] * path_sum(beam[i], way);
  return sum * exp(-fading * depth);
}
vec3 water_added(float depth, vec3 ray, float way) { return water_added(depth, ray, way, 0.0); }

// How far a line of sight that begins `depth` metres below the surface goes in the water, where it meets nothing.
float way_to_surface(float depth, vec3 ray) { return min(1e4, (depth + 0.1) / max(ray.y, 1e-5)); }

// What such a line shows.
vec3 open_water(float depth, vec3 ray) { return water_added(depth, ray, way_to_surface(depth, ray)); }

#include "lib/lamp.glsl"

// What the water between `from` and `to` metres on an eye's line of sight adds, lamp and all; `wet`: metres of water
// before it.
vec3 water_added_to_eye(vec3 eye, vec3 ray, float from, float to, float wet) {
  vec3 added = water_added(depth_in_water(eye.y + from * ray.y), ray, to - from, wet);
  if (lamp_carried && lamp_shines()) added += lamp_in_water(eye, ray, from, to, from - wet);
  return added;
}

// The water on a line of sight, between shapes of air and within portals.
struct SeenThrough {
  vec3 added;     // radiance that comes from before its end
  float wet;      // metres of water
  float share;    // of the light from its end, what the water surfaces within shapes let through
  bool ends_dry;  // what it ends at stands in air
};

// What a still surface of water in a shape mirrors, seen along `ray` in the air over it, or below it.
float mirrored_by_level(float up) {
  if (up < 0.0) return fresnel(-up);
  const float sine2 = water_index * water_index * (1.0 - up * up);
  return sine2 >= 1.0 ? 1.0 : fresnel(sqrt(1.0 - sine2));
}

// A line of sight from `from` (relative to the viewer), `way` metres along `ray`. What stands within 3 cm of a shape's
// side is on the side that the line comes from, so that walls may lie in the shape's own sides.
SeenThrough seen_through(vec3 from, vec3 ray, float way) {
  const LineThrough line = line_through(from, ray);
  SeenThrough seen = SeenThrough(vec3(0.0), 0.0, 1.0, true);
  const float last = max(way - 0.03, 0.0);
  float at = 0.0;
  for (int i = 0; i <= air_pockets + portals; ++i) {
    const vec2 part = next_wet_part(line.dry, air_pockets, line.seen, portals, at);
    if (part.x >= way || seen.share <= 0.0) break;
    bool comes_down = false, goes_up = false;  // through the water of a shape's own
    for (int k = 0; k < air_pockets; ++k) {
      comes_down = comes_down || (part.x > 0.0 && line.level[k] == part.x && ray.y < 0.0);
      goes_up = goes_up || (part.y < way && line.level[k] == part.y && ray.y > 0.0);
    }
    if (comes_down) {  // over it are grey walls in what light there is
      const float depth = depth_in_water(from.y + part.x * ray.y), mirrored = mirrored_by_level(ray.y);
      const vec3 walls = 0.3 / pi * water_lit() * exp(-water_fading() * depth);
      seen.added += seen.share * mirrored * walls * water_passed(seen.wet);
      seen.share *= 1.0 - mirrored;
    }
    const float to = min(part.y, way);
    seen.added += seen.share * water_added_to_eye(from, ray, part.x, to, seen.wet);
    seen.wet += to - part.x;
    if (part.x <= last && part.y > last) seen.ends_dry = false;
    if (goes_up) {
      const float mirrored = mirrored_by_level(ray.y);
      seen.added += seen.share * mirrored * water_passed(seen.wet) *
                    open_water(depth_in_water(from.y + part.y * ray.y), vec3(ray.x, -ray.y, ray.z));
      seen.share *= 1.0 - mirrored;
    }
    at = to;
  }
  return seen;
}

// What a line of sight shows that meets nothing but the water, through which it may come to the sky.
vec3 open_water_seen(vec3 ray, ViewData view) {
  const float way = way_to_surface(depth_in_water(view.eye.y), ray);
  if (air_pockets + portals == 0) return water_added_to_eye(view.eye.xyz, ray, 0.0, way, 0.0);
  const SeenThrough seen = seen_through(view.eye.xyz, ray, way);
  if (!seen.ends_dry) return seen.added;
  return seen.added + seen.share * water_passed(seen.wet) * sky_light(ray, view.eye.w);
}

// Light of what stands in the air at `place`, with the water before it.
vec3 seen_behind_water(vec3 lit, vec3 place, ViewData view) {
  const vec3 line = place - view.eye.xyz;
  const float way = max(length(line), 1e-3);
  const SeenThrough seen = seen_through(view.eye.xyz, line / way, way);
  return seen.share * water_passed(seen.wet) * lit + seen.added;
}

// Of a thing that lies `depth` metres deep and would send `sent` just under the surface (of solid_in_water(), or of the
// bed): what it sends there along `ray`, which is as the surface throws it back at it (light_out_of_water()).
vec3 sent_in_water(vec3 sent, float depth, vec3 ray) {
  const vec3 arrives = sent * exp(-water_fading() * depth);
  const vec3 up = sent * water_column(depth, max(-ray.y, 0.3)).passed;
  const vec3 again = min(1.5 * up / max(water_lit(), vec3(1e-9)), vec3(0.48));
  return arrives / (1.0 - again);
}

// Its light after `way` metres on a line of sight along `ray`, which begins `from` metres deep; `own`: what it shines
// by itself.
vec3 light_in_water(vec3 sent, vec3 own, float depth, float from, vec3 ray, float way) {
  return (sent_in_water(sent, depth, ray) + own) / (water_index * water_index) * water_passed(way) +
         water_added(from, ray, way);
}

// The same as an eye sees it, at `place`; `of_lamp`: what it sends to the eye of the lamp's light. In air it shines by
// the index's square more.
vec3 light_in_water(vec3 sent, vec3 own, vec3 of_lamp, vec3 place, ViewData view) {
  const vec3 line = place - view.eye.xyz;
  const float way = max(length(line), 1e-3);
  const vec3 ray = line / way;
  SeenThrough seen = SeenThrough(vec3(0.0), way, 1.0, false);
  if (air_pockets + portals > 0)
    seen = seen_through(view.eye.xyz, ray, way);
  else
    seen.added = water_added_to_eye(view.eye.xyz, ray, 0.0, way, 0.0);
  const float spread_in = seen.ends_dry ? 1.0 : water_index * water_index;
  vec3 lit = (sent_in_water(sent, depth_in_water(place.y), ray) + own) * water_passed(seen.wet);
  if (lamp_carried && lamp_shines()) lit += of_lamp * exp(-lamp_attenuation() * seen.wet);
  return seen.share * lit / spread_in + seen.added;
}
#endif
