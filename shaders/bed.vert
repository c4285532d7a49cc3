#version 460
// The bed before an eye in the water: patches of a quadtree of its own (ocean/mesh/bed_mesh.h), as high as the windows
// of the bed have it.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/patch_of_instance.glsl"
#include "lib/sea.glsl"

layout(location = 0) out vec3 relative;  // metres from the viewer, world axes

void main() {
  int number, i, j;
  const PatchInstance p = patch_of_vertex(number, i, j);
  if ((p.flags & patch_nothing) != 0u) {
    gl_Position = vec4(0.0, 0.0, -1.0, 1.0);  // before the near plane
    return;
  }
  const vec2 stands = patch_vertex(p, i, j, frame.bed_mesh);
  const vec2 place = stands * frame.bed_mesh.unit_m + frame.bed_mesh.from_grid;
  const float footprint = displacement_footprint(frame.bed_mesh.morph, stands) * frame.bed_mesh.unit_m;
  relative = curved(place - frame.viewer.xy, sea_bed_height(place_read(place, footprint), place).x, frame.viewer.w);
  relative.y -= frame.viewer.z;
  gl_Position = frame.view[eye_index()].clip_from_relative * vec4(relative, 1.0);
}
