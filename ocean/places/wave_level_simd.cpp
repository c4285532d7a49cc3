#include "ocean/places/wave_level_simd.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/places/wave_level_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, 8>;
using Floats = hn::Rebind<float, Doubles>;
using Lanes = hn::CappedTag<float, 16>;
}  // namespace

void to_floats(const double* modes, std::ptrdiff_t count, float* re, float* im) {
  const Doubles dd;
  const Floats df;
  for (std::ptrdiff_t i = 0; i < count; i += std::ptrdiff_t(hn::Lanes(dd))) {
    hn::Vec<Doubles> a, b;
    hn::LoadInterleaved2(dd, modes + 2 * i, a, b);
    hn::StoreU(hn::DemoteTo(df, a), df, re + i);
    hn::StoreU(hn::DemoteTo(df, b), df, im + i);
  }
}

void add_modes(double* modes, std::ptrdiff_t count, const double* share, double scale, const float* re,
               const float* im) {
  const Doubles dd;
  const Floats df;
  const auto by = hn::Set(dd, scale);
  for (std::ptrdiff_t i = 0; i < count; i += std::ptrdiff_t(hn::Lanes(dd))) {
    hn::Vec<Doubles> a, b;
    hn::LoadInterleaved2(dd, modes + 2 * i, a, b);
    const auto carried = hn::Gt(hn::LoadU(dd, share + i), hn::Zero(dd));
    const auto more = [&](const float* from) HWY_ATTR {
      return hn::IfThenElseZero(carried, hn::Mul(by, hn::PromoteTo(dd, hn::LoadU(df, from + i))));
    };
    hn::StoreInterleaved2(hn::Add(a, more(re)), hn::Add(b, more(im)), dd, modes + 2 * i);
  }
}

void products(double* to, std::ptrdiff_t count, const double* of_re, const double* of_im, std::ptrdiff_t sources,
              const double* along_re, const double* along_im, std::ptrdiff_t stride) {
  const Doubles dd;
  for (std::ptrdiff_t i = 0; i < count; i += std::ptrdiff_t(hn::Lanes(dd))) {
    hn::Vec<Doubles> re, im;
    hn::LoadInterleaved2(dd, to + 2 * i, re, im);
    for (std::ptrdiff_t s = 0; s < sources; ++s) {
      const auto a = hn::Set(dd, of_re[s]), b = hn::Set(dd, of_im[s]);
      const auto c = hn::LoadU(dd, along_re + s * stride + i), d = hn::LoadU(dd, along_im + s * stride + i);
      re = hn::Add(re, hn::Sub(hn::Mul(a, c), hn::Mul(b, d)));
      im = hn::Add(im, hn::Add(hn::Mul(a, d), hn::Mul(b, c)));
    }
    hn::StoreInterleaved2(re, im, dd, to + 2 * i);
  }
}

void outer_product(float* to, std::ptrdiff_t n, std::ptrdiff_t stride, const TexelPatch& patch, const float* of_x,
                   const float* of_z, float by) {
  const Lanes d;
  // Whole groups of 16, the first from a multiple of it.
  const std::ptrdiff_t begin = patch.x_first / 16 * 16,
                       past = std::min(std::ptrdiff_t(patch.x_first) + patch.x_count, begin + n),
                       end = std::min(past, n), wrapped = past - n;
  for (std::ptrdiff_t j = 0; j < patch.z_count; ++j) {
    const std::ptrdiff_t z = (patch.z_first + j) % n;
    float* row = to + z * stride;
    const auto across = hn::Set(d, by * of_z[z]);
    const auto add = [&](std::ptrdiff_t x) HWY_ATTR {
      hn::StoreU(hn::Add(hn::LoadU(d, row + x), hn::Mul(across, hn::LoadU(d, of_x + x))), d, row + x);
    };
    constexpr std::ptrdiff_t group = 16;
    for (std::ptrdiff_t x = begin; x < end; x += group)
      for (std::ptrdiff_t i = 0; i < group; i += std::ptrdiff_t(hn::Lanes(d))) add(x + i);
    for (std::ptrdiff_t x = 0; x < wrapped; x += group)
      for (std::ptrdiff_t i = 0; i < group; i += std::ptrdiff_t(hn::Lanes(d))) add(x + i);
  }
}

void multiply(float* re, float* im, std::ptrdiff_t n, std::ptrdiff_t stride, const float* along_x, const float* along_z,
              const float* open) {
  const Lanes d;
  const auto one = hn::Set(d, 1.0f);
  for (std::ptrdiff_t z = 0; z < n; ++z) {
    const auto across = hn::Set(d, along_z[z]);
    for (std::ptrdiff_t x = 0; x < n; x += std::ptrdiff_t(hn::Lanes(d))) {
      auto left = hn::Mul(hn::LoadU(d, along_x + x), across);
      if (open != nullptr) left = hn::Mul(left, hn::LoadU(d, open + z * n + x));
      const auto lost = hn::Sub(left, one);
      for (float* part : {re, im}) {
        float* at = part + z * stride + x;
        hn::StoreU(hn::Mul(hn::LoadU(d, at), lost), d, at);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(to_floats);
HWY_EXPORT(add_modes);
HWY_EXPORT(products);
HWY_EXPORT(outer_product);
HWY_EXPORT(multiply);

void floats_from_modes(std::span<const std::complex<double>> modes, float* re, float* im) {
  assert(modes.size() % 16 == 0);
  HWY_DYNAMIC_DISPATCH(to_floats)
  (reinterpret_cast<const double*>(modes.data()), std::ptrdiff_t(modes.size()), re, im);
}

void add_to_modes(std::span<std::complex<double>> modes, const double* share, double scale, const float* re,
                  const float* im) {
  assert(modes.size() % 16 == 0);
  HWY_DYNAMIC_DISPATCH(add_modes)
  (reinterpret_cast<double*>(modes.data()), std::ptrdiff_t(modes.size()), share, scale, re, im);
}

void add_products(std::span<std::complex<double>> to, std::span<const double> of_re, std::span<const double> of_im,
                  const double* along_re, const double* along_im, std::ptrdiff_t stride) {
  assert(to.size() % 8 == 0 && of_re.size() == of_im.size());
  HWY_DYNAMIC_DISPATCH(products)
  (reinterpret_cast<double*>(to.data()), std::ptrdiff_t(to.size()), of_re.data(), of_im.data(),
   std::ptrdiff_t(of_re.size()), along_re, along_im, stride);
}

void add_outer_product(float* to, int n, int stride, const TexelPatch& patch, const float* of_x, const float* of_z,
                       float by) {
  assert(n % 16 == 0);
  HWY_DYNAMIC_DISPATCH(outer_product)(to, n, stride, patch, of_x, of_z, by);
}

void multiply_by_loss(float* re, float* im, int n, int stride, const float* along_x, const float* along_z,
                      const float* open) {
  assert(n % 16 == 0);
  HWY_DYNAMIC_DISPATCH(multiply)(re, im, n, stride, along_x, along_z, open);
}

}  // namespace seascape
#endif
