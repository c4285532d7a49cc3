#include "ocean/foam/foam_simd.h"

#include <cassert>
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/foam/foam_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include "ocean/sea/formulas-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

// No multiplication is fused with an addition anywhere here, and sums have as many parts whatever the vectors' width.

constexpr int group = foam_group;
using Lanes = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Lanes>;

// From 0 to `most`; what is no number stays so.
HWY_INLINE Vector held(Vector value, float most) {
  const Lanes d;
  const auto zero = hn::Zero(d), top = hn::Set(d, most);
  return hn::IfThenElse(hn::Lt(value, zero), zero, hn::IfThenElse(hn::Gt(value, top), top, value));
}

// Weights of four texels for places a share f of the way from the second to the third (Catmull and Rom 1974), four
// floats a place.
HWY_INLINE void cubics(Vector f, float* to) {
  const Lanes d;
  const auto half = hn::Set(d, 0.5f), one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f), three = hn::Set(d, 3.0f);
  const auto f2 = hn::Mul(f, f);
  const auto a = hn::Mul(f, hn::Sub(hn::Mul(f, hn::Sub(two, f)), one)),
             b = hn::Add(hn::Mul(f2, hn::Sub(hn::Mul(three, f), hn::Set(d, 5.0f))), two),
             c = hn::Mul(f, hn::Add(hn::Mul(f, hn::Sub(hn::Set(d, 4.0f), hn::Mul(three, f))), one)),
             e = hn::Mul(f2, hn::Sub(f, one));
  hn::StoreInterleaved4(hn::Mul(half, a), hn::Mul(half, b), hn::Mul(half, c), hn::Mul(half, e), d, to);
}

// Where a group's texels come from: the first of the four by four before the step, and their weights.
struct Origins {
  alignas(64) std::int32_t at[group];
  alignas(64) float along[4 * group], across[4 * group], way_x[group], way_z[group], beyond[group];
};

// Texels x + i to x + i + lanes - 1. Gives whether any of them moves.
HWY_INLINE bool locate(const CarriedRow& row, int x, int i, Origins& origins, float* grow) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  const auto zero = hn::Zero(d);
  const auto load = [&](const glm::vec2* from, int at, Vector& vx, Vector& vz)
                        HWY_ATTR { hn::LoadInterleaved2(d, &from[at].x, vx, vz); };
  Vector speed_x, speed_z, left_x, left_z, right_x, right_z, above_x, above_z, below_x, below_z;
  const int first = x + i;
  load(row.speed, first, speed_x, speed_z);
  load(row.speed, first - 1, left_x, left_z), load(row.speed, first + 1, right_x, right_z);
  load(row.above, first, above_x, above_z), load(row.below, first, below_x, below_z);
  const auto place = hn::Iota(d, float(first));
  const auto within = hn::And(hn::Gt(place, zero), hn::Lt(place, hn::Set(d, float(row.side - 1))));
  const auto slope = [&](Vector from, Vector to) HWY_ATTR {
    return row.row > 0 && row.row + 1 < row.side ? hn::IfThenElse(within, hn::Sub(to, from), zero) : zero;
  };
  const auto x_by_x = slope(left_x, right_x), z_by_x = slope(left_z, right_z), x_by_z = slope(above_x, below_x),
             z_by_z = slope(above_z, below_z);
  // Minus the flow's divergence, in the step.
  const auto meets = hn::Mul(hn::Add(x_by_x, z_by_z), hn::Set(d, -row.dt / (2.0f * row.texel_m)));
  const auto most = hn::Set(d, 4.0f);
  hn::StoreU(exp_minus(d, hn::Neg(hn::Min(hn::Max(meets, hn::Neg(most)), most))), d, grow + first);
  // The velocity half a step upstream, by its own slope here.
  const auto back = hn::Set(d, -0.5f * row.dt / (2.0f * row.texel_m));
  const auto back_x = hn::Mul(back, speed_x), back_z = hn::Mul(back, speed_z),
             steps = hn::Set(d, -row.dt / row.texel_m);
  const auto midway = [&](Vector speed, Vector by_x, Vector by_z)
                          HWY_ATTR { return hn::Add(speed, hn::Add(hn::Mul(back_x, by_x), hn::Mul(back_z, by_z))); };
  const auto way_x = hn::Mul(steps, midway(speed_x, x_by_x, x_by_z)),
             way_z = hn::Mul(steps, midway(speed_z, z_by_x, z_by_z));
  const auto rests = hn::And(hn::Eq(way_x, zero), hn::Eq(way_z, zero));
  const auto cell_x = hn::Floor(way_x), cell_z = hn::Floor(way_z);
  const auto column = hn::Add(place, cell_x), line = hn::Add(hn::Set(d, float(row.row)), cell_z);
  const auto one = hn::Set(d, 1.0f), end = hn::Set(d, float(row.side - 2));
  const auto inside =
      hn::And(hn::And(hn::Ge(column, one), hn::Ge(line, one)), hn::And(hn::Lt(column, end), hn::Lt(line, end)));
  const auto from_x = hn::ConvertTo(di, hn::IfThenElse(inside, column, one)),
             from_z = hn::ConvertTo(di, hn::IfThenElse(inside, line, one));
  const auto before = hn::Set(di, 1);
  hn::Store(hn::Add(hn::Mul(hn::Sub(from_z, before), hn::Set(di, row.side)), hn::Sub(from_x, before)), di,
            origins.at + i);
  cubics(hn::Sub(way_x, cell_x), origins.along + 4 * i);
  cubics(hn::Sub(way_z, cell_z), origins.across + 4 * i);
  hn::Store(way_x, d, origins.way_x + i);
  hn::Store(way_z, d, origins.way_z + i);
  // 0: from within; 1: it rests; 2: from beyond.
  hn::Store(hn::IfThenElse(rests, one, hn::IfThenElse(inside, zero, hn::Add(one, one))), d, origins.beyond + i);
  return !hn::AllTrue(d, rests);
}

}  // namespace

