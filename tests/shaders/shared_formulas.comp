#version 460
// The formulas that C++ and GLSL share, of the numbers that a test gives.
#extension GL_GOOGLE_include_directive : require
#include "shared/flow_height.h"
#include "shared/surface_slope.h"

layout(local_size_x = 64) in;
struct Given {
  vec4 height_shift;  // dh/dx, dh/dz, dDx/dx, dDz/dz
  vec4 shear_decay;   // dDx/dz; how fast two patterns cease to be alike, 1/m^2
  vec4 way;           // xy: between them, m
};
layout(std430, binding = 0) readonly buffer In { Given given[]; };
layout(std430, binding = 1) writeonly buffer Out { vec4 found[]; };  // slope, Jacobian, height of the patterns

void main() {
  const Given g = given[gl_GlobalInvocationID.x];
  const vec2 slope = surface_slope(g.height_shift.x, g.height_shift.y, g.height_shift.z, g.height_shift.w,
                                   g.shear_decay.x, g.shear_decay.x);
  found[gl_GlobalInvocationID.x] =
      vec4(slope, surface_jacobian(g.height_shift.z, g.height_shift.w, g.shear_decay.x, g.shear_decay.x),
           flow_height(g.shear_decay.y, g.shear_decay.z, g.shear_decay.w, g.way.x, g.way.y, 0.3));
}
