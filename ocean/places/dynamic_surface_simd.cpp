#include "ocean/places/dynamic_surface_simd.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ocean/waves/thread_scratch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/places/dynamic_surface_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep

#include "ocean/waves/fft-inl.h"
#include "ocean/waves/turns-inl.h"

#ifndef SEASCAPE_DYNAMIC_SURFACE_SIMD_ONCE
#define SEASCAPE_DYNAMIC_SURFACE_SIMD_ONCE
namespace seascape {
namespace {
constexpr float most_half = 65504.0f;  // what textures of half floats hold
// Two real fields f and g go as f + i g: Dx + i h, Dz + i dDx/dz; dh/dx + i dh/dz, dDx/dx + i dDz/dz; dDx/dt + i dh/dt,
// dDz/dt.
constexpr int most_fields = 6, still_fields = 4;
}  // namespace
}  // namespace seascape
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {

namespace {

using Lanes = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Lanes>;
using Strip = Lanes;                 // whose results of all fields stay in the second-level cache
constexpr std::ptrdiff_t line = 16;  // floats

// A thread's memory. Rows are padded against cache aliasing.
struct Scratch {
  std::ptrdiff_t width, row, plane, strip_row, strip_plane;
  float* middle;  // [field][re, im][mz + band/2][x]
  float *turned, *packed, *rows, *columns, *sums;
  float* results;  // of a strip: [field][re, im][z][x]
  float* east;     // of both slopes, right of the strip: [re, im][z]
  std::size_t floats;
  Scratch(const FftPlan& plan, int fields, float* memory)
      : width(plan.band + line),
        row(plan.n + line),
        plane(row * plan.band + line),
        strip_row(std::ptrdiff_t(hn::MaxLanes(Strip()))),
        strip_plane(strip_row * plan.n + line) {
    std::ptrdiff_t next = 0;
    const auto take = [&next, memory](std::ptrdiff_t count) {  // no memory: its size is asked for
      const std::ptrdiff_t at = std::exchange(next, next + (count + line - 1) / line * line);
      return memory != nullptr ? memory + at : nullptr;
    };
    middle = take(2 * fields * plane);
    turned = take(4 * width);
    packed = take(2 * fields * width);
    rows = take(row_work(plan));
    columns = take(column_work<Strip>(plan));
    results = take(2 * fields * strip_plane);
    east = take(2 * plan.n);
    sums = take(3 * width);
    floats = std::size_t(next);
  }
};

HWY_INLINE Vector reversed(const float* last) {  // last[0], last[-1], ...
  const Lanes d;
  return hn::Reverse(d, hn::LoadU(d, last - (hn::Lanes(d) - 1)));
}

// A row of waves as floats, turned to the time wanted, and one zero more: the mirror of m = -band/2.
HWY_INLINE void turned_row(const LevelWaves& waves, int band, int i, float* re, float* im) {
  const Lanes d;
  const hn::Half<Lanes> dh;
  const hn::Rebind<double, decltype(dh)> dd;
  const hn::RebindToSigned<decltype(dh)> dih;
  const hn::RebindToSigned<Lanes> di;
  const std::ptrdiff_t row = std::ptrdiff_t(i) * band, half = std::ptrdiff_t(hn::Lanes(dd));
  const double turns_a_frequency = waves.ahead_s / (2.0 * std::numbers::pi);
  const Vector left = hn::Set(d, float(std::exp(-0.5 * waves.damping_per_s * waves.ahead_s)));
  for (std::ptrdiff_t j = 0; j < band; j += 2 * half) {
    const double* from = reinterpret_cast<const double*>(waves.modes.data() + row + j);
    hn::Vec<decltype(dd)> low_re, low_im, high_re, high_im;
    hn::LoadInterleaved2(dd, from, low_re, low_im);
    hn::LoadInterleaved2(dd, from + 2 * half, high_re, high_im);
    Vector a = hn::Combine(d, hn::DemoteTo(dh, high_re), hn::DemoteTo(dh, low_re)),
           b = hn::Combine(d, hn::DemoteTo(dh, high_im), hn::DemoteTo(dh, low_im));
    if (waves.ahead_s > 0.0) {
      const auto turns = [&](std::ptrdiff_t at) HWY_ATTR {
        const auto t = hn::Mul(hn::LoadU(dd, waves.frequency.data() + at), hn::Set(dd, turns_a_frequency));
        return hn::DemoteTo(dih, hn::Mul(hn::Sub(t, hn::Round(t)), hn::Set(dd, 0x1p32)));
      };
      Vector c, s;
      cos_sin_turns(d, hn::Combine(di, turns(row + j + half), turns(row + j)), c, s);
      const Vector re_was = hn::Mul(left, a), im_was = hn::Mul(left, b);
      a = hn::Add(hn::Mul(re_was, c), hn::Mul(im_was, s));
      b = hn::Sub(hn::Mul(im_was, c), hn::Mul(re_was, s));
    }
    hn::StoreU(a, d, re + j);
    hn::StoreU(b, d, im + j);
  }
  re[band] = im[band] = 0.0f;
}

// A row of the packed spectra: [field][re, im][mx + band/2], planes `width` apart, from its waves and those of row -mz.
// The height is the waves' real part: h(m) = (a(m) + conj a(-m)) / 2. The rest are h times a factor each: a gradient's
// is i k, the shift's i k / |k| times its width. Adds to the sums over mz of each mx: |h|^2, kz |h|^2, kz^2 |h|^2.
HWY_INLINE void packed_row(const LevelTable& table, const LevelWaves& waves, int band, int i, int fields,
                           const float* here, const float* mirror, float* to, std::ptrdiff_t width, float* sums) {
  const Lanes d;
  const float *mirror_re = mirror + band, *mirror_im = mirror + width + band;
  const Vector one = hn::Set(d, 1.0f), kz = hn::Set(d, table.k[std::size_t(i)]);
  for (int j = 0; j < band; j += int(hn::Lanes(d))) {
    const std::ptrdiff_t at = std::ptrdiff_t(i) * band + j;
    const Vector half = hn::LoadU(d, table.half.data() + at), width_m = hn::LoadU(d, table.width.data() + at);
    const Vector kx = hn::LoadU(d, table.k.data() + j);
    const Vector a_re = hn::LoadU(d, here + j), a_im = hn::LoadU(d, here + width + j);
    const Vector m_re = reversed(mirror_re - j), m_im = reversed(mirror_im - j);
    const Vector h_re = hn::Mul(half, hn::Add(a_re, m_re)), h_im = hn::Mul(half, hn::Sub(a_im, m_im));
    const auto put = [&](int field, Vector re, Vector im) HWY_ATTR {
      hn::StoreU(re, d, to + (2 * field) * width + j);
      hn::StoreU(im, d, to + (2 * field + 1) * width + j);
    };
    const Vector sx = hn::Mul(width_m, kx), sz = hn::Mul(width_m, kz);
    const Vector shift_height = hn::Add(one, sx), shift_z = hn::Mul(sz, hn::Sub(one, kx));
    put(0, hn::Neg(hn::Mul(h_im, shift_height)), hn::Mul(h_re, shift_height));  // i h (1 + sx)
    put(1, hn::Neg(hn::Mul(h_im, shift_z)), hn::Mul(h_re, shift_z));            // i h sz (1 - kx)
    put(2, hn::Neg(hn::Add(hn::Mul(h_im, kx), hn::Mul(h_re, kz))),              // h (i kx - kz)
        hn::Sub(hn::Mul(h_re, kx), hn::Mul(h_im, kz)));
    const Vector xx = hn::Mul(sx, kx), zz = hn::Mul(sz, kz);  // -h (sx kx + i sz kz)
    put(3, hn::Sub(hn::Mul(h_im, zz), hn::Mul(h_re, xx)), hn::Neg(hn::Add(hn::Mul(h_re, zz), hn::Mul(h_im, xx))));
    if (fields == most_fields) {
      // dh/dt, of waves that fall as they turn: a(m) times -damping/2 - i w.
      const hn::Half<Lanes> dh;
      const hn::Rebind<double, decltype(dh)> dd;
      const double* frequency = waves.frequency.data() + at;
      const Vector w = hn::Mul(half, hn::Combine(d, hn::DemoteTo(dh, hn::LoadU(dd, frequency + hn::Lanes(dd))),
                                                 hn::DemoteTo(dh, hn::LoadU(dd, frequency))));
      const Vector loss = hn::Set(d, float(0.5 * waves.damping_per_s));
      const Vector r_re = hn::Sub(hn::Mul(w, hn::Add(a_im, m_im)), hn::Mul(loss, h_re));
      const Vector r_im = hn::Sub(hn::Mul(w, hn::Sub(m_re, a_re)), hn::Mul(loss, h_im));
      put(4, hn::Neg(hn::Mul(r_im, shift_height)), hn::Mul(r_re, shift_height));
      put(5, hn::Neg(hn::Mul(r_im, sz)), hn::Mul(r_re, sz));
    }
    const Vector power = hn::Add(hn::Mul(h_re, h_re), hn::Mul(h_im, h_im)), power_z = hn::Mul(kz, power);
    const auto add = [&](float* sum, Vector more) HWY_ATTR { hn::StoreU(hn::Add(hn::LoadU(d, sum), more), d, sum); };
    add(sums + j, power);
    add(sums + width + j, power_z);
    add(sums + 2 * width + j, hn::Mul(kz, power_z));
  }
}

// The spectra and their transforms along x. Gives the slopes' moments: of real fields the means of products are the
// sums of their waves' (Parseval).
HWY_NOINLINE glm::dvec3 along_x(const FftPlan& plan, const LevelTable& table, const LevelWaves& waves, int fields,
                                const Scratch& s) {
  const int band = plan.band;
  std::fill_n(s.sums, 3 * s.width, 0.0f);
  for (int part = 0; part < 2 * fields; ++part) std::fill_n(s.middle + part * s.plane, s.row, 0.0f);
  for (int pair = 1; pair <= band / 2; ++pair) {
    const int rows[2] = {pair, band - pair}, sides = pair == band / 2 ? 1 : 2;
    for (int side = 0; side < 2; ++side)
      turned_row(waves, band, rows[side], s.turned + 2 * side * s.width, s.turned + (2 * side + 1) * s.width);
    for (int side = 0; side < sides; ++side) {
      packed_row(table, waves, band, rows[side], fields, s.turned + 2 * side * s.width,
                 s.turned + 2 * (1 - side) * s.width, s.packed, s.width, s.sums);
      float* to = s.middle + rows[side] * s.row;
      for (int field = 0; field < fields; ++field)
        transform_row(plan, s.packed + 2 * field * s.width, s.packed + (2 * field + 1) * s.width,
                      to + 2 * field * s.plane, to + (2 * field + 1) * s.plane, s.rows);
    }
  }
  glm::dvec3 moments(0.0);
  for (int j = 0; j < band; ++j) {
    const double kx = table.k[std::size_t(j)];
    moments += glm::dvec3(kx * kx * s.sums[j], s.sums[2 * s.width + j], kx * s.sums[s.width + j]);
  }
  return moments;
}

// The transforms along z of a strip's columns, of one field: [re, im][z][x].
HWY_INLINE void along_z(const FftPlan& plan, const Scratch& s, int field, int x) {
  const float* from = s.middle + 2 * field * s.plane + x;
  float* to = s.results + 2 * field * s.strip_plane;
  for (std::ptrdiff_t r = 0; r < plan.repeats; ++r) {
    columns_in<Strip>(plan, int(r), from, from + s.plane, s.row, s.columns);
    columns_out<Strip>(plan, int(r), s.columns, to + r * s.strip_row, to + r * s.strip_row + s.strip_plane,
                       plan.repeats * s.strip_row);
  }
}

// What is greatest so far, in each lane.
struct Greatest {
  using V = hn::Vec<Strip>;
  V height, shift, squeeze, step;  // of shift and step squares
  HWY_INLINE Greatest() { height = shift = squeeze = step = hn::Zero(Strip()); }
};

// A strip's texels from its results, and what is greatest of them.
HWY_NOINLINE void texels(const FftPlan& plan, const Scratch& s, int x, const LevelPlanes& planes, Greatest& greatest) {
  const Strip d;
  using V = hn::Vec<Strip>;
  const V most = hn::Set(d, most_half), least = hn::Neg(most), half_of = hn::Set(d, 0.5f);
  const auto inside = hn::FirstN(d, hn::Lanes(d) - 1);
  const std::ptrdiff_t n = plan.n;
  Greatest g = greatest;
  for (std::ptrdiff_t z = 0; z < n; ++z) {
    const float *here = s.results + z * s.strip_row, *north = s.results + ((z + 1) & (n - 1)) * s.strip_row;
    const auto value = [&](int part)
                           HWY_ATTR { return hn::Min(hn::Max(hn::Load(d, here + part * s.strip_plane), least), most); };
    const auto square = [](V v) HWY_ATTR { return hn::Mul(v, v); };
    float* shift = &planes.shift[z * n + x].x;
    float* slope = &planes.slope[z * n + x].x;
    const V dx = value(0), h = value(1), dz = value(2), xz = value(3);
    const V hx = value(4), hz = value(5), xx = value(6), zz = value(7);
    hn::StoreInterleaved4(dx, h, dz, xz, d, shift);
    hn::StoreInterleaved4(hx, hz, xx, zz, d, slope);
    g.height = hn::Max(g.height, hn::Abs(h));
    g.shift = hn::Max(g.shift, hn::Add(square(dx), square(dz)));
    const V across = hn::Mul(half_of, hn::Sub(xx, zz)), middle = hn::Mul(half_of, hn::Add(xx, zz));
    g.squeeze = hn::Max(g.squeeze, hn::Sub(hn::Sqrt(hn::Add(square(across), square(xz))), middle));
    const auto differ = [&](int part) HWY_ATTR {
      const float* from = here + part * s.strip_plane;
      float& column = s.east[(part - 4) * n + z];
      const V is = hn::Load(d, from), east = hn::IfThenElse(inside, hn::LoadU(d, from + 1), hn::Set(d, column));
      column = *from;
      return hn::Add(square(hn::Sub(east, is)), square(hn::Sub(hn::Load(d, north + part * s.strip_plane), is)));
    };
    g.step = hn::Max(g.step, hn::Add(differ(4), differ(5)));
    if (planes.velocity == nullptr) continue;
    hn::StoreInterleaved4(value(8), value(9), value(10), hn::Zero(d), d, &planes.velocity[z * n + x].x);
  }
  greatest = g;
}
}  // namespace

std::size_t level_scratch(const FftPlan& plan, int fields) { return Scratch(plan, fields, nullptr).floats; }

LevelMost level(const FftPlan& plan, const LevelTable& table, const LevelWaves& waves, const LevelPlanes& planes,
                float* memory) {
  const Strip d;
  const int fields = planes.velocity != nullptr ? most_fields : still_fields, lanes = int(hn::MaxLanes(d));
  const Scratch s(plan, fields, memory);
  LevelMost result{};
  result.slope_moments = along_x(plan, table, waves, fields, s);
  // From the east, so that of each strip what lies east of it is there.
  Greatest greatest;
  along_z(plan, s, 2, 0);
  for (int part = 0; part < 2; ++part)
    for (std::ptrdiff_t z = 0; z < plan.n; ++z)
      s.east[part * plan.n + z] = s.results[(4 + part) * s.strip_plane + z * s.strip_row];
  for (int x = plan.n - lanes; x >= 0; x -= lanes) {
    for (int field = 0; field < fields; ++field) along_z(plan, s, field, x);
    texels(plan, s, x, planes, greatest);
  }
  result.height_m = hn::GetLane(hn::MaxOfLanes(d, greatest.height));
  result.shift_m = std::sqrt(hn::GetLane(hn::MaxOfLanes(d, greatest.shift)));
  result.squeeze = hn::GetLane(hn::MaxOfLanes(d, greatest.squeeze));
  result.slope_step = std::sqrt(hn::GetLane(hn::MaxOfLanes(d, greatest.step)));
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(level_scratch);
HWY_EXPORT(level);

LevelMost fill_level(const FftPlan& plan, const LevelTable& table, const LevelWaves& waves, const LevelPlanes& planes) {
  const int fields = planes.velocity != nullptr ? most_fields : still_fields;
  float* memory = thread_scratch(HWY_DYNAMIC_DISPATCH(level_scratch)(plan, fields));
  return HWY_DYNAMIC_DISPATCH(level)(plan, table, waves, planes, memory);
}

}  // namespace seascape
#endif
