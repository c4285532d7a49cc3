// The microfacets of rough surfaces: GGX (Walter et al. 2007, eq. 33 to 35), with Smith's height-correlated masking
// (Heitz 2014, eq. 99). `a`: its width, the square of glTF's roughness.
#ifndef SEASCAPE_GGX_GLSL
#define SEASCAPE_GGX_GLSL

float ggx_facets(float nh, float a) {
  const float a2 = a * a, d = (nh * a2 - nh) * nh + 1.0;
  return a2 / (3.14159265 * d * d);
}

// Masking over 4 (n.l) (n.v).
float ggx_seen(float nl, float nv, float a) {
  const float a2 = a * a;
  return 0.5 / max(nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2), 1e-7);
}

// The i-th of n directions of facets about +z, by their density times the cosine (Karis 2013).
vec3 ggx_facet(uint i, uint n, float a) {
  const float turn = 6.2831853 * float(bitfieldReverse(i)) * 2.3283064365386963e-10;
  const float u = (float(i) + 0.5) / float(n);
  const float cosine = sqrt((1.0 - u) / (1.0 + (a * a - 1.0) * u)), sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  return vec3(cos(turn) * sine, sin(turn) * sine, cosine);
}

// Likewise by the density of those that are seen from v (Heitz 2018, "Sampling the GGX distribution of visible
// normals").
vec3 ggx_visible_facet(uint i, uint n, vec3 v, float a) {
  const float turn = 6.2831853 * float(bitfieldReverse(i)) * 2.3283064365386963e-10;
  const float r = sqrt((float(i) + 0.5) / float(n));
  const vec3 stretched = normalize(vec3(a * v.xy, v.z));
  const float level = length(stretched.xy);
  const vec3 across = level > 1e-6 ? vec3(-stretched.y, stretched.x, 0.0) / level : vec3(1.0, 0.0, 0.0);
  const float x = r * cos(turn);
  const float y = mix(sqrt(max(1.0 - x * x, 0.0)), r * sin(turn), 0.5 + 0.5 * stretched.z);
  const vec3 half_ball = x * across + y * cross(stretched, across) + sqrt(max(1.0 - x * x - y * y, 0.0)) * stretched;
  return normalize(vec3(a * half_ball.xy, max(half_ball.z, 1e-6)));
}
#endif
