// Forward differentiation against differences of the same functions in double.
#include "ocean/sea/dual-inl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace seascape {
namespace {

namespace vectors = HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::FixedTag<float, 4>;
using Vector = hn::Vec<Tag>;
template <int count>
using Number = vectors::Dual<Vector, count>;

// One formula with everything that queries use, of two numbers: T is a Dual, or the double of the reference.
double clamped(double a) { return std::clamp(a, 0.0, 1.0); }
double root(double a) { return std::sqrt(a); }
double larger(double a, double b) { return std::max(a, b); }
double times(double a, float by) { return a * double(by); }
double plus(double a, float more) { return a + double(more); }
template <class T>
T formula(const T& x, const T& z) {
  using namespace vectors;
  const T square = x * x + z * z;
  const T quotient = (plus(times(x, 3.0f), 1.0f) - z) / plus(square, 0.5f);
  return root(plus(square, 0.1f)) * quotient + larger(x * z, z - x) * clamped(plus(times(x, 0.5f), 0.4f));
}

template <int count>
Number<count> variable(const float (&values)[4], int which) {
  Number<count> result = vectors::constant<count>(hn::LoadU(Tag(), values));
  if (which < count) result.by[std::size_t(which)] = hn::Set(Tag(), 1.0f);
  return result;
}

// Values are those of no derivatives to the bit, derivatives those of differences in double. Controls seen: the product
// rule without its second part; a quotient's derivative not divided; clamped numbers that go on changing.
TEST(Dual, DerivativesAreThoseOfDifferences) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> within(-2.0f, 2.0f);
  int compared = 0, held = 0;
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    float x[4], z[4], value[4], plain[4], by_x[4], by_z[4];
    for (int lane = 0; lane < 4; ++lane) x[lane] = within(random), z[lane] = within(random);
    const Number<2> found = formula(variable<2>(x, 0), variable<2>(z, 1));
    const Number<0> alone = formula(variable<0>(x, 0), variable<0>(z, 1));
    hn::StoreU(found.value, Tag(), value);
    hn::StoreU(alone.value, Tag(), plain);
    hn::StoreU(found.by[0], Tag(), by_x);
    hn::StoreU(found.by[1], Tag(), by_z);
    for (int lane = 0; lane < 4; ++lane) {
      ASSERT_EQ(value[lane], plain[lane]);
      const double a = double(x[lane]), b = double(z[lane]), step = 1e-5;
      EXPECT_NEAR(double(value[lane]), formula(a, b), 2e-5);
      const double share = 0.5 * a + 0.4;
      // Differences across a kink are of neither side.
      if (std::abs(a * b - (b - a)) < 1e-3 || std::abs(share) < 1e-3 || std::abs(share - 1.0) < 1e-3) continue;
      ++compared;
      held += share < 0.0 || share > 1.0;
      const double want_x = (formula(a + step, b) - formula(a - step, b)) / (2.0 * step),
                   want_z = (formula(a, b + step) - formula(a, b - step)) / (2.0 * step);
      worst = std::max({worst, std::abs(double(by_x[lane]) - want_x) / (1.0 + std::abs(want_x)),
                        std::abs(double(by_z[lane]) - want_z) / (1.0 + std::abs(want_z))});
    }
  }
  EXPECT_GT(compared, 7000);
  EXPECT_GT(held, 1000);
  EXPECT_LT(worst, 2e-5);
}

// Where a mask says so, values and derivatives of one or the other, or none; a root of nothing changes nothing.
// Controls seen: derivatives that no mask chooses; a root's derivative at 0 left infinite.
TEST(Dual, MasksChooseDerivativesToo) {
  const float one[4] = {1.0f, -2.0f, 3.0f, -4.0f}, other[4] = {5.0f, 6.0f, 7.0f, 8.0f}, none[4] = {};
  const Tag d;
  const Number<2> a = variable<2>(one, 0), b = variable<2>(other, 1);
  const auto positive = hn::Gt(a.value, hn::Zero(d));
  const auto lanes = [&](Vector v) {
    std::array<float, 4> result;
    hn::StoreU(v, d, result.data());
    return result;
  };
  using Lanes = std::array<float, 4>;
  const Number<2> chosen = vectors::select(positive, a, b), kept = vectors::only(positive, a);
  EXPECT_EQ(lanes(chosen.value), (Lanes{1.0f, 6.0f, 3.0f, 8.0f}));
  EXPECT_EQ(lanes(chosen.by[0]), (Lanes{1.0f, 0.0f, 1.0f, 0.0f}));
  EXPECT_EQ(lanes(chosen.by[1]), (Lanes{0.0f, 1.0f, 0.0f, 1.0f}));
  EXPECT_EQ(lanes(kept.value), (Lanes{1.0f, 0.0f, 3.0f, 0.0f}));
  EXPECT_EQ(lanes(kept.by[0]), (Lanes{1.0f, 0.0f, 1.0f, 0.0f}));
  const Number<2> nothing = vectors::root(variable<2>(none, 0));
  EXPECT_EQ(lanes(nothing.value), Lanes{});
  EXPECT_EQ(lanes(nothing.by[0]), Lanes{});
}

}  // namespace
}  // namespace seascape
