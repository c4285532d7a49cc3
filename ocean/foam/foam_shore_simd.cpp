#include "ocean/foam/foam_shore_simd.h"

#include <cmath>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/foam/foam_shore_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include "ocean/sea/formulas-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

// No multiplication is fused with an addition anywhere here: all instruction sets give the same bits.

constexpr int group = shore_group;
using Lanes = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Lanes>;

// Of a level the four texels around each of a group's places, in floats from the first, and their weights.
struct Corners {
  alignas(64) std::int32_t at[4][group];
  alignas(64) float weight[4][group];
};

HWY_INLINE void locate(const ShoreLevel& level, Vector bent_x, Vector bent_z, int i, Corners& corners) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  const auto cosine = hn::Set(d, level.cosine), sine = hn::Set(d, level.sine), first = hn::Set(d, level.first);
  const auto x = hn::Add(hn::Add(hn::Mul(cosine, bent_x), hn::Mul(sine, bent_z)), first),
             z = hn::Add(hn::Sub(hn::Mul(cosine, bent_z), hn::Mul(sine, bent_x)), first);
  const auto floor_x = hn::Floor(x), floor_z = hn::Floor(z);
  const auto right = hn::Sub(x, floor_x), below = hn::Sub(z, floor_z), one = hn::Set(d, 1.0f);
  const auto mask = hn::Set(di, level.mask), stride = hn::Set(di, level.stride), next = hn::Set(di, 1);
  const auto column = hn::ConvertTo(di, floor_x), row = hn::ConvertTo(di, floor_z);
  const auto x0 = hn::And(column, mask), x1 = hn::And(hn::Add(column, next), mask);
  const auto z0 = hn::Mul(hn::And(row, mask), stride), z1 = hn::Mul(hn::And(hn::Add(row, next), mask), stride);
  const auto share = hn::Set(d, level.share), under = hn::Mul(share, below),
             above = hn::Mul(share, hn::Sub(one, below)), left = hn::Sub(one, right);
  const auto put = [&](int n, auto texel, Vector weight) HWY_ATTR {
    hn::Store(hn::ShiftLeft<2>(texel), di, corners.at[n] + i);
    hn::Store(weight, d, corners.weight[n] + i);
  };
  put(0, hn::Add(z0, x0), hn::Mul(left, above)), put(1, hn::Add(z0, x1), hn::Mul(right, above));
  put(2, hn::Add(z1, x0), hn::Mul(left, under)), put(3, hn::Add(z1, x1), hn::Mul(right, under));
}

// Four floats of each plane, of each texel that has waves.
struct Samples {
  alignas(64) float shift[4 * group], slope[4 * group], moments[4 * group];
};

HWY_INLINE void sample(const ShorePattern& pattern, const Corners* corners, int texel, Samples& to) {
  const hn::FixedTag<float, 4> d;
  const auto plane = [&](const glm::vec4* ShoreLevel::*which, float* sum) HWY_ATTR {
    auto all = hn::Zero(d);
    for (int l = 0; l < pattern.count; ++l) {
      const float* const texels = &(pattern.levels[l].*which)->x;
      for (int n = 0; n < 4; ++n)
        all = hn::Add(all,
                      hn::Mul(hn::Set(d, corners[l].weight[n][texel]), hn::LoadU(d, texels + corners[l].at[n][texel])));
    }
    hn::Store(all, d, sum + 4 * texel);
  };
  plane(&ShoreLevel::shift, to.shift);
  plane(&ShoreLevel::slope, to.slope);
  plane(&ShoreLevel::moments, to.moments);
}

// A group's texels, one number each in a row.
struct Texels {
  alignas(64) float bent_x[group], bent_z[group], forward_x[group], forward_z[group];
  alignas(64) float stretch[group], turning[group], share[group];
  alignas(64) float flow_x[group], flow_z[group];
};

struct Sum {
  Vector x, y, z, xx, zz, xz, variance;
};

