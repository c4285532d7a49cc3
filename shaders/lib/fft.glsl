// An inverse discrete Fourier transform of FFT_RADIX^2 points (64 or 256: `core`) by FFT_RADIX invocations with as many
// values each: two steps in registers and one exchange through shared memory (Cooley and Tukey 1965). Included with
// FFT_RADIX defined, 8 or 16.
//
// A tile of N = core P samples whose waves all have |m| <= core / 2 needs no longer transform: its samples n = q P + s,
// for each s, are the transform of length core of the bins turned by s m / N. Bins beyond that fold onto it: those of
// the same m modulo core are added after their turn. `band`, core or a multiple of twice that, is how many bins there
// are.
#ifndef SEASCAPE_FFT_GLSL
#define SEASCAPE_FFT_GLSL
#include "shared/phase.h"

const uint radix = FFT_RADIX, core = radix * radix;

vec2 times(vec2 a, vec2 b) { return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }
vec2 times_i(vec2 a) { return vec2(-a.y, a.x); }
vec2 times_eighth(vec2 a) { return vec2(a.x - a.y, a.x + a.y) * 0.70710678118654752; }

// v[k] = sum over r of v[r] exp(2 pi i r k / FFT_RADIX).
#if FFT_RADIX == 8
void dft(inout vec2 v[8]) {
  vec2 a0 = v[0] + v[4], a1 = v[1] + v[5], a2 = v[2] + v[6], a3 = v[3] + v[7];
  vec2 b0 = v[0] - v[4], b1 = v[1] - v[5], b2 = v[2] - v[6], b3 = v[3] - v[7];
  b1 = times_eighth(b1);
  b2 = times_i(b2);
  b3 = times_i(times_eighth(b3));
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
#else
void dft4(inout vec2 a, inout vec2 b, inout vec2 c, inout vec2 d) {
  vec2 sum_ac = a + c, diff_ac = a - c, sum_bd = b + d, diff_bd = times_i(b - d);
  a = sum_ac + sum_bd;
  b = diff_ac + diff_bd;
  c = sum_ac - sum_bd;
  d = diff_ac - diff_bd;
}
void dft(inout vec2 v[16]) {
  // Four transforms of four, turns by sixteenths, four of four.
  const vec2 one = vec2(0.92387953251128674, 0.38268343236508977), three = one.yx;
  dft4(v[0], v[4], v[8], v[12]);
  dft4(v[1], v[5], v[9], v[13]);
  dft4(v[2], v[6], v[10], v[14]);
  dft4(v[3], v[7], v[11], v[15]);
  v[5] = times(v[5], one);
  v[9] = times_eighth(v[9]);
  v[13] = times(v[13], three);
  v[6] = times_eighth(v[6]);
  v[10] = times_i(v[10]);
  v[14] = times_i(times_eighth(v[14]));
  v[7] = times(v[7], three);
  v[11] = times_i(times_eighth(v[11]));
  v[15] = -times(v[15], one);
  dft4(v[0], v[1], v[2], v[3]);
  dft4(v[4], v[5], v[6], v[7]);
  dft4(v[8], v[9], v[10], v[11]);
  dft4(v[12], v[13], v[14], v[15]);
  // Result k + 4 l lies at 4 k + l.
  vec2 t;
  t = v[1];
  v[1] = v[4];
  v[4] = t;
  t = v[2];
  v[2] = v[8];
  v[8] = t;
  t = v[3];
  v[3] = v[12];
  v[12] = t;
  t = v[6];
  v[6] = v[9];
  v[9] = t;
  t = v[7];
  v[7] = v[13];
  v[13] = t;
  t = v[11];
  v[11] = v[14];
  v[14] = t;
}
#endif

// exp(2 pi i lane c / core) for c below FFT_RADIX: powers of two of c in full, the rest by one to three products.
void twiddles(uint lane, out vec2 w[FFT_RADIX]) {
  w[0] = vec2(1.0, 0.0);
  for (uint c = 1u; c < radix; ++c) {
    const uint top = c >= 8u ? 8u : c >= 4u ? 4u : c >= 2u ? 2u : 1u;
    if (c == top)
      w[c] = cos_sin_turns(lane * c * (0xffffffffu / core + 1u));
    else
      w[c] = times(w[top], w[c - top]);
  }
}

// Input r of a lane is m = lane + FFT_RADIX r modulo core: its first bin's index in a table that begins at m = -band
// / 2. The others follow every core.
uint bin_index(uint lane, uint r, uint band) { return (lane + radix * r + band / 2u) & (core - 1u); }

// exp(2 pi i m s / N) for the first bins of a lane's inputs; N = 2^log2_n = core P, exactly reduced.
void phase_twiddles(uint lane, uint s, uint log2_n, uint band, out vec2 turn[FFT_RADIX]) {
  const uint unit = s << (32u - log2_n);  // turns of m = 1
  const vec2 one = cos_sin_turns(radix * unit), two = times(one, one);
  for (uint r = 0u; r < radix; r += 4u) {
    turn[r] = cos_sin_turns((bin_index(lane, r, band) - band / 2u) * unit);
    turn[r + 1u] = times(turn[r], one);
    turn[r + 2u] = times(turn[r], two);
    turn[r + 3u] = times(turn[r + 1u], two);
  }
}

// The transform of a lane's inputs, given the lane's twiddles; result c of a lane is q = lane + FFT_RADIX c. `slot`:
// which of the workgroup's transforms. Every invocation of the workgroup calls it.
shared vec2 exchanged[gl_WorkGroupSize.x * (FFT_RADIX + 1)];
void transform(uint lane, uint slot, vec2 w[FFT_RADIX], inout vec2 v[FFT_RADIX]) {
  const uint base = slot * radix * (radix + 1u);
  dft(v);
  barrier();
  for (uint c = 0u; c < radix; ++c) exchanged[base + c * (radix + 1u) + lane] = times(v[c], w[c]);
  barrier();
  for (uint t = 0u; t < radix; ++t) v[t] = exchanged[base + lane * (radix + 1u) + t];
  dft(v);
}
#endif
