#version 460
// What the drawn surface says of each pixel, kept for surface_light.frag to light once, however many triangles met
// there.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sea.glsl"
#include "lib/water_shapes.glsl"

layout(location = 0) in vec3 relative;  // where shapes cut the surface: metres from the viewer, world axes

layout(location = 1) in vec2 rest;
layout(location = 3) in vec4 derivatives;
layout(location = 5) in vec4 shift_shear;
layout(location = 2) in vec3 water_clip_height;  // x: above the curved still sea, metres

// Bits: a float may not pass through a picture unchanged, an integer does. What is not drawn is known by its depth.
layout(location = 0) out uvec4 kept_point;  // the shift; then as half floats the vertices' derivatives (two words);
                                            // shear and footprint, which is below 0 on a ramp
layout(location = 1) out uvec2
    footprint;  // as half floats the rest position's change along x and along y, where samplers make use of both

void main() {
  bool dry = false;
  if (water_clip)
    dry =
        water_clipped(rest + shift_shear.xy, vec3(rest.x + shift_shear.x, water_clip_height.x, rest.y + shift_shear.y));
  if (sea_bed && water_clip)
    dry = water_clip_cuts(rest + shift_shear.xy,
                          vec3(rest.x + shift_shear.x, water_clip_height.x, rest.y + shift_shear.y));
  if (air_pockets + portals > 0) dry = dry || surface_is_cut(relative, frame.view[eye_index()].eye.xyz);
  const vec2 along = dFdx(rest), across = dFdy(rest);
  if (dry) discard;
  float longest = min(sqrt(max(dot(along, along), dot(across, across))), 6e4);
  if (sea_bed) longest = joins_land(shift_shear.w) ? -max(longest, 1e-4) : longest;
  kept_point = uvec4(packSnorm2x16(shift_shear.xy / frame.sea.footprint.x), packHalf2x16(derivatives.xy),
                     packHalf2x16(derivatives.zw), packHalf2x16(vec2(shift_shear.z, longest)));
  if (anisotropy > 1.0)
    footprint = uvec2(packHalf2x16(clamp(along, -6e4, 6e4)), packHalf2x16(clamp(across, -6e4, 6e4)));
}
