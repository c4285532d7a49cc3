// What is known of the places of a group of points, read from pages, for the instruction set that Highway compiles
// this for.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <cmath>

#include "ocean/sea/place_query_simd.h"

#if defined(SEASCAPE_PLACE_TEXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_PLACE_TEXELS_INL_H
#undef SEASCAPE_PLACE_TEXELS_INL_H
#else
#define SEASCAPE_PLACE_TEXELS_INL_H
#endif

#include "ocean/sea/dual-inl.h"
#include "ocean/sea/query_group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

constexpr int vectors = PlacePages::most_vectors;

constexpr double no_page = 1e300;  // no place lies beside this

// What derivatives are by: a metre along x, a metre along z, a second of what a current does to the patterns.
constexpr int by_x = 0, by_z = 1, by_time = 2;

// What the weights of the four texels that a layer's sample blends grow by, and what Places::sideways does.
struct Growth {
  alignas(64) float weight[most_layers][4 * group], sideways[most_layers][group];
};

struct Places {
  // Sizes of the texels that are read, the finer ones and the coarser (m), the coarser ones' share, and how much there
  // is of both (gpu::LodRead).
  alignas(64) double texel_m[2][group], per_m[2][group];
  float coarser[group], present[group];
  // Where points lie between texels, the finer ones and the coarser: the page that they lie in and its first texel, how
  // many floats from there theirs begins, how far they lie from it, and the slot of the page that was found last.
  const float* page[2][group];
  alignas(64) double page_x[2][group], page_z[2][group];
  alignas(64) std::int32_t texel_at[2][group];
  alignas(64) float beyond_x[2][group], beyond_z[2][group];
  std::uint32_t slot[2];
  PlacePages::Own own[2][group];
  // What is read there, four floats a point, and the same number by number; then what it grows by along x and z.
  alignas(64) float texel[3][vectors][4 * group];
  alignas(64) float number[3][4 * vectors][group];
  alignas(64) float from_viewer_x[group], from_viewer_z[group];  // of the places asked, and from the windows' bodies
  alignas(64) float from_body_x[gpu::max_wake_windows][group], from_body_z[gpu::max_wake_windows][group];
  // Of waves along curves, where forward is, and its derivatives.
  alignas(64) float forward_x[3][group], forward_z[3][group];
  // Which layers there are at all, a bit for each, and what Dx and Dz of those that are not even are multiplied with
  // besides.
  alignas(64) std::int32_t live[2][group];
  alignas(64) float sideways[most_layers][group];
  Growth growth[3];
};

// Sums of layers, and of their derivatives: those of the waves, and those along curves, which have the curve's axes.
struct Sums {
  alignas(64) float waves[4][4 * group], curved[4][4 * group];
};

// Which texels a point's numbers are read from, `fine` metres wide. Of other sizes it has no pages yet.
inline void choose_texels(const gpu::LodRead& how, double fine, Places& at, int point) {
  if (at.texel_m[0][point] != fine)
    for (int i = 0; i < 2; ++i) {
      at.texel_m[i][point] = (i + 1) * fine;
      at.per_m[i][point] = 1.0 / at.texel_m[i][point];
      at.page_x[i][point] = at.page_z[i][point] = no_page;
    }
  at.coarser[point] = how.coarser;
  at.present[point] = how.present;
}

// Finds the page that a point's texels are in, and has them fetched.
inline void find_page(const PlacePlan& plan, Places& at, int which, int point, std::int64_t x, std::int64_t z) {
  const PlacePages::Cell cell =
      plan.pages->cell(x, z, at.texel_m[which][point], plan.place_time_s, at.slot[which], at.own[which][point]);
  const bool own = cell.first == at.own[which][point].texel;
  const std::int64_t in_x = x & (PlacePages::cells - 1), in_z = z & (PlacePages::cells - 1);
  const std::ptrdiff_t texel = own ? 0 : in_z * cell.below + in_x * cell.right;
  at.page[which][point] = cell.first - texel;
  at.texel_at[which][point] = std::int32_t(texel);
  // Of its own a point has no others.
  at.page_x[which][point] = own ? no_page : double(x - in_x);
  at.page_z[which][point] = own ? no_page : double(z - in_z);
  for (const float* row : {cell.first, cell.first + cell.below}) {
    hwy::Prefetch(row);
    hwy::Prefetch(row + cell.right);
  }
}

