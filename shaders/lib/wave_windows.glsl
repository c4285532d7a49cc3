// Reading the levels of waves that windows hold: around the viewer or around bodies. Part of lib/sea.glsl; the C++ twin
// is ocean/places/dynamic_surface.cpp.

// What a footprint in metres leaves of a level with such texels: it fades from four to eight of them, half and all of
// its shortest wave.
float window_kept(float texel, float footprint) { return clamp(2.0 - footprint / (4.0 * texel), 0.0, 1.0); }

// `slice`: LodWindows::slice.
vec4 window_texel(texture2DArray waves, vec4 slice, int layer, vec2 rest) {
  return textureLod(sampler2DArray(waves, smooth_sampler), vec3(lod_coordinates(slice, rest), float(layer)), 0.0);
}
