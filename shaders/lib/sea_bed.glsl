// What the bed makes of the water above it: where there is land, and how much each cascade's waves come to and from
// where their patterns are taken. Part of lib/sea.glsl; the C++ twins are ocean/places/shallows.cpp and place_sea.cpp.

vec4 sea_bed_height(LodRead read, vec2 place) {
  return place_value(sea_bed_windows, read, place, vec4(frame.sea.place.outside_bed.x, 0.0, 0.0, 0.0));
}

vec4 sea_bed_layers(LodRead read, vec2 place, int number, vec4 outside) {
  return place_value(sea_bed_waves, 4, number, read, place, outside);
}

// The bed's slope along x and z, and that of the first cascade's shift.
vec4 sea_bed_slope(LodRead read, vec2 place) { return sea_bed_layers(read, place, 2, vec4(0.0)); }

SeaBed sea_bed_read(LodRead read, vec2 place) {
  SeaBed bed = SeaBed(sea_bed_height(read, place), sea_bed_layers(read, place, 0, vec4(1.0)),
                      sea_bed_layers(read, place, 1, vec4(1.0, 1.0, 0.0, 1.0)), sea_bed_slope(read, place), vec4(0.0));
  // Where no shift is, none changes.
  if (bed.here.z != 0.0 || bed.here.w != 0.0) bed.bend = sea_bed_layers(read, place, 3, vec4(0.0));
  return bed;
}

// Numbers: 0 to 4 the cascades, 5 the other sources, 6 what has the bed's share by other ways.
float sea_bed_of(SeaBed bed, int number) {
  return number == 0   ? bed.share.x
         : number == 1 ? bed.share.y
         : number == 2 ? bed.share.z
         : number == 3 ? bed.share.w
         : number == 4 ? bed.more.x
         : number == 5 ? bed.more.y
                       : 1.0;
}

// By which a texel of displacement is multiplied: the run-up lifts the water and does not push it.
vec4 sea_bed_displaced(SeaBed bed, int number) {
  const float share = sea_bed_of(bed, number);
  return vec4(share, number < swash_cascades ? length(vec2(share, bed.more.z)) : share, share, share);
}

vec2 sea_bed_along(int number) { return number < bent_cascades ? frame.sea.place.shift_along[number].xy : vec2(0.0); }

// How far from a rest position a cascade's pattern is taken, in tile coordinates.
vec2 sea_bed_shift(SeaBed bed, CascadeData c, int number) {
  const float shift = number == 0 ? bed.here.y : number == 1 ? bed.here.z : number == 2 ? bed.here.w : 0.0;
  return tile_vector(c, shift * sea_bed_along(number));
}

// Derivatives as they are drawn: a pattern's phase is bent by what its shift changes by (ocean/places/refraction.h),
// its shear left out.
vec4 sea_bed_derivatives(SeaBed bed, vec4 d, int number) {
  const vec2 along = sea_bed_along(number);
  const vec2 bend = number == 0 ? bed.slope.zw : number == 1 ? bed.bend.xy : number == 2 ? bed.bend.zw : vec2(0.0);
  return sea_bed_displaced(bed, number).yyxx * vec4(d.xy + dot(d.xy, along) * bend, d.zw * (1.0 + along * bend));
}

float sea_bed_energy(SeaBed bed, int number) { return sea_bed_of(bed, number) * sea_bed_of(bed, number); }

// Of what is 1 at a triangle's corners on land and 0 at the others: is it a triangle of both?
bool joins_land(float land) { return land > 0.0 && land < 0.9999; }

// Land stands above the water, and does not go to and fro with it.
vec4 sea_bed_land(SeaPlace place, vec4 sum) {
  const float wet = smoothstep(dry_depth_m, wet_depth_m, place.level.x - place.bed.here.x);
  return vec4(wet * sum.x, max(sum.y, place.bed.here.x), wet * sum.zw);
}
