// What the bed makes of the water above it: where there is land, and how much each cascade's waves come to and from
// where their patterns are taken. Part of lib/sea.glsl; the C++ twins are ocean/places/shallows.cpp and place_sea.cpp.

vec4 sea_bed_here;   // BedTexel (ocean/places/bed_field.h): the bed's height, the shifts of the longest three cascades
vec4 sea_bed_share;  // of cascades 0 to 3
vec4 sea_bed_more;   // of the fifth; of other sources; of the run-up; of all shorter waves
vec4 sea_bed_x, sea_bed_z;  // what sea_bed_here changes by along x and z, a metre
float sea_bed_still;        // the still water's height; where it has levels lib/sea.glsl tells

vec4 sea_bed_height(LodRead read, vec2 place) {
  return place_value(sea_bed_windows, read, place, vec4(frame.sea.place.outside_bed.x, 0.0, 0.0, 0.0));
}

vec4 sea_bed_layers(LodRead read, vec2 place, int number, vec4 outside) {
  return place_value(sea_bed_waves, 2, number, read, place, outside);
}

// Slopes of the bed and of the shifts, over a texel to either side.
void sea_bed_slopes_at(LodRead read, vec2 place) {
  sea_bed_x = sea_bed_z = vec4(0.0);
  if (read.present <= 0.0) return;
  const float texel = frame.sea.place.windows.slice[read.fine].w;
  const vec2 x = vec2(texel, 0.0), z = vec2(0.0, texel);
  sea_bed_x = (sea_bed_height(read, place + x) - sea_bed_height(read, place - x)) / (2.0 * texel);
  sea_bed_z = (sea_bed_height(read, place + z) - sea_bed_height(read, place - z)) / (2.0 * texel);
}

void sea_bed_read(vec2 rest, float footprint) {
  const LodRead read = place_read(rest, footprint);
  sea_bed_here = sea_bed_height(read, rest);
  sea_bed_share = sea_bed_layers(read, rest, 0, vec4(1.0));
  sea_bed_more = sea_bed_layers(read, rest, 1, vec4(1.0, 1.0, 0.0, 1.0));
  sea_bed_slopes_at(read, rest);
  sea_bed_still = 0.0;
}

// Numbers: 0 to 4 the cascades, 5 the other sources, 6 what has the bed's share by other ways.
float sea_bed_of(int number) {
  return number == 0   ? sea_bed_share.x
         : number == 1 ? sea_bed_share.y
         : number == 2 ? sea_bed_share.z
         : number == 3 ? sea_bed_share.w
         : number == 4 ? sea_bed_more.x
         : number == 5 ? sea_bed_more.y
                       : 1.0;
}

// By which a texel of displacement is multiplied: the run-up lifts the water and does not push it.
vec4 sea_bed_displaced(int number) {
  const float share = sea_bed_of(number);
  return vec4(share, number < swash_cascades ? length(vec2(share, sea_bed_more.z)) : share, share, share);
}

vec2 sea_bed_along(int number) { return number < bent_cascades ? frame.sea.place.shift_along[number].xy : vec2(0.0); }

// How far from a rest position a cascade's pattern is taken, in tile coordinates.
vec2 sea_bed_shift(CascadeData c, int number) {
  const float shift = number == 0 ? sea_bed_here.y : number == 1 ? sea_bed_here.z : number == 2 ? sea_bed_here.w : 0.0;
  return tile_vector(c, shift * sea_bed_along(number));
}

// Derivatives as they are drawn: a pattern's phase is bent by what its shift changes by (ocean/places/refraction.h),
// its shear left out.
vec4 sea_bed_derivatives(vec4 d, int number) {
  const vec2 along = sea_bed_along(number);
  const vec2 bend = number == 0   ? vec2(sea_bed_x.y, sea_bed_z.y)
                    : number == 1 ? vec2(sea_bed_x.z, sea_bed_z.z)
                    : number == 2 ? vec2(sea_bed_x.w, sea_bed_z.w)
                                  : vec2(0.0);
  return sea_bed_displaced(number).yyxx * vec4(d.xy + dot(d.xy, along) * bend, d.zw * (1.0 + along * bend));
}

float sea_bed_energy(int number) { return sea_bed_of(number) * sea_bed_of(number); }

// Land stands above the water, and does not go to and fro with it.
vec4 sea_bed_land(vec4 sum) {
  const float wet = smoothstep(dry_depth_m, wet_depth_m, sea_bed_still - sea_bed_here.x);
  return vec4(wet * sum.x, max(sum.y, sea_bed_here.x), wet * sum.zw);
}
