// The wake of a travelling pressure against Kelvin's angle, the narrowing of what stands highest, and Havelock's
// integral.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/ocean/places/waves_support.h"
#include "tests/support/wake_truth.h"

namespace seascape {
namespace {

struct Angles {
  double highest = 0.0, fold = 0.0, steepest = 0.0, truth_highest = 0.0;  // degrees
};

double degrees(double across, double behind) { return std::atan2(across, behind) * 180.0 / truth::pi; }

// The wake of a pressure of length 1 m, the viewer following: means over lines across it from 6 to 11.5 lengths behind.
Angles wake(double froude, double depth_m) {
  DynamicWavesSettings s = waves_test::quiet(256, 3, 1.0 / 16.0);
  s.depth_m = depth_m;
  DynamicWaves waves(s);
  const double speed = froude * std::sqrt(s.gravity_mps2), dt = 1.0 / s.rate_hz;
  const int steps = int(30.0 / speed / dt);
  glm::dvec2 place(0.0);
  for (int i = 0; i < steps; ++i) {
    place.x += speed * dt;
    const WaveSource source{.place_m = place, .velocity_mps = {speed, 0.0}, .length_m = 1.0, .head_m = 0.01};
    waves.advance(dt, lod_placement(s.windows, place - glm::dvec2(6.0, 0.0), {}), {&source, 1});
  }
  const waves_test::Surface surface(waves);
  // What all levels together carry of a wave.
  const auto share = [&](double k) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += wave_share(2.0 * truth::pi / (k * waves.level(i).texel_m()), i == 2, 256);
    return sum;
  };
  const auto greatest = [](const auto& amplitude, double step) {
    double best = 0.0, at = 0.0;
    for (double y = 0.0; y < 5.5; y += step)
      if (const double here = amplitude(y); here > best) best = here, at = y;
    return std::pair(at, best);
  };
  Angles sum;
  int lines = 0;
  for (double behind = 6.0; behind <= 11.51; behind += 0.5, ++lines) {
    const auto at = [&](double x, double y) { return surface.at({place.x - behind + x, place.y + y}); };
    const auto high = [&](double y) { return std::abs(at(0.0, y)); };
    const auto steep = [&](double y) {
      return std::hypot(std::abs(at(0.0625, y) - at(-0.0625, y)), std::abs(at(0.0, y + 0.0625) - at(0.0, y - 0.0625)));
    };
    const auto [where, best] = greatest(high, 0.02);
    double fold = where;
    while (fold < 6.0 && high(fold) > truth::airy_at_fold() * best) fold += 0.02;
    sum.highest += degrees(where, behind);
    sum.fold += degrees(fold, behind);
    sum.steepest += degrees(greatest(steep, 0.02).first, behind);
    if (depth_m > 1.0)
      sum.truth_highest += degrees(
          greatest([&](double y) { return truth::wake_amplitude(froude, behind, y, 0, share); }, 0.04).first, behind);
  }
  return {sum.highest / lines, sum.fold / lines, sum.steepest / lines, sum.truth_highest / lines};
}

// Where the waves are highest stands as Havelock's integral has it, at every speed. At Froude numbers up to 0.6 they
// end at Kelvin's angle. Above, the formula of Darmon et al. for a narrowing peak holds for where they are steepest,
// within the 1.5 degrees that issue 5 asks for; for where they are highest it is 2.4 degrees less than the integral at
// Fr 1 (at 6 to 11.5 lengths behind; far behind 2.3), and 1.2 at Fr 2. The control is below: a sea in which all waves
// run alike.
TEST(Wake, IsKelvinsAndNarrows) {
  for (const double froude : {0.5, 0.6, 1.0, 2.0}) {
    const Angles a = wake(froude, 1e6);
    EXPECT_NEAR(a.highest, a.truth_highest, 0.3) << froude;
    if (froude <= 0.6) {
      EXPECT_NEAR(a.fold, truth::kelvin_degrees(), 1.5) << froude;
    } else {
      EXPECT_NEAR(a.steepest, truth::highest_degrees(froude), 1.5) << froude;
    }
  }
}

// The control that the issue asks for: over a bottom of 9 cm, c = sqrt(g h), the same pressure at the same speeds
// leaves a wedge of its own, and passes none of the bars.
TEST(Wake, WithoutDispersionIsNot) {
  for (const double froude : {0.5, 1.0, 2.0}) {
    const Angles a = wake(froude, 0.09);
    if (froude <= 0.6) {
      EXPECT_GT(std::abs(a.fold - truth::kelvin_degrees()), 3.0) << froude;
    } else {
      EXPECT_GT(std::abs(a.steepest - truth::highest_degrees(froude)), 1.5) << froude;
    }
  }
}

}  // namespace
}  // namespace seascape
