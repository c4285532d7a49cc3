// sea(): what all of the surface asks about the water at a rest position, for a footprint in metres. Included after the
// uniform block `frame` (FrameData) has been declared. The C++ twin is ocean/waves/tile_sampler.h.
#ifndef SEASCAPE_SEA_GLSL
#define SEASCAPE_SEA_GLSL

layout(binding = 1) uniform sampler2DArray sea_displacement_tiles;  // Dx, h, Dz, dDx/dz
layout(binding = 2) uniform sampler2DArray sea_derivative_tiles;    // dh/dx, dh/dz, dDx/dx, dDz/dz
layout(binding = 3) uniform sampler2DArray sea_moment_tiles;        // (dh/dx)^2, (dh/dz)^2, product

// How many cascades there are; what is beyond is stripped.
layout(constant_id = 7) const int cascade_count = max_cascades;

vec2 tile_vector(CascadeData c, vec2 rest) {
  return vec2(dot(c.tile_from_rest.xy, rest), dot(c.tile_from_rest.zw, rest));
}

// How much of a cascade a footprint keeps: from half the cascade's longest wave on it fades, and at the whole it is gone.
float kept(CascadeData c, float footprint) { return clamp(2.0 - 2.0 * footprint / c.moments.w, 0.0, 1.0); }

void add_displacement(inout vec4 sum, int i, vec2 rest, float footprint) {
  const CascadeData c = frame.sea.cascade[i];
  const float share = kept(c, footprint);
  if (share <= 0.0) return;
  const float level = log2(max(footprint / c.origin.z, 1.0));
  sum += share * textureLod(sea_displacement_tiles, vec3(tile_vector(c, rest) + c.origin.xy, float(i)), level);
}

// Displacement in metres at `rest` (metres from the grid origin) of the waves longer than the footprint; w: dDx/dz.
vec4 sea_displacement(vec2 rest, float footprint) {
  vec4 sum = vec4(0.0);
  // Written out: drivers do not unroll a loop with so much in it, and then read its uniforms lane by lane.
  add_displacement(sum, 0, rest, footprint);
  if (cascade_count > 1) add_displacement(sum, 1, rest, footprint);
  if (cascade_count > 2) add_displacement(sum, 2, rest, footprint);
  if (cascade_count > 3) add_displacement(sum, 3, rest, footprint);
  if (cascade_count > 4) add_displacement(sum, 4, rest, footprint);
  return sum;
}

// First and second moments of the surface's slope in a footprint.
struct SeaSlopes {
  vec2 gradient;   // mean dh/dx, dh/dz over the rest position
  vec3 shift;      // mean dDx/dx, dDz/dz, dDx/dz
  vec3 variance;   // of the slopes that the footprint does not resolve: xx, zz, xz
};

void add_slopes(inout SeaSlopes s, int i, vec2 rest, vec2 along, vec2 across, float blur) {
  const CascadeData c = frame.sea.cascade[i];
  const float share = kept(c, blur);
  if (share <= 0.0) {  // all of its waves lie below the footprint: mean zero, and all of its variance
    s.variance += c.moments.xyz;
    return;
  }
  const vec3 at = vec3(tile_vector(c, rest) + c.origin.xy, float(i));
  const vec2 du = tile_vector(c, along), dv = tile_vector(c, across);
  const vec4 d = share * textureGrad(sea_derivative_tiles, at, du, dv);
  s.gradient += d.xy;
  s.shift.xy += d.zw;
  // Within a texel nothing is left unresolved: the second moments count from there to two texels.
  const float coarse = clamp(blur / c.origin.z - 1.0, 0.0, 1.0);
  if (coarse <= 0.0) return;
  const vec3 m = mix(c.moments.xyz, textureGrad(sea_moment_tiles, at, du, dv).xyz, share);
  s.variance += coarse * max(m - vec3(d.xy * d.xy, d.x * d.y), vec3(0.0, 0.0, -1.0));
}

// `along`, `across`: the two axes of the footprint at the rest position, in metres. `shear`: dDx/dz, which vertices carry.
SeaSlopes sea_slopes(vec2 rest, vec2 along, vec2 across, float anisotropy, float shear) {
  SeaSlopes s = SeaSlopes(vec2(0.0), vec3(0.0, 0.0, shear), frame.sea.tail.xyz);
  along = mix(vec2(0.0), along, lessThan(abs(along), vec2(1e5)));
  across = mix(vec2(0.0), across, lessThan(abs(across), vec2(1e5)));
  const float l0 = length(along), l1 = length(across);
  const float blur = max(min(l0, l1), max(l0, l1) / anisotropy);  // what the sampler averages at least
  add_slopes(s, 0, rest, along, across, blur);
  if (cascade_count > 1) add_slopes(s, 1, rest, along, across, blur);
  if (cascade_count > 2) add_slopes(s, 2, rest, along, across, blur);
  if (cascade_count > 3) add_slopes(s, 3, rest, along, across, blur);
  if (cascade_count > 4) add_slopes(s, 4, rest, along, across, blur);
  return s;
}

// Jacobian of the horizontal displacement: below 0 the surface folds (Tessendorf 2001, eq. 45).
float sea_jacobian(SeaSlopes s) { return (1.0 + s.shift.x) * (1.0 + s.shift.y) - s.shift.z * s.shift.z; }

// Slope of the displaced surface: the inverse transpose of (I + grad D) times the gradient over rest positions.
vec2 sea_slope(SeaSlopes s) {
  const float j = max(sea_jacobian(s), 0.15);  // where it folds, the slope of the steepest face that light still reaches
  return vec2((1.0 + s.shift.y) * s.gradient.x - s.shift.z * s.gradient.y,
              (1.0 + s.shift.x) * s.gradient.y - s.shift.z * s.gradient.x) / j;
}
#endif
