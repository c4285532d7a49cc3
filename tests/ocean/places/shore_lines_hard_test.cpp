// Hard cases of waves along curves: 3 numbers that are none, 36 splines of nothing; what does not go together; points
// nearly at one place.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "ocean/inputs/inputs.h"
#include "ocean/places/shore_lines.h"
#include "tests/support/expect_error.h"

namespace seascape {
namespace {

InputSpec along(SplineInput spline) {
  InputSpec spec;
  spec.to = InputTarget::gerstner;
  spec.where = "s.json:7: inputs[2]";
  spec.value = glm::vec4(1.0f);
  for (SplinePoint& point : spline.points) point.value = spec.value;
  spec.shape = std::move(spline);
  return spec;
}
ShoreLines lines(const InputSpec& spec) { return ShoreLines(std::vector<InputSpec>{spec}, 30.0); }
std::string refusal(const InputSpec& spec) {
  return test::error_of([&] { lines(spec); });
}
SplinePoint at(double x, double z, double width = 10.0) { return {{x, z}, width, glm::vec4(1.0f)}; }

// Of curves of no points, of one and of coincident ones there are no waves, and a message says what to do. Control
// seen: points_apart() that gives too few points all the same (the curve's assertion of two points or more, or NaN).
TEST(ShoreLinesHard, hard_36_a_spline_of_no_length_gives_nothing_and_says_so) {
  for (const SplineInput& nothing :
       {SplineInput{}, SplineInput{{at(1, 1)}}, SplineInput{{at(1, 1), at(1, 1), at(1, 1)}},
        SplineInput{{at(1, 1), at(2, 1), at(1, 1)}, true}}) {
    const InputSpec spec = along(nothing);
    EXPECT_TRUE(lines(spec).empty());
    EXPECT_EQ(lines(spec).at({1.0, 1.0}, 1.0).share, 0.0f);
    const std::vector<std::string> remarks = remarks_of(std::vector<InputSpec>{spec});
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_NE(remarks[0].find("s.json:7: inputs[2]: a "), std::string::npos) << remarks[0];
    EXPECT_NE(remarks[0].find("gives nothing; give "), std::string::npos) << remarks[0];
  }
  InputSpec weightless = along({{at(0, 0), at(50, 0)}});
  weightless.weight = 0.0;
  EXPECT_TRUE(lines(weightless).empty());
}

// NaN in places, widths, values and edges, and what no waves run along, is refused with the key's name. Control seen: a
// blend of max let pass.
TEST(ShoreLinesHard, hard_3_what_is_no_number_or_does_not_go_together_is_refused_by_name) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(along({{at(0, nan), at(9, 9)}})).find("points[0].at_m[1]: "), std::string::npos);
  EXPECT_NE(refusal(along({{at(0, 0), at(9, 9, nan)}})).find("points[1].width_m: "), std::string::npos);
  InputSpec spec = along({{at(0, 0), at(9, 9)}});
  std::get<SplineInput>(spec.shape).points[1].value.x = 1.5f;
  EXPECT_NE(refusal(spec).find("points[1].value: "), std::string::npos);
  spec = along({{at(0, 0), at(9, 9)}});
  spec.feather_m = nan;
  EXPECT_NE(refusal(spec).find("feather_m: "), std::string::npos);
  spec.feather_m = 1.0, spec.blend = InputBlend::max;
  EXPECT_NE(refusal(spec).find("blend: "), std::string::npos);
  spec.blend = InputBlend::add, spec.follow_waves = true;
  EXPECT_NE(refusal(spec).find("follow_waves: "), std::string::npos);
  EXPECT_NE(refusal(along({{at(0, 0), at(9, 9), at(0, 9)}, true, true})).find("filled: "), std::string::npos);
  spec = along({});
  spec.shape = AreaInput{};
  EXPECT_NE(refusal(spec).find("kind: "), std::string::npos);
}

// Points almost at one place, turns back on themselves, and places and sizes at the ends of their ranges: all finite,
// shares from 0 to 1.
TEST(ShoreLinesHard, AllIsFinite) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> off(-1e-9, 1e-9), place(-20.0, 20.0);
  for (int trial = 0; trial < 60; ++trial) {
    SplineInput spline;
    for (int i = 0; i < 8; ++i) {
      const double size = trial % 3 == 2 ? 9e5 : 1.0;
      spline.points.push_back(at(size * ((i % 3) * 5.0 + off(random)), size * off(random), trial % 3 == 1 ? 1e6 : 8.0));
    }
    spline.closed = trial % 2 == 1;
    InputSpec spec = along(spline);
    spec.feather_m = trial % 4 == 0 ? 3.0 : 0.0;
    const ShoreLines curves = lines(spec);
    for (int i = 0; i < 200; ++i) {
      const double size = trial % 3 == 2 ? 9e5 : 1.0;
      const ShorePlace there = curves.at({size * place(random), place(random)}, i % 2 == 0 ? 0.0 : 5.0);
      ASSERT_TRUE(there.share >= 0.0f && there.share <= 1.0f) << there.share;
      ASSERT_TRUE(std::isfinite(there.bent_m.x + there.bent_m.y + there.turning_per_m + double(there.stretch)));
      ASSERT_NEAR(glm::length(there.forward), 1.0, 1e-9);
      ASSERT_LE(double(there.stretch), 5.0);
    }
  }
}

}  // namespace
}  // namespace seascape
