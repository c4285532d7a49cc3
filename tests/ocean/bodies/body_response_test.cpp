// Hulls in regular head waves: how much they heave and pitch over the wave's length, at rest and under way.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/support/body_waves.h"

namespace seascape {
namespace {

using namespace test;
using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

// Waves as a hull meets them that is towed against them: seen from the carriage the water comes towards it, and waves
// come as often as they meet.
struct TowedWater : FormulaWater {
  double speed_mps = 0.0;
  void ask(double t, double footprint, std::span<const glm::dvec2> places,
           std::span<WaterHere> answers) const override {
    std::vector<glm::dvec2> over_ground(places.begin(), places.end());
    for (glm::dvec2& at : over_ground) at.y -= speed_mps * t;  // the hull goes to -z, the waves to +z
    FormulaWater::ask(t, footprint, over_ground, answers);
    for (WaterHere& a : answers) a.velocity_mps.z += speed_mps, a.current_mps.y += speed_mps;
  }
};

// a + b cos w t + c sin w t, nearest to what is added: how large the oscillation at w is, and by how much it lags.
class Oscillation {
 public:
  explicit Oscillation(double w) : w_(w) {}
  void add(double t, double value) {
    const glm::dvec3 of(1.0, std::cos(w_ * t), std::sin(w_ * t));
    squares_ += glm::outerProduct(of, of), sums_ += value * of;
  }
  Complex result() const {
    const glm::dvec3 x = glm::inverse(squares_) * sums_;
    return {x[1], x[2]};
  }