// Texels i to i + lanes - 1: adds what a pattern does that counts for `counts` of their share.
HWY_INLINE void add(const ShorePattern& pattern, const Texels& t, const Samples& samples, Vector counts, int i,
                    Sum& sum) {
  const Lanes d;
  const auto load = [&](const float* from) HWY_ATTR { return hn::Load(d, from + i); };
  const auto share = hn::Mul(load(t.share), counts), kept = hn::Set(d, pattern.kept);
  Vector d_x, d_y, d_z, xz, unused, other, xx, zz, m_x, m_z, m_xz, moment;
  hn::LoadInterleaved4(d, samples.shift + 4 * i, d_x, d_y, d_z, xz);
  hn::LoadInterleaved4(d, samples.slope + 4 * i, unused, other, xx, zz);
  hn::LoadInterleaved4(d, samples.moments + 4 * i, m_x, m_z, m_xz, moment);
  const auto size = hn::Mul(kept, hn::Set(d, pattern.size));
  d_x = hn::Mul(size, d_x), d_y = hn::Mul(size, d_y), d_z = hn::Mul(size, d_z);
  xx = hn::Mul(kept, xx), zz = hn::Mul(kept, zz), xz = hn::Mul(kept, xz);
  const auto whole = hn::Set(d, pattern.whole_moment), divergence = hn::Add(xx, zz);
  const auto left = hn::Sub(hn::Add(whole, hn::Mul(kept, hn::Sub(moment, whole))), hn::Mul(divergence, divergence));
  sum.variance = hn::Add(sum.variance, hn::Mul(hn::Mul(share, share), hn::Max(left, hn::Zero(d))));
  const auto f_x = load(t.forward_x), f_z = load(t.forward_z), r_x = hn::Neg(f_z), r_z = f_x;
  const auto both = [&](Vector a, Vector b, Vector c, Vector e)
                        HWY_ATTR { return hn::Add(hn::Mul(a, b), hn::Mul(c, e)); };
  sum.x = hn::Add(sum.x, hn::Mul(share, both(d_x, f_x, d_z, r_x)));
  sum.y = hn::Add(sum.y, hn::Mul(share, d_y));
  sum.z = hn::Add(sum.z, hn::Mul(share, both(d_x, f_z, d_z, r_z)));
  // D = share (Dx forward + Dz right); forward turns by `turning` to the right, right as much against forward
  // (in plain double precision: tests/support/place_truth.cpp).
  const auto stretch = load(t.stretch), turning = load(t.turning);
  const auto along_x = hn::Mul(stretch, f_x), along_z = hn::Mul(stretch, f_z);
  const auto by_x = hn::Mul(turning, f_x), by_z = hn::Mul(turning, f_z);
  const auto forward_by_x = hn::Sub(both(xx, along_x, xz, r_x), hn::Mul(d_z, by_x)),
             forward_by_z = hn::Sub(both(xx, along_z, xz, r_z), hn::Mul(d_z, by_z)),
             right_by_x = hn::Add(both(xz, along_x, zz, r_x), hn::Mul(d_x, by_x)),
             right_by_z = hn::Add(both(xz, along_z, zz, r_z), hn::Mul(d_x, by_z));
  sum.xx = hn::Add(sum.xx, hn::Mul(share, both(f_x, forward_by_x, r_x, right_by_x)));
  sum.zz = hn::Add(sum.zz, hn::Mul(share, both(f_z, forward_by_z, r_z, right_by_z)));
  const auto mean = hn::Add(both(f_x, forward_by_z, r_x, right_by_z), both(f_z, forward_by_x, r_z, right_by_x));
  sum.xz = hn::Add(sum.xz, hn::Mul(hn::Mul(hn::Set(d, 0.5f), share), mean));
}

}  // namespace