// Finds between which texels the rest positions of points i to i + lanes - 1 lie; of those in `left`.
template <class D>
HWY_INLINE void find_texels(D d, const PlacePlan& plan, const Group& g, Places& at, std::uint64_t left, int i) {
  const hn::CappedTag<double, hn::MaxLanes(D()) / 2> dd;
  const hn::Rebind<float, decltype(dd)> df;
  const hn::Rebind<std::int32_t, decltype(dd)> di;
  const int lanes = int(hn::Lanes(dd));
  const auto half = hn::Set(dd, 0.5), most = hn::Set(dd, 0x1p40), zero = hn::Zero(dd);
  const auto cells = hn::Set(dd, double(PlacePages::cells)), row = hn::Set(dd, double(PlacePages::texels)),
             floats = hn::Set(dd, 4.0 * plan.numbers.vectors);
  for (int which = 0; which <= (plan.seen != nullptr || plan.reading.read.coarser > 0.0f ? 1 : 0); ++which)
    for (int p = i; p < i + int(hn::Lanes(d)); p += lanes) {
      const auto per_m = hn::Load(dd, at.per_m[which] + p);
      const auto find = [&](const double* place, const float* way, float* beyond) HWY_ATTR {
        auto of =
            hn::Sub(hn::Mul(hn::Add(hn::Load(dd, place + p), hn::PromoteTo(dd, hn::Load(df, way + p))), per_m), half);
        of = hn::IfThenElseZero(hn::Lt(hn::Abs(of), most), of);  // no number, or too far: texels at the origin
        const auto floor = hn::Floor(of);
        hn::Store(hn::DemoteTo(df, hn::Sub(of, floor)), df, beyond + p);
        return floor;
      };
      const auto first_x = find(g.x, g.way_x, at.beyond_x[which]), first_z = find(g.z, g.way_z, at.beyond_z[which]);
      const auto x = hn::Sub(first_x, hn::Load(dd, at.page_x[which] + p)),
                 z = hn::Sub(first_z, hn::Load(dd, at.page_z[which] + p));
      const auto inside =
          hn::And(hn::And(hn::Ge(x, zero), hn::Lt(x, cells)), hn::And(hn::Ge(z, zero), hn::Lt(z, cells)));
      hn::Store(hn::DemoteTo(di, hn::IfThenElseZero(inside, hn::Mul(hn::Add(hn::Mul(z, row), x), floats))), di,
                at.texel_at[which] + p);
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(dd, inside, bytes);
      const std::uint64_t others = (left >> p) & ~std::uint64_t{bytes[0]} & ((std::uint64_t{1} << lanes) - 1);
      if (HWY_LIKELY(others == 0)) continue;
      alignas(64) double to_x[hn::MaxLanes(dd)], to_z[hn::MaxLanes(dd)];
      hn::Store(first_x, dd, to_x);
      hn::Store(first_z, dd, to_z);
      for (std::uint64_t rest = others; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        if (which == 0 || at.coarser[p + lane] > 0.0f)
          find_page(plan, at, which, p + lane, std::int64_t(to_x[lane]), std::int64_t(to_z[lane]));
      }
    }
}

// Has a point's numbers give way to those beyond all windows. Of a place along a curve only its share does.
inline void fade(const PlacePlan& plan, Places& at, int point, bool gradients) {
  const float present = at.present[point];
  for (int n = 0; n < 4 * plan.numbers.vectors; ++n) {
    if (!plan.fades[std::size_t(n)]) continue;
    const int v = n / 4, part = 4 * point + n % 4;
    const float outside = plan.outside[std::size_t(n)];
    float& value = at.texel[0][v][part];
    value = outside + (value - outside) * present;
    if (!gradients) continue;
    at.texel[1][v][part] *= present;
    at.texel[2][v][part] *= present;
  }
}

