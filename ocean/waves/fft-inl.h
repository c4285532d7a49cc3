// The transforms of a band along one dimension, for the instruction set that Highway compiles this for: of columns,
// whose neighbours lie side by side and fill the vectors, and of rows, whose own values do.
#include <utility>

#include "ocean/waves/fft.h"
#include "ocean/waves/fft_butterflies-inl.h"

#if defined(SEASCAPE_FFT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_FFT_INL_H
#undef SEASCAPE_FFT_INL_H
#else
#define SEASCAPE_FFT_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

// The factors of a plan for transform r.
struct Factors {
  const float *outer_cosines, *outer_sines, *inner_cosines, *inner_sines;
  Factors(const FftPlan& plan, int r)
      : outer_cosines(plan.outer.data() + std::ptrdiff_t(2) * r * plan.core),
        outer_sines(outer_cosines + plan.core),
        inner_cosines(plan.inner.data()),
        inner_sines(inner_cosines + plan.core) {}
};

// The columns' first stage leaves value q1 of j2 at q1 * column_group<D>(R2) + j2 * lanes; groups are padded against
// cache aliasing.
template <class D>
constexpr std::ptrdiff_t column_group(int radix_2) {
  return std::ptrdiff_t(radix_2 + 1) * std::ptrdiff_t(hn::MaxLanes(D()));
}

template <class D, int R1, int R2, int Fold, int Quarters, bool Turn>
HWY_NOINLINE void column_stage_1(const Factors& f, const float* in_re, const float* in_im, std::ptrdiff_t step,
                                 float* work) {
  constexpr std::ptrdiff_t lanes = hn::MaxLanes(D()), group = column_group<D>(R2);
  for (int j2 = 0; j2 < R2; ++j2)
    butterfly<R1>(D(),
                  Inputs<D, Lay::columns, R1, Fold, Quarters, Turn>{in_re + j2 * step, in_im + j2 * step, R2 * step,
                                                                    f.outer_cosines + j2, f.outer_sines + j2, R2},
                  Results<D, Lay::columns, true>{work + j2 * lanes, work + R1 * group + j2 * lanes, group,
                                                 f.inner_cosines + j2, f.inner_sines + j2, R2});
}

template <class D, int R1, int R2>
HWY_NOINLINE void column_stage_2(const float* work, float* out_re, float* out_im, std::ptrdiff_t step) {
  constexpr std::ptrdiff_t lanes = hn::MaxLanes(D()), group = column_group<D>(R2);
  for (int q1 = 0; q1 < R1; ++q1)
    butterfly<R2>(
        D(), Lines<D>{work + q1 * group, work + (R1 + q1) * group, lanes},
        Results<D, Lay::columns, false>{out_re + q1 * step, out_im + q1 * step, R1 * step, nullptr, nullptr, 0});
}

// One row's transform r: its first stage with lanes along j2, a transposition, its second with lanes along q1.
template <int R1, int R2, int Fold, int Quarters, bool Turn>
HWY_NOINLINE void row_core(const Factors& f, const float* in_re, const float* in_im, float* out_re, float* out_im) {
  using D = hn::CappedTag < float, R1<R2 ? R1 : R2>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  alignas(64) float first[2][R1 * R2], second[2][R1 * R2];
  for (int j2 = 0; j2 < R2; j2 += lanes)
    butterfly<R1>(
        D(),
        Inputs<D, Lay::row, R1, Fold, Quarters, Turn>{in_re + j2, in_im + j2, R2, f.outer_cosines + j2,
                                                      f.outer_sines + j2, R2},
        Results<D, Lay::row, true>{first[0] + j2, first[1] + j2, R2, f.inner_cosines + j2, f.inner_sines + j2, R2});
  // Blocks of 4 x 4 in their place, by which each vector of the second stage is whole blocks side by side.
  for (int part = 0; part < 2; ++part)
    for (int q1 = 0; q1 < R1; q1 += 4)
      for (int j2 = 0; j2 < R2; j2 += lanes) {
        const D d;
        const float* from = first[part] + q1 * R2 + j2;
        float* to = second[part] + q1 * R2 + j2;
        const auto a = hn::Load(d, from), b = hn::Load(d, from + R2), c = hn::Load(d, from + 2 * R2),
                   e = hn::Load(d, from + 3 * R2);
        const auto ac_low = hn::InterleaveLower(d, a, c), be_low = hn::InterleaveLower(d, b, e);
        const auto ac_high = hn::InterleaveUpper(d, a, c), be_high = hn::InterleaveUpper(d, b, e);
        hn::Store(hn::InterleaveLower(d, ac_low, be_low), d, to);
        hn::Store(hn::InterleaveUpper(d, ac_low, be_low), d, to + R2);
        hn::Store(hn::InterleaveLower(d, ac_high, be_high), d, to + 2 * R2);
        hn::Store(hn::InterleaveUpper(d, ac_high, be_high), d, to + 3 * R2);
      }
  for (int q1 = 0; q1 < R1; q1 += lanes)
    butterfly<R2>(D(), Blocks<D>{second[0] + q1 * R2, second[1] + q1 * R2, R2},
                  Results<D, Lay::row, false>{out_re + q1, out_im + q1, R1, nullptr, nullptr, 0});
}