void move(const ShorePattern& pattern, const FlowPhase& phase, const ShoreTexelPlace* texels, const glm::vec2* flow,
          ShoreMoved* moved) {
  const Lanes d;
  constexpr float least = 1e-20f;
  Texels t;
  bool flows = false;
  for (int i = 0; i < group; ++i) {
    const ShoreTexelPlace& from = texels[i];
    t.bent_x[i] = from.place.x, t.bent_z[i] = from.place.y, t.forward_x[i] = from.place.z,
    t.forward_z[i] = from.place.w, t.stretch[i] = from.waves.x, t.turning[i] = from.waves.y, t.share[i] = from.waves.z;
    t.flow_x[i] = flow != nullptr ? flow[i].x : 0.0f, t.flow_z[i] = flow != nullptr ? flow[i].y : 0.0f;
    if (t.flow_x[i] * t.flow_x[i] + t.flow_z[i] * t.flow_z[i] < pattern.least_flow_mps * pattern.least_flow_mps)
      t.flow_x[i] = t.flow_z[i] = 0.0f;
    flows = flows || ((t.flow_x[i] != 0.0f || t.flow_z[i] != 0.0f) && t.share[i] > 0.0f);
  }
  alignas(64) Sum sums[group / 4];  // a vector holds four texels at least
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  for (int i = 0, v = 0; i < group; i += int(hn::Lanes(d)), ++v) sums[v] = {zero, zero, zero, zero, zero, zero, zero};
  Corners corners[2];
  Samples samples = {};
  alignas(64) float counts[group];
  for (int turn = 0; turn < (flows ? 2 : 1); ++turn) {
    const float way_s = float(turn == 0 ? phase.first_s : phase.second_s),
                part = float(turn == 0 ? phase.first : 1.0 - phase.first);
    const auto apart = hn::Set(d, float(std::abs(phase.second_s - phase.first_s)));
    for (int i = 0; i < group; i += int(hn::Lanes(d))) {
      const auto load = [&](const float* from) HWY_ATTR { return hn::Load(d, from + i); };
      const auto f_x = load(t.forward_x), f_z = load(t.forward_z), v_x = load(t.flow_x), v_z = load(t.flow_z);
      const auto along = hn::Mul(load(t.stretch), hn::Add(hn::Mul(v_x, f_x), hn::Mul(v_z, f_z))),
                 across = hn::Sub(hn::Mul(v_z, f_x), hn::Mul(v_x, f_z)), back = hn::Set(d, -way_s);
      const auto stands = hn::And(hn::Eq(v_x, zero), hn::Eq(v_z, zero));
      const auto height =
          flow_height(d, pattern.decay_per_m2, hn::Mul(apart, along), hn::Mul(apart, across), float(phase.first));
      hn::Store(hn::IfThenElse(stands, turn == 0 ? one : zero, hn::Mul(height, hn::Set(d, part))), d, counts + i);
      for (int l = 0; l < pattern.count; ++l)
        locate(pattern.levels[l], hn::Add(load(t.bent_x), hn::Mul(back, along)),
               hn::Add(load(t.bent_z), hn::Mul(back, across)), i, corners[l]);
    }
    for (int i = 0; i < group; ++i)
      if (t.share[i] * counts[i] > least) sample(pattern, corners, i, samples);
    for (int i = 0, v = 0; i < group; i += int(hn::Lanes(d)), ++v)
      add(pattern, t, samples, hn::Load(d, counts + i), i, sums[v]);
  }
  for (int i = 0, v = 0; i < group; i += int(hn::Lanes(d)), ++v) {
    alignas(64) float out[7][group];
    const Sum& s = sums[v];
    int n = 0;
    for (const Vector& value : {s.x, s.y, s.z, s.xx, s.zz, s.xz, s.variance}) hn::Store(value, d, out[n++]);
    for (int lane = 0; lane < int(hn::Lanes(d)); ++lane)
      moved[i + lane] = {out[0][lane], out[1][lane], out[2][lane], out[3][lane],
                         out[4][lane], out[5][lane], out[6][lane]};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(move);

void shore_moved(const ShorePattern& pattern, const FlowPhase& phase, const ShoreTexelPlace* texels,
                 const glm::vec2* flow, ShoreMoved* moved) {
  HWY_DYNAMIC_DISPATCH(move)(pattern, phase, texels, flow, moved);
}

}  // namespace seascape
#endif
