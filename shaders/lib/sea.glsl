// sea(): what all of the surface asks about the water at a rest position, for a footprint in metres. Included after the
// uniform block `frame` (FrameData) has been declared. The C++ twin is ocean/waves/tile_sampler.cpp.
#ifndef SEASCAPE_SEA_GLSL
#define SEASCAPE_SEA_GLSL
#include "shared/flow_height.h"
#include "shared/surface_slope.h"

// All images of the sea share two samplers, for a device allows few a stage (16 on many). Both are linear and repeat;
// that of pixels is anisotropic.
layout(binding = slot_smooth_sampler) uniform sampler smooth_sampler;
layout(binding = slot_pixel_sampler) uniform sampler pixel_sampler;

// The first cascade's tile, which has more texels, and all others.
layout(binding = slot_longest_tile) uniform texture2DArray sea_longest_displacement;
layout(binding = slot_longest_tile + 1) uniform texture2DArray sea_longest_derivatives;
layout(binding = slot_longest_tile + 2) uniform texture2DArray sea_longest_moments;
layout(binding = slot_tiles) uniform texture2DArray sea_displacement_tiles;    // Dx, h, Dz, dDx/dz
layout(binding = slot_tiles + 1) uniform texture2DArray sea_derivative_tiles;  // dh/dx, dh/dz, dDx/dx, dDz/dz
layout(binding = slot_tiles + 2) uniform texture2DArray sea_moment_tiles;      // (dh/dx)^2, (dh/dz)^2, product

// How many cascades there are; what is beyond is stripped.
layout(constant_id = value_cascades) const int cascade_count = max_cascades;
// Of the samplers of slopes; 1 where the driver has no other.
layout(constant_id = value_anisotropy) const float anisotropy = 1.0;

// Whether the first cascade's pattern is warped, as in light seas; false: nothing of it is left here.
layout(constant_id = value_warp) const bool sea_warp = false;

// A recorded loop's tile (the effect baked); 0: there is none, and nothing of it is left here.
layout(constant_id = value_baked) const int baked_layings = 0;
layout(binding = slot_baked) uniform texture2DArray baked_displacement;  // as those above
layout(binding = slot_baked + 1) uniform texture2DArray baked_derivatives;
layout(binding = slot_baked + 2) uniform texture2DArray baked_moments;

// The tile of Gerstner waves (the effect gerstner); 0: there are none, and nothing of them is left here.
layout(constant_id = value_gerstner) const int gerstner_layings = 0;
layout(binding = slot_gerstner) uniform texture2DArray gerstner_displacement;  // as those above
layout(binding = slot_gerstner + 1) uniform texture2DArray gerstner_derivatives;
layout(binding = slot_gerstner + 2) uniform texture2DArray gerstner_moments;

// Wave particles: one tile laid over the sea in up to three sizes; 0: there are none, and nothing of them is left here.
layout(constant_id = value_particles) const int particle_layings = 0;
layout(binding = slot_particles) uniform texture2DArray particle_displacement;  // as those above
layout(binding = slot_particles + 1) uniform texture2DArray particle_derivatives;
layout(binding = slot_particles + 2) uniform texture2DArray particle_moments;

// Dynamic waves: so many levels around the viewer; 0: there are none, and nothing of them is left here.
layout(constant_id = value_dynamic_levels) const int dynamic_levels = 0;
layout(binding = slot_dynamic_shift) uniform texture2DArray dynamic_shift;  // as those of displacement,
layout(binding = slot_dynamic_slope) uniform texture2DArray dynamic_slope;  // and of derivatives

// Windows of waves that belong to bodies: so many levels each; 0: there are none, and nothing of them is left here.
layout(constant_id = value_wake_levels) const int wake_levels = 0;
layout(binding = slot_wakes) uniform texture2DArray wake_windows;  // as those above: all shifts, then all slopes

// Data of places; false: there is none, and nothing of it is left here.
layout(constant_id = value_level) const bool sea_level = false;
layout(binding = slot_level) uniform texture2DArray sea_level_windows;  // the still water's height, m; its slopes
layout(constant_id = value_flow) const bool sea_flow = false;
layout(binding = slot_flow) uniform texture2DArray sea_flow_windows;  // the water's velocity along x and z, m/s
layout(constant_id = value_bed) const bool sea_bed = false;
layout(binding = slot_bed) uniform texture2DArray sea_bed_windows;      // BedTexel::bed (ocean/places/bed_field.h),
layout(binding = slot_bed_waves) uniform texture2DArray sea_bed_waves;  // its other two and slopes, four layers a slice
layout(constant_id = value_clip) const bool water_clip = false;
// Gerstner waves along curves; false: there are none, and nothing of shores is left here.
layout(constant_id = value_shore_waves) const bool shore_waves = false;