int carry(const CarriedRow& row, std::span<float> values, std::span<float> grow, std::span<int> beyond,
          std::span<glm::vec2> ways) {
  const hn::FixedTag<float, 4> d4;
  const Lanes d;
  const float* own = row.before + std::ptrdiff_t(row.row) * row.side;
  Origins origins;
  alignas(64) float parts[4 * group];
  int count = 0;
  for (int x = 0; x < row.side; x += group) {
    bool moves = false;
    for (int i = 0; i < group; i += int(hn::Lanes(d)))
      if (locate(row, x, i, origins, grow.data())) moves = true;
    for (int i = 0; !moves && i < group; ++i) values[std::size_t(x + i)] = own[x + i];
    if (!moves) continue;
    for (int i = 0; i < group; ++i) {
      const float *from = row.before + origins.at[i], *across = origins.across + 4 * i;
      auto sum = hn::Mul(hn::Set(d4, across[0]), hn::LoadU(d4, from));
      for (int j = 1; j < 4; ++j)
        sum = hn::Add(sum, hn::Mul(hn::Set(d4, across[j]), hn::LoadU(d4, from + std::ptrdiff_t(j) * row.side)));
      hn::Store(hn::Mul(hn::Load(d4, origins.along + 4 * i), sum), d4, parts + 4 * i);
    }
    for (int i = 0; i < group; i += int(hn::Lanes(d))) {
      Vector a, b, c, e;
      hn::LoadInterleaved4(d, parts + 4 * i, a, b, c, e);
      const auto sum = hn::Add(hn::Add(a, b), hn::Add(c, e));
      const auto rests = hn::Eq(hn::Load(d, origins.beyond + i), hn::Set(d, 1.0f));
      hn::StoreU(hn::IfThenElse(rests, hn::LoadU(d, own + x + i), sum), d, values.data() + x + i);
    }
    for (int i = 0; i < group; ++i) {
      if (origins.beyond[i] != 2.0f) continue;
      ways[std::size_t(count)] = {origins.way_x[i], origins.way_z[i]};
      beyond[std::size_t(count++)] = x + i;
    }
  }
  return count;
}

