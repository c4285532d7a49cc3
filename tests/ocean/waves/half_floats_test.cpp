#include "ocean/waves/half_floats.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace seascape {
namespace {

// By definition: 10 bits after the point, a smallest exponent of -14.
double value_of(std::uint16_t half) {
  const int exponent = (half >> 10) & 31, mantissa = half & 1023;
  const double size = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return half & 0x8000 ? -size : size;
}

std::vector<std::uint16_t> converted(const std::vector<float>& floats) {
  std::vector<std::uint16_t> halves(floats.size());
  halves_from_floats(floats.data(), halves.data(), floats.size());
  return halves;
}

class HalfFloats : public ::testing::Test {
 protected:
  // Calls `check` for every vector instruction set that this processor has.
  template <class Check>
  void on_every_instruction_set(Check check) {
    int sets = 0;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1, ++sets) {
      SCOPED_TRACE(hwy::TargetName(left & -left));
      hwy::SetSupportedTargetsForTest(left & -left);
      hwy::GetChosenTarget().DeInit();
      check();
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
    EXPECT_GE(sets, 1);
  }
};

// Every half, every place half way to the next, and the floats on both sides of that. Control: cut instead of rounded,
// as Highway 1.0.3 does for SSE4, half of the middles and those above them fail.
TEST_F(HalfFloats, AreTheNearestAndTiesGoToTheEven) {
  std::vector<float> floats;
  std::vector<std::uint16_t> wanted;
  for (std::uint16_t half = 0; half < 0x7c00; ++half) {
    const auto next = std::uint16_t(half + 1);
    const double middle = half == 0x7bff ? 65520.0 : 0.5 * (value_of(half) + value_of(next));
    const float here = float(value_of(half)), between = float(middle);
    ASSERT_EQ(double(between), middle) << "which a float has exactly";
    const std::uint16_t even = half % 2 == 0 ? half : next;
    for (const auto& [value, to] : {std::pair(here, half), std::pair(std::nextafter(between, 0.0f), half),
                                    std::pair(between, even), std::pair(std::nextafter(between, 1e6f), next)})
      for (const bool negative : {false, true}) {
        floats.push_back(negative ? -value : value);
        wanted.push_back(negative ? std::uint16_t(to | 0x8000) : to);
      }
  }
  on_every_instruction_set([&] {
    const auto halves = converted(floats);
    int wrong = 0;
    for (std::size_t i = 0; i < floats.size(); ++i)
      if (halves[i] != wanted[i] && ++wrong <= 3)
        ADD_FAILURE() << floats[i] << " became " << halves[i] << ", not " << wanted[i];
    EXPECT_EQ(wrong, 0);
  });
}

// Beyond +-65504 half floats are infinite from where the nearest one would be 65536, and what is no number stays none,
// on every instruction set. Control seen: what is no number made infinite.
TEST_F(HalfFloats, hard_35_know_infinity_and_what_is_no_number) {
  const float infinity = std::numeric_limits<float>::infinity();
  on_every_instruction_set([&] {
    EXPECT_EQ(converted({infinity, -infinity, 65536.0f, 3e38f, -1e9f, 1e-40f, -1e-40f}),
              (std::vector<std::uint16_t>{0x7c00, 0xfc00, 0x7c00, 0x7c00, 0xfc00, 0x0000, 0x8000}));
    const std::uint16_t not_a_number = converted({std::numeric_limits<float>::quiet_NaN()})[0];
    EXPECT_GT(not_a_number & 0x7fff, 0x7c00);
  });
}

// Any count, and nothing beyond it. Control: the last piece stored as a whole vector is seen.
TEST_F(HalfFloats, WriteAsManyAsWereAskedFor) {
  on_every_instruction_set([] {
    for (std::size_t count = 0; count <= 40; ++count) {
      const std::vector<float> floats(count, 1.5f);
      std::vector<std::uint16_t> halves(count + 20, 0x1234);
      halves_from_floats(floats.data(), halves.data(), count);
      for (std::size_t i = 0; i < halves.size(); ++i)
        EXPECT_EQ(halves[i], i < count ? 0x3e00 : 0x1234) << count << ", " << i;
    }
  });
}

}  // namespace
}  // namespace seascape