// What a tile's displacement counts for where it is laid `size` times as long; its shear is that of the tile.
vec4 laid(float size) { return vec4(size, size, size, 1.0); }

vec2 tile_vector(CascadeData c, vec2 rest) {
  return vec2(dot(c.tile_from_rest.xy, rest), dot(c.tile_from_rest.zw, rest));
}

// How much of a cascade a footprint keeps: from half the cascade's longest wave on it fades, and at the whole it is
// gone.
float kept(CascadeData c, float footprint) { return clamp(2.0 - 2.0 * footprint / c.moments.w, 0.0, 1.0); }

#include "lib/place.glsl"
#include "lib/sea_place.glsl"
#include "lib/flow.glsl"
#include "lib/sea_bed.glsl"
#include "lib/sea_warp.glsl"
#include "lib/shore.glsl"

// What is known of a rest position for a footprint in metres.
SeaPlace sea_place(vec2 rest, float footprint) {
  SeaPlace place = plain_place(rest, place_read(rest, footprint));
  if (sea_level)
    place.level = place_value(sea_level_windows, place.read, rest, vec4(frame.sea.place.outside.x, vec3(0.0))).xyz;
  if (sea_flow) place.flow = place_value(sea_flow_windows, place.read, rest, frame.sea.place.outside.zwzw).xy;
  if (sea_bed) place.bed = sea_bed_read(place.read, rest);
  if (shore_waves) place.shore = shore_read(place.read, rest);
  if (sea_warp) place.warp = sea_warp_at(rest);
  return place;
}

// Whether the water stands there, and one pattern of waves is all.
bool stands(SeaPlace place) {
  bool standing = true;
  if (sea_flow) standing = place.flow == vec2(0.0);
  return standing;
}

// `by`: what the texels' four numbers count for, beside what the footprint keeps. `number`: of the cascade, 5 of other
// sources.
void add_displacement(inout vec4 sum, texture2DArray tiles, CascadeData c, int number, float layer, vec4 by,
                      SeaPlace place, float footprint) {
  const float share = kept(c, footprint);
  if (share <= 0.0) return;
  const float level = log2(max(footprint / c.origin.z, 1.0));
  vec2 at = tile_vector(c, place.rest) + c.origin.xy;
  if (sea_bed) at += sea_bed_shift(place.bed, c, number);
  if (sea_warp) at += sea_warp_shift(place.warp, c, number);
  vec4 texel = vec4(0.0);
  if (stands(place)) texel = textureLod(sampler2DArray(tiles, smooth_sampler), vec3(at, layer), level);
  if (sea_flow && !stands(place)) texel = flow_texel(tiles, c, place.flow, vec3(at, layer), level);
  if (sea_bed) texel *= sea_bed_displaced(place.bed, number);
  sum += share * by * texel;
}

#include "lib/shore_displacement.glsl"

// What is left, at a distance from the viewer, of what fades with it: from half of a source's own distance on less, and
// at the whole nothing.
float near_viewer(vec2 rest) {
  return clamp(2.0 - 2.0 * length(rest - frame.viewer.xy) * frame.sea.footprint.y, 0.0, 1.0);
}

#include "lib/wave_windows.glsl"
#include "lib/dynamic_waves.glsl"
#include "lib/wake_waves.glsl"

#include "lib/water_clip.glsl"

