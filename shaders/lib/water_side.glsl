// From which side a triangle of the surface is seen.
#ifndef SEASCAPE_WATER_SIDE_GLSL
#define SEASCAPE_WATER_SIDE_GLSL

// `along`, `across`: how the rest position changes a pixel to the right and a pixel down; `place_along`,
// `place_across`: the same of where it stands, x and z. Where a crest is folded over its sheet lies upside down on the
// water, with the air on what was its lower face. (Where a triangle is seen edge on, its neighbouring pixels may lie
// beyond its plane's horizon, so that changes are turned about: both kinds alike, which leaves the sign of their
// ratio.)
bool seen_from_below(vec2 along, vec2 across, vec2 place_along, vec2 place_across) {
  if (frame.shown.y == eyes_in_water) return true;
  const bool folded =
      (along.x * across.y - along.y * across.x) * (place_along.x * place_across.y - place_along.y * place_across.x) <
      0.0;
  return gl_FrontFacing == folded;
}
#endif
