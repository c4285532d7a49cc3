#version 460
// The sea's surface: patches of the quadtree and the horizon skirt, displaced by the waves and curved as the earth is.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "shared/phase.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/mesh.glsl"
#include "lib/sea.glsl"
#include "lib/water_shapes.glsl"
#include "lib/patch_of_instance.glsl"

// Writes each vertex's position to a buffer: only in tests, which compare it with the wave field.
layout(constant_id = value_probe) const bool probe = false;
layout(constant_id = value_debug) const bool debug = false;
layout(constant_id = value_underwater) const bool underwater = false;  // an eye may be in the water
layout(constant_id = value_deferred) const bool deferred = false;      // pixels have their place from their depth
layout(std430, binding = slot_probe) buffer Probe {
  vec4 probed[];
};  // rest x, z (from the grid origin), footprint, 0; then position relative to the viewer before curving

layout(location = 0) out vec3 place;  // metres from the viewer, world axes
layout(location = 1) out vec2 rest;   // rest position, metres from the grid origin
layout(location = 2) out vec3
    height_shear;  // x: above the curved still sea, metres; y: dDx/dz; z: 1 on land, 0 on water
layout(location = 3) out vec4 derivatives;  // of the cascades that vertices carry
layout(location = 4) flat out uint flags;
layout(location = 5) out vec4
    shift_shear;  // deferred, instead of height_shear: the way from the rest position in x and z, metres; dDx/dz; land
layout(location = 6) out vec2 rest_at_middle;   // forward: the rest position once more (surface_pixels.glsl)
layout(location = 7) out vec2 place_at_middle;  // forward, with eyes in the water: where it stands, x and z

void main() {
  int number, i, j;
  const PatchInstance p = patch_of_vertex(number, i, j);
  if ((p.flags & patch_nothing) != 0u) {
    gl_Position = vec4(0.0, 0.0, -1.0, 1.0);  // before the near plane
    return;
  }
  const MeshVertex stands = mesh_vertex(p, i, j);
  rest = stands.rest;
  const vec2 from_viewer = rest - frame.viewer.xy;
  const float spacing = mesh_spacing(rest), displaced = stands.footprint;
  const SeaPlace here = sea_place(rest, displaced);
  const vec4 d = sea_displacement(here, displaced);
  vec3 relative = curved(from_viewer + d.xz, d.y, frame.viewer.w);
  relative.y -= frame.viewer.z;
  if (!deferred || air_pockets + portals > 0) place = relative;
  if (!deferred) rest_at_middle = rest;
  if (!deferred && underwater) place_at_middle = relative.xz;
  if (deferred && water_clip && (water_clip_kinds & (sea_bed ? 8 : 6)) != 0) height_shear = vec3(d.y, 0.0, 0.0);
  float land = 0.0;
  if (sea_bed) land = d.y <= here.bed.here.x ? 1.0 : 0.0;
  if (deferred)
    shift_shear = vec4(d.xzw, land);
  else
    height_shear = vec3(d.yw, land);
  const ViewData view = frame.view[eye_index()];
  derivatives = sea_carried(here, spacing, level_blur(view.eye.xyz - relative, view.eye.w));
  if (debug && !deferred) flags = p.flags;
  if (probe) {
    const int side = patch_quads + 1;
    const int at = 2 * (((gl_InstanceIndex * patches_an_instance + number) * side + j) * side + i);
    probed[at] = vec4(rest, displaced, 0.0);
    probed[at + 1] = vec4(from_viewer + d.xz, d.y, 0.0);
  }
  gl_Position = view.clip_from_relative * vec4(relative, 1.0);
}