// Displacement in metres at a place of the waves longer than the footprint; w: dDx/dz.
vec4 sea_displacement(SeaPlace place, float footprint) {
  vec4 sum = vec4(0.0);
  // Written out: drivers do not unroll a loop with so much in it, and then read its uniforms lane by lane.
  if (cascade_count > 0)
    add_displacement(sum, sea_longest_displacement, frame.sea.cascade[0], 0, 0.0, vec4(1.0), place, footprint);
  if (cascade_count > 1)
    add_displacement(sum, sea_displacement_tiles, frame.sea.cascade[1], 1, 0.0, vec4(1.0), place, footprint);
  if (cascade_count > 2)
    add_displacement(sum, sea_displacement_tiles, frame.sea.cascade[2], 2, 1.0, vec4(1.0), place, footprint);
  if (cascade_count > 3)
    add_displacement(sum, sea_displacement_tiles, frame.sea.cascade[3], 3, 2.0, vec4(1.0), place, footprint);
  if (cascade_count > 4)
    add_displacement(sum, sea_displacement_tiles, frame.sea.cascade[4], 4, 3.0, vec4(1.0), place, footprint);
  if (baked_layings > 0)
    add_displacement(sum, baked_displacement, frame.sea.baked, 5, 0.0, vec4(near_viewer(place.rest)), place, footprint);
  if (gerstner_layings > 0)
    add_displacement(sum, gerstner_displacement, frame.sea.gerstner, 5, 0.0, vec4(1.0), place, footprint);
  if (particle_layings > 0)
    add_displacement(sum, particle_displacement, frame.sea.particles[0], 5, 0.0, vec4(1.0), place, footprint);
  if (particle_layings > 1)
    add_displacement(sum, particle_displacement, frame.sea.particles[1], 5, 0.0, laid(particle_size_1), place,
                     footprint);
  if (particle_layings > 2)
    add_displacement(sum, particle_displacement, frame.sea.particles[2], 5, 0.0, laid(particle_size_2), place,
                     footprint);
  if (shore_waves) add_shore_displacement(sum, place, footprint);
  if (dynamic_levels > 0) add_dynamic_displacement(sum, place.rest, footprint);
  if (wake_levels > 0) add_wake_displacement(sum, place.rest, footprint);
  if (sea_level) sum.y += place.level.x;
  if (sea_bed) sum = sea_bed_land(place, sum);
  if (sea_bed && water_clip && water_clip_dries(place.rest, vec3(place.rest.x + sum.x, sum.y, place.rest.y + sum.z)))
    sum = vec4(0.0, place.bed.here.x, 0.0, 0.0);  // the bed lies dry
  return sum;
}

// How much of a cascade's slopes the vertices carry, so that pixels need not look them up: all where its shortest wave
// has six or more vertices and `blur`, what a pixel averages at least, is below a texel; none at four vertices or two
// texels.
float carried(CascadeData c, float footprint, float blur) {
  return clamp(0.5 * c.origin.w / footprint - 2.0, 0.0, 1.0) * clamp(2.0 - blur / c.origin.z, 0.0, 1.0);
}

// Times that what a pixel asks of the waves may be longer than wide: what its pipeline was made for, or less.
float longest_to_widest() { return min(anisotropy, frame.air.w); }

// What a pixel averages at least where `to_eye` leads to the eye, on a level sea; `pixel`: radians a pixel.
float level_blur(vec3 to_eye, float pixel) {
  const float across = length(to_eye) * pixel;
  return across * max(1.0, length(to_eye) / (longest_to_widest() * max(abs(to_eye.y), 1e-3)));
}

// Of a cascade's derivatives (dh/dx, dh/dz, dDx/dx, dDz/dz), those of its pattern as a bed and the warp have it.
vec4 drawn_derivatives(SeaPlace place, vec4 d, int number) {
  vec4 drawn = d;
  if (sea_bed) drawn = sea_bed_derivatives(place.bed, d, number);
  vec4 grown = vec4(0.0);
  if (sea_warp) grown = sea_warp_growth(place.warp, d, number);
  if (sea_bed) grown *= sea_bed_displaced(place.bed, number).yyxx;
  if (sea_warp) drawn += grown;
  return drawn;
}

void add_carried(inout vec4 sum, texture2DArray tiles, int i, SeaPlace place, float footprint, float blur) {
  const CascadeData c = frame.sea.cascade[i];
  const float share = carried(c, footprint, blur);
  if (share <= 0.0) return;
  vec2 at = tile_vector(c, place.rest) + c.origin.xy;
  if (sea_bed) at += sea_bed_shift(place.bed, c, i);
  if (sea_warp) at += sea_warp_shift(place.warp, c, i);
  vec4 texel = vec4(0.0);
  if (stands(place)) texel = textureLod(sampler2DArray(tiles, smooth_sampler), vec3(at, float(max(i - 1, 0))), 0.0);
  if (sea_flow && !stands(place)) texel = flow_texel(tiles, c, place.flow, vec3(at, float(max(i - 1, 0))), 0.0);
  sum += share * drawn_derivatives(place, texel, i);
}

