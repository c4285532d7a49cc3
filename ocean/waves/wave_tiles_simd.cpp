#include "ocean/waves/wave_tiles_simd.h"

#include <memory>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/waves/wave_tiles_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep

#include "ocean/waves/fft-inl.h"

#ifndef SEASCAPE_WAVE_TILES_SIMD_ONCE
#define SEASCAPE_WAVE_TILES_SIMD_ONCE
namespace seascape {
// The workspace of a cascade: waves turned to their phase, packed spectra, and these transformed along x.
struct Workspace {
  std::ptrdiff_t row;         // floats from one row of mz to the next, padded against cache aliasing
  std::ptrdiff_t spectrum;    // offset of the packed spectra: [field][re, im][mx + band/2][mz + band/2]
  std::ptrdiff_t half_done;   // offset of their transforms along x: [field][re, im][x][mz + band/2]
  std::ptrdiff_t floats;
  Workspace(const FftPlan& plan, bool velocity)
      : row(plan.band + 16),
        // [re, im][mx + band/2], one row and one column more, zero: the mirror of m = -band/2.
        spectrum(2 * row * (plan.band + 1)),
        half_done(spectrum + 2 * packed_fields(velocity) * row * plan.band),
        floats(half_done + 2 * packed_fields(velocity) * row * plan.n) {}
};
}  // namespace seascape
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {

namespace {

// Wider vectors gain nothing here and would push the scratch of a strip out of the first-level cache.
using Lanes = hn::CappedTag<float, 8>;
using Vector = hn::Vec<Lanes>;
using Ints = hn::RebindToSigned<Lanes>;

// gpu::cos_sin_turns (shaders/shared/phase.h), the same operations in the same order.
HWY_INLINE void cos_sin_turns(hn::Vec<Ints> turns, Vector& cosine, Vector& sine) {
  const Lanes d;
  const Ints di;
  const hn::RebindToUnsigned<Lanes> du;
  const auto quarter = hn::ShiftRight<30>(hn::BitCast(du, hn::Add(turns, hn::Set(di, 0x20000000))));
  const auto rest = hn::Sub(turns, hn::BitCast(di, hn::ShiftLeft<30>(quarter)));
  const Vector f = hn::Mul(hn::ConvertTo(d, rest), hn::Set(d, 2.3283064365386963e-10f));
  const Vector f2 = hn::Mul(f, f);
  Vector s = hn::Mul(f2, hn::Set(d, -75.401612699015970f));
  s = hn::Mul(f2, hn::Add(hn::Set(d, 81.592542871205710f), s));
  s = hn::Mul(f2, hn::Add(hn::Set(d, -41.341662570547270f), s));
  s = hn::Mul(f, hn::Add(hn::Set(d, 6.2831852878129455f), s));
  Vector c = hn::Mul(f2, hn::Set(d, 59.424105800289940f));
  c = hn::Mul(f2, hn::Add(hn::Set(d, -85.448820084313820f), c));
  c = hn::Mul(f2, hn::Add(hn::Set(d, 64.939369051373060f), c));
  c = hn::Mul(f2, hn::Add(hn::Set(d, -19.739208789987394f), c));
  c = hn::Add(hn::Set(d, 1.0f), c);
  const auto swap = hn::MaskFromVec(hn::BitCast(d, hn::Neg(hn::BitCast(di, hn::And(quarter, hn::Set(du, 1u))))));
  const auto sign = hn::Set(du, 0x80000000u);
  const auto sign_x = hn::And(hn::ShiftLeft<30>(hn::Add(quarter, hn::Set(du, 1u))), sign);
  const auto sign_y = hn::And(hn::ShiftLeft<30>(quarter), sign);
  cosine = hn::Xor(hn::IfThenElse(swap, s, c), hn::BitCast(d, sign_x));
  sine = hn::Xor(hn::IfThenElse(swap, c, s), hn::BitCast(d, sign_y));
}

// Four rows of four floats into four columns.
HWY_INLINE void transpose_4(const float* from, std::ptrdiff_t from_row, float* to, std::ptrdiff_t to_row) {
  const hn::FixedTag<float, 4> d;
  const auto a = hn::LoadU(d, from), b = hn::LoadU(d, from + from_row), c = hn::LoadU(d, from + 2 * from_row),
             e = hn::LoadU(d, from + 3 * from_row);
  const auto ac_low = hn::InterleaveLower(d, a, c), be_low = hn::InterleaveLower(d, b, e);
  const auto ac_high = hn::InterleaveUpper(d, a, c), be_high = hn::InterleaveUpper(d, b, e);
  hn::StoreU(hn::InterleaveLower(d, ac_low, be_low), d, to);
  hn::StoreU(hn::InterleaveUpper(d, ac_low, be_low), d, to + to_row);
  hn::StoreU(hn::InterleaveLower(d, ac_high, be_high), d, to + 2 * to_row);
  hn::StoreU(hn::InterleaveUpper(d, ac_high, be_high), d, to + 3 * to_row);
}

HWY_INLINE Vector reversed(const float* last) {  // last[0], last[-1], ...
  const Lanes d;
  return hn::Reverse(d, hn::LoadU(d, last - (hn::Lanes(d) - 1)));
}
}  // namespace

void along_x(const WaveTable& table, const FftPlan& plan, std::int64_t ticks, bool velocity, float* workspace, float* scratch) {
  const Lanes d;
  const Ints di;
  const int band = plan.band, lanes = int(hn::Lanes(d));
  const Workspace layout(plan, velocity);
  const std::ptrdiff_t row = layout.row;
  float* turned_re = workspace;
  float* turned_im = workspace + row * (band + 1);

  // Every wave turned to its phase: a exp(-i phase).
  for (int i = 0; i < band; ++i) {
    for (int j = 0; j < band; j += 16) {
      const std::ptrdiff_t at = std::ptrdiff_t(i) * band + j;
      alignas(64) std::int32_t phase[16];
      for (int l = 0; l < 16; ++l) phase[l] = std::int32_t(std::uint32_t((table.turns[at + l] * std::uint64_t(ticks)) >> 32));
      for (int l = 0; l < 16; l += lanes) {
        Vector c, s;
        cos_sin_turns(hn::Load(di, phase + l), c, s);
        const Vector re = hn::LoadU(d, table.amplitude_re.data() + at + l), im = hn::LoadU(d, table.amplitude_im.data() + at + l);
        hn::StoreU(hn::Add(hn::Mul(re, c), hn::Mul(im, s)), d, turned_re + i * row + j + l);
        hn::StoreU(hn::Sub(hn::Mul(im, c), hn::Mul(re, s)), d, turned_im + i * row + j + l);
      }
    }
    turned_re[i * row + band] = turned_im[i * row + band] = 0.0f;
  }
  for (int j = 0; j <= band; ++j) turned_re[band * row + j] = turned_im[band * row + j] = 0.0f;

  // Height: H(m) = (r(m) + conj r(-m)) / 2, so that the field is real. The rest are H times a factor each (a field's gradient
  // is i k, its displacement i k / |k| times chop, which narrows crests), packed as packed_fields() says.
  const std::ptrdiff_t plane = row * band;
  for (int i = 0; i < band; ++i) {
    float* to = workspace + layout.spectrum + i * row;
    const float* here_re = turned_re + i * row;
    const float* here_im = turned_im + i * row;
    const float* mirror_re = turned_re + (band - i) * row + band;
    const float* mirror_im = turned_im + (band - i) * row + band;
    for (int j = 0; j < band; j += lanes) {
      const Vector r_re = hn::LoadU(d, here_re + j), r_im = hn::LoadU(d, here_im + j);
      const Vector m_re = reversed(mirror_re - j), m_im = reversed(mirror_im - j);
      const Vector half_of = hn::Set(d, 0.5f), one = hn::Set(d, 1.0f);
      const Vector h_re = hn::Mul(half_of, hn::Add(r_re, m_re)), h_im = hn::Mul(half_of, hn::Sub(r_im, m_im));
      const int at = i * band + j;
      const Vector kx = hn::LoadU(d, table.kx.data() + at), kz = hn::LoadU(d, table.kz.data() + at);
      const Vector sx = hn::LoadU(d, table.shift_x.data() + at), sz = hn::LoadU(d, table.shift_z.data() + at);
      const auto put = [&](int field, Vector re, Vector im) HWY_ATTR {
        hn::StoreU(re, d, to + (2 * field) * plane + j);
        hn::StoreU(im, d, to + (2 * field + 1) * plane + j);
      };
      const Vector shift_height = hn::Add(one, sx);                  // i H (1 + sx)
      put(0, hn::Neg(hn::Mul(h_im, shift_height)), hn::Mul(h_re, shift_height));
      const Vector shift_z = hn::Mul(sz, hn::Sub(one, hn::Mul(hn::Set(d, table.shear_length_m), kx)));  // i H sz (1 - length kx)
      put(1, hn::Neg(hn::Mul(h_im, shift_z)), hn::Mul(h_re, shift_z));
      put(2, hn::Neg(hn::Add(hn::Mul(h_im, kx), hn::Mul(h_re, kz))),  // H (i kx - kz)
          hn::Sub(hn::Mul(h_re, kx), hn::Mul(h_im, kz)));
      const Vector xx = hn::Mul(sx, kx), zz = hn::Mul(sz, kz);       // -H (sx kx + i sz kz)
      put(3, hn::Sub(hn::Mul(h_im, zz), hn::Mul(h_re, xx)), hn::Neg(hn::Add(hn::Mul(h_re, zz), hn::Mul(h_im, xx))));
      if (velocity) {
        // dh/dt: W(m) = -i w (r(m) - conj r(-m)) / 2.
        const Vector w = hn::Mul(half_of, hn::LoadU(d, table.frequency.data() + at));
        const Vector w_re = hn::Mul(w, hn::Add(r_im, m_im)), w_im = hn::Mul(w, hn::Sub(m_re, r_re));
        put(4, hn::Neg(hn::Mul(w_im, shift_height)), hn::Mul(w_re, shift_height));
        put(5, hn::Neg(hn::Mul(w_im, sz)), hn::Mul(w_re, sz));
      }
    }
  }

  for (int part = 0; part < packed_fields(velocity); ++part) {
    const float* in_re = workspace + layout.spectrum + 2 * part * plane;
    float* out_re = workspace + layout.half_done + 2 * part * row * plan.n;
    float* out_im = out_re + row * plan.n;
    for (int j = 0; j < band; j += lanes)
      for (int r = 0; r < plan.repeats; ++r) {
        columns_in<Lanes>(plan, r, in_re + j, in_re + plane + j, row, scratch);
        columns_out<Lanes>(plan, r, scratch, out_re + r * row + j, out_im + r * row + j, plan.repeats * row);
      }
  }
}

// Two packed fields side by side: their columns out of the workspace, and from these their values at every z.
constexpr int column_width = 8;
constexpr int pair_planes = 4;  // [field of two][re, im]

// columns: [plane][mz + band/2][lane].
HWY_INLINE void columns_of_pair(const Workspace& layout, const FftPlan& plan, const float* workspace, int pair, int x, float* columns) {
  const int lanes = int(hn::Lanes(Lanes()));
  const std::ptrdiff_t size = std::ptrdiff_t(plan.band) * column_width;
  for (int p = 0; p < pair_planes; ++p) {
    const float* rows = workspace + layout.half_done + (std::ptrdiff_t(pair_planes * pair + p) * plan.n + x) * layout.row;
    for (int j = 0; j < plan.band; j += 4)
      for (int lane = 0; lane < lanes; lane += 4)
        transpose_4(rows + lane * layout.row + j, layout.row, columns + p * size + j * column_width + lane,
                    column_width);
  }
}

void along_z(const WaveTable& table, const FftPlan& plan, const float* workspace, bool velocity, int first_x, const PlaneLevel& level,
             float* scratch) {
  const Lanes d;
  const int lanes = int(hn::Lanes(d));
  const Workspace layout(plan, velocity);
  const std::ptrdiff_t column = std::ptrdiff_t(plan.band) * column_width, part = std::ptrdiff_t(plan.core) * column_width;
  float* work = scratch;
  float* columns = scratch + column_work<Lanes>(plan);
  float* results = columns + pair_planes * column;
  const Vector shear = hn::Set(d, 1.0f / table.shear_length_m);
  for (int x = first_x; x < first_x + strip_width; x += lanes)
    for (int pair = 0; 2 * pair < packed_fields(velocity); ++pair) {
      columns_of_pair(layout, plan, workspace, pair, x, columns);
      for (int r = 0; r < plan.repeats; ++r) {
        for (int p = 0; p < pair_planes; p += 2) {
          columns_in<Lanes>(plan, r, columns + p * column, columns + (p + 1) * column, column_width, work);
          columns_out<Lanes>(plan, r, work, results + p * part, results + (p + 1) * part, column_width);
        }
        for (int q = 0; q < plan.core; ++q) {
          const std::ptrdiff_t at = (std::ptrdiff_t(plan.repeats) * q + r) * level.stride + x;
          const auto value = [&](int p) HWY_ATTR { return hn::Load(d, results + p * part + q * column_width); };
          const auto plane = [&](WavePlane which) HWY_ATTR { return &level.texels[int(which)][at].x; };
          const Vector a = value(0), b = value(1), c = value(2), e = value(3);
          if (pair == 0) {
            hn::StoreInterleaved4(a, b, c, hn::Mul(shear, e), d, plane(WavePlane::shift));
          } else if (pair == 1) {
            const Vector divergence = hn::Add(c, e);
            hn::StoreInterleaved4(a, b, c, e, d, plane(WavePlane::slope));
            const auto moment = [&](Vector one, Vector other) HWY_ATTR { return hn::Mul(hn::Mul(one, other), hn::Set(d, table.moment_share)); };
            hn::StoreInterleaved4(moment(a, a), moment(b, b), moment(a, b), moment(divergence, divergence), d, plane(WavePlane::moments));
          } else {
            hn::StoreInterleaved4(a, b, c, hn::Zero(d), d, plane(WavePlane::velocity));
          }
        }
      }
    }
}

void average(const PlaneLevel& from, const PlaneLevel& to, int planes, int x, int width, int height) {
  const hn::FixedTag<float, 4> d;
  for (int plane = 0; plane < planes; ++plane)
    for (int z = 0; z < height; ++z) {
      const float* a = &from.texels[plane][std::ptrdiff_t(2 * z) * from.stride + 2 * x].x;
      const float* b = a + std::ptrdiff_t(4) * from.stride;
      float* out = &to.texels[plane][std::ptrdiff_t(z) * to.stride + x].x;
      for (int i = 0; i < width; ++i) {
        const auto upper = hn::Add(hn::LoadU(d, a + 8 * i), hn::LoadU(d, a + 8 * i + 4));
        const auto lower = hn::Add(hn::LoadU(d, b + 8 * i), hn::LoadU(d, b + 8 * i + 4));
        hn::StoreU(hn::Mul(hn::Add(upper, lower), hn::Set(d, 0.25f)), d, out + 4 * i);
      }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(along_x);
HWY_EXPORT(along_z);
HWY_EXPORT(average);

std::size_t workspace_floats(const FftPlan& plan, bool velocity) { return std::size_t(Workspace(plan, velocity).floats); }

namespace {
// The columns and results of a pair of fields; the thread's own, so that strips find them in its core's caches.
float* strip_scratch(const FftPlan& plan) {
  thread_local std::vector<float> memory;
  thread_local float* aligned = nullptr;
  constexpr std::size_t planes = 4, width = 8, line = 64;
  const std::size_t floats = planes * width * std::size_t(plan.band + plan.core) + 2 * width * std::size_t(plan.core + 16);
  if (memory.size() < floats + line / sizeof(float)) {
    memory.resize(floats + line / sizeof(float));
    void* first = memory.data();
    std::size_t bytes = memory.size() * sizeof(float);
    aligned = static_cast<float*>(std::align(line, floats * sizeof(float), first, bytes));
  }
  return aligned;
}
}  // namespace

void waves_along_x(const WaveTable& table, const FftPlan& plan, std::int64_t ticks, bool velocity, float* workspace) {
  HWY_DYNAMIC_DISPATCH(along_x)(table, plan, ticks, velocity, workspace, strip_scratch(plan));
}

void average_down(const PlaneLevel& from, const PlaneLevel& to, int planes, int x, int width, int height) {
  HWY_DYNAMIC_DISPATCH(average)(from, to, planes, x, width, height);
}

void strip_along_z(const WaveTable& table, const FftPlan& plan, const float* workspace, bool velocity, int x, const PlaneLevel* levels) {
  HWY_DYNAMIC_DISPATCH(along_z)(table, plan, workspace, velocity, x, levels[0], strip_scratch(plan));
  for (int level = 1; level <= strip_levels; ++level)
    average_down(levels[level - 1], levels[level], velocity ? 4 : 3, x >> level, strip_width >> level, plan.n >> level);
}

}  // namespace seascape
#endif
