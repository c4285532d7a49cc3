// sea(): what all of the surface asks about the water at a rest position, for a footprint in metres. Included after the
// uniform block `frame` (FrameData) has been declared. The C++ twin is ocean/waves/tile_sampler.h.
#ifndef SEASCAPE_SEA_GLSL
#define SEASCAPE_SEA_GLSL

layout(binding = 1) uniform sampler2DArray sea_displacement_tiles;  // Dx, h, Dz
layout(binding = 2) uniform sampler2DArray sea_derivative_tiles;    // dh/dx, dh/dz, dDx/dx, dDz/dz
layout(binding = 3) uniform sampler2DArray sea_moment_tiles;        // (dh/dx)^2, (dh/dz)^2, product, dDx/dz

// How many cascades there are: a constant, so that drivers unroll the loops over them.
layout(constant_id = 7) const int cascade_count = max_cascades;

vec2 tile_vector(CascadeData c, vec2 rest) {
  return vec2(dot(c.tile_from_rest.xy, rest), dot(c.tile_from_rest.zw, rest));
}

// Displacement in metres at `rest` (metres from the grid origin) of the waves longer than the footprint.
vec3 sea_displacement(vec2 rest, float footprint) {
  vec3 sum = vec3(0.0);
  const float last = float(frame.sea.shape.y - 1);
  for (int i = 0; i < cascade_count; ++i) {
    CascadeData c = frame.sea.cascade[i];
    const float level = log2(max(footprint / c.origin.z, 1.0));
    if (level >= last) continue;  // the whole tile lies in one footprint: its mean is zero
    sum += textureLod(sea_displacement_tiles, vec3(tile_vector(c, rest) + c.origin.xy, float(i)), level).xyz;
  }
  return sum;
}

// First and second moments of the surface's slope in a footprint.
struct SeaSlopes {
  vec2 gradient;   // mean dh/dx, dh/dz over the rest position
  vec3 shift;      // mean dDx/dx, dDz/dz, dDx/dz
  vec3 variance;   // of the slopes that the footprint does not resolve: xx, zz, xz
};

// `along`, `across`: the two axes of the footprint at the rest position, in metres.
SeaSlopes sea_slopes(vec2 rest, vec2 along, vec2 across, float anisotropy) {
  SeaSlopes s = SeaSlopes(vec2(0.0), vec3(0.0), frame.sea.tail.xyz);
  const float l0 = length(along), l1 = length(across);
  const float blur = max(min(l0, l1), max(l0, l1) / anisotropy);  // what the sampler averages at least
  for (int i = 0; i < cascade_count; ++i) {
    CascadeData c = frame.sea.cascade[i];
    if (blur > 0.5 * c.origin.w) {  // the whole tile in one sample: mean zero, all of its variance
      s.variance += c.moments.xyz;
      continue;
    }
    const vec3 at = vec3(tile_vector(c, rest) + c.origin.xy, float(i));
    const vec2 du = tile_vector(c, along), dv = tile_vector(c, across);
    const vec4 d = textureGrad(sea_derivative_tiles, at, du, dv);
    const vec4 m = textureGrad(sea_moment_tiles, at, du, dv);
    s.gradient += d.xy;
    s.shift += vec3(d.zw, m.w);
    s.variance += max(m.xyz - vec3(d.xy * d.xy, d.x * d.y), vec3(0.0, 0.0, -1.0));
  }
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
