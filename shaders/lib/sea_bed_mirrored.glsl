// The bed as the water's surface mirrors it. Part of lib/sea_from_below.glsl.

// What a line of sight meets that the surface sends down along `ray`: the bed, level at the depth that it has there, or
// far off `open`.
vec3 sea_bed_mirrored(vec3 open, vec3 ray, SurfacePoint p, SeaPlace here, float footprint) {
  const float depth = max(here.level.x - here.bed.here.x, 0.0), falls = max(-ray.y, 0.02), way = depth / falls;
  if (way > 200.0) return open;
  const vec2 place = p.place + ray.xz * way;
  const vec3 sent = bed_albedo(place, -max(depth, 1e-3), here.bed.slope.xy, footprint / falls) / pi * water_lit();
  return light_in_water(sent, vec3(0.0), depth, 0.0, ray, way);
}
