// Foam on the water: what breaks now, what has stayed, and the lace that it breaks up into. Part of lib/sea_light.glsl;
// the C++ twin of what it reads is ocean/foam/foam.h.

layout(constant_id = value_foam_kept) const bool foam_kept = false;      // it is simulated around the viewer
layout(constant_id = value_foam_spared) const bool foam_spared = false;  // inputs take foam away
layout(binding = slot_foam) uniform texture2DArray foam_windows;  // the share covered; what is left of breaking waves
layout(binding = slot_foam_lace) uniform texture2DArray foam_lace;

// Two ways that the pattern has been carried by a current, and the first one's share.
struct FoamWay {
  vec2 first, second;
  float share;
};

vec2 foam_texel(int slice, vec2 rest) {
  const int layer = lod_layer(frame.foam.windows.first_layer, slice, frame.foam.windows.slices);
  return textureLod(sampler2DArray(foam_windows, smooth_sampler),
                    vec3(lod_coordinates(frame.foam.windows.slice[slice], rest), float(layer)), 0.0)
      .rg;
}

// The share of a footprint that foam covers, and what inputs leave of the foam of waves that break.
vec2 foam_covered(vec2 rest, float footprint) {
  const LodRead read = lod_read(frame.foam.windows.reach, frame.foam.windows.slices,
                                lod_distance(rest - frame.foam.windows.viewer), footprint);
  const vec2 outside = vec2(frame.foam.look.z, 1.0);
  if (read.present <= 0.0) return outside;
  vec2 value = foam_texel(read.fine, rest);
  if (read.coarser > 0.0) value = mix(value, foam_texel(read.fine + 1, rest), read.coarser);
  return mix(outside, value, read.present);
}

// A place of a laying where the wind has drawn it out, or a slope there.
vec2 foam_drawn_out(vec2 v, float taken) { return v - taken * dot(v, frame.foam.wind.xy) * frame.foam.wind.xy; }

// A laying's share of the tile that is covered before this place, its slope along the tile's axes, 1/m, and fine
// bubbles.
vec4 foam_laying(vec2 rest, vec2 origin, float side, float footprint) {
  const float a_metre = foam_lace_texels / side;
  vec4 texel = textureLod(sampler2DArray(foam_lace, smooth_sampler), vec3(rest / side + origin, 0.0),
                          mip_level(footprint * a_metre));
  texel.yz = (texel.yz - 128.0 / 255.0) * (255.0 / 1024.0) * a_metre;
  return texel;
}

// Of the first laying and, as a pixel takes in more, of the second, none or the third. `covered`: the third has more of
// it here and less there, so that no tile is seen to come again.
vec4 foam_lacing(vec2 place, float footprint, inout float covered) {
  float b = 0.55 * clamp(footprint / 0.12 - 1.0, 0.0, 1.0) + 0.45 * clamp(footprint / 0.4 - 1.0, 0.0, 1.0),
        turn = -foam_turn_sin, taken = frame.foam.wind.w;
  const vec2 rest = foam_drawn_out(place, frame.foam.wind.z);
  vec4 first = vec4(0.0);
  if (b < 1.0) {
    first = foam_laying(rest, frame.foam.origin.xy, foam_side_m, footprint);
    first.yz = foam_drawn_out(first.yz, frame.foam.wind.z);
  }
  const vec2 wide = foam_drawn_out(place, frame.foam.wind.w);
  const vec2 one_way =
      vec2(foam_turn_cos * wide.x - foam_turn_sin * wide.y, foam_turn_cos * wide.y + foam_turn_sin * wide.x);
  vec4 second = foam_laying(one_way, frame.foam.look.xy, foam_wide_side_m, max(footprint, 0.2));
  covered *= mix(0.4 + 1.2 * second.x, 1.0, clamp(b * 2.0, 0.0, 1.0));
  if (footprint < 0.12) {
    const vec2 other_way =
        vec2(foam_turn_cos * rest.x + foam_turn_sin * rest.y, foam_turn_cos * rest.y - foam_turn_sin * rest.x);
    second = foam_laying(other_way, frame.foam.origin.zw, foam_fine_side_m, footprint);
    b = 0.42 * clamp(2.0 - footprint / 0.06, 0.0, 1.0);
    turn = foam_turn_sin;
    taken = frame.foam.wind.z;
  }
  if (b < 0.01) return first;
  second.yz = foam_drawn_out(
      vec2(foam_turn_cos * second.y - turn * second.z, foam_turn_cos * second.z + turn * second.y), taken);
  // The sum of two even numbers is below s in so many cases: a trapezium's integral.
  const float a = 1.0 - b, s = a * first.x + b * second.x, low = min(a, b), high = max(a, b),
              corners = 2.0 * max(a * b, 1e-6);
  const float below = s < low    ? s * s / corners
                      : s > high ? 1.0 - (1.0 - s) * (1.0 - s) / corners
                                 : (s - 0.5 * low) / high;
  return vec4(below, a * first.yz + b * second.yz, mix(first.w, second.w, b));
}

