// An inverse discrete Fourier transform of length 64 by eight invocations with eight values each: two radix-8 steps and one
// exchange through shared memory (Cooley and Tukey 1965). A tile of N = 64 P samples whose waves all have |m| <= 32
// needs no longer transform: its samples n = q P + s, for each s, are the transform of length 64 of the bins turned by
// s m / N. Bins beyond that fold onto it: those of the same m modulo 64 are added after their turn. `band`, 64 or a multiple of
// 128, is how many bins there are.
#ifndef SEASCAPE_FFT64_GLSL
#define SEASCAPE_FFT64_GLSL
#include "shared/phase.h"

vec2 times(vec2 a, vec2 b) { return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }
vec2 times_i(vec2 a) { return vec2(-a.y, a.x); }

// v[k] = sum over r of v[r] exp(2 pi i r k / 8).
void dft8(inout vec2 v[8]) {
  const float h = 0.70710678118654752;
  vec2 a0 = v[0] + v[4], a1 = v[1] + v[5], a2 = v[2] + v[6], a3 = v[3] + v[7];
  vec2 b0 = v[0] - v[4], b1 = v[1] - v[5], b2 = v[2] - v[6], b3 = v[3] - v[7];
  b1 = vec2(b1.x - b1.y, b1.x + b1.y) * h;
  b2 = times_i(b2);
  b3 = vec2(-b3.x - b3.y, b3.x - b3.y) * h;
  vec2 c0 = a0 + a2, c1 = a1 + a3, c2 = a0 - a2, c3 = times_i(a1 - a3);
  vec2 d0 = b0 + b2, d1 = b1 + b3, d2 = b0 - b2, d3 = times_i(b1 - b3);
  v[0] = c0 + c1;
  v[4] = c0 - c1;
  v[2] = c2 + c3;
  v[6] = c2 - c3;
  v[1] = d0 + d1;
  v[5] = d0 - d1;
  v[3] = d2 + d3;
  v[7] = d2 - d3;
}

// Powers 1, w, w^2 ... of exp(2 pi i lane / 64), each by one product: errors stay within 3e-7.
void twiddles(uint lane, out vec2 w[8]) {
  w[0] = vec2(1.0, 0.0);
  w[1] = cos_sin_turns(lane << 26);
  w[2] = times(w[1], w[1]);
  w[3] = times(w[2], w[1]);
  w[4] = times(w[2], w[2]);
  w[5] = times(w[4], w[1]);
  w[6] = times(w[4], w[2]);
  w[7] = times(w[4], w[3]);
}

// The index in a table that begins at m = -band / 2 of the first bin of input r of a lane: m = lane + 8 r modulo 64. The
// others follow every 64.
uint bin_index(uint lane, uint r, uint band) { return (lane + 8u * r + band / 2u) & 63u; }

// exp(2 pi i m s / N) for the first bins of the eight inputs of a lane; N = 64 P, exactly reduced.
void phase_twiddles(uint lane, uint s, uint log2_n, uint band, out vec2 turn[8]) {
  const uint unit = s << (32u - log2_n);  // turns of m = 1
  turn[0] = cos_sin_turns((bin_index(lane, 0u, band) - band / 2u) * unit);
  turn[4] = cos_sin_turns((bin_index(lane, 4u, band) - band / 2u) * unit);
  const vec2 one = cos_sin_turns(8u * unit), two = times(one, one);
  for (uint r = 0u; r < 8u; r += 4u) {
    turn[r + 1u] = times(turn[r], one);
    turn[r + 2u] = times(turn[r], two);
    turn[r + 3u] = times(turn[r + 1u], two);
  }
}
#endif
