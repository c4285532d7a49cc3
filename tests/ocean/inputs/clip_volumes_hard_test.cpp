// Hard cases of volumes: numbers that are none, bodies of a millimetre, thousands of them and within each other, and at
// the end of the world.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "ocean/inputs/clip_volumes.h"
#include "tests/support/expect_error.h"
#include "tests/support/wigley.h"

namespace seascape {
namespace {

using Form = VolumeInput::Form;
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

InputSpec of(VolumeInput body) {
  InputSpec spec;
  spec.to = InputTarget::clip;
  spec.blend = InputBlend::replace;
  spec.value.x = 1.0f;
  spec.where = "s.json:7: inputs[2]";
  spec.shape = body;
  return spec;
}
std::string refusal(const InputSpec& spec) {
  return test::error_of([&] { ClipVolumes(std::vector{spec}); });
}

// NaN, infinities, -1 and 0 as sizes, places and angles of volumes are refused with the key's name. Control seen:
// comparisons that let NaN pass.
TEST(ClipVolumesHard, hard_3_numbers_that_are_none_are_refused_by_name) {
  for (const double bad : {nan, infinity, -infinity, -1.0, 0.0}) {
    SCOPED_TRACE(bad);
    EXPECT_NE(refusal(of({.form = Form::sphere, .radius_m = bad})).find("radius_m: "), std::string::npos);
    EXPECT_NE(refusal(of({.form = Form::box, .size_m = {1.0, bad, 1.0}})).find("size_m[1]: "), std::string::npos);
    EXPECT_NE(refusal(of({.form = Form::cylinder, .radius_m = 1.0, .length_m = bad})).find("length_m: "),
              std::string::npos);
    EXPECT_NE(refusal(of({.form = Form::capsule, .radius_m = 1.0, .length_m = bad})).find("length_m: "),
              std::string::npos);
    if (bad == 0.0) continue;
    EXPECT_NE(refusal(of({.form = Form::box, .round_m = bad})).find("round_m: "), std::string::npos);
    if (bad == -1.0) continue;
    EXPECT_NE(refusal(of({.at_m = {0.0, bad, 0.0}})).find("at_m[1]: "), std::string::npos);
    EXPECT_NE(refusal(of({.pitch_deg = bad})).find("pitch_deg: "), std::string::npos);
  }
  EXPECT_NE(refusal(of({.form = Form::box, .size_m = {4.0, 1.0, 4.0}, .round_m = 0.6}))
                .find("round_m: 0.6 is out of range; give a number from 0 to 0.5"),
            std::string::npos);
  EXPECT_NE(refusal(of({.form = Form::capsule, .radius_m = 2.0, .length_m = 3.0}))
                .find("length_m: 3 is out of range; give a number from 4"),
            std::string::npos);
  InputSpec spec = of({});
  spec.feather_m = 1.0;
  EXPECT_NE(refusal(spec).find("feather_m: a sphere has no soft edge; remove it"), std::string::npos);
  spec = of({});
  spec.blend = InputBlend::add;
  EXPECT_NE(refusal(spec).find("blend: "), std::string::npos);
  spec = of({});
  spec.to = InputTarget::level;
  EXPECT_NE(refusal(spec).find("a sphere is no input of level; give it \"to\": \"clip\""), std::string::npos);
  const ClipVolumes volumes(std::vector{of({})});
  for (const bool flat : {false, true}) EXPECT_EQ(volumes.clipped(glm::dvec3(nan, 0.0, 0.0), flat), flat);
  EXPECT_TRUE(ClipVolumes(std::vector<InputSpec>{}).clipped(glm::dvec3(0.0), true)) << "none at all";
  EXPECT_FALSE(volumes.clipped({nan, 0.0}, {1.0, 1.0}, 1.0, true));
}

// The tree finds what going through all does, among 4,096 of all forms and sizes, and of 500 within each other the last
// decides. Control seen: nodes that pass over one more (59 of 5,000 wrong).
TEST(ClipVolumesHard, ThousandsAreFoundAsIfAllWereAsked) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> at(-400.0, 400.0), turn(-180.0, 180.0), unit(0.0, 1.0), up(-2.0, 2.0);
  std::vector<InputSpec> specs;
  for (int i = 0; i < 4096; ++i) {
    const double size = std::pow(10.0, -3.0 + 4.0 * unit(random));
    specs.push_back(of({.form = Form(i % 4),
                        .at_m = i < 500 ? glm::dvec3(0.0) : glm::dvec3(at(random), up(random), at(random)),
                        .size_m = {size, 2.0 * size, 3.0 * size},
                        .round_m = 0.2 * size,
                        .radius_m = size,
                        .length_m = 2.5 * size,
                        .turn_deg = turn(random),
                        .pitch_deg = turn(random),
                        .roll_deg = turn(random)}));
    specs.back().value.x = float(i % 3 == 0 ? 0.0 : 1.0);
  }
  const ClipVolumes volumes(specs);
  ASSERT_EQ(volumes.size(), specs.size());
  int held = 0, wrong = 0;
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec3 p = i % 4 == 0 ? glm::dvec3(at(random), up(random), at(random)) * 0.02
                                    : glm::dvec3(at(random), up(random), at(random));
    bool want = false;
    for (std::size_t n = 0; n < volumes.size(); ++n)
      if (volumes.distance_m(n, p) < 0.0) want = specs[n].value.x > 0.5f, ++held;
    wrong += volumes.clipped(p, false) != want;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(held, 2500);
}

// 10,000 km off an edge is where it is at home, to a tenth of a millimetre. Control seen: a middle kept as one float.
TEST(ClipVolumesHard, FarAwayEdgesAreAsSharp) {
  const glm::dvec3 middle(-9999999.75, 3.5, 9999998.125);
  const ClipVolumes volumes(std::vector{of({.form = Form::sphere, .at_m = middle, .radius_m = 2.5})});
  for (int i = 0; i < 64; ++i) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(std::cos(1.7 * i), std::sin(0.9 * i), std::sin(1.7 * i)));
    EXPECT_TRUE(volumes.clipped(middle + 2.4999 * way, false));
    EXPECT_FALSE(volumes.clipped(middle + 2.5001 * way, false));
  }
  EXPECT_FALSE(volumes.clipped(glm::dvec3(1e300, 0.0, -1e300), false));
}

