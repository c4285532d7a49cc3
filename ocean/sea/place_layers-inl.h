// What is known of the places of a group of points, read from pages, and how much of each layer of waves there is
// there, for the instruction set that Highway compiles this for.
#include <hwy/highway.h>

#include <cmath>

#include "ocean/sea/place_query_simd.h"

#if defined(SEASCAPE_PLACE_LAYERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_PLACE_LAYERS_INL_H
#undef SEASCAPE_PLACE_LAYERS_INL_H
#else
#define SEASCAPE_PLACE_LAYERS_INL_H
#endif

#include "ocean/sea/query_group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

constexpr int vectors = PlacePages::most_vectors;

// What is known of the places of a group's points, and what it makes of the layers there.
struct Known {
  alignas(64) float value[vectors][4 * group];  // PlaceTexel
  // Of waves along curves: where the pattern is taken (m), how it is stretched, and where forward is.
  alignas(64) float bent_x[group], bent_z[group], stretch[group], forward_x[group], forward_z[group];
  Patterns patterns;
};

struct Places {
  PlacePages::Own own;
  // Sizes of the texels that are read, the finer ones and the coarser (m), the coarser ones' share, and how much there
  // is of both (gpu::LodRead).
  alignas(64) double texel_m[2][group], per_m[2][group];
  float coarser[group], present[group];
  // Where points lie between texels, the finer ones and the coarser: the first texel, how far from it, and the slot of
  // the page that they lay in last.
  alignas(64) double first_x[2][group], first_z[2][group];
  alignas(64) float right[2][group], below[2][group];
  std::uint32_t slot[2][group];
  alignas(64) float grows_x[vectors][4 * group], grows_z[vectors][4 * group];  // PlaceTexel's, in a metre
  alignas(64) float from_viewer_x[group], from_viewer_z[group];                // of the places asked
  Known now, to_x, to_z;  // at the points, and a little further along x and along z
  Patterns later;         // a little later, of what a current carries
};

// Sums of layers: those of the waves, and those along curves, which have the curve's axes.
struct Sums {
  alignas(64) float waves[4 * group], curved[4 * group];
};

constexpr float apart_m = 1.0f / 64.0f;   // a little further: places' numbers grow evenly over it
constexpr double apart_s = 1.0 / 1024.0;  // a little later

// Which texels a point's numbers are read from.
inline void choose_texels(const PlaceReading& reading, Places& at, int point) {
  at.texel_m[0][point] = reading.fine_texel_m();
  at.texel_m[1][point] = 2.0 * at.texel_m[0][point];
  for (int i = 0; i < 2; ++i) at.per_m[i][point] = 1.0 / at.texel_m[i][point];
  at.coarser[point] = reading.read.coarser;
  at.present[point] = reading.read.present;
}

// Finds between which texels the rest positions of points i to i + lanes - 1 lie.
template <class D>
HWY_INLINE void find_texels(D d, const PlacePlan& plan, const Group& g, Places& at, int i) {
  const hn::CappedTag<double, hn::MaxLanes(D()) / 2> dd;
  const hn::Rebind<float, decltype(dd)> df;
  for (int coarser = 0; coarser <= (plan.seen != nullptr || plan.reading.read.coarser > 0.0f ? 1 : 0); ++coarser) {
    const auto half = hn::Set(dd, 0.5), most = hn::Set(dd, 0x1p40);
    const auto find = [&](int p, const double* place, const float* way, double* first, float* beyond) HWY_ATTR {
      const auto per_m = hn::Load(dd, at.per_m[coarser] + p);
      auto of = hn::Sub(hn::Mul(hn::Add(hn::Load(dd, place), hn::PromoteTo(dd, hn::Load(df, way))), per_m), half);
      of = hn::IfThenElseZero(hn::Lt(hn::Abs(of), most), of);  // no number, or too far: texels at the origin
      const auto floor = hn::Floor(of);
      hn::Store(floor, dd, first);
      hn::Store(hn::DemoteTo(df, hn::Sub(of, floor)), df, beyond);
    };
    for (int p = i; p < i + int(hn::Lanes(d)); p += int(hn::Lanes(dd))) {
      find(p, g.x + p, g.way_x + p, at.first_x[coarser] + p, at.right[coarser] + p);
      find(p, g.z + p, g.way_z + p, at.first_z[coarser] + p, at.below[coarser] + p);
    }
  }
}

// Has a point's numbers give way to those beyond all windows. Of a place along a curve only its share does.
inline void fade(const PlacePlan& plan, Places& at, int point, bool gradients) {
  const float present = at.present[point];
  for (int n = 0; n < 4 * plan.vectors; ++n) {
    const int v = n / 4, part = 4 * point + n % 4;
    if (v >= PlaceTexel::shore && n != 4 * PlaceTexel::shore + 3) continue;
    const float outside = plan.outside[std::size_t(n)];
    float& value = at.now.value[v][part];
    value = outside + (value - outside) * present;
    if (!gradients) continue;
    at.grows_x[v][part] *= present;
    at.grows_z[v][part] *= present;
  }
}