// Derivatives that a vertex carries, of the three longest cascades: dh/dx, dh/dz, dDx/dx, dDz/dz. The others' waves are
// too short for all but the nearest vertices.
vec4 sea_carried(SeaPlace place, float footprint, float blur) {
  vec4 sum = vec4(0.0);
  if (cascade_count > 0) add_carried(sum, sea_longest_derivatives, 0, place, footprint, blur);
  if (cascade_count > 1) add_carried(sum, sea_derivative_tiles, 1, place, footprint, blur);
  if (cascade_count > 2) add_carried(sum, sea_derivative_tiles, 2, place, footprint, blur);
  return sum;
}

// First and second moments of the surface's slope in a footprint.
struct SeaSlopes {
  vec2 gradient;  // mean dh/dx, dh/dz over the rest position
  vec3 shift;     // mean dDx/dx, dDz/dz, dDx/dz
  vec3 variance;  // of the slopes that the footprint does not resolve: xx, zz, xz
};

// A mip level for a footprint of `texels`, which a driver that samples on a CPU reads in half the time where it is
// whole.
float mip_level(float texels) { return mostly_whole(log2(max(texels, 1.0))); }

// Mean of a tile over a footprint with half axes du, dv (tile coordinates), or about that of mip level `level` without
// anisotropy.
vec4 tile_mean(texture2DArray tiles, vec3 at, vec2 du, vec2 dv, float level) {
  if (anisotropy > 1.0) return textureGrad(sampler2DArray(tiles, pixel_sampler), at, du, dv);
  return textureLod(sampler2DArray(tiles, smooth_sampler), at, level);
}

#include "lib/flow_mean.glsl"

vec4 pattern_mean(texture2DArray tiles, CascadeData c, SeaPlace place, vec3 at, vec2 du, vec2 dv, float level) {
  vec4 mean = vec4(0.0);
  if (stands(place)) mean = tile_mean(tiles, at, du, dv, level);
  if (sea_flow && !stands(place)) mean = flow_mean(tiles, c, place.flow, at, du, dv, level);
  return mean;
}

// What a pixel takes in of the rest positions, metres: its two axes, and what the sampler averages at least.
struct SeaFootprint {
  vec2 along, across;
  float blur;
};

// Of two axes, of which one that is out of all bounds counts for nothing.
SeaFootprint sea_footprint(vec2 along, vec2 across) {
  along = mix(vec2(0.0), along, lessThan(abs(along), vec2(1e5)));
  across = mix(vec2(0.0), across, lessThan(abs(across), vec2(1e5)));
  const float l0 = length(along), l1 = length(across);
  const float blur = max(min(l0, l1), max(l0, l1) / longest_to_widest());
  // The sampler keeps to the pipeline's own; where less is asked for, the shorter axis is made longer.
  if (frame.air.w < anisotropy) {
    along *= max(1.0, blur / max(l0, 1e-6));
    across *= max(1.0, blur / max(l1, 1e-6));
  }
  return SeaFootprint(along, across, blur);
}

// `left`: the share that the vertices have not carried.
void add_slopes(inout SeaSlopes s, texture2DArray derivatives, texture2DArray moments, CascadeData c, int number,
                float layer, SeaPlace place, SeaFootprint over, float left) {
  if (left <= 0.0) return;
  const float share = kept(c, 2.0 * over.blur);  // at two to four pixels a wave
  if (share <= 0.0) {  // all of its waves lie below the footprint: mean zero, and all of its variance
    vec3 all = c.moments.xyz;
    if (sea_warp) all = sea_warp_moments(place.warp, all, number);
    if (sea_bed) all *= sea_bed_energy(place.bed, number);
    s.variance += all;
    return;
  }
  vec3 at = vec3(tile_vector(c, place.rest) + c.origin.xy, layer);
  if (sea_bed) at.xy += sea_bed_shift(place.bed, c, number);
  if (sea_warp) at.xy += sea_warp_shift(place.warp, c, number);
  const vec2 du = 0.5 * tile_vector(c, over.along), dv = 0.5 * tile_vector(c, over.across);
  const float level = mip_level(0.5 * over.blur / c.origin.z);
  // Half the footprint: a tile's shortest wave has four texels or more, so that a texel for every two of a pixel
  // aliases nothing.
  const vec4 d = share * pattern_mean(derivatives, c, place, at, du, dv, level);
  const vec4 drawn = drawn_derivatives(place, d, number);
  s.gradient += left * drawn.xy;
  s.shift.xy += left * drawn.zw;
  // Up to three eighths of its shortest wave next to nothing is left unresolved: the second moments count from there to
  // twice that.
  const float coarse = clamp(over.blur / (0.375 * c.origin.w) - 1.0, 0.0, 1.0);
  if (coarse <= 0.0) return;
  const vec3 m = mix(c.moments.xyz, tile_mean(moments, at, du, dv, level).xyz, share);
  vec3 rough = coarse * max(m - vec3(d.xy * d.xy, d.x * d.y), vec3(0.0, 0.0, -1.0));
  if (sea_warp) rough = sea_warp_moments(place.warp, rough, number);
  if (sea_bed) rough *= sea_bed_energy(place.bed, number);
  s.variance += rough;
}