void settle(std::span<const float> values, std::span<const float> grow, std::span<float> covered, glm::dvec2& sums) {
  const Lanes d;
  const auto zero = hn::Zero(d);
  alignas(64) float below[group] = {}, above[group] = {};
  for (std::size_t x = 0; x < values.size(); x += group)
    for (std::size_t i = 0; i < std::size_t(group); i += hn::Lanes(d)) {
      const auto value = hn::Mul(hn::LoadU(d, values.data() + x + i), hn::LoadU(d, grow.data() + x + i));
      const auto less = hn::Lt(value, zero);
      hn::Store(hn::Add(hn::Load(d, below + i), hn::IfThenElse(less, value, zero)), d, below + i);
      hn::Store(hn::Add(hn::Load(d, above + i), hn::IfThenElse(less, zero, value)), d, above + i);
      hn::StoreU(held(value, 1.0f), d, covered.data() + x + i);
    }
  sums = glm::dvec2(0.0);
  for (int i = 0; i < group; ++i) sums += glm::dvec2(below[i], above[i]);
}

void spend(float loss, float dt, float lasting, std::span<const float> gains, std::span<float> covered,
           SpentRow& told) {
  const Lanes d;
  const auto zero = hn::Zero(d), most = hn::Set(d, 1e6f), one = hn::Set(d, 1.0f), per_s = hn::Set(d, loss);
  for (std::size_t x = 0; x < gains.size(); x += hn::Lanes(d)) {
    auto g = hn::LoadU(d, gains.data() + x), f = hn::LoadU(d, covered.data() + x);
    const auto sound = hn::And(hn::And(hn::Ge(g, zero), hn::Lt(g, most)), hn::And(hn::Ge(f, zero), hn::Le(f, one)));
    if (!hn::AllTrue(d, sound)) {
      told.wrong = true;
      g = hn::IfThenElse(hn::Ge(g, zero), held(g, 1e6f), zero);
      f = hn::IfThenElse(hn::Ge(f, zero), held(f, 1.0f), zero);
    }
    auto next = hn::Mul(f, hn::Set(d, lasting));
    const auto fed = hn::Gt(g, zero);
    if (!hn::AllFalse(d, fed)) {
      const auto rate = hn::Add(g, per_s), rest = hn::Div(g, rate);
      const auto kept = hn::Mul(hn::Sub(f, rest), exp_minus(d, hn::Mul(rate, hn::Set(d, dt))));
      next = hn::IfThenElse(fed, held(hn::Add(rest, kept), 1.0f), next);
    }
    next = hn::IfThenElse(hn::Lt(next, hn::Set(d, least_foam)), zero, next);
    told.holds = told.holds || !hn::AllFalse(d, hn::Gt(next, zero));
    hn::StoreU(next, d, covered.data() + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(carry);
HWY_EXPORT(settle);
HWY_EXPORT(spend);

SpentRow spend_row(float loss, float dt, float lasting, std::span<const float> gains, std::span<float> covered) {
  assert(gains.size() % foam_group == 0 && covered.size() == gains.size());
  SpentRow told;
  HWY_DYNAMIC_DISPATCH(spend)(loss, dt, lasting, gains, covered, told);
  return told;
}

int carry_row(const CarriedRow& row, std::span<float> values, std::span<float> grow, std::span<int> beyond,
              std::span<glm::vec2> ways) {
  assert(row.side % foam_group == 0);
  return HWY_DYNAMIC_DISPATCH(carry)(row, values, grow, beyond, ways);
}

glm::dvec2 settle_row(std::span<const float> values, std::span<const float> grow, std::span<float> covered) {
  glm::dvec2 sums(0.0);
  HWY_DYNAMIC_DISPATCH(settle)(values, grow, covered, sums);
  return sums;
}

}  // namespace seascape
#endif
