// The lab's curves that draw: their errors follow theory, without a clock.
#include "app/lab/drawn_curves.h"

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "app/lab/frame_curve.h"
#include "app/settings.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape {
namespace {

class DrawnCurves : public test::GpuTest {};
const test::DrawsMuch draws_much("DrawnCurves");

std::vector<LabPoint> errors_of(const std::string& name, double wind_mps) {
  LabOptions options;
  options.quick = true;
  options.timed = false;
  for (const LabCurve& curve : drawn_curves(test::device(), test::shaders()))
    if (curve.name == name) return measure(name, wind_mps, curve.tasks(wind_mps, options), options, 0.0, [](double) {});
  return {};
}

const LabLaw& law_of(const std::string& name) {
  static const std::vector<LabCurve> curves = drawn_curves(test::device(), test::shaders());
  for (const LabCurve& curve : curves)
    if (curve.name == name) return curve.laws.at(0);
  throw std::out_of_range(name);
}

// Both laws and joins, at one sea. Controls seen: meshes of one pixel_error whatever is asked for (power 0); joins that
// are not told to the tree (equal triangles).
TEST_F(DrawnCurves, TheMeshMissesWhatIsAskedFor) {
  const std::vector<LabPoint> points = errors_of("mesh", 10.0);
  EXPECT_NEAR(fitted_power(law_of("mesh"), points, "U10"), 1.0, law_of("mesh").tolerance);
  std::map<std::string, double> triangles;
  for (const LabPoint& p : points) {
    if (p.error.unit.ends_with("worst") && p.knob.starts_with("lod.pixel_error")) {
      EXPECT_LE(p.error.value, p.value) << p.knob;
    }
    if (p.error.unit == "triangles") triangles[p.knob] += p.error.value;
  }
  ASSERT_EQ(triangles.size(), 4u);
  EXPECT_GT(triangles["lod.pixel_error, masked"], 1.02 * triangles["lod.pixel_error, morphed"])
      << "masked joins split farther off";
}

// The processor and compute shaders make one sea; half floats cost eleven bits; reading between texels is of second
// order. Controls seen: compute shaders a millisecond late (the last expectation), texels read half a texel off (power
// -1).
TEST_F(DrawnCurves, TilesAreReadBetweenTexelsToSecondOrder) {
  const std::vector<LabPoint> points = errors_of("compute", 10.0);
  EXPECT_NEAR(fitted_power(law_of("compute"), points, "U10"), -2.0, law_of("compute").tolerance);
  std::map<std::string, std::map<double, double>> error;
  for (const LabPoint& p : points) error[p.knob][p.value] = p.error.value;
  ASSERT_EQ(error.size(), 4u);
  for (const auto& [resolution, value] : error["waves.resolution, processor"]) {
    EXPECT_NEAR(error["waves.resolution, compute shaders"][resolution], value, 1e-5) << resolution;
    EXPECT_NEAR(error["waves.resolution, processor, 16 bit"][resolution], value, 4e-4) << resolution;
    EXPECT_NEAR(error["waves.resolution, compute shaders, 16 bit"][resolution], value, 4e-4) << resolution;
  }
}

// Whole frames: each preset has its three errors and a time; a better preset errs less, by pixels and by what an eye
// sees, and all settings can be given to --set. Controls seen: the best drawn a second late; presets that differ in
// samples a pixel alone.
TEST_F(DrawnCurves, BetterPresetsDrawWhatIsNearerToTheBest) {
  LabOptions options;
  options.quick = true;
  options.timed = false;
  const LabCurve curve = frame_curve(test::device(), test::shaders());
  double last = 0.0;
  const std::vector<LabPoint> points = curve.points(10.0, options, [&](double done) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1.0 + 1e-9);
    last = done;
  });
  EXPECT_GT(last, 0.99);
  std::map<std::string, std::map<std::string, double>> errors;  // by preset and unit
  int random = 0;
  for (const LabPoint& p : points) {
    EXPECT_TRUE(std::isfinite(p.error.value) && p.error.value > 0.0) << p.settings;
    EXPECT_GT(p.time_us.median, 0.0) << p.settings;
    if (p.preset.empty())
      ++random;
    else
      errors[p.preset][p.error.unit] = p.error.value;
    Settings settings;
    std::istringstream all(p.settings);
    for (std::string one; all >> one;)
      EXPECT_NO_THROW(set_from_text(settings, one.substr(0, one.find('=')), one.substr(one.find('=') + 1), "test"))
          << one;
  }
  EXPECT_EQ(random, 9);
  ASSERT_EQ(errors.size(), 4u);
  for (const auto& [unit, of_ultra] : errors["ultra"]) {
    EXPECT_LT(of_ultra, 0.95 * errors["high"][unit]) << unit;
    EXPECT_LT(errors["high"][unit], 0.95 * errors["medium"][unit]) << unit;
    EXPECT_LT(errors["medium"][unit], 1.02 * errors["low"][unit]) << unit;
  }
  EXPECT_EQ(errors["ultra"].size(), 3u);
}

}  // namespace
}  // namespace seascape