SeaSlopes no_slopes() { return SeaSlopes(vec2(0.0), vec3(0.0), vec3(0.0)); }

// Adds a part of which distance leaves `near`; what it takes is roughness.
void add_near(inout SeaSlopes s, SeaSlopes part, CascadeData c, float near) {
  s.gradient += near * part.gradient;
  s.shift += near * part.shift;
  s.variance += mix(c.moments.xyz, part.variance, near);
}

#include "lib/shore_slopes.glsl"
#include "lib/dynamic_slopes.glsl"
#include "lib/wake_slopes.glsl"

// What vertices carry of the slopes, and for which footprint and blur (see sea_carried).
struct CarriedSlopes {
  vec4 derivatives;
  float shear;  // dDx/dz, of all cascades
  float footprint, blur;
};

SeaSlopes sea_slopes(SeaPlace place, SeaFootprint over, CarriedSlopes have) {
  SeaSlopes s = SeaSlopes(have.derivatives.xy, vec3(have.derivatives.zw, have.shear), frame.sea.tail.xyz);
  if (sea_bed) s.variance *= place.bed.more.w * place.bed.more.w;
  if (cascade_count > 0)
    add_slopes(s, sea_longest_derivatives, sea_longest_moments, frame.sea.cascade[0], 0, 0.0, place, over,
               1.0 - carried(frame.sea.cascade[0], have.footprint, have.blur));
  if (cascade_count > 1)
    add_slopes(s, sea_derivative_tiles, sea_moment_tiles, frame.sea.cascade[1], 1, 0.0, place, over,
               1.0 - carried(frame.sea.cascade[1], have.footprint, have.blur));
  if (cascade_count > 2)
    add_slopes(s, sea_derivative_tiles, sea_moment_tiles, frame.sea.cascade[2], 2, 1.0, place, over,
               1.0 - carried(frame.sea.cascade[2], have.footprint, have.blur));
  if (cascade_count > 3)
    add_slopes(s, sea_derivative_tiles, sea_moment_tiles, frame.sea.cascade[3], 3, 2.0, place, over, 1.0);
  if (cascade_count > 4)
    add_slopes(s, sea_derivative_tiles, sea_moment_tiles, frame.sea.cascade[4], 4, 3.0, place, over, 1.0);
  SeaSlopes part = no_slopes();
  if (baked_layings > 0) add_slopes(part, baked_derivatives, baked_moments, frame.sea.baked, 5, 0.0, place, over, 1.0);
  if (baked_layings > 0) add_near(s, part, frame.sea.baked, near_viewer(place.rest));
  if (gerstner_layings > 0)
    add_slopes(s, gerstner_derivatives, gerstner_moments, frame.sea.gerstner, 5, 0.0, place, over, 1.0);
  if (particle_layings > 0)
    add_slopes(s, particle_derivatives, particle_moments, frame.sea.particles[0], 5, 0.0, place, over, 1.0);
  if (particle_layings > 1)
    add_slopes(s, particle_derivatives, particle_moments, frame.sea.particles[1], 5, 0.0, place, over, 1.0);
  if (particle_layings > 2)
    add_slopes(s, particle_derivatives, particle_moments, frame.sea.particles[2], 5, 0.0, place, over, 1.0);
  if (shore_waves) add_shore_slopes(s, place, over);
  if (dynamic_levels > 0) add_dynamic_slopes(s, place.rest, over.blur);
  if (wake_levels > 0) add_wake_slopes(s, place.rest, over.blur);
  if (sea_level) s.gradient += place.level.yz;
  return s;
}

float sea_jacobian(SeaSlopes s) { return surface_jacobian(s.shift.x, s.shift.y, s.shift.z, s.shift.z); }

vec2 sea_slope(SeaSlopes s) {
  return surface_slope(s.gradient.x, s.gradient.y, s.shift.x, s.shift.y, s.shift.z, s.shift.z);
}
#endif
