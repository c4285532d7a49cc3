#version 460
// What of the near plane is in the water: bands from the line where the drawn surface passes it downwards, as far as
// the picture goes.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
layout(constant_id = value_clip) const bool water_clip = false;
#include "lib/near_line.glsl"

layout(location = 0) out vec3 line_of_sight;
layout(location = 1) out vec3 line_at;

void main() {
  const ViewData view = frame.view[eye_index()];
  const Plate plate = plate_before(view);
  vec3 end;
  bool top;
  line_of_sight = vec3(0.0);
  if (water_clip) line_at = vec3(0.0);
  gl_Position = vec4(0.0, 0.0, -1.0, 1.0);  // before the near plane
  if (!near_line(view, plate, end, top)) return;
  if (water_clip) line_at = end;
  line_of_sight = end - view.eye.xyz - (top ? 0.0 : 100.0 * frame.air.z) * plate.up;
  gl_Position = view.clip_from_relative * vec4(view.eye.xyz + 1.001 * line_of_sight, 1.0);
}
