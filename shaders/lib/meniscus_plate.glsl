// The lens as a plate that water wets: the near plane of an eye. Included after the uniform block `frame`.
#ifndef SEASCAPE_MENISCUS_PLATE_GLSL
#define SEASCAPE_MENISCUS_PLATE_GLSL
#include "shared/meniscus.h"

struct Plate {
  vec3 ahead;     // its normal, away from the eye
  vec3 over;      // upwards from the water's mean plane at the eye: waves have their weight at right angles to it
  vec3 up;        // along the plate, away from the water
  float wall;     // the angle at which a surface that wets it leaves it, from the water's plane
  float rises_m;  // how far up the plate the water stands
};

// The water's plane is one for the whole picture, so that neighbouring ribbons join.
Plate plate_before(ViewData view) {
  Plate plate;
  const mat4 clip = view.clip_from_relative;
  plate.ahead = normalize(vec3(clip[0].w, clip[1].w, clip[2].w));
  const vec2 slope = frame.water_at_eye[eye_index()].yz;
  plate.over = normalize(vec3(-slope.x, 1.0, -slope.y));
  const vec3 up = plate.over - plate.ahead * dot(plate.ahead, plate.over);
  plate.up = length(up) > 1e-3 ? normalize(up) : vec3(0.0);
  // Of an eye that looks straight up or down the water stands along the plate: its edge is far off, or a film.
  plate.wall = acos(clamp(dot(plate.ahead, plate.over), -0.94, 0.94));
  plate.rises_m = capillary_length_m * meniscus_height(plate.wall) / sin(plate.wall);
  return plate;
}
#endif
