#include "ocean/waves/wave_tiles_simd.h"

#include <algorithm>

#include "ocean/waves/thread_scratch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/waves/wave_tiles_simd.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // IWYU pragma: keep

#include "ocean/waves/fft-inl.h"
#include "ocean/waves/half_floats-inl.h"
#include "ocean/waves/turns-inl.h"

#ifndef SEASCAPE_WAVE_TILES_SIMD_ONCE
#define SEASCAPE_WAVE_TILES_SIMD_ONCE
namespace seascape {
// The workspace of a cascade: its packed spectra transformed along x, [field][re, im][mz + band/2][x]. Rows and planes
// are padded against cache aliasing, and begin with cache lines.
struct Workspace {
  std::ptrdiff_t row, plane, floats;
  Workspace(const FftPlan& plan, const TileFields& fields)
      : row(plan.n + 16), plane(row * plan.band + 16), floats(2 * packed_fields(fields) * plane) {}
};
}  // namespace seascape
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {

namespace {

using Lanes = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Lanes>;
using Ints = hn::RebindToSigned<Lanes>;

HWY_INLINE Vector reversed(const float* last) {  // last[0], last[-1], ...
  const Lanes d;
  return hn::Reverse(d, hn::LoadU(d, last - (hn::Lanes(d) - 1)));
}

// gpu::phase_turns of the waves from `turns` on.
HWY_INLINE hn::Vec<Ints> phases(const std::uint64_t* turns, std::uint64_t ticks) {
  const hn::RebindToUnsigned<Lanes> du;
  const hn::Repartition<std::uint64_t, Lanes> dw;
  const auto low_ticks = hn::Set(du, std::uint32_t(ticks)), high_ticks = hn::Set(du, std::uint32_t(ticks >> 32));
  const auto a = hn::BitCast(du, hn::LoadU(dw, turns)), b = hn::BitCast(du, hn::LoadU(dw, turns + hn::Lanes(dw)));
  const auto carried =
      hn::ConcatOdd(du, hn::BitCast(du, hn::MulEven(b, low_ticks)), hn::BitCast(du, hn::MulEven(a, low_ticks)));
  const auto low = hn::ConcatEven(du, b, a), high = hn::ConcatOdd(du, b, a);
  return hn::BitCast(Ints(), hn::Add(carried, hn::Add(hn::Mul(high, low_ticks), hn::Mul(low, high_ticks))));
}

// A row of waves turned to their phase, a exp(-i phase), and one zero more: the mirror of m = -band/2.
HWY_INLINE void turned_row(const WaveTable& table, int band, int i, std::uint64_t ticks, float* re, float* im) {
  const Lanes d;
  const std::ptrdiff_t row = std::ptrdiff_t(i) * band;
  for (int j = 0; j < band; j += int(hn::Lanes(d))) {
    Vector c, s;
    cos_sin_turns(d, phases(table.turns.data() + row + j, ticks), c, s);
    const Vector a = hn::LoadU(d, table.amplitude_re.data() + row + j),
                 b = hn::LoadU(d, table.amplitude_im.data() + row + j);
    hn::StoreU(hn::Add(hn::Mul(a, c), hn::Mul(b, s)), d, re + j);
    hn::StoreU(hn::Sub(hn::Mul(b, c), hn::Mul(a, s)), d, im + j);
  }
  re[band] = im[band] = 0.0f;
}

// A row of the packed spectra: [field][re, im][mx + band/2], planes `width` apart. Height: H(m) = (r(m) + conj r(-m)) /
// 2, so that the field is real. The rest are H times a factor each (a field's gradient is i k, its displacement i k /
// |k| times chop, which narrows crests), packed as packed_fields() says. `mirror`: row -mz.
HWY_INLINE void packed_row(const WaveTable& table, int band, int i, const TileFields& fields, const float* here,
                           const float* mirror, float* to, std::ptrdiff_t width) {
  const Lanes d;
  const float *mirror_re = mirror + band, *mirror_im = mirror + width + band;
  const Vector half_of = hn::Set(d, 0.5f), one = hn::Set(d, 1.0f), length = hn::Set(d, table.shear_length_m);
  for (int j = 0; j < band; j += int(hn::Lanes(d))) {
    const Vector r_re = hn::LoadU(d, here + j), r_im = hn::LoadU(d, here + width + j);
    const Vector m_re = reversed(mirror_re - j), m_im = reversed(mirror_im - j);
    const Vector h_re = hn::Mul(half_of, hn::Add(r_re, m_re)), h_im = hn::Mul(half_of, hn::Sub(r_im, m_im));
    const std::ptrdiff_t at = std::ptrdiff_t(i) * band + j;
    const Vector kx = hn::LoadU(d, table.kx.data() + at), kz = hn::LoadU(d, table.kz.data() + at);
    const Vector sx = hn::LoadU(d, table.shift_x.data() + at), sz = hn::LoadU(d, table.shift_z.data() + at);
    const auto put = [&](int which, Vector re, Vector im) HWY_ATTR {
      hn::StoreU(re, d, to + (2 * which) * width + j);
      hn::StoreU(im, d, to + (2 * which + 1) * width + j);
    };
    const Vector shift_height = hn::Add(one, sx);  // i H (1 + sx)
    int field = 0;
    put(field++, hn::Neg(hn::Mul(h_im, shift_height)), hn::Mul(h_re, shift_height));
    const Vector shift_z = hn::Mul(sz, hn::Sub(one, hn::Mul(length, kx)));  // i H sz (1 - length kx)
    put(field++, hn::Neg(hn::Mul(h_im, shift_z)), hn::Mul(h_re, shift_z));
    if (fields.slopes) {
      put(field++, hn::Neg(hn::Add(hn::Mul(h_im, kx), hn::Mul(h_re, kz))),  // H (i kx - kz)
          hn::Sub(hn::Mul(h_re, kx), hn::Mul(h_im, kz)));
      const Vector xx = hn::Mul(sx, kx), zz = hn::Mul(sz, kz);  // -H (sx kx + i sz kz)
      put(field++, hn::Sub(hn::Mul(h_im, zz), hn::Mul(h_re, xx)),
          hn::Neg(hn::Add(hn::Mul(h_re, zz), hn::Mul(h_im, xx))));
    }
    if (fields.velocity) {
      // dh/dt: W(m) = -i w (r(m) - conj r(-m)) / 2.
      const Vector w = hn::Mul(half_of, hn::LoadU(d, table.frequency.data() + at));
      const Vector w_re = hn::Mul(w, hn::Add(r_im, m_im)), w_im = hn::Mul(w, hn::Sub(m_re, r_re));
      put(field++, hn::Neg(hn::Mul(w_im, shift_height)), hn::Mul(w_re, shift_height));
      put(field++, hn::Neg(hn::Mul(w_im, sz)), hn::Mul(w_re, sz));
    }
  }
}
}  // namespace

std::size_t rows_scratch(const FftPlan& plan) { return std::size_t(16 * (plan.band + 16) + row_work(plan)); }

void rows_along_x(const WaveTable& table, const FftPlan& plan, std::int64_t ticks, const TileFields& fields, int first,
                  int last, float* workspace, float* scratch) {
  const int band = plan.band;
  const Workspace layout(plan, fields);
  const std::ptrdiff_t width = band + 16;
  float *turned = scratch, *packed = scratch + 4 * width, *work = scratch + 16 * width;
  for (int pair = first; pair < last; ++pair) {
    const int rows[2] = {pair, (band - pair) % band};
    for (int side = 0; side < 2; ++side)
      turned_row(table, band, rows[side], std::uint64_t(ticks), turned + 2 * side * width,
                 turned + (2 * side + 1) * width);
    if (pair == 0) std::fill_n(turned + 2 * width, 2 * width, 0.0f);  // m = -band/2 has no mirror
    for (int side = 0; side < (pair == 0 || pair == band / 2 ? 1 : 2); ++side) {
      packed_row(table, band, rows[side], fields, turned + 2 * side * width, turned + 2 * (1 - side) * width, packed,
                 width);
      float* to = workspace + rows[side] * layout.row;
      for (int field = 0; field < packed_fields(fields); ++field)
        transform_row(plan, packed + 2 * field * width, packed + (2 * field + 1) * width, to + 2 * field * layout.plane,
                      to + (2 * field + 1) * layout.plane, work);
    }
  }
}

// Wider vectors gain nothing here and would push a strip's scratch out of the first-level cache.
using Strip = hn::CappedTag<float, 8>;
constexpr int pair_planes = 4;  // [field of two][re, im]

std::size_t strip_scratch(const FftPlan& plan) {
  return std::size_t(column_work<Strip>(plan) +
                     std::ptrdiff_t(pair_planes) * plan.core * std::ptrdiff_t(hn::MaxLanes(Strip())));
}

void along_z(const WaveTable& table, const FftPlan& plan, const float* workspace, const TileFields& fields, int first_x,
             const PlaneLevel& level, int to_x, float* scratch) {
  const Strip d;
  constexpr int lanes = int(hn::MaxLanes(Strip()));
  const Workspace layout(plan, fields);
  const std::ptrdiff_t part = std::ptrdiff_t(plan.core) * lanes;
  float *work = scratch, *results = scratch + column_work<Strip>(plan);
  const auto shear = hn::Set(d, 1.0f / table.shear_length_m), share = hn::Set(d, table.moment_share);
  WavePlane planes[3] = {WavePlane::shift};  // of each pair
  int pairs = 1;
  if (fields.slopes) planes[pairs++] = WavePlane::slope;
  if (fields.velocity) planes[pairs++] = WavePlane::velocity;
  for (int x = first_x; x < first_x + strip_width; x += lanes)
    for (int pair = 0; pair < pairs; ++pair) {
      if (level.texels[int(planes[pair])] == nullptr) continue;
      for (int r = 0; r < plan.repeats; ++r) {
        for (int p = 0; p < pair_planes; p += 2) {
          const float* from = workspace + (pair_planes * pair + p) * layout.plane + x;
          columns_in<Strip>(plan, r, from, from + layout.plane, layout.row, work);
          columns_out<Strip>(plan, r, work, results + p * part, results + (p + 1) * part, lanes);
        }
        for (int q = 0; q < plan.core; ++q) {
          const std::ptrdiff_t at = (std::ptrdiff_t(plan.repeats) * q + r) * level.stride + (x - first_x + to_x);
          const auto value = [&](int p) HWY_ATTR { return hn::Load(d, results + p * part + q * lanes); };
          const auto plane = [&](WavePlane which) HWY_ATTR { return &level.texels[int(which)][at].x; };
          const auto a = value(0), b = value(1), c = value(2), e = value(3);
          if (planes[pair] == WavePlane::shift) {
            hn::StoreInterleaved4(a, b, c, hn::Mul(shear, e), d, plane(WavePlane::shift));
          } else if (planes[pair] == WavePlane::slope) {
            const auto divergence = hn::Add(c, e);
            hn::StoreInterleaved4(a, b, c, e, d, plane(WavePlane::slope));
            const auto moment = [&](auto one, auto other) HWY_ATTR { return hn::Mul(hn::Mul(one, other), share); };
            hn::StoreInterleaved4(moment(a, a), moment(b, b), moment(a, b), moment(divergence, divergence), d,
                                  plane(WavePlane::moments));
          } else {
            hn::StoreInterleaved4(a, b, c, hn::Zero(d), d, plane(WavePlane::velocity));
          }
        }
      }
    }
}

void average(const PlaneLevel& from, const PlaneLevel& to, int x, int width, int height) {
  const hn::FixedTag<float, 4> texel;
  for (int plane = 0; plane < 4; ++plane)
    for (int z = 0; z < height && to.texels[plane] != nullptr; ++z) {
      const float* a = &from.texels[plane][std::ptrdiff_t(2 * z) * from.stride + 2 * x].x;
      const float* b = a + std::ptrdiff_t(4) * from.stride;
      float* out = &to.texels[plane][std::ptrdiff_t(z) * to.stride + x].x;
      int i = 0;
      // Of four texels rows are summed before columns whatever the width of the vectors: the bits are the same.
#if HWY_MAX_BYTES >= 32
      const hn::FixedTag<float, 8> two;
      for (; i + 2 <= width; i += 2) {
        const auto left = hn::Add(hn::LoadU(two, a + 8 * i), hn::LoadU(two, b + 8 * i));
        const auto right = hn::Add(hn::LoadU(two, a + 8 * i + 8), hn::LoadU(two, b + 8 * i + 8));
        const auto sum = hn::Add(hn::ConcatLowerLower(two, right, left), hn::ConcatUpperUpper(two, right, left));
        hn::StoreU(hn::Mul(sum, hn::Set(two, 0.25f)), two, out + 4 * i);
      }
#endif
      for (; i < width; ++i) {
        const auto left = hn::Add(hn::LoadU(texel, a + 8 * i), hn::LoadU(texel, b + 8 * i));
        const auto right = hn::Add(hn::LoadU(texel, a + 8 * i + 4), hn::LoadU(texel, b + 8 * i + 4));
        hn::StoreU(hn::Mul(hn::Add(left, right), hn::Set(texel, 0.25f)), texel, out + 4 * i);
      }
    }
}

// Whether vectors of this many bytes, each on its own boundary, make up all rows, and are long enough to be streamed.
bool whole_vectors(const void* first, std::ptrdiff_t row_bytes, std::size_t count_bytes, std::size_t vector_bytes) {
  return vector_bytes >= 16 &&
         (reinterpret_cast<std::uintptr_t>(first) | std::size_t(row_bytes) | count_bytes) % vector_bytes == 0;
}

// Rows of `count` numbers, a multiple of 4, past the caches where vectors of D fit.
template <class D>
HWY_INLINE void send_floats(D d, const float* from, int count, int height, float* to, std::ptrdiff_t row) {
  const int lanes = int(hn::Lanes(d));
  if (!whole_vectors(to, row * 4, std::size_t(count) * 4, hn::Lanes(d) * 4)) {
    for (int z = 0; z < height; ++z) std::copy_n(from + z * count, count, to + z * row);
    return;
  }
  for (int z = 0; z < height; ++z)
    for (int i = 0; i < count; i += lanes) hn::Stream(hn::Load(d, from + z * count + i), d, to + z * row + i);
}

template <class D>
HWY_INLINE void send_halves(D d, const float* from, int count, int height, const WaveTiles::HalfRows& to) {
  const hn::Rebind<std::uint16_t, D> dh;
  const int lanes = int(hn::Lanes(d));
  const bool streams = whole_vectors(to.first, to.row * 2, std::size_t(count) * 2, hn::Lanes(d) * 2);
  for (int z = 0; z < height; ++z)
    for (int i = 0; i < count; i += lanes) {
      const auto value = rounded(d, hn::Load(d, from + z * count + i));
      if (streams)
        hn::Stream(value, dh, to.first + z * to.row + i);
      else
        hn::StoreU(value, dh, to.first + z * to.row + i);
    }
}

// Floats of a plane of a strip and its mip chain.
std::size_t strip_floats(const FftPlan& plan) {
  std::size_t texels = 0;
  for (int level = 0; level <= strip_levels; ++level) texels += std::size_t(strip_width >> level) * (plan.n >> level);
  return (4 * texels + 15) / 16 * 16;
}

std::size_t out_scratch(const FftPlan& plan) { return (strip_scratch(plan) + 15) / 16 * 16 + 2 * strip_floats(plan); }

void out(const WaveTable& table, const FftPlan& plan, const float* workspace, const TileFields& fields, int x,
         const StripPlaces& to, float* scratch) {
  float* const strip = scratch + (strip_scratch(plan) + 15) / 16 * 16;
  // A pair of planes after the other, so that they stay in the core's cache.
  const struct {
    bool there;
    std::initializer_list<WavePlane> planes;
  } pairs[] = {{true, {WavePlane::shift}},
               {fields.slopes, {WavePlane::slope, WavePlane::moments}},
               {fields.velocity, {WavePlane::velocity}}};
  for (const auto& [there, planes] : pairs) {
    if (!there) continue;
    PlaneLevel levels[strip_levels + 1]{};
    float* next = strip;
    for (const WavePlane plane : planes) {
      float* at = next;
      next += strip_floats(plan);
      for (int level = 0; level <= strip_levels; ++level) {
        levels[level].texels[int(plane)] = reinterpret_cast<glm::vec4*>(at);
        levels[level].stride = strip_width >> level;
        at += std::ptrdiff_t(4) * (strip_width >> level) * (plan.n >> level);
      }
    }
    along_z(table, plan, workspace, fields, x, levels[0], 0, scratch);
    for (int level = 1; level <= strip_levels; ++level)
      average(levels[level - 1], levels[level], 0, strip_width >> level, plan.n >> level);
    for (const WavePlane plane : planes)
      for (int level = 0; level <= strip_levels; ++level) {
        const float* const from = &levels[level].texels[int(plane)]->x;
        const int count = 4 * (strip_width >> level), height = plan.n >> level, first = x >> level;
        if (glm::vec4* const texels = to.floats[level].texels[int(plane)])
          send_floats(Lanes(), from, count, height, &texels[first].x, std::ptrdiff_t(4) * to.floats[level].stride);
        WaveTiles::HalfRows halves =
            plane == WavePlane::velocity ? WaveTiles::HalfRows{} : to.halves[level][std::size_t(plane)];
        if (halves.first == nullptr) continue;
        halves.first += 4 * first;
        if (count >= int(hn::Lanes(Lanes())))
          send_halves(Lanes(), from, count, height, halves);
        else
          send_halves(hn::FixedTag<float, 4>(), from, count, height, halves);
      }
  }
  hwy::FlushStream();  // before others are told that the strip is there
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(rows_scratch);
HWY_EXPORT(rows_along_x);
HWY_EXPORT(strip_scratch);
HWY_EXPORT(along_z);
HWY_EXPORT(average);
HWY_EXPORT(out_scratch);
HWY_EXPORT(out);

std::size_t workspace_floats(const FftPlan& plan, const TileFields& fields) {
  return std::size_t(Workspace(plan, fields).floats);
}

void waves_along_x(const WaveTable& table, const FftPlan& plan, std::int64_t ticks, const TileFields& fields, int first,
                   int last, float* workspace) {
  float* scratch = thread_scratch(HWY_DYNAMIC_DISPATCH(rows_scratch)(plan));
  HWY_DYNAMIC_DISPATCH(rows_along_x)(table, plan, ticks, fields, first, last, workspace, scratch);
}

void average_down(const PlaneLevel& from, const PlaneLevel& to, int x, int width, int height) {
  HWY_DYNAMIC_DISPATCH(average)(from, to, x, width, height);
}

void strip_along_z(const WaveTable& table, const FftPlan& plan, const float* workspace, const TileFields& fields, int x,
                   const PlaneLevel& level) {
  float* scratch = thread_scratch(HWY_DYNAMIC_DISPATCH(strip_scratch)(plan));
  HWY_DYNAMIC_DISPATCH(along_z)(table, plan, workspace, fields, x, level, x, scratch);
}

void strip_out(const WaveTable& table, const FftPlan& plan, const float* workspace, const TileFields& fields, int x,
               const StripPlaces& to) {
  float* scratch = thread_scratch(HWY_DYNAMIC_DISPATCH(out_scratch)(plan));
  HWY_DYNAMIC_DISPATCH(out)(table, plan, workspace, fields, x, to, scratch);
}

void strip_mips(const FftPlan& plan, int x, const PlaneLevel* levels) {
  for (int level = 1; level <= strip_levels; ++level)
    average_down(levels[level - 1], levels[level], x >> level, strip_width >> level, plan.n >> level);
}

}  // namespace seascape
#endif
