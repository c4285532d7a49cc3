#include "ocean/waves/wave_particles_simd.h"

#include <algorithm>
#include <bit>

#include "shaders/shared/phase.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/waves/wave_particles_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// No multiplication is fused with an addition anywhere here, and every texel is summed alone: all instruction sets give
// the same bits.

// W over 1 - u^2 = p, which needs neither root nor cosine: p^2 times a polynomial, within 7e-7 of (1 + cos pi u) / 2
// (least maximum by reweighted squares), with the value and the slope of 0 at the rim.
constexpr float w0 = 0.6167371615f, w1 = 0.3092322909f, w2 = 0.0639644560f, w3 = 0.0100654085f;

// Rows `first` to `last` - 1 of the particle's own. `with_rate`: the rate of change -v . grad h as well, v being `way`.
// dW/dp = p (2 g + p g').
template <class D, bool with_rate>
HWY_INLINE void add_rows(D d, const ParticleShape& shape, const PlacedParticle& particle, int first, int last,
                         const TorusField& height, glm::vec2 way, const TorusField& rate) {
  const int lanes = int(hn::Lanes(d));
  const float inverse = 1.0f / shape.radius, amplitude = particle.number & 1u ? -shape.amplitude : shape.amplitude;
  const auto one = hn::Set(d, 1.0f), zero = hn::Zero(d), scale = hn::Set(d, inverse),
             from_x = hn::Set(d, particle.from_x);
  const auto a0 = hn::Set(d, amplitude * w0), a1 = hn::Set(d, amplitude * w1), a2 = hn::Set(d, amplitude * w2),
             a3 = hn::Set(d, amplitude * w3);
  for (int column = 0; column < shape.reach; column += lanes) {
    const auto x = hn::Mul(hn::Sub(hn::Iota(d, float(column)), from_x), scale);
    const auto left = hn::Sub(one, hn::Mul(x, x));
    const auto along_x = hn::Mul(x, hn::Set(d, 2.0f * inverse * way.x));  // of 2 v . d / r^2
    for (int j = first; j < last; ++j) {
      const float z = (float(j) - particle.from_z) * inverse;
      const auto p = hn::Max(hn::Sub(left, hn::Set(d, z * z)), zero);
      const auto g = hn::Add(a0, hn::Mul(p, hn::Add(a1, hn::Mul(p, hn::Add(a2, hn::Mul(p, a3))))));
      float* to = height.row(particle.z + j) + particle.x + column;
      hn::StoreU(hn::Add(hn::LoadU(d, to), hn::Mul(hn::Mul(p, p), g)), d, to);
      if (!with_rate) continue;
      const auto slope = hn::Add(a1, hn::Mul(p, hn::Add(hn::Add(a2, a2), hn::Mul(p, hn::Mul(hn::Set(d, 3.0f), a3)))));
      const auto by_p = hn::Mul(p, hn::Add(hn::Add(g, g), hn::Mul(p, slope)));
      float* at = rate.row(particle.z + j) + particle.x + column;
      const auto along = hn::Add(along_x, hn::Set(d, 2.0f * inverse * way.y * z));
      hn::StoreU(hn::Add(hn::LoadU(d, at), hn::Mul(by_p, along)), d, at);
    }
  }
}

template <class D>
HWY_INLINE void add_all(D d, const ParticleShape& shape, const PlacedParticle* particles, int count, int first,
                        int rows, const TorusField& height, const glm::vec2* ways, const TorusField& rate) {
  for (int i = 0; i < count; ++i) {
    const PlacedParticle& particle = particles[i];
    // Its first row lies among those asked for, or so far before them, around the torus, that only its last ones do.
    const int from_first = (particle.z - first) & (height.size - 1);
    const int begin = from_first < rows ? 0 : height.size - from_first,
              end = from_first < rows ? std::min(shape.reach, rows - from_first) : shape.reach;
    if (ways)
      add_rows<D, true>(d, shape, particle, begin, end, height, ways[particle.number >> 1], rate);
    else
      add_rows<D, false>(d, shape, particle, begin, end, height, glm::vec2(0.0f), rate);
  }
}

// Six texels around the middle between the third and the fourth.
constexpr float near_share = 150.0f / 256.0f, next_share = -25.0f / 256.0f, far_share = 3.0f / 256.0f;

template <class D, class V>
HWY_INLINE V middle(D d, V far_0, V next_0, V near_0, V near_1, V next_1, V far_1) {
  const auto near = hn::Mul(hn::Set(d, near_share), hn::Add(near_0, near_1));
  const auto next = hn::Mul(hn::Set(d, next_share), hn::Add(next_0, next_1));
  return hn::Add(near, hn::Add(next, hn::Mul(hn::Set(d, far_share), hn::Add(far_0, far_1))));
}
}  // namespace