// Share of the footprint whose Jacobian is below the threshold, taken as Gaussian (Dupuy and Bruneton 2012). The spread
// of the divergence of a linear choppy sea is chop times that of its slope. `variance`: of the slopes within the pixel.
float foam_breaking(SeaSlopes s, vec3 variance) {
  const float sigma =
      frame.sea.tail.w * sqrt(max(variance.x + variance.y - frame.sea.tail.x - frame.sea.tail.y, 0.0)) + 0.06;
  return frame.whitecap.x * 0.5 * erfc_approx((sea_jacobian(s) - frame.whitecap.y) / (1.4142136 * sigma));
}

float foam_footprint(SurfacePoint p) { return min(max(length(p.along), length(p.across)), 1e3); }

// Of the footprint, what foam covers.
float foam_cover(SurfacePoint p, SeaSlopes s, vec3 variance) {
  const float breaking = foam_breaking(s, variance);
  if (!foam_kept) return clamp(breaking, 0.0, 0.9);
  const vec2 kept = foam_covered(p.rest, foam_footprint(p));
  float breaks = breaking;
  if (foam_spared) breaks *= kept.y;
  return clamp(kept.x + (1.0 - kept.x) * breaks, 0.0, 1.0);
}

// Lays what covers the water over its light. `variance`: of the slopes within the pixel; `sunlit`: on the surface;
// `white`: what a white cloth would send to the eye.
void lay_foam(inout vec3 lit, SurfacePoint p, SeaSlopes s, vec3 variance, vec3 normal, float sunlit, vec3 white,
              FoamWay way) {
  const float covered = foam_cover(p, s, variance), footprint = foam_footprint(p);
  if (!foam_kept) {
    lit = mix(lit, 0.7 * white, covered);
    return;
  }
  if (covered < 0.002) return;
  // Bubbles beneath send light back that water has coloured.
  const vec3 veiled = white * 0.2 * exp(-3.0 * frame.water_absorption.rgb);
  lit = mix(lit, veiled, 0.35 * smoothstep(0.0, 0.7, covered));
  // Broken up as far as a pixel lets it be seen; beyond that its mean.
  const float near = clamp(2.0 - footprint / 1.2, 0.0, 1.0);
  float opaque = covered;
  vec3 shone = white;
  if (near > 0.0) {
    float here = covered, there = covered;
    vec4 lace = foam_lacing(p.rest - way.first, footprint, here);
    if (way.share < 1.0) {
      lace = mix(foam_lacing(p.rest - way.second, footprint, there), lace, way.share);
      here = mix(there, here, way.share);
    }
    // Its edge is a few bubbles deep and lets water through; within it grows thick.
    const float soft = 0.16 + 0.25 * clamp(footprint / 1.2, 0.0, 1.0), reached = foam_reach(min(here, 1.0));
    const float edge = smoothstep(lace.x - soft, lace.x + soft, reached * (1.0 + 2.0 * soft) - soft),
                thick = foam_thickness(reached - lace.x);
    opaque = mix(covered, edge * mix(foam_thin, 1.0, thick), near);
    // Thick foam stands higher than thin: its own slope, and bubbles that shade each other.
    const vec3 lean = normalize(normal - 0.05 * near * vec3(-lace.y, 0.0, -lace.z));
    shone = (light.sky_irradiance.rgb + sunlit * light.sun_irradiance.rgb * max(dot(lean, frame.sun.xyz), 0.0)) / pi;
    shone *= mix(1.0, 0.7 + 0.3 * thick + 0.2 * (lace.w - 0.5), near);
  }
  lit = mix(lit, 0.8 * shone, 0.94 * opaque);
}
