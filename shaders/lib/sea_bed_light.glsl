// The bed seen through shallow water, and the land above it. Part of lib/sea_light.glsl.

// How a place of the bed looks.
struct Bed {
  float still_depth;  // of the still water above it, m; below 0 on land
  vec2 slope;         // of the bed
  float film;         // of the water that stands there now, m; below 0 where it is dry
  float water;        // share of the footprint under water
};

// Thinner water is wet land, and land that lies at the still level is land.
const float least_film_m = 0.01;
const float flattest_beach = 0.02;  // its slope; beaches of 0.01 to 0.11 were measured (Stockdon et al. 2006, table 1)

float bed_hash(vec2 cell) {
  vec3 p = fract(vec3(cell.xyx) * 0.1031);  // of whole numbers up to some thousands (Hoskins 2014)
  p += dot(p, p.yzx + 33.33);
  return fract((p.x + p.y) * p.z);
}

// Smooth noise of mean 0.5 over cells of a size that divides ground_pattern_m, after which it comes again; faded to its
// mean as the footprint comes to the size.
float bed_noise(vec2 place, float size, float footprint) {
  const float faded = clamp(2.0 * footprint / size - 0.5, 0.0, 1.0);
  if (faded >= 1.0) return 0.5;
  const vec2 at = place / size, cell = floor(at), f = at - cell, t = f * f * (3.0 - 2.0 * f);
  const float period = ground_pattern_m / size;
  const vec2 low = mod(cell, period), high = mod(cell + 1.0, period);
  const float value = mix(mix(bed_hash(low), bed_hash(vec2(high.x, low.y)), t.x),
                          mix(bed_hash(vec2(low.x, high.y)), bed_hash(high), t.x), t.y);
  return mix(value, 0.5, faded);
}

float bed_height(vec2 place, float footprint) { return sea_bed_height(place_read(place, footprint), place).x; }

vec2 bed_slope(vec2 place, float footprint) { return sea_bed_slope(place_read(place, footprint), place).xy; }

// Of a triangle that stands with one foot in the water and with another on land (`above`: as in bed_at): is it the wall
// that the line of sight goes on to above the water? Then what is known of the bed is that of the wall.
void meet_wall(inout Bed bed, SurfacePoint p, SeaPlace here, float above, vec3 v, float footprint) {
  const float level = max(length(v.xz), 0.1), fall = v.y / level, stands = here.level.x + above;
  const vec2 on = -v.xz / level;
  float outside = 0.0, within = 1.5 * mesh_spacing(p.rest);
  bool meets = false;
  for (int i = 0; i < 3 && !meets; ++i) {
    meets = stands - fall * within < bed_height(p.place + on * within, footprint);
    if (!meets) outside = within;
    if (!meets) within *= 2.0;
  }
  if (!meets) return;
  for (int i = 0; i < 6; ++i) {
    const float middle = 0.5 * (outside + within);
    if (stands - fall * middle < bed_height(p.place + on * middle, footprint))
      within = middle;
    else
      outside = middle;
  }
  const vec2 slope = bed_slope(p.place + on * within, footprint);
  const float met = above - fall * within;
  float wall = smoothstep(0.5, 1.0, length(slope));
  if (wall > 0.0) {
    const float water = sea_displacement(here, mesh_spacing(p.rest)).y - here.level.x;
    wall *= smoothstep(0.0, 0.2, met - water);
  }
  bed.water *= 1.0 - wall;
  bed.still_depth = mix(bed.still_depth, -met, wall);
  bed.slope = mix(bed.slope, slope, wall);
}