// A body of a millimetre is there, and one of a thousand kilometres holds everything.
TEST(ClipVolumesHard, FromAMillimetreToAThousandKilometres) {
  const ClipVolumes volumes(std::vector{of({.form = Form::box, .at_m = {0.5, 0.0, 0.5}, .size_m = glm::dvec3(1e-3)}),
                                        of({.form = Form::sphere, .at_m = {5e6, 0.0, 0.0}, .radius_m = 1e6})});
  EXPECT_TRUE(volumes.clipped(glm::dvec3(0.5, 0.0, 0.5), false));
  EXPECT_FALSE(volumes.clipped(glm::dvec3(0.501, 0.0, 0.5), false));
  EXPECT_TRUE(volumes.clipped(glm::dvec3(4.1e6, 0.0, 0.0), false));
  EXPECT_TRUE(volumes.clipped({5e6, 0.0}, {5.001e6, 1000.0}, 50.0, false));
}

// Different models have a limit; one model may be placed as often as inputs may.
TEST(ClipVolumesHard, HullsShareTheirModelsMaps) {
  ShapeInput shape;
  shape.file = "boat.glb", shape.from = ShapeInput::From::hull, shape.model = test::wigley_model({});
  std::vector<InputSpec> specs(1000, of({}));
  for (int i = 0; i < 1000; ++i) {
    shape.at_m = {20.0 * (i % 40), 20.0 * (i / 40)};
    specs[std::size_t(i)].shape = shape;
  }
  const ClipVolumes volumes(specs);
  EXPECT_EQ(volumes.hulls().size(), 1u);
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(volumes.clipped(glm::dvec3(20.0 * (i % 40), 0.0, 20.0 * (i / 40)), false));
  specs.resize(most_input_hulls + 1);
  for (InputSpec& spec : specs) {
    shape.model = test::wigley_model({});
    spec.shape = shape;
  }
  EXPECT_NE(test::error_of([&] { ClipVolumes many(specs); }).find("more than 64 different models as hulls"),
            std::string::npos);
}

}  // namespace
}  // namespace seascape