// Reads vectors `v` and on of a point's texels, as many as `tag` holds; with `gradients` what they grow by too. Of the
// finer texels all, and then what the coarser ones differ by: what is the same in both stays.
template <bool coarser, bool gradients, class T>
HWY_INLINE void read_vectors(T tag, const PlacePlan& plan, Places& at, int v, int point) {
  const hn::FixedTag<float, 4> d4;
  constexpr int which = coarser ? 1 : 0;
  const std::ptrdiff_t next = 4 * plan.numbers.vectors, under_it = next * PlacePages::texels;
  const float* const from = at.page[which][point] + at.texel_at[which][point] + 4 * v;
  const auto right = hn::Set(tag, at.beyond_x[which][point]), below = hn::Set(tag, at.beyond_z[which][point]);
  const auto a = hn::LoadU(tag, from), c = hn::LoadU(tag, from + under_it);
  const auto above = hn::Sub(hn::LoadU(tag, from + next), a),
             under = hn::Sub(hn::LoadU(tag, from + under_it + next), c);
  const auto low = hn::Add(a, hn::Mul(above, right)), high = hn::Add(c, hn::Mul(under, right));
  const auto put = [&](int kind, hn::Vec<T> value) HWY_ATTR {
    const auto put_one = [&](int n, hn::Vec<decltype(d4)> one) HWY_ATTR {
      float* const to = at.texel[kind][v + n] + 4 * point;
      if constexpr (coarser) {
        const auto fine = hn::Load(d4, to);
        one = hn::Add(fine, hn::Mul(hn::Sub(one, fine), hn::Set(d4, at.coarser[point])));
      }
      hn::Store(one, d4, to);
    };
    if constexpr (hn::MaxLanes(T()) == 16) {
      const hn::Half<T> half;
      const auto first = hn::LowerHalf(half, value), second = hn::UpperHalf(half, value);
      put_one(0, hn::LowerHalf(d4, first));
      put_one(1, hn::UpperHalf(d4, first));
      put_one(2, hn::LowerHalf(d4, second));
      put_one(3, hn::UpperHalf(d4, second));
    } else if constexpr (hn::MaxLanes(T()) == 8) {
      put_one(0, hn::LowerHalf(d4, value));
      put_one(1, hn::UpperHalf(d4, value));
    } else {
      put_one(0, value);
    }
  };
  put(0, hn::Add(low, hn::Mul(hn::Sub(high, low), below)));
  if constexpr (gradients) {
    const auto per_m = hn::Set(tag, float(at.per_m[which][point]));
    put(1, hn::Mul(hn::Add(above, hn::Mul(hn::Sub(under, above), below)), per_m));
    put(2, hn::Mul(hn::Sub(high, low), per_m));
  }
}
template <bool coarser, bool gradients>
HWY_INLINE void read_all(const PlacePlan& plan, Places& at, int point) {
  const int end = plan.numbers.vectors;
  int v = 0;
#if HWY_MAX_BYTES >= 64
  for (; v + 4 <= end; v += 4) read_vectors<coarser, gradients>(hn::FixedTag<float, 16>(), plan, at, v, point);
#endif
#if HWY_MAX_BYTES >= 32
  for (; v + 2 <= end; v += 2) read_vectors<coarser, gradients>(hn::FixedTag<float, 8>(), plan, at, v, point);
#endif
  for (; v < end; ++v) read_vectors<coarser, gradients>(hn::FixedTag<float, 4>(), plan, at, v, point);
}
template <bool gradients>
HWY_INLINE void read(const PlacePlan& plan, Places& at, int point) {
  read_all<false, gradients>(plan, at, point);
  if (HWY_UNLIKELY(at.coarser[point] > 0.0f)) read_all<true, gradients>(plan, at, point);
  if (HWY_UNLIKELY(plan.seen != nullptr)) fade(plan, at, point, gradients);
}

// What was read of points i to i + lanes - 1, number by number.
template <class D>
HWY_INLINE void arrange(D d, const PlacePlan& plan, Places& at, int i, bool gradients) {
  for (int kind = 0; kind < (gradients ? 3 : 1); ++kind)
    for (int v = 0; v < plan.numbers.vectors; ++v) {
      hn::Vec<D> part[4];
      hn::LoadInterleaved4(d, at.texel[kind][v] + 4 * i, part[0], part[1], part[2], part[3]);
      for (int n = 0; n < 4; ++n) hn::Store(part[n], d, at.number[kind][4 * v + n] + i);
    }
}

