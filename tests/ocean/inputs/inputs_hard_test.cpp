// Hard cases of inputs: 3 numbers that are none, 6 land, 35 half floats, 36 splines of nothing, 44 flows against each
// other and a whirlpool's middle.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "engine/gltf.h"
#include "engine/image_file.h"
#include "ocean/inputs/inputs.h"
#include "tests/support/expect_error.h"

namespace seascape {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
constexpr glm::vec4 zero{0.0f};

InputSpec of(InputTarget to, decltype(InputSpec::shape) shape, float value = 1.0f) {
  InputSpec spec;
  spec.to = to;
  spec.where = "s.json:7: inputs[2]";
  spec.value = {value, 0.0f, 0.0f, 0.0f};
  spec.shape = std::move(shape);
  return spec;
}
std::string refusal(const InputSpec& spec) {
  return test::error_of([&] { Inputs(spec.to, std::vector{spec}); });
}

// NaN, infinities and -1 are refused with file, place and key, a picture that holds one with its texel; a place or a
// time that is none gets what there is without inputs. Control: comparisons written the other way round (refuse where
// below least or above most) let NaN pass.
TEST(InputsHard, hard_3_numbers_that_are_none_are_refused_by_name) {
  for (const double bad : {nan, infinity, -infinity, -1.0}) {
    SCOPED_TRACE(bad);
    InputSpec spec = of(InputTarget::level, AreaInput{});
    spec.weight = bad;
    EXPECT_EQ(refusal(spec).rfind("s.json:7: inputs[2]: weight: ", 0), 0u);
    spec = of(InputTarget::level, AreaInput{});
    spec.feather_m = bad;
    EXPECT_NE(refusal(spec).find("feather_m: "), std::string::npos);
    EXPECT_NE(refusal(of(InputTarget::level, AreaInput{.size_m = {1.0, bad}})).find("size_m[1]: "), std::string::npos);
    EXPECT_NE(refusal(of(InputTarget::flow, VortexInput{.core_m = bad})).find("core_m: "), std::string::npos);
    EXPECT_NE(refusal(of(InputTarget::level, TrailInput{.keys = {}, .radius_m = bad})).find("radius_m: "),
              std::string::npos);
    EXPECT_NE(refusal(of(InputTarget::level, TrailInput{.keys = {}, .life_s = bad})).find("life_s: "),
              std::string::npos);
    EXPECT_NE(
        refusal(of(InputTarget::level, SplineInput{.points = {{{0.0, 0.0}, bad, zero}}})).find("points[0].width_m: "),
        std::string::npos);
    if (bad == -1.0) continue;
    EXPECT_NE(refusal(of(InputTarget::level, AreaInput{}, float(bad))).find("value: "), std::string::npos);
    EXPECT_NE(refusal(of(InputTarget::level, AreaInput{.at_m = {bad, 0.0}})).find("at_m[0]: "), std::string::npos);
    EXPECT_NE(refusal(of(InputTarget::level, TrailInput{.keys = {{bad, {0.0, 0.0}}}})).find("keys[0].time_s: "),
              std::string::npos);
    EXPECT_NE(
        refusal(of(InputTarget::level, SplineInput{.points = {{{0.0, bad}, 1.0, zero}}})).find("points[0].at_m[1]: "),
        std::string::npos);
  }
  auto image = std::make_shared<ImageF>();
  image->width = 3, image->height = 2;
  image->pixels.assign(24, 0.5f);
  image->pixels[4 * 4 + 2] = float(nan);
  TextureInput texture;
  texture.file = "bed.exr", texture.image = image;
  EXPECT_NE(refusal(of(InputTarget::level, texture)).find("'bed.exr' holds NaN or infinity at column 1, row 1"),
            std::string::npos);
  texture.image = nullptr;
  EXPECT_NE(refusal(of(InputTarget::level, texture)).find("was not read"), std::string::npos);

  // A place or time that is no number gets what there is without inputs.
  const Inputs inputs(InputTarget::level, std::vector{of(InputTarget::level, AreaInput{})});
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_EQ(inputs.value({bad, 0.0}, 0.0, 0.0, glm::vec4(4.0f)), glm::vec4(4.0f));
    EXPECT_EQ(inputs.value({0.0, 0.0}, 0.0, bad, glm::vec4(4.0f)), glm::vec4(4.0f));
    EXPECT_TRUE(std::isfinite(inputs.value({0.0, 0.0}, bad, 0.0, zero).x));
  }
}

