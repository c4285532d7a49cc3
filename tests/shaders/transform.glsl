// One dimension of a field's transforms and nothing else: what the sea's shaders do it with, alone, for tests and
// benchmarks. Included with FFT_RADIX defined.
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 0) const uint band = 256;
layout(constant_id = 1) const uint log2_samples = 8;
// Whether neighbouring invocations share a transform (rows) or have the same place in neighbouring ones (columns).
layout(constant_id = 2) const bool lanes_first = true;

layout(local_size_x = 64, local_size_x_id = 3) in;
#include "lib/fft.glsl"
const uint slots = gl_WorkGroupSize.x / radix;  // transforms of a workgroup
layout(std430, binding = 0) readonly buffer In { vec2 bins[]; };
layout(std430, binding = 1) writeonly buffer Out { vec2 samples[]; };
// Floats from one transform to the next, and from one of its values to the next.
layout(push_constant) uniform Push { uint in_transform, in_step, out_transform, out_step; }
push;

void keep(uint which, uint lane, uint phases, uint phase, vec2 v[FFT_RADIX]) {
  for (uint c = 0u; c < radix; ++c)
    samples[which * push.out_transform + ((lane + radix * c) * phases + phase) * push.out_step] = v[c];
}

void main() {
  const uint i = gl_LocalInvocationIndex;
  const uint lane = lanes_first ? i % radix : i / slots, slot = lanes_first ? i / radix : i % slots;
  const uint which = gl_WorkGroupID.x * slots + slot;
  const uint phases = max(1u, (1u << log2_samples) / core);
  const bool both = phases == 2u;  // phases 0 and 1 from one reading
  const uint phase = both ? 1u : gl_WorkGroupID.y;
  vec2 w[FFT_RADIX], turn[FFT_RADIX], v[FFT_RADIX], first[FFT_RADIX];
  twiddles(lane, w);
  phase_twiddles(lane, phase, log2_samples, band, turn);
  const vec2 next_turn = cos_sin_turns((core * phase) << (32u - log2_samples));
  for (uint r = 0u; r < radix; ++r) {
    vec2 sum = vec2(0.0), plain = vec2(0.0), by = turn[r];
    for (uint index = bin_index(lane, r, band); index < band; index += core) {
      const vec2 bin = bins[which * push.in_transform + index * push.in_step];
      sum += phases == 1u ? bin : times(bin, by);
      plain += bin;
      if (band > core) by = times(by, next_turn);
    }
    v[r] = sum;
    first[r] = plain;
  }
  if (both) {
    transform(lane, slot, w, first);
    keep(which, lane, phases, 0u, first);
  }
  transform(lane, slot, w, v);
  keep(which, lane, phases, phase, v);
}