 private:
  double w_;
  glm::dmat3 squares_{0.0};
  glm::dvec3 sums_{0.0};
};

struct Response {
  double heave = 0.0, pitch = 0.0;  // over the wave's amplitude, and over its slope
};
Response response(const BodySpec& spec, double length_m, double speed_mps = 0.0) {
  constexpr double amplitude = 0.002;
  const double k = 2.0 * pi / length_m, w = std::sqrt(g * k) + k * speed_mps;
  TowedWater water;
  water.waves = {{amplitude, length_m}}, water.speed_mps = speed_mps;
  Bodies bodies({}, {spec});
  Oscillation heave(w), pitch(w);
  const BodyMotion at_rest = bodies.result()[0].motion;
  for (int n = 0; n < 60 * 40; ++n) {
    const double t = (n + 1) / 60.0;
    bodies.step(t, 1.0 / 60.0, water);
    BodyMotion motion = bodies.result()[0].motion;
    if (speed_mps > 0.0) {  // the carriage holds it on its way
      motion.centre_m.z = at_rest.centre_m.z, motion.velocity.linear.z = 0.0;
      bodies.place(0, motion);
    }
    if (n < 60 * 20) continue;
    heave.add(t, motion.centre_m.y), pitch.add(t, 2.0 * motion.orientation.x);
  }
  return {std::abs(heave.result()) / amplitude, std::abs(pitch.result()) / (k * amplitude)};
}

// A box of 10 x 3 x 1.5 at draught 0.5 heaves by e^(-kT) sin u / u, u = pi L / l, and pitches by
// 3 (sin u - u cos u) / u^3 of the slope, each as an oscillator of its own period answers that (facts/boats.md, section
// 1): within 2 and 6 % from waves twice its length to forty times it, and without the oscillator where the wave is
// long. (Of the pitch the ends' pressure is no part of the formula.) Controls seen: pressure that does not fade (16 %
// too much heave at twice the length); half the pressure's moment.
TEST(BodyResponse, ABoxAnswersHeadWaves) {
  const double length = 10.0, beam = 3.0, draught = 0.5, mass = rho * length * beam * draught;
  BodySpec spec = even_body(box_hull({beam, 1.5, length}, 16), rho / 3.0, 0.75 - draught);
  const double stiff = rho * g * length * beam, slow = 0.2 * std::sqrt(stiff * mass);  // a tenth of what is critical
  const double arm = draught / 2.0 - 0.75 + length * length / (12.0 * draught), turn = mass * g * arm;
  const double inertia = spec.mass.inertia_kg_m2[0][0], turns_slow = 0.2 * std::sqrt(turn * inertia);
  spec.damping = Matrix6::diagonal({0.0, slow, 0.0, turns_slow, 0.0, turns_slow});
  for (const double ratio : {2.0, 3.0, 5.0, 10.0, 40.0}) {
    const double k = 2.0 * pi / (ratio * length), w = std::sqrt(g * k), u = pi / ratio;
    const double still_heave = std::exp(-k * draught) * std::sin(u) / u,
                 still_pitch = 3.0 * (std::sin(u) - u * std::cos(u)) / (u * u * u) * std::exp(-k * draught);
    // The damping is against the water, which goes up and down as its surface does.
    const Complex heave = (stiff * still_heave + Complex(0.0, w * slow)) / Complex(stiff - mass * w * w, w * slow);
    const Complex pitch = turn * still_pitch / Complex(turn - inertia * w * w, w * turns_slow);
    const Response got = response(spec, ratio * length);
    EXPECT_NEAR(got.heave / std::abs(heave), 1.0, 0.02) << ratio;
    EXPECT_NEAR(got.pitch / std::abs(pitch), 1.0, 0.06) << ratio;
    if (ratio >= 10.0) {
      EXPECT_NEAR(got.heave / still_heave, 1.0, 0.04) << ratio;
      EXPECT_NEAR(got.pitch / still_pitch, 1.0, 0.06) << ratio;
    }
  }
}

// Wigley's hull towed against the waves at Fr 0.3 heaves most where it meets them in its own period, 1.66 s with the
// stated added mass (facts/boats.md), within 5 %, and there at least twice as much as the longest waves. In waves of
// a third of its length it hardly moves. Control seen: no added mass (the peak at 1.3 s).
TEST(BodyResponse, WigleyPeaksAtItsPeriod) {
  BodySpec spec = even_body(wigley_hull(10.0, 1.0, 0.625, 0.4, 10, 4), rho);
  const double mass = rho * volume_of(wigley_hull(10.0, 1.0, 0.625, 1e-9, 10, 4)).volume_m3;
  spec.mass.mass_kg = mass;
  spec.mass_centre_m = {0.0, 0.40 - 0.625, 0.0};
  spec.mass.inertia_kg_m2 = glm::dmat3(mass * 6.25, 0, 0, 0, mass * 6.25, 0, 0, 0, mass * 0.1225);
  const double stiffness = rho * g * 6.66667, period = 1.66,
               added = stiffness * std::pow(period / (2.0 * pi), 2.0) - mass, slow = 0.16 * std::sqrt(stiffness * mass);
  spec.at_m.y = 0.0;
  spec.mass.added = Matrix6::diagonal({0.0, added, 0.0, 0.4 * mass * 6.25, 0.0, 0.0});
  spec.damping = Matrix6::diagonal({0.0, slow, 0.0, 2.0 * mass * 6.25, 0.0, mass * 0.1});
  const double speed = 0.3 * std::sqrt(g * 10.0);
  double most = 0.0, at_period = 0.0;
  for (double ratio = 0.8; ratio < 2.4; ratio *= 1.08) {
    const double k = 2.0 * pi / (ratio * 10.0), w = std::sqrt(g * k) + k * speed;
    const double heave = response(spec, ratio * 10.0, speed).heave;
    if (heave > most) most = heave, at_period = 2.0 * pi / w;
  }
  EXPECT_NEAR(at_period / period, 1.0, 0.05);
  EXPECT_GT(most, 2.0);
  EXPECT_NEAR(response(spec, 400.0, speed).heave, 1.0, 0.05);
  EXPECT_LT(response(spec, 3.3, speed).heave, 0.1);
}

}  // namespace
}  // namespace seascape