// `above`: the drawn water over the still one, m; `v`: to the eye.
Bed bed_at(SurfacePoint p, SeaPlace here, float above, vec3 v, float footprint) {
  Bed bed;
  // A plane through where the water rests: waves carry it less far than beds bend.
  bed.slope = here.bed.slope.xy;
  bed.still_depth = here.level.x - here.bed.here.x - dot(bed.slope, p.place - p.rest);
  // Near the shore the water is where the long waves have run up to; what is drawn there may be the bed itself.
  const float shore = 2.0 * frame.sea.place.shift_along[0].z + 0.05;
  bed.film = bed.still_depth + max(above, -0.9 * max(bed.still_depth, 0.0));
  if (abs(bed.still_depth) < 2.0 * shore) {
    vec4 run = vec4(0.0);
    if (cascade_count > 0)
      add_displacement(run, sea_longest_displacement, frame.sea.cascade[0], 0, 0.0, vec4(1.0), here, footprint);
    if (cascade_count > 1)
      add_displacement(run, sea_displacement_tiles, frame.sea.cascade[1], 1, 0.0, vec4(1.0), here, footprint);
    // Ground flatter than any beach (1 in 50) has no shore for water to run up: there its crests and troughs would lie
    // about as sheets and bars.
    run.y *= smoothstep(0.0, flattest_beach, length(bed.slope));
    bed.film = mix(bed.still_depth + run.y, bed.film, smoothstep(shore, 2.0 * shore, bed.still_depth));
  }
  if (bed.still_depth < -2.0 * shore) bed.film = bed.still_depth;
  bed.water = clamp(0.5 + (bed.film - least_film_m) / (length(bed.slope) * footprint + least_film_m), 0.0, 1.0);
  // Only where the drawn surface leaves the ground.
  if (p.ramp && bed.still_depth > -2.0 * shore && above > -bed.still_depth)
    meet_wall(bed, p, here, above, v, footprint);
  return bed;
}

// Albedo of the bed: sand with its ripples and darker patches; above the beach growth, where it is not too steep, and
// rock. `height`: above the still water, m.
vec3 bed_albedo(vec2 place, float height, vec2 slope, float footprint) {
  const vec2 straight = place + frame.sea.place.outside_bed.yz;  // bent, so that no lattice is seen from above
  const vec2 at =
      straight +
      14.0 * (vec2(bed_noise(straight, 16.0, footprint), bed_noise(straight.yx + 237.0, 16.0, footprint)) - 0.5);
  const float fine = bed_noise(at, 0.5, footprint), middle = bed_noise(at, 2.0, footprint),
              broad = bed_noise(at, 8.0, footprint), wide = bed_noise(at, 32.0, footprint);
  vec3 albedo = frame.sea.place.shift_along[2].z * vec3(0.50, 0.43, 0.32) *
                (0.75 + 0.10 * fine + 0.12 * middle + 0.14 * broad + 0.14 * wide);
  if (height < 0.0) {  // weed and stones in deeper water
    const float weed =
        smoothstep(0.50, 0.66,
                   0.36 * bed_noise(at, 128.0, footprint) + 0.26 * wide + 0.18 * broad + 0.12 * middle + 0.08 * fine) *
        smoothstep(0.8, 3.0, -height);
    return mix(albedo, vec3(0.055, 0.065, 0.035), 0.85 * weed);
  }
  const float grown_from = frame.sea.place.shift_along[1].z;
  if (grown_from > 0.0) {
    const float edge = height - grown_from * (0.55 + 0.35 * wide + 0.3 * broad + 0.25 * middle);
    const vec3 growth =
        mix(vec3(0.045, 0.075, 0.022), vec3(0.11, 0.12, 0.05), 0.35 * broad + 0.4 * middle + 0.25 * fine) *
        (0.5 + 0.5 * wide + 0.5 * broad);
    albedo = mix(albedo, growth, smoothstep(0.0, 0.35 * grown_from, edge));
  }
  const float steep = length(slope);
  return mix(albedo, vec3(0.19, 0.175, 0.155) * (0.6 + 0.5 * fine + 0.4 * middle),
             smoothstep(0.65, 1.0, steep + 0.3 * (middle - 0.5)));
}

// Where a line of sight under water meets the bed.
struct BedSeen {
  float way;  // how deep below the water, m
  vec2 place, slope;
};

