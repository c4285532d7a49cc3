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
#endif
