// The warp of the first cascade's pattern in light seas. Part of lib/sea.glsl; the C++ twin is
// ocean/waves/pattern_warp.cpp.
#include "shared/phase.h"

SeaWarp sea_warp_at(vec2 rest) {
  SeaWarp warp = SeaWarp(vec2(0.0), vec4(0.0));
  for (int i = 0; i < warp_waves; ++i) {
    const vec4 wave = frame.sea.warp.wave[i];
    const vec2 turn =  // cosine, sine
        cos_sin_turns(warp_turns(wave.x, wave.y, frame.sea.warp.phase[i], rest.x, rest.y));
    warp.shift += turn.y * wave.zw;
    warp.growth += vec4(warp_growth(wave.z, wave.x, turn.x), warp_growth(wave.z, wave.y, turn.x),
                        warp_growth(wave.w, wave.x, turn.x), warp_growth(wave.w, wave.y, turn.x));
  }
  return warp;
}

// How far from a rest position a cascade's pattern is taken, in tile coordinates.
vec2 sea_warp_shift(SeaWarp warp, CascadeData c, int number) {
  return number == 0 ? tile_vector(c, warp.shift) : vec2(0.0);
}

// What the warp adds to derivatives (dh/dx, dh/dz, dDx/dx, dDz/dz), the shift's shear left out.
vec4 sea_warp_growth(SeaWarp warp, vec4 d, int number) {
  return number == 0 ? vec4(dot(d.xy, warp.growth.xz), dot(d.xy, warp.growth.yw), d.zw * warp.growth.xw) : vec4(0.0);
}

// Second moments of a cascade's slopes (xx, zz, xz) as they are drawn.
vec3 sea_warp_moments(SeaWarp warp, vec3 m, int number) {
  const vec2 by_x = vec2(1.0 + warp.growth.x, warp.growth.z), by_z = vec2(warp.growth.y, 1.0 + warp.growth.w);
  const mat2 moments = mat2(m.x, m.z, m.z, m.y);
  const vec2 along_x = moments * by_x, along_z = moments * by_z;
  return number == 0 ? vec3(dot(along_x, by_x), dot(along_z, by_z), dot(along_x, by_z)) : m;
}