// Where the line that goes `sideways` a metre of depth meets the bed under `water` (m, its height). From `place` there
// are `film` metres straight down.
BedSeen bed_seen(Bed bed, float water, vec2 place, vec2 sideways, float footprint) {
  // First the bed is taken for a plane, and then for what lies below the place that this leads to.
  const float film = max(bed.film, 0.0), far = min(film, 20.0);
  float tried = min(film / clamp(1.0 + dot(bed.slope, sideways), 1.0, 8.0), 20.0);
  float left = water - bed_height(place + sideways * tried, footprint) - tried;
  if (left > 0.1 * film && tried < far) {  // no plane: at the foot of a wall, or of a bank
    tried = far;
    left = water - bed_height(place + sideways * tried, footprint) - tried;
  }
  BedSeen seen = BedSeen(0.0, place, bed.slope);
  seen.way = left > 0.0 ? tried + left : tried * film / max(film - left, 1e-6);
  // Where it rises more than that it is found by the rule of false position (of Illinois: Dowell and Jarratt 1971): a
  // wall is met below the water, and what stands above the water behind it is not seen through it.
  if (left < -0.1 * film) {
    float above = 0.0, above_by = film, below = tried, below_by = -left;
    for (int i = 0; i < 5; ++i) {
      const vec2 at = place + sideways * seen.way;
      const float by = water - bed_height(at, footprint) - seen.way;
      if (by > 0.0) {
        above = seen.way;
        above_by = by;
        below_by *= 0.5;
      } else {
        below = seen.way;
        below_by = -by;
        above_by *= 0.5;
      }
      seen.way = mix(above, below, above_by / max(above_by + below_by, 1e-6));
    }
    seen.slope = bed_slope(place + sideways * seen.way, footprint);
  }
  seen.place = place + sideways * min(seen.way, 20.0);
  return seen;
}

// Radiance that comes out of shallow water, where `deep` comes out of deep (light_out_of_water()). `down`: irradiance
// that has entered; `inside`: the line of sight under water; `way`: how deep it meets the bed, m.
vec3 bed_through_water(Bed bed, float still, vec3 deep, vec3 down, vec2 place, vec3 inside, float above,
                       float footprint, out float way) {
  const float eye_cosine = max(-inside.y, 0.3);
  const BedSeen seen =
      bed_seen(bed, still + max(above, -0.9 * max(bed.still_depth, 0.0)), place, inside.xz / eye_cosine, footprint);
  way = mix(max(bed.film, 0.0), seen.way, clamp(bed.still_depth - 0.5, 0.0, 1.0));
  const WaterColumn column = water_column(way, eye_cosine);
  vec3 sent = vec3(0.0);
  if (max(column.passed.r, max(column.passed.g, column.passed.b)) > 1e-3)
    sent = bed_albedo(seen.place, -way, seen.slope, footprint) / pi * down;
  return light_out_of_water(column, deep, sent, down);
}

// Albedo of what lies around land, of all of it.
const vec3 ground_around = vec3(0.24, 0.21, 0.16);

// Land lit by sun, sky and the ground around it; wet as far as run-up comes, where it is darker (Lekner and Dorf 1988)
// and mirrors the sky.
vec3 bed_land(Bed bed, vec2 place, vec3 relative, vec3 v, float sunlit, float footprint) {
  const vec3 normal = normalize(vec3(-bed.slope.x, 1.0, -bed.slope.y));
  const float run_up = frame.sea.place.shift_along[0].z;
  const float wet =
      1.0 - smoothstep(0.4 * run_up, 1.3 * run_up + 0.01,
                       -bed.still_depth +
                           0.25 * run_up * (bed_noise(place + frame.sea.place.outside_bed.yz, 16.0, footprint) - 0.5));
  // A wall sees half of the sky, and in place of the rest what sky and sun light around it: sand, growth and water. Its
  // half of the sky gives it what pi / 2 times the radiance 19 degrees above the horizon would (docs/accuracy.md).
  const vec3 low = 0.5 * pi * textureLod(sky_map, sky_coordinate(normalize(vec3(normal.x, 0.35, normal.z))), 0.0).rgb;
  const vec3 around = ground_around * (light.sky_irradiance.rgb + light.sun_irradiance.rgb * max(frame.sun.y, 0.0));
  vec3 light_there = mix(low + 0.5 * around, light.sky_irradiance.rgb, normal.y) +
                     sunlit * light.sun_irradiance.rgb * max(dot(normal, frame.sun.xyz), 0.0);
  if (lamp_carried && lamp_shines()) light_there += lamp_on(relative, normal);
  vec3 lit = bed_albedo(place, max(-bed.still_depth, 0.0), bed.slope, footprint) * light_there / pi;
  lit *= mix(1.0, 0.45, wet);
  if (wet > 0.0) {
    const vec3 mirrored = reflect(-v, normal);  // what goes down meets the ground
    lit += 0.6 * wet * smoothstep(0.0, 0.3, mirrored.y) * fresnel(max(dot(v, normal), 0.0)) *
           textureLod(sky_map, sky_coordinate(mirrored), 0.0).rgb;
  }
  return lit;
}
