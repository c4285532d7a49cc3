#include "ocean/places/wave_source.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace seascape {

namespace {

// Through exp(-k depth) at two numbers within the band, where its error is the same at both ends and between
// (Chebyshev): it is b^2 (k - k1)(k - k2) of the value.
DepthTerm one_term(double depth, double least, double most) {
  const double middle = 0.5 * (least + most), away = 0.5 * std::sqrt(0.5) * (most - least), k1 = middle - away,
               width = depth / (2.0 * middle);
  return {std::exp(-k1 * depth + k1 * k1 * width), width};
}

}  // namespace

int depth_terms(double depth, double least, double most, std::span<DepthTerm, 2> terms) {
  constexpr double one_is_enough = 0.002;
  terms[0] = {};
  if (!(depth > 0.0)) return 1;
  terms[0] = one_term(depth, least, most);
  if (depth * (most - least) * (most - least) / (8.0 * (most + least)) < one_is_enough) return 1;
  // Two exponentials in k^2 through four equal steps of it (Prony 1795). exp(-k depth) is completely monotone in k^2,
  // so that both are real and fall. Where the deep band's far end has nothing left, the steps stay where there is.
  const double to = std::min(most, std::max(3.0 * least, 2.0 / depth)), first = least * least,
               step = (to * to - first) / 3.0;
  std::array<double, 4> f{};
  for (std::size_t i = 0; i < 4; ++i) f[i] = std::exp(depth * (least - std::sqrt(first + double(i) * step)));
  const double det = f[1] * f[1] - f[0] * f[2], p = (f[2] * f[1] - f[0] * f[3]) / det,
               q = (f[1] * f[3] - f[2] * f[2]) / det, root = std::sqrt(p * p + 4.0 * q), slow = 0.5 * (p + root),
               fast = 0.5 * (p - root);
  if (!(fast > 0.0 && slow > fast && slow < 1.0)) return 1;
  const double share = (f[1] - f[0] * fast) / (slow - fast), scale = std::exp(-least * depth);
  const auto term = [&](double amplitude, double factor) {
    const double width = -std::log(factor) / step;
    return DepthTerm{scale * amplitude * std::exp(width * first), width};
  };
  terms[0] = term(share, slow), terms[1] = term(f[0] - share, fast);
  return 2;
}

}  // namespace seascape