// A number of points i to i + lanes - 1; `absent` where texels do not have it.
template <int count, class D>
HWY_INLINE Dual<hn::Vec<D>, count> number(D d, const PlacePlan& plan, const Places& at, int which, float absent,
                                          int i) {
  const int from = plan.numbers.at[std::size_t(which)];
  if (from < 0) return constant<count>(hn::Set(d, absent));
  auto result = constant<count>(hn::Load(d, at.number[0][from] + i));
  if constexpr (count > 0) {
    result.by[by_x] = hn::Load(d, at.number[1][from] + i);
    result.by[by_z] = hn::Load(d, at.number[2][from] + i);
  }
  return result;
}

// The angle of a point (x, y) in turns, -0.5 to 0.5, to some 1e-7 (Hastings 1955, sheet 13, for the arc tangent).
template <class D>
HWY_INLINE hn::Vec<D> turns_of(D d, hn::Vec<D> x, hn::Vec<D> y) {
  const auto a = hn::Abs(x), b = hn::Abs(y), zero = hn::Zero(d);
  const auto t = hn::Div(hn::Min(a, b), hn::Max(hn::Max(a, b), hn::Set(d, 1e-30f))), square = hn::Mul(t, t);
  auto sum = hn::Set(d, 0.0028662257f);
  for (const float c : {-0.0161657367f, 0.0429096138f, -0.0752896400f, 0.1065626393f, -0.1420889944f, 0.1999355085f,
                        -0.3333314528f, 1.0f})
    sum = hn::Add(hn::Mul(sum, square), hn::Set(d, c));
  auto turns = hn::Mul(hn::Mul(sum, t), hn::Set(d, 0.15915494f));
  turns = hn::IfThenElse(hn::Gt(b, a), hn::Sub(hn::Set(d, 0.25f), turns), turns);
  turns = hn::IfThenElse(hn::Lt(x, zero), hn::Sub(hn::Set(d, 0.5f), turns), turns);
  return hn::CopySign(turns, y);
}

// Where points lie along the curve that their texels tell of (shore_place): where the pattern is taken (m), how it is
// stretched, where forward is, and what there is of the waves.
template <class N>
struct AlongCurve {
  N x, z, stretch, forward_x, forward_z, share;
};
template <int count, class D>
HWY_INLINE AlongCurve<Dual<hn::Vec<D>, count>> along_curve(D d, const PlacePlan& plan, const Places& at, int i) {
  const auto of = [&](int which) HWY_ATTR { return number<count>(d, plan, at, which, 0.0f, i); };
  const auto cosine = of(PlaceNumbers::cosine), sine = of(PlaceNumbers::sine), share = of(PlaceNumbers::shore_share),
             way_x = of(PlaceNumbers::along_x), way_z = of(PlaceNumbers::along_z);
  const auto one = constant<count>(hn::Set(d, 1.0f));
  const auto size = larger(root(way_x * way_x + way_z * way_z), one);
  auto turns = constant<count>(turns_of(d, cosine.value, sine.value));
  if constexpr (count > 0) {
    const auto square = hn::Add(hn::Mul(cosine.value, cosine.value), hn::Mul(sine.value, sine.value));
    const auto per_turn = hn::Div(hn::Set(d, 0.15915494f), hn::Max(square, hn::Set(d, 1e-30f)));
    for (const std::size_t by : {by_x, by_z})
      turns.by[by] = hn::Mul(hn::Sub(hn::Mul(cosine.value, sine.by[by]), hn::Mul(sine.value, cosine.by[by])), per_turn);
  }
  // Where there are no waves the direction counts for nothing.
  const auto there = hn::Gt(share.value, hn::Zero(d));
  return {only(there, times(turns, plan.shore_period_m)),
          only(there, of(PlaceNumbers::right)),
          only(there, size - one),
          only(there, way_x / size),
          only(there, way_z / size),
          only(there, share)};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#endif
