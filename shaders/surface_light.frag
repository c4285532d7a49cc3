#version 460
// Lights each pixel of a picture once: the sea from what surface_points.frag has kept of it, and the sky where it kept
// nothing.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sea_light.glsl"
#include "lib/tone.glsl"

layout(binding = slot_points) uniform usampler2DArray points;
layout(binding = slot_footprints) uniform usampler2DArray footprints;
layout(binding = slot_point_depths) uniform sampler2DArray depths;
layout(binding = slot_point_sides) uniform usampler2DArray sides;

layout(constant_id = value_tile_shape) const bool tile_shape = false;  // tone mapping here
layout(constant_id = value_debug) const bool debug = false;
layout(constant_id = value_models) const bool models = false;  // some points are solid things, lit already

layout(constant_id = value_hidden) const bool may_be_hidden = false;

layout(location = 0) in vec3 pixel_ray;
layout(location = 0) out vec4 colour;

void main() {
  const ivec3 at = ivec3(gl_FragCoord.xy, eye_index());
  const ViewData view = frame.view[eye_index()];
  const float depth = texelFetch(depths, at, 0).r;
  // As near as can be lies only what hidden.vert has drawn.
  if (may_be_hidden && depth == 1.0) {
    colour = vec4(0.0, 0.0, 0.0, 1.0);
    return;
  }
  vec3 lit;
  bool in_air = true;
  if (underwater) in_air = texelFetch(sides, at, 0).r >= side_in_air;
  if (depth == 0.0 && underwater && !in_air) {
    lit = open_water_seen(normalize(pixel_ray), view);
  } else if (depth == 0.0) {
    lit = sky_light(normalize(pixel_ray), view.eye.w);
  } else {
    const uvec4 kept = texelFetch(points, at, 0);
    if (models && kept.w == kept_solid) {
      colour = vec4(vec3(unpackHalf2x16(kept.x), unpackHalf2x16(kept.y).x), 1.0);
      if (tile_shape) colour.rgb = tone_map(colour.rgb);
      return;
    }
    SurfacePoint p;
    // Reversed depth without a far plane: near over the distance along the line of sight's axis, which is the ray's own
    // measure.
    p.relative = view.eye.xyz + pixel_ray * (frame.air.z / depth);
    const vec3 flat_place = flattened(p.relative + vec3(0.0, frame.viewer.z, 0.0), frame.viewer.w);
    p.place = frame.viewer.xy + flat_place.xz;
    p.rest = p.place - frame.sea.footprint.x * unpackSnorm2x16(kept.x);
    p.derivatives = vec4(unpackHalf2x16(kept.y), unpackHalf2x16(kept.z));
    const vec2 shear_footprint = unpackHalf2x16(kept.w);
    p.height_shear = vec2(flat_place.y, shear_footprint.x);
    p.ramp = shear_footprint.y < 0.0;
    p.along =
        vec2(abs(shear_footprint.y), 0.0);  // a sampler of one texel in all directions asks only how long the longer is
    p.across = p.along.yx;
    if (anisotropy > 1.0) {
      const uvec2 footprint = texelFetch(footprints, at, 0).xy;
      p.along = unpackHalf2x16(footprint.x);
      p.across = unpackHalf2x16(footprint.y);
    }
    vec3 normal;
    if (underwater && !in_air)
      lit = sea_from_below(p, view, normal);
    else
      lit = sea_light(p, view, normal);
  }
  lit *= light.exposure.x * exp2(frame.air.y);
  if (tile_shape) lit = tone_map(lit);
  colour = vec4(min(lit, vec3(6e4)), 1.0);
  if (debug && frame.shown.x == debug_holes && depth == 0.0 && in_air && is_hole(normalize(pixel_ray), view))
    colour = hole_colour(tile_shape);
}
