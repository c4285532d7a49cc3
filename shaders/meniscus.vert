#version 460
// The edge of the water at the lens: a ribbon on the near plane, from the line where the drawn surface passes it up to
// where the water stands against it.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
layout(constant_id = value_clip) const bool water_clip = false;
#include "lib/near_line.glsl"

layout(location = 0) out vec3 line_of_sight;  // metres from the eye to the near plane
layout(location = 1) out float over_line;     // metres up the near plane from the line
layout(location = 2) out vec3 line_at;        // the line's place beside: metres from the viewer

void main() {
  const ViewData view = frame.view[eye_index()];
  const Plate plate = plate_before(view);
  vec3 end;
  bool top;
  line_of_sight = vec3(0.0);
  if (water_clip) line_at = vec3(0.0);
  over_line = 0.0;
  gl_Position = vec4(0.0, 0.0, -1.0, 1.0);  // before the near plane
  if (!near_line(view, plate, end, top)) return;
  const float below_m = 0.0005;  // so that no sample at the line is left out: the sides say where it ends
  over_line = top ? plate.rises_m : -below_m;
  if (water_clip) line_at = end;
  line_of_sight = end - view.eye.xyz + over_line * plate.up;
  // Nearer than all that is drawn, and farther than what hides pixels that no eye sees.
  gl_Position = view.clip_from_relative * vec4(view.eye.xyz + 1.00002 * line_of_sight, 1.0);
}