void add(const ParticleShape& shape, const PlacedParticle* particles, int count, int first, int rows,
         const TorusField& height, const glm::vec2* ways, const TorusField& rate) {
  if (shape.reach <= 8)
    add_all(hn::CappedTag<float, 8>(), shape, particles, count, first, rows, height, ways, rate);
  else
    add_all(hn::CappedTag<float, 16>(), shape, particles, count, first, rows, height, ways, rate);
}

void add_spline(std::span<const WaveParticle> particles, std::int64_t ticks, float amplitude, float way_a_turn,
                const TorusField& height, const TorusField& rate) {
  const hn::FixedTag<float, 4> d;
  // Of a particle a part t of a texel past the second of four: Horner's coefficients of the four weights (Unser 1999,
  // eq. 6).
  alignas(16) static constexpr float c0[4] = {1.0f / 6, 4.0f / 6, 1.0f / 6, 0.0f}, c1[4] = {-0.5f, 0.0f, 0.5f, 0.0f},
                                     c2[4] = {0.5f, -1.0f, 0.5f, 0.0f}, c3[4] = {-1.0f / 6, 0.5f, -0.5f, 1.0f / 6};
  const auto a0 = hn::Load(d, c0), a1 = hn::Load(d, c1), a2 = hn::Load(d, c2), a3 = hn::Load(d, c3),
             two = hn::Set(d, 2.0f), three = hn::Set(d, 3.0f);
  const auto weights = [&](auto t) HWY_ATTR {
    return hn::Add(a0, hn::Mul(t, hn::Add(a1, hn::Mul(t, hn::Add(a2, hn::Mul(t, a3))))));
  };
  const auto slopes = [&](auto t) HWY_ATTR {
    return hn::Add(a1, hn::Mul(t, hn::Add(hn::Mul(two, a2), hn::Mul(t, hn::Mul(three, a3)))));
  };
  const int log2_size = std::countr_zero(unsigned(height.size)), shift = 32 - log2_size, mask = height.size - 1;
  const auto time = std::uint64_t(ticks);
  const bool with_rate = way_a_turn != 0.0f;
  alignas(16) float along[4], along_slope[4];
  for (const WaveParticle& p : particles) {
    const std::uint32_t x = p.x + std::uint32_t((p.turns_x * time) >> 32),
                        z = p.z + std::uint32_t((p.turns_z * time) >> 32);  // gpu::phase_turns
    const auto t_x = hn::Set(d, float(std::int32_t((x << log2_size) >> 1)) * 0x1p-31f),
               t_z = hn::Set(d, float(std::int32_t((z << log2_size) >> 1)) * 0x1p-31f);
    const int column = (int(x >> shift) - 1) & mask, row = int(z >> shift) - 1;
    const auto w_x = weights(t_x);
    const auto strength = hn::Set(d, p.trough ? -amplitude : amplitude);
    hn::Store(hn::Mul(strength, weights(t_z)), d, along);
    for (int j = 0; j < 4; ++j) {
      float* to = height.row(row + j) + column;
      hn::StoreU(hn::Add(hn::LoadU(d, to), hn::Mul(hn::Set(d, along[j]), w_x)), d, to);
    }
    if (!with_rate) continue;
    const float v_x = float(std::int64_t(p.turns_x)) * way_a_turn, v_z = float(std::int64_t(p.turns_z)) * way_a_turn;
    hn::Store(hn::Mul(hn::Set(d, v_z), hn::Mul(strength, slopes(t_z))), d, along_slope);
    const auto s_x = hn::Mul(hn::Set(d, v_x), slopes(t_x));
    for (int j = 0; j < 4; ++j) {
      float* to = rate.row(row + j) + column;
      const auto change = hn::Add(hn::Mul(hn::Set(d, along[j]), s_x), hn::Mul(hn::Set(d, along_slope[j]), w_x));
      hn::StoreU(hn::Add(hn::LoadU(d, to), change), d, to);
    }
  }
}

