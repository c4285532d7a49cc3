// The lamp that the viewer carries: how it lights things, dry and in water, and how its beam shows in the water. Part
// of lib/underwater.glsl.
#include "shared/lamp_light.h"

layout(constant_id = value_lamp) const bool lamp_carried = false;  // it may shine

bool lamp_shines() { return frame.lamp.intensity.w > 0.0; }

// How its light fades in the water, 1/m: all that is scattered is lost to its beam.
vec3 lamp_attenuation() { return frame.water_absorption.rgb + frame.water_scattering.rgb; }

// How much of the straight way from the lamp to a place, `range` metres off, lies in water: under the still surface, in
// no pocket of air, and within portals.
float lamp_way_in_water(vec3 at, vec3 towards, float range) {
  const float level = frame.water_scattering.w - frame.viewer.z, a = level - at.y, b = level - frame.lamp.at.y;
  float wet = range;
  if (min(a, b) < 0.0) wet *= max(max(a, b), 0.0) / max(abs(a) + abs(b), 1e-6);
  if (air_pockets + portals == 0) return wet;
  const LineThrough line = line_through(frame.lamp.at.xyz, -towards);
  float among = 0.0, passed = 0.0;
  for (int i = 0; i <= air_pockets + portals; ++i) {
    const vec2 part = next_wet_part(line.dry, air_pockets, line.seen, portals, passed);
    if (part.x >= range) break;
    passed = min(part.y, range);
    among += passed - part.x;
  }
  return min(wet, among);
}

// Its light as it comes to a place (from the viewer).
struct LampThere {
  vec3 towards;     // the lamp
  vec3 irradiance;  // on a plane that faces it
};
LampThere lamp_there(vec3 at) {
  const vec3 line = frame.lamp.at.xyz - at;
  const float range = max(length(line), lamp_radius_m);
  const vec3 towards = line / range;
  const float beam = lamp_beam(-dot(towards, frame.lamp.along.xyz), frame.lamp.at.w) / (range * range);
  return LampThere(towards,
                   frame.lamp.intensity.rgb * beam * exp(-lamp_attenuation() * lamp_way_in_water(at, towards, range)));
}

// The same on a plane of normal `n`.
vec3 lamp_on(vec3 at, vec3 n) {
  const LampThere there = lamp_there(at);
  return there.irradiance * max(dot(n, there.towards), 0.0);
}

// What the water between `from` and `to` metres on a line of sight scatters of its beam to the eye (lamp_scattered());
// `dry`: metres of air before it. The lamp is near the eye, and its light passes as much air.
vec3 lamp_in_water(vec3 eye, vec3 ray, float from, float to, float dry) {
  const vec3 lamp = frame.lamp.at.xyz - eye, c = lamp_attenuation();
  const float passes = dot(lamp, ray),
              apart = sqrt(max(dot(lamp, lamp) - passes * passes, lamp_radius_m * lamp_radius_m)),
              along = dot(ray, frame.lamp.along.xyz), ahead = dot(lamp, frame.lamp.along.xyz),
              narrowness = frame.lamp.at.w;
  vec2 reach = lamp_reach(passes, apart, along, ahead, narrowness, min(c.r, min(c.g, c.b)), to);
  reach.x = max(reach.x, from);
  if (reach.y <= reach.x) return vec3(0.0);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < lamp_nodes; ++i) {
    const vec2 node = lamp_scattered(i, passes, apart, along, ahead, narrowness, reach.x, reach.y);
    sum += node.x * exp(-c * max(node.y - 2.0 * dry, 0.0));
  }
  return sum * frame.water_scattering.rgb * frame.lamp.intensity.rgb / (water_index * water_index);
}
