// Whether there is no water where a line of near_line() is: clip takes it away. Included after lib/sea.glsl.
bool line_is_dry(vec3 line_at) {
  bool dry = false;
  if (!water_clip) return dry;
  const vec3 stands =
      flattened(line_at + vec3(0.0, frame.viewer.z, 0.0), frame.viewer.w) + vec3(frame.viewer.x, 0.0, frame.viewer.y);
  if (water_clip) dry = water_clipped(stands.xz, stands);
  if (sea_bed && water_clip) dry = water_clip_cuts(stands.xz, stands);
  return dry;
}
