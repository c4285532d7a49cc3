// The wake of the scene wake_tank as it is drawn, against Kelvin and Noblesse et al.: through the whole program's sea,
// its windows of waves, a preset's textures and mesh. The second test is the control of the first.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/towing_tank.h"
#include "tests/support/wake_truth.h"

namespace seascape {
namespace {

using test::DrawnWake;
using test::TankRun;

bool asked_for_long() {
  const char* asked = std::getenv("SEASCAPE_LONG");
  return asked && std::string(asked) == "1";
}

class TowingTank : public test::GpuTest {
 protected:
  void SetUp() override {
    if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  }
  static void say(const TankRun& run, const std::string& what) {
    const std::string name = run.preset + " Fr " + std::to_string(run.froude).substr(0, 4) + " course " +
                             std::to_string(int(run.course_deg));
    std::printf("%s: %s\n", name.c_str(), what.c_str());
  }
  static void is_kelvins(const TankRun& run) {
    const DrawnWake wake(run);
    const bool slow = run.froude < 0.3;
    const double envelope = slow ? wake.envelope_deg(12.0, 28.0) : wake.envelope_deg(16.0, 44.0),
                 wave = wake.wavelength_m(7.0, slow ? 30.0 : 40.0) * wake.transverse_number() / (2.0 * truth::pi);
    say(run, "envelope " + std::to_string(envelope) + ", wave " + std::to_string(wave));
    EXPECT_NEAR(envelope, truth::kelvin_degrees(), 1.5) << run.preset << " " << run.froude << " " << run.course_deg;
    EXPECT_NEAR(wave, 1.0, 0.03) << run.preset << " " << run.froude << " " << run.course_deg;
  }
};
const test::DrawsMuch draws_much("TowingTank");

// Issue 11's second bar at Froude 0.25 and 0.4: the envelope 19.47 +- 1.5 degrees and transverse waves 2 pi U^2 / g
// +- 3 %. A part of presets and courses; all with SEASCAPE_LONG.
// Measured: 19.1 degrees and +1.0 % at 0.25, 20.4 degrees and +0.4 % at 0.4 along an axis, 20.9 aslant. Controls: the
// next test.
TEST_F(TowingTank, IsKelvinsAsItIsDrawn) {
  if (!asked_for_long()) {
    is_kelvins({.froude = 0.4, .course_deg = 30.0, .way_m = 110.0, .frame_s = 1.0 / 30.0, .preset = "high"});
    return;
  }
  for (const char* preset : {"low", "medium", "high", "ultra"})
    for (const double course : {0.0, 30.0, 77.0})
      for (const double froude : {0.25, 0.4}) is_kelvins({.froude = froude, .course_deg = course, .preset = preset});
}

// The control: over 0.8 m of water, which the hull outruns, there is a wedge of its own and no transverse wave; and
// with gravity a tenth lower waves are as much longer. Neither passes a bar. With SEASCAPE_LONG.
TEST_F(TowingTank, OverShallowsAndWithOtherGravityIsNot) {
  if (!asked_for_long()) GTEST_SKIP() << "SEASCAPE_LONG=1 asks for it";
  TankRun run{.froude = 0.4, .way_m = 80.0};
  run.set.emplace_back("waves.depth_m", "0.8");
  const double envelope = DrawnWake(run).envelope_deg(16.0, 30.0);
  say(run, "over 0.8 m: envelope " + std::to_string(envelope));
  EXPECT_GT(std::abs(envelope - truth::kelvin_degrees()), 3.0);
  run.set.back() = {"waves.gravity_mps2", "8.83"};
  const DrawnWake lighter(run);
  const double wave = lighter.wavelength_m(7.0, 30.0) * lighter.transverse_number() / (2.0 * truth::pi);
  say(run, "gravity a tenth lower: wave " + std::to_string(wave));
  EXPECT_GT(wave, 1.06);
}

// At Froude 0.8 the highest waves stand within 15 % of 0.14 / Fr^2 rad (Noblesse et al. 2014) 20 to 48 m behind the
// hull's middle. Linear theory has the peak of all waves of this hull at 9 to 11 degrees there (Havelock's integral),
// below that bar; windows let its waves of 4 m end 36 m behind, and those of 7 m that go on stand 13 degrees out. With
// SEASCAPE_LONG.
TEST_F(TowingTank, NarrowsAtSpeedAsItIsDrawn) {
  if (!asked_for_long()) GTEST_SKIP() << "SEASCAPE_LONG=1 asks for it";
  for (const char* preset : {"high", "low"}) {
    const TankRun run{.froude = 0.8, .way_m = 150.0, .preset = preset};
    const DrawnWake wake(run);
    const double angle = glm::radians(wake.highest_deg(20.0, 48.0)), want = 0.14 / (run.froude * run.froude);
    say(run, "highest " + std::to_string(glm::degrees(angle)));
    EXPECT_NEAR(angle, want, 0.15 * want) << preset;
  }
}

// The same heights whatever the course, the frame rate and the camera, 6 to 34 m behind: across the end of the hull's
// own finest window at 14 to 18 m. All three at once; one by one with SEASCAPE_LONG.
TEST_F(TowingTank, IsTheSameWhateverCourseFramesAndCamera) {
  const TankRun plain{.froude = 0.4, .way_m = 80.0};
  const DrawnWake wake(plain);
  std::vector<TankRun> others(3, plain);
  others[0].course_deg = 77.0;
  others[1].frame_s = 1.0 / 20.0;
  others[2].eye_m = {14.0, 30.0, 20.0}, others[2].looks_down_deg = 64.0, others[2].to_right_deg = -80.0;
  if (!asked_for_long()) {
    others[2].course_deg = others[0].course_deg, others[2].frame_s = others[1].frame_s;
    others.erase(others.begin(), others.begin() + 2);
  }
  for (const TankRun& other : others) {
    const double missed = std::sqrt(wake.difference(DrawnWake(other), {6.0, 34.0}, {-8.0, 8.0}));
    say(other, "other by " + std::to_string(missed));
    EXPECT_LT(missed, 0.1) << other.course_deg << " " << other.frame_s << " " << other.eye_m.x;
  }
}

}  // namespace
}  // namespace seascape