// Reads a point's texels.
HWY_INLINE void read(const PlacePlan& plan, Places& at, int point, bool gradients) {
  const hn::FixedTag<float, 4> d4;
  const hn::CappedTag<float, 16> d;
  const hn::CappedTag<float, 8> d8;
  const auto take = [&](double texel_m, float share, int which) HWY_ATTR {
    const PlacePages::Cell cell =
        plan.pages->cell(std::int64_t(at.first_x[which][point]), std::int64_t(at.first_z[which][point]), texel_m,
                         plan.place_time_s, at.slot[which][point], at.own);
    const bool first = which == 0;
    const auto put_one = [&](float* of_point, hn::Vec<decltype(d4)> one) HWY_ATTR {
      // Of the finer texels all, and then what the coarser ones differ by: what is the same in both stays.
      if (!first) {
        const auto fine = hn::Load(d4, of_point);
        one = hn::Add(fine, hn::Mul(hn::Sub(one, fine), hn::Set(d4, share)));
      }
      hn::Store(one, d4, of_point);
    };
    const auto put = [&](auto tag, float(*to)[4 * group], int v, auto value) HWY_ATTR {
      const auto halves = [&](int from, auto two) HWY_ATTR {
        put_one(to[from] + 4 * point, hn::LowerHalf(d4, two));
        put_one(to[from + 1] + 4 * point, hn::UpperHalf(d4, two));
      };
      if constexpr (hn::MaxLanes(decltype(tag)()) == 16) {
        halves(v, hn::LowerHalf(d8, value));
        halves(v + 2, hn::UpperHalf(d8, value));
      } else if constexpr (hn::MaxLanes(decltype(tag)()) == 8) {
        halves(v, value);
      } else {
        put_one(to[v] + 4 * point, value);
      }
    };
    const auto some = [&](auto tag, int v) HWY_ATTR {
      const auto right = hn::Set(tag, at.right[which][point]), below = hn::Set(tag, at.below[which][point]);
      const float* const from = cell.first + 4 * v;
      const auto a = hn::LoadU(tag, from), b = hn::LoadU(tag, from + cell.right), c = hn::LoadU(tag, from + cell.below),
                 e = hn::LoadU(tag, from + cell.below + cell.right);
      const auto above = hn::Sub(b, a), under = hn::Sub(e, c);
      const auto low = hn::Add(a, hn::Mul(above, right)), high = hn::Add(c, hn::Mul(under, right));
      put(tag, at.now.value, v, hn::Add(low, hn::Mul(hn::Sub(high, low), below)));
      if (!gradients) return;
      const auto per_m = hn::Set(tag, float(1.0 / texel_m));
      put(tag, at.grows_x, v, hn::Mul(hn::Add(above, hn::Mul(hn::Sub(under, above), below)), per_m));
      put(tag, at.grows_z, v, hn::Mul(hn::Sub(high, low), per_m));
    };
    constexpr int at_once = int(hn::MaxLanes(d)) / 4;
    int v = 0;
    for (; v + at_once <= plan.vectors; v += at_once) some(d, v);
    for (; at_once > 2 && v + 2 <= plan.vectors; v += 2) some(d8, v);
    for (; v < plan.vectors; ++v) some(d4, v);
  };
  take(at.texel_m[0][point], 1.0f, 0);
  if (at.coarser[point] > 0.0f) take(at.texel_m[1][point], at.coarser[point], 1);
  if (plan.seen != nullptr) fade(plan, at, point, gradients);
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

// Where points lie along the curve that their texels tell of (shore_place).
template <class D>
HWY_INLINE void bend(D d, const PlacePlan& plan, Known& at, int i) {
  hn::Vec<D> right, cosine, sine, share, way_x, way_z, unused;
  hn::LoadInterleaved4(d, at.value[PlaceTexel::shore] + 4 * i, right, cosine, sine, share);
  hn::LoadInterleaved4(d, at.value[PlaceTexel::shore_way] + 4 * i, way_x, way_z, unused, unused);
  const auto one = hn::Set(d, 1.0f);
  const auto length = hn::Sqrt(hn::Add(hn::Mul(way_x, way_x), hn::Mul(way_z, way_z))), size = hn::Max(length, one);
  // Where there are no waves the direction counts for nothing.
  const auto there = hn::Gt(share, hn::Zero(d));
  const auto only = [&](hn::Vec<D> value) HWY_ATTR { return hn::IfThenElseZero(there, value); };
  hn::Store(only(hn::Mul(turns_of(d, cosine, sine), hn::Set(d, float(plan.shore_period_m)))), d, at.bent_x + i);
  hn::Store(only(right), d, at.bent_z + i);
  hn::Store(only(hn::Sub(size, one)), d, at.stretch + i);
  hn::Store(only(hn::Div(way_x, size)), d, at.forward_x + i);
  hn::Store(only(hn::Div(way_z, size)), d, at.forward_z + i);
}

// How much of each layer there is at points i to i + lanes - 1, whose ways from the places asked are given, and where
// its pattern lies.
template <class D>
HWY_INLINE void spread(D d, const PlacePlan& plan, const Places& places, const Known& at, hn::Vec<D> way_x,
                       hn::Vec<D> way_z, const FlowPhase& phase, int i, Patterns& to) {
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  hn::Vec<D> level, bed, flow_x = zero, flow_z = zero, bends[3] = {zero, zero, zero}, run_up = zero;
  hn::Vec<D> shares[gpu::max_cascades + 1], shore_share = zero, unused;
  for (auto& share : shares) share = one;
  if (plan.pages != nullptr) hn::LoadInterleaved4(d, at.value[PlaceTexel::water] + 4 * i, level, bed, flow_x, flow_z);
  if (plan.bed) {
    hn::LoadInterleaved4(d, at.value[PlaceTexel::bend] + 4 * i, bends[0], bends[1], bends[2], run_up);
    hn::LoadInterleaved4(d, at.value[PlaceTexel::share] + 4 * i, shares[0], shares[1], shares[2], shares[3]);
    hn::LoadInterleaved4(d, at.value[PlaceTexel::share_more] + 4 * i, shares[4], shares[5], unused, unused);
  }
  if (plan.shore) {
    hn::LoadInterleaved4(d, at.value[PlaceTexel::shore] + 4 * i, unused, unused, unused, shore_share);
    shore_share = hn::Max(shore_share, zero);
  }
  const auto square = hn::Add(hn::Mul(flow_x, flow_x), hn::Mul(flow_z, flow_z));
  const float first = float(phase.first), second = 1.0f - first;
  const auto stretch = hn::Load(d, at.stretch + i), forward_x = hn::Load(d, at.forward_x + i),
             forward_z = hn::Load(d, at.forward_z + i);
  const auto along_curve = hn::Mul(stretch, hn::Add(hn::Mul(flow_x, forward_x), hn::Mul(flow_z, forward_z))),
             across_curve = hn::Sub(hn::Mul(flow_z, forward_x), hn::Mul(flow_x, forward_z));
  auto sum_height = one;  // one over the height of two patterns' sum, which follow each other
  for (int l = 0; l < plan.waves.count; ++l) {
    const PlacedLayer& layer = plan.placed[std::size_t(l)];
    auto off_x = zero, off_z = zero, flat = one, lift = one;
    auto carried_x = flow_x, carried_z = flow_z, carried = square;
    if (layer.kind == PlacedLayer::dynamic) {
      const auto x = hn::Add(hn::Load(d, places.from_viewer_x + i), way_x),
                 z = hn::Add(hn::Load(d, places.from_viewer_z + i), way_z);
      const auto present =
          hn::Mul(hn::Sub(hn::Set(d, layer.end_m), hn::Max(hn::Abs(x), hn::Abs(z))), hn::Set(d, layer.per_border));
      lift = hn::Mul(hn::Min(hn::Max(present, zero), one), hn::Set(d, layer.counts));
      flat = hn::Mul(lift, hn::Set(d, layer.sharpened));
    } else if (layer.kind == PlacedLayer::curved) {
      off_x = hn::Load(d, at.bent_x + i);
      off_z = hn::Load(d, at.bent_z + i);
      flat = lift = shore_share;
      carried_x = along_curve;
      carried_z = across_curve;
      carried = hn::Add(hn::Mul(carried_x, carried_x), hn::Mul(carried_z, carried_z));
    } else if (plan.bed) {
      flat = lift = shares[layer.share];
      if (layer.runs_up) lift = hn::Sqrt(hn::Add(hn::Mul(flat, flat), hn::Mul(run_up, run_up)));
      if (layer.bent >= 0) {
        off_x = hn::Mul(bends[layer.bent], hn::Set(d, plan.along[std::size_t(layer.bent)].x));
        off_z = hn::Mul(bends[layer.bent], hn::Set(d, plan.along[std::size_t(layer.bent)].y));
      }
    }
    if (layer.pattern >= 0) {
      if (layer.pattern == 0) sum_height = flow_height(d, hn::Mul(carried, hn::Set(d, layer.flow_height)), first);
      const auto height = hn::Mul(hn::Set(d, layer.pattern == 0 ? first : second), sum_height);
      const auto way_s = hn::Set(d, float(layer.pattern == 0 ? phase.first_s : phase.second_s));
      flat = hn::Mul(flat, height);
      lift = hn::Mul(lift, height);
      off_x = hn::Sub(off_x, hn::Mul(carried_x, way_s));
      off_z = hn::Sub(off_z, hn::Mul(carried_z, way_s));
    }
    hn::Store(off_x, d, to.off_x[l] + i);
    hn::Store(off_z, d, to.off_z[l] + i);
    hn::StoreInterleaved4(hn::Mul(flat, hn::Set(d, layer.laid[0])), hn::Mul(lift, hn::Set(d, layer.laid[1])),
                          hn::Mul(flat, hn::Set(d, layer.laid[2])), zero, d, to.scale[l] + 4 * i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#endif
