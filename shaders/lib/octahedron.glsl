// Directions on a square (Engelhardt and Dachsbacher 2008, "Octahedron environment maps").
#ifndef SEASCAPE_OCTAHEDRON_GLSL
#define SEASCAPE_OCTAHEDRON_GLSL

vec2 octahedron_place(vec3 d) {
  vec2 p = d.xz / (abs(d.x) + abs(d.y) + abs(d.z));
  if (d.y < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return 0.5 + 0.5 * p;
}

vec3 octahedron_direction(vec2 place) {
  vec2 p = 2.0 * place - 1.0;
  const float y = 1.0 - abs(p.x) - abs(p.y);
  if (y < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return normalize(vec3(p.x, y, p.y));
}
#endif