TEST(InputsHard, WhatDoesNotGoTogetherIsRefused) {
  EXPECT_NE(refusal(of(InputTarget::level, VortexInput{})).find("a vortex is no input of level"), std::string::npos);
  EXPECT_NE(refusal(of(InputTarget::level, SplineInput{.points = {}, .filled = true}))
                .find("filled: the spline is not closed"),
            std::string::npos);
  InputSpec spec = of(InputTarget::flow, AreaInput{});
  spec.blend = InputBlend::max;
  EXPECT_NE(refusal(spec).find("neither velocities nor colours have a max"), std::string::npos);
  EXPECT_NE(refusal(of(InputTarget::level, TrailInput{.keys = {{0.0, {}}, {0.0, {}}}}))
                .find("keys[1].time_s: 0 does not come after 0"),
            std::string::npos);
  EXPECT_NE(refusal(of(InputTarget::level, TrailInput{.keys = {{0.0, {}}, {1.0, {9.0, 0.0}}}, .loop = true}))
                .find("loop: the last key"),
            std::string::npos);
}

// Land is any height above the sea; a bed may lie at it or below. The seabed of nothing is the base. Control seen:
// values between inputs held to 1,000 m.
TEST(InputsHard, hard_6_land_and_dry_beds_are_heights_like_others) {
  for (const float bed : {-12000.0f, -1e-6f, 0.0f, 3.0f, 8848.0f}) {
    InputSpec spec = of(InputTarget::sea_depth, AreaInput{}, bed);
    spec.blend = InputBlend::replace;
    EXPECT_NEAR(Inputs(InputTarget::sea_depth, std::vector{spec}).value({0.0, 0.0}, 0.0, 0.0, glm::vec4(-200.0f)).x,
                bed, 1e-3f);
  }
}

// 400 inputs at one place, sums and factors by turns, come to a value within the target's range, which half floats
// hold. Control: without the last clamp the sum of 400 levels is 4e6.
TEST(InputsHard, hard_35_sums_stay_within_half_floats) {
  for (std::size_t t = 0; t < input_targets.size(); ++t) {
    EXPECT_LE(input_targets[t].most, 65504.0);
    EXPECT_GE(input_targets[t].least, -65504.0);
    if (InputTarget(t) == InputTarget::gerstner)
      continue;  // takes curves, which do not add up (shore_lines_hard_test.cpp)
    std::vector<InputSpec> specs;
    for (int i = 0; i < 400; ++i) {
      specs.push_back(of(InputTarget(t), AreaInput{}, float(input_targets[t].most)));
      if (i % 2 == 1) specs.back().blend = InputBlend::scale, specs.back().value.x = 1000.0f;
    }
    const glm::vec4 v = Inputs(InputTarget(t), specs).value({0.0, 0.0}, 0.0, 0.0, glm::vec4(0.5f));
    for (int c = 0; c < input_targets[t].channels; ++c)
      EXPECT_TRUE(v[c] >= input_targets[t].least && v[c] <= input_targets[t].most) << input_targets[t].name;
  }
}