// Calls work.template stages<R1, R2, Fold, Quarters, Turn>() for transform r of a plan.
template <class Work>
HWY_INLINE void with_stages(const FftPlan& plan, int r, const Work& work) {
  if (plan.fold > 1) {
    // Value j + core of a band: m = j + core, or j - core where the band is two cores wide.
    const int quarters = (plan.fold == 2 ? 4 - 4 * r / plan.repeats : 4 * r / plan.repeats) % 4;
    if (plan.fold == 2) {
      if (r == 0)
        work.template stages<16, 16, 2, 0, false>();
      else if (quarters == 1)
        work.template stages<16, 16, 2, 1, true>();
      else if (quarters == 2)
        work.template stages<16, 16, 2, 2, true>();
      else
        work.template stages<16, 16, 2, 3, true>();
    } else {
      if (r == 0)
        work.template stages<16, 16, 4, 0, false>();
      else if (quarters == 1)
        work.template stages<16, 16, 4, 1, true>();
      else if (quarters == 2)
        work.template stages<16, 16, 4, 2, true>();
      else
        work.template stages<16, 16, 4, 3, true>();
    }
  } else if (plan.core == 256) {
    if (r == 0)
      work.template stages<16, 16, 1, 0, false>();
    else
      work.template stages<16, 16, 1, 0, true>();
  } else if (plan.core == 128) {
    if (r == 0)
      work.template stages<8, 16, 1, 0, false>();
    else
      work.template stages<8, 16, 1, 0, true>();
  } else if (plan.core == 64) {
    if (r == 0)
      work.template stages<8, 8, 1, 0, false>();
    else
      work.template stages<8, 8, 1, 0, true>();
  } else if (plan.core == 32) {
    if (r == 0)
      work.template stages<4, 8, 1, 0, false>();
    else
      work.template stages<4, 8, 1, 0, true>();
  } else {
    if (r == 0)
      work.template stages<4, 4, 1, 0, false>();
    else
      work.template stages<4, 4, 1, 0, true>();
  }
}

// Lanes(D()) columns side by side: value m + band/2 at in + (m + band/2) * step. `work` holds column_work<D>(plan)
// floats, on a whole line.
template <class D>
struct ColumnsIn {
  const Factors& factors;
  const float *re, *im;
  std::ptrdiff_t step;
  float* work;
  template <int R1, int R2, int Fold, int Quarters, bool Turn>
  HWY_INLINE void stages() const {
    column_stage_1<D, R1, R2, Fold, Quarters, Turn>(factors, re, im, step, work);
  }
};
template <class D>
struct ColumnsOut {
  const float* work;
  float *re, *im;
  std::ptrdiff_t step;
  template <int R1, int R2, int, int, bool>
  HWY_INLINE void stages() const {
    column_stage_2<D, R1, R2>(work, re, im, step);
  }
};
struct RowCore {
  const Factors& factors;
  const float *re, *im;
  float *out_re, *out_im;
  template <int R1, int R2, int Fold, int Quarters, bool Turn>
  HWY_INLINE void stages() const {
    row_core<R1, R2, Fold, Quarters, Turn>(factors, re, im, out_re, out_im);
  }
};

template <class D>
HWY_INLINE std::ptrdiff_t column_work(const FftPlan& plan) {
  return 2 * (plan.core + 16) * std::ptrdiff_t(hn::MaxLanes(D()));
}

// The first stage of transform r, of whatever plan; the second, whose results x = repeats q + r go to out + q * step.
template <class D>
HWY_INLINE void columns_in(const FftPlan& plan, int r, const float* re, const float* im, std::ptrdiff_t step,
                           float* work) {
  const Factors factors(plan, r);
  with_stages(plan, r, ColumnsIn<D>{factors, re, im, step, work});
}
template <class D>
HWY_INLINE void columns_out(const FftPlan& plan, int r, const float* work, float* re, float* im, std::ptrdiff_t step) {
  with_stages(plan, r, ColumnsOut<D>{work, re, im, step});
}

// One whole row: value m + band/2 at in + m + band/2, sample x at out + x. `work` holds row_work(plan) floats.
inline std::ptrdiff_t row_work(const FftPlan& plan) { return plan.repeats == 1 ? 0 : std::ptrdiff_t(4) * plan.n; }
HWY_INLINE void transform_row(const FftPlan& plan, const float* in_re, const float* in_im, float* out_re, float* out_im,
                              float* work) {
  const hn::CappedTag<float, 16> d;
  const int n = plan.n, lanes = int(hn::Lanes(d));
  float *re = work, *im = work + n, *next_re = work + 2 * n, *next_im = work + 3 * n;
  for (int r = 0; r < plan.repeats; ++r) {
    const Factors factors(plan, r);
    float* to_re = plan.repeats == 1 ? out_re : re + std::ptrdiff_t(r) * plan.core;
    float* to_im = plan.repeats == 1 ? out_im : im + std::ptrdiff_t(r) * plan.core;
    with_stages(plan, r, RowCore{factors, in_re, in_im, to_re, to_im});
  }
  // Results q of r and of r + parts/2 shuffled together are results q of r in half as many parts.
  for (int parts = plan.repeats, size = plan.core; parts > 1; parts /= 2, size *= 2) {
    if (parts == 2) next_re = out_re, next_im = out_im;
    const int half = parts / 2 * size;
    for (int i = 0; i < half; i += lanes) {
      hn::StoreInterleaved2(hn::LoadU(d, re + i), hn::LoadU(d, re + half + i), d, next_re + 2 * i);
      hn::StoreInterleaved2(hn::LoadU(d, im + i), hn::LoadU(d, im + half + i), d, next_im + 2 * i);
    }
    std::swap(re, next_re), std::swap(im, next_im);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();
#endif
