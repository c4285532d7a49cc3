// Lights the sea's pixels where its triangles are drawn: surface.frag, and with CLIP_EACH_SAMPLE surface_clip.frag.
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "shared/patch_instance.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sea_light.glsl"
#include "lib/tone.glsl"
#include "lib/water_side.glsl"

layout(constant_id = value_tile_shape) const bool tile_shape = false;  // tone mapping here, in the tile
layout(constant_id = value_debug) const bool debug = false;
#ifdef CLIP_EACH_SAMPLE
layout(constant_id = value_clip_samples) const int clip_samples = 4;  // of a pixel
#endif

// Centroid: at the edge of a crest a multisampled pixel would else extrapolate past it, to places without sense.
layout(location = 0) centroid in vec3 relative;
layout(location = 1) centroid in vec2 rest;
layout(location = 2) centroid in vec3 height_shear;
layout(location = 3) centroid in vec4 derivatives;
layout(location = 4) flat in uint flags;
// Centroids lie where samples are covered, elsewhere in each pixel of an edge: what is derived is known at pixels'
// middles.
layout(location = 6) in vec2 rest_at_middle;
layout(location = 7) in vec2 place_at_middle;

layout(location = 0) out vec4 colour;

vec3 debug_colour(vec3 lit, vec3 normal) {
  if (frame.shown.x == debug_lod) {
    const uint level = patch_level(flags);
    const vec3 tint =
        (flags & patch_skirt) != 0u ? vec3(0.5) : 0.5 + 0.5 * cos(vec3(0.0, 2.1, 4.2) + float(level) * 1.7);
    return mix(vec3(luminance(lit)), tint, 0.6);
  }
  if (frame.shown.x == debug_normals) return 0.5 + 0.5 * normal;
  if (frame.shown.x == debug_wireframe) return vec3(0.9);
  if (cascade_count > 0 &&
      frame.shown.x == debug_slices) {  // the displacement of each cascade's tile, side by side on the water
    const int i = int(mod(floor(rest.x / 16.0), float(cascade_count)));
    vec3 d = texture(sampler2DArray(sea_longest_displacement, pixel_sampler), vec3(fract(rest / 16.0), 0.0)).xyz;
    if (cascade_count > 1 && i > 0)
      d = texture(sampler2DArray(sea_displacement_tiles, pixel_sampler), vec3(fract(rest / 16.0), float(i - 1))).xyz;
    return 0.5 + 0.5 * d / max(frame.sea.footprint.w, 0.1);
  }
  return lit;
}

// Where a sliver along the horizon holds a sample, a driver may find its distance past infinity, and so behind the eye:
// in the right direction, turned about. It is as far as the horizon then.
vec3 ahead(vec3 found) {
  const mat4 clip = frame.view[eye_index()].clip_from_relative;
  if (dot(vec4(clip[0].w, clip[1].w, clip[2].w, clip[3].w), vec4(found, 1.0)) > 0.0) return found;
  const vec3 eye = frame.view[eye_index()].eye.xyz;
  return eye + sqrt(2.0 * max(frame.viewer.z, 1.0) / max(frame.viewer.w, 1e-9)) * normalize(eye - found);
}

// Where the water seen stands: metres from the grid origin, y above the curved still sea.
vec3 standing(vec3 seen) {
  return flattened(seen + vec3(0.0, frame.viewer.z, 0.0), frame.viewer.w) + vec3(frame.viewer.x, 0.0, frame.viewer.y);
}

void main() {
  const vec3 seen = ahead(relative), stands = standing(seen);
  const vec2 place = stands.xz;
  const vec2 along = dFdx(rest_at_middle), across = dFdy(rest_at_middle);  // before any pixel is left out
  // Over a bed what is clipped lies dry, as land, but for hulls with a floor of their own.
#ifdef CLIP_EACH_SAMPLE
  int wet = -1;
  if (water_clip && !sea_bed)
    for (int i = 0; i < clip_samples; ++i) {
      const vec3 there = standing(ahead(interpolateAtSample(relative, i)));
      if (water_clipped(there.xz, there)) wet &= ~(1 << i);
    }
  if (air_pockets + portals > 0 && surface_is_cut(seen, frame.view[eye_index()].eye.xyz)) wet = 0;
  if ((wet & ((1 << clip_samples) - 1)) == 0) discard;
  gl_SampleMask[0] = wet;
#else
  bool dry = false;
  if (water_clip) dry = water_clipped(place, stands);
  if (sea_bed && water_clip) dry = water_clip_cuts(place, stands);
  if (air_pockets + portals > 0) dry = dry || surface_is_cut(seen, frame.view[eye_index()].eye.xyz);
  if (dry) discard;
#endif
  vec3 normal;
  SurfacePoint p = SurfacePoint(seen, rest, place, along, across, height_shear.xy, derivatives, false);
  if (sea_bed) p.ramp = joins_land(height_shear.z);
  bool below = false;
  if (underwater) below = seen_from_below(along, across, dFdx(place_at_middle), dFdy(place_at_middle));
  vec3 lit;
  if (underwater && below)
    lit = sea_from_below(p, frame.view[eye_index()], normal);
  else
    lit = sea_light(p, frame.view[eye_index()], normal);
  lit *= light.exposure.x * exp2(frame.air.y);
  if (debug) lit = debug_colour(lit, normal);
  if (tile_shape && !(debug && frame.shown.x > debug_lod)) lit = tone_map(lit);
  colour = vec4(min(lit, vec3(6e4)), 1.0);
}
