// The lamp that is carried, as shaders are told of it. Controls are named beside each test; each was
// seen to fail.
#include "app/lamp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shaders/shared/lamp_light.h"

namespace seascape {
namespace {

double luminance(const glm::dvec3& light) { return glm::dot(light, glm::dvec3(0.2126, 0.7152, 0.0722)); }

// A lamp of 133,300 cd is, a metre off, as bright as the sun above the air (133.3 klx), whatever its colour; a warm one
// is redder than a cold one, as Planck's law has it. Half of the beam's angle off it is half as bright. Controls: the
// luminance left out; the wavelengths in another order; the whole angle for half of it.
TEST(Lamp, IsAsBrightAsItsCandela) {
  for (const double kelvin : {2700.0, 5000.0, 10000.0}) {
    const gpu::LampData data = lamp_data({.on = true, .candela = 133300.0, .kelvin = kelvin}, Pose{}, std::nullopt);
    EXPECT_NEAR(luminance(glm::dvec3(data.intensity)), luminance({1.474, 1.8504, 1.91198}), 1e-5);
    const gpu::LampData wide = lamp_data({.on = true, .beam_deg = 40.0}, Pose{}, std::nullopt);
    EXPECT_NEAR(gpu::lamp_beam(std::cos(glm::radians(20.0)), double(wide.at.w)), 0.5, 1e-5);
    // Ratio of 680 to 440 nm: (440 / 680)^5 (exp(c2 / 0.44 T) - 1) / (exp(c2 / 0.68 T) - 1).
    const double planck = std::pow(0.440 / 0.680, 5.0) * std::expm1(14387.77 / (0.440 * kelvin)) /
                          std::expm1(14387.77 / (0.680 * kelvin));
    EXPECT_NEAR(double(data.intensity.x) / double(data.intensity.z), planck, 1e-4 * planck);
  }
}

// On the head it is above the eyes and turns with them; in a hand it shines along the fist's -z. Where no hand is
// tracked it is before the shoulder. It is told from the viewer, however far from the origin. Control: the hand's place
// in the world.
TEST(Lamp, IsWhereItIsHeld) {
  const Pose head{{1e6, 3.0, -2e6}, glm::angleAxis(1.0, glm::dvec3(0.0, 1.0, 0.0))};
  const Pose hand{{1e6 + 0.3, 2.6, -2e6 - 0.2}, glm::angleAxis(-0.5, glm::dvec3(1.0, 0.0, 0.0))};
  LampSettings settings{.on = true};
  const glm::vec3 ahead(head.orientation * glm::dvec3(0.0, 0.0, -1.0));
  for (const auto held : {LampHeld::head, LampHeld::hand}) {
    settings.held = held;
    const gpu::LampData none = lamp_data(settings, head, std::nullopt);
    EXPECT_NEAR(double(none.at.y), held == LampHeld::head ? 0.12 : -0.3, 1e-6);
    // Its beam meets the line of sight 5 m before the eyes.
    const glm::vec3 met = glm::vec3(none.at) + glm::vec3(none.along) * glm::length(5.0f * ahead - glm::vec3(none.at));
    EXPECT_LT(glm::length(met - 5.0f * ahead), 1e-4f);
    const gpu::LampData data = lamp_data(settings, head, hand);
    if (held == LampHeld::head) {
      EXPECT_EQ(data.at, none.at);
    } else {
      EXPECT_LT(glm::length(glm::vec3(data.at) - glm::vec3(0.3f, -0.4f, -0.2f)), 1e-6f);
      EXPECT_NEAR(double(data.along.y), -std::sin(0.5), 1e-6);
    }
    EXPECT_NEAR(double(glm::length(glm::vec3(data.along))), 1.0, 1e-6);
  }
  settings.on = false;
  EXPECT_EQ(lamp_data(settings, head, hand).intensity, glm::vec4(0.0f));
}

}  // namespace
}  // namespace seascape