// Splines of no points, of one and of coincident ones give nothing and a message that says what to do; trails of one
// key and models that stand upright alike. Control: without the search for points at one place the curve's knots
// coincide, and the level is NaN.
TEST(InputsHard, hard_36_a_spline_of_no_length_gives_nothing_and_says_so) {
  const auto at = [](double x, double z) { return SplinePoint{{x, z}, 10.0, glm::vec4(3.0f, 0.0f, 0.0f, 0.0f)}; };
  const std::pair<SplineInput, const char*> nothing[] = {
      {{}, "s.json:7: inputs[2]: a spline of 0 points at 0 places gives nothing; give 2 points or more that lie apart"},
      {{{at(1, 1)}},
       "s.json:7: inputs[2]: a spline of 1 point at 1 place gives nothing; give 2 points or more that lie apart"},
      {{{at(1, 1), at(1, 1), at(1, 1)}},
       "s.json:7: inputs[2]: a spline of 3 points at 1 place gives nothing; give 2 points or more that lie apart"},
      {{{at(1, 1), at(2, 1), at(1, 1)}, true},
       "s.json:7: inputs[2]: a closed spline of 3 points at 2 places gives nothing; give 3 points or more that lie "
       "apart"},
  };
  for (const auto& [spline, message] : nothing) {
    const Inputs inputs(InputTarget::level, std::vector{of(InputTarget::level, spline)});
    EXPECT_TRUE(inputs.empty());
    ASSERT_EQ(inputs.remarks().size(), 1u);
    EXPECT_EQ(inputs.remarks()[0], message);
    EXPECT_EQ(inputs.value({1.0, 1.0}, 1.0, 0.0, glm::vec4(4.0f)), glm::vec4(4.0f));
  }
  const Inputs some(InputTarget::level,
                    std::vector{of(InputTarget::level,
                                   SplineInput{.points = {at(0, 0), at(0, 0), at(50, 0), at(50, 0), at(100, 0)}})});
  ASSERT_EQ(some.remarks().size(), 1u);
  EXPECT_NE(some.remarks()[0].find("2 of 5 points lie where the one before does"), std::string::npos);
  for (double x = -10.0; x < 110.0; x += 0.5) EXPECT_TRUE(std::isfinite(some.value({x, 1.0}, 0.0, 0.0, zero).x));
  EXPECT_NEAR(some.value({50.0, 0.0}, 0.0, 0.0, zero).x, 3.0f, 1e-6f);
  // A trail of one key, and a model that stands upright, give nothing either.
  EXPECT_EQ(
      Inputs(InputTarget::foam, std::vector{of(InputTarget::foam, TrailInput{.keys = {{0.0, {}}}})}).remarks().size(),
      1u);
  auto wall = std::make_shared<Model>();
  wall->parts.emplace_back();
  wall->parts[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  wall->parts[0].indices = {0, 1, 2};
  ShapeInput shape;
  shape.file = "wall.glb", shape.model = wall;
  EXPECT_EQ(Inputs(InputTarget::level, std::vector{of(InputTarget::level, shape)}).remarks().size(), 1u);
}

// Points almost at one place, and turns back on itself, stay finite, and values between those of the points. Control
// seen: a nearest place that may lie beyond its span's ends.
TEST(InputsHard, hard_36_points_nearly_at_one_place_stay_finite) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> off(-1e-9, 1e-9), place(-20.0, 20.0);
  for (int trial = 0; trial < 50; ++trial) {
    SplineInput spline;
    for (int i = 0; i < 8; ++i)
      spline.points.push_back({{(i % 3) * 5.0 + off(random), off(random)}, 4.0, glm::vec4(float(i))});
    spline.closed = trial % 2 == 1, spline.filled = trial % 4 == 3;
    const Inputs inputs(InputTarget::level, std::vector{of(InputTarget::level, spline)});
    for (int i = 0; i < 200; ++i) {
      const float v = inputs.value({place(random), place(random)}, i % 2 == 0 ? 0.0 : 5.0, 0.0, zero).x;
      EXPECT_TRUE(std::isfinite(v) && v >= 0.0f && v <= 7.0f) << v;
    }
  }
}

// Flows against each other add to rest; a whirlpool's middle rests and is finite. Control: 1 / r to the middle gives
// NaN there.
TEST(InputsHard, hard_44_opposed_flow_and_a_whirlpools_middle) {
  const auto canal = [](double from, double to) {
    return of(InputTarget::flow, SplineInput{.points = {{{from, 0.0}, 20.0, {2.0f, 0.0f, 0.0f, 0.0f}},
                                                        {{to, 0.0}, 20.0, {2.0f, 0.0f, 0.0f, 0.0f}}}});
  };
  const Inputs opposed(InputTarget::flow, std::vector{canal(-100.0, 100.0), canal(100.0, -100.0)});
  for (double x = -99.0; x < 100.0; x += 1.0)
    EXPECT_EQ(glm::vec2(opposed.value({x, 3.0}, 0.0, 0.0, zero)), glm::vec2(0.0f));
  InputSpec spec =
      of(InputTarget::flow,
         VortexInput{.at_m = {7.0, 9.0}, .core_m = 1e-3, .reach_m = 1000.0, .swirl_mps = 100.0, .inflow_mps = 100.0});
  spec.feather_m = 500.0;
  const Inputs whirlpool(InputTarget::flow, std::vector{spec});
  EXPECT_EQ(glm::vec2(whirlpool.value({7.0, 9.0}, 0.0, 0.0, zero)), glm::vec2(0.0f));
  for (double r = 1e-12; r < 2000.0; r *= 1.3)
    for (const double footprint : {0.0, 0.1, 100.0}) {
      const glm::vec4 v = whirlpool.value({7.0 + r, 9.0}, footprint, 0.0, zero);
      EXPECT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::hypot(v.x, v.y) <= 142.0f) << r;
    }
}

}  // namespace
}  // namespace seascape