void fold(const TorusField& from, const TorusField& to, const float* taps, int reach, int first, int last) {
  const hn::CappedTag<float, 8> d;
  const int lanes = int(hn::Lanes(d));
  alignas(64) float both[256 + 32];  // the rows above and below together
  for (int z = first; z < last; ++z) {
    float* out = to.row(z);
    std::fill_n(out, from.size, 0.0f);
    for (int k = 0; k <= reach; ++k, taps += reach + 1) {
      const float* row = from.row(z - k);
      if (k > 0) {
        const float* other = from.row(z + k);
        for (int x = -16; x < from.size + 16; x += lanes)
          hn::StoreU(hn::Add(hn::LoadU(d, row + x), hn::LoadU(d, other + x)), d, both + 16 + x);
        row = both + 16;
      }
      for (int x = 0; x < from.size; x += lanes) {
        auto sum = hn::Add(hn::LoadU(d, out + x), hn::Mul(hn::Set(d, taps[0]), hn::LoadU(d, row + x)));
        for (int m = 1; m <= reach; ++m)
          sum =
              hn::Add(sum, hn::Mul(hn::Set(d, taps[m]), hn::Add(hn::LoadU(d, row + x - m), hn::LoadU(d, row + x + m))));
        hn::StoreU(sum, d, out + x);
      }
    }
    taps -= (reach + 1) * (reach + 1);
    std::copy_n(out, 16, out + to.size);
    std::copy_n(out + to.size - TorusField::before, TorusField::before, out - TorusField::before);
  }
}

void sum_row(const TorusField& from, const TorusField& to, int z) {
  const hn::CappedTag<float, 16> d;
  const int lanes = int(hn::Lanes(d));
  const float* row = from.row(z);
  float* out = to.row(z);
  for (int x = 0; x < from.size + TorusField::after; x += lanes)
    hn::StoreU(hn::Add(hn::LoadU(d, out + x), hn::LoadU(d, row + x)), d, out + x);
}

void wrap(const TorusField& field, int z) {
  const hn::CappedTag<float, 16> d;
  const int lanes = int(hn::Lanes(d));
  float* row = field.row(z);
  for (int x = 0; x < TorusField::after; x += lanes)
    hn::StoreU(hn::Add(hn::LoadU(d, row + x), hn::LoadU(d, row + field.size + x)), d, row + x);
  std::copy_n(row, 16, row + field.size);
  std::copy_n(row + field.size - TorusField::before, TorusField::before, row - TorusField::before);
}

void refine(const TorusField& from, const TorusField& to, int first, int last) {
  const hn::CappedTag<float, 8> d;
  const int lanes = int(hn::Lanes(d));
  alignas(64) float line[256 + 32];  // a row between the rows, three columns beyond either end at least
  for (int z = first; z < last; ++z) {
    const int half = z >> 1;
    const float* row = from.row(half);
    if (z & 1) {
      const float *far_0 = from.row(half - 2), *next_0 = from.row(half - 1), *next_1 = from.row(half + 2),
                  *far_1 = from.row(half + 3), *near_1 = from.row(half + 1);
      for (int x = -16; x < from.size + 16; x += lanes)
        hn::StoreU(middle(d, hn::LoadU(d, far_0 + x), hn::LoadU(d, next_0 + x), hn::LoadU(d, row + x),
                          hn::LoadU(d, near_1 + x), hn::LoadU(d, next_1 + x), hn::LoadU(d, far_1 + x)),
                   d, line + 16 + x);
      row = line + 16;
    }
    float* out = to.row(z);
    for (int x = 0; x < from.size; x += lanes) {
      const auto at = [&](int shift) HWY_ATTR { return hn::LoadU(d, row + x + shift); };
      hn::StoreInterleaved2(at(0), middle(d, at(-2), at(-1), at(0), at(1), at(2), at(3)), d, out + 2 * x);
    }
    std::copy_n(out, 16, out + to.size);
    std::copy_n(out + to.size - TorusField::before, TorusField::before, out - TorusField::before);
  }
}

void rows(const TorusField& height, const TorusField& rate, const ParticleTexels& texels, int first, int last,
          const PlaneLevel& level) {
  const hn::CappedTag<float, 8> d;
  const int lanes = int(hn::Lanes(d));
  const float inverse = texels.inverse_texel, inverse_2 = inverse * inverse;
  const auto eight = hn::Set(d, 8.0f), sixteen = hn::Set(d, 16.0f), thirty = hn::Set(d, 30.0f),
             shift = hn::Set(d, texels.shift);
  const auto mean = hn::Set(d, texels.mean);
  const auto first_scale = hn::Set(d, inverse / 12.0f), second_scale = hn::Set(d, texels.shift * inverse_2 / 12.0f),
             cross_scale = hn::Set(d, texels.shift * inverse_2 / 48.0f);
  // (8 (f1 - f-1) - (f2 - f-2)) / 12: within (k texel)^4 / 30 of a slope.
  const auto slope = [&](auto b2, auto b1, auto f1, auto f2) HWY_ATTR {
    return hn::Mul(first_scale, hn::Sub(hn::Mul(eight, hn::Sub(f1, b1)), hn::Sub(f2, b2)));
  };
  const auto bend = [&](auto b2, auto b1, auto f0, auto f1, auto f2) HWY_ATTR {
    return hn::Mul(second_scale,
                   hn::Sub(hn::Sub(hn::Mul(sixteen, hn::Add(f1, b1)), hn::Add(f2, b2)), hn::Mul(thirty, f0)));
  };
  for (int z = first; z < last; ++z) {
    const float *r0 = height.row(z - 2), *r1 = height.row(z - 1), *r2 = height.row(z), *r3 = height.row(z + 1),
                *r4 = height.row(z + 2);
    const std::ptrdiff_t at = std::ptrdiff_t(z) * level.stride;
    const auto plane = [&](WavePlane which, int x) HWY_ATTR { return &level.texels[int(which)][at + x].x; };
    for (int x = 0; x < height.size; x += lanes) {
      const auto of = [&](const float* row, int by) HWY_ATTR { return hn::LoadU(d, row + x + by); };
      const auto h = of(r2, 0);
      const auto hx = slope(of(r2, -2), of(r2, -1), of(r2, 1), of(r2, 2)),
                 hz = slope(of(r0, 0), of(r1, 0), of(r3, 0), of(r4, 0));
      const auto xx = bend(of(r2, -2), of(r2, -1), h, of(r2, 1), of(r2, 2)),
                 zz = bend(of(r0, 0), of(r1, 0), h, of(r3, 0), of(r4, 0));
      // Differences of differences, over one texel and over two: (16 near - far) / 48.
      const auto near = hn::Sub(hn::Sub(of(r3, 1), of(r3, -1)), hn::Sub(of(r1, 1), of(r1, -1)));
      const auto far = hn::Sub(hn::Sub(of(r4, 2), of(r4, -2)), hn::Sub(of(r0, 2), of(r0, -2)));
      const auto xz = hn::Mul(cross_scale, hn::Sub(hn::Mul(sixteen, near), far));
      const auto divergence = hn::Add(xx, zz);
      hn::StoreInterleaved4(hn::Mul(shift, hx), hn::Sub(h, mean), hn::Mul(shift, hz), xz, d,
                            plane(WavePlane::shift, x));
      hn::StoreInterleaved4(hx, hz, xx, zz, d, plane(WavePlane::slope, x));
      hn::StoreInterleaved4(hn::Mul(hx, hx), hn::Mul(hz, hz), hn::Mul(hx, hz), hn::Mul(divergence, divergence), d,
                            plane(WavePlane::moments, x));
      if (!texels.velocity) continue;
      const float *q0 = rate.row(z - 2), *q1 = rate.row(z - 1), *q2 = rate.row(z), *q3 = rate.row(z + 1),
                  *q4 = rate.row(z + 2);
      const auto vx = hn::Mul(shift, slope(of(q2, -2), of(q2, -1), of(q2, 1), of(q2, 2)));
      const auto vz = hn::Mul(shift, slope(of(q0, 0), of(q1, 0), of(q3, 0), of(q4, 0)));
      hn::StoreInterleaved4(vx, of(q2, 0), vz, hn::Zero(d), d, plane(WavePlane::velocity, x));
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(add);
HWY_EXPORT(add_spline);
HWY_EXPORT(fold);
HWY_EXPORT(sum_row);
HWY_EXPORT(wrap);
HWY_EXPORT(refine);
HWY_EXPORT(rows);

void add_particles(const ParticleShape& shape, const PlacedParticle* particles, int count, int first, int rows,
                   const TorusField& height, const glm::vec2* ways, const TorusField& rate) {
  HWY_DYNAMIC_DISPATCH(add)(shape, particles, count, first, rows, height, ways, rate);
}
void add_splines(std::span<const WaveParticle> particles, std::int64_t ticks, float amplitude, float way_a_turn,
                 const TorusField& height, const TorusField& rate) {
  HWY_DYNAMIC_DISPATCH(add_spline)(particles, ticks, amplitude, way_a_turn, height, rate);
}
void fold_rows(const TorusField& from, const TorusField& to, const float* taps, int reach, int first, int last) {
  HWY_DYNAMIC_DISPATCH(fold)(from, to, taps, reach, first, last);
}
void add_row(const TorusField& from, const TorusField& to, int z) { HWY_DYNAMIC_DISPATCH(sum_row)(from, to, z); }
void wrap_row(const TorusField& field, int z) { HWY_DYNAMIC_DISPATCH(wrap)(field, z); }
void refine_rows(const TorusField& from, const TorusField& to, int first, int last) {
  HWY_DYNAMIC_DISPATCH(refine)(from, to, first, last);
}
void particle_rows(const TorusField& height, const TorusField& rate, const ParticleTexels& texels, int first, int last,
                   const PlaneLevel& level) {
  HWY_DYNAMIC_DISPATCH(rows)(height, rate, texels, first, last, level);
}

}  // namespace seascape
#endif
