#include "app/lamp.h"

#include <cmath>

#include "shaders/shared/lamp_light.h"

namespace seascape {

namespace {

// The picture's wavelengths, and the sun's irradiance above the air there (lib/atmosphere.glsl), which has 133.3 klx
// (Darula, Kittler and Gueymard 2005): what a lux is in the units of the sun's light.
constexpr glm::dvec3 wavelengths_um{0.680, 0.550, 0.440}, sun_above_air{1.474, 1.8504, 1.91198};
constexpr double sun_above_air_lx = 133300.0;

double luminance(const glm::dvec3& light) { return glm::dot(light, glm::dvec3(0.2126, 0.7152, 0.0722)); }

// From a place beside the eyes to one before them.
Pose aimed(const glm::dvec3& from_m) {
  constexpr double meets_m = 5.0;
  const glm::dvec3 way = glm::normalize(glm::dvec3(0.0, 0.0, -meets_m) - from_m), ahead(0.0, 0.0, -1.0);
  return {from_m, glm::normalize(glm::dquat(1.0 + glm::dot(ahead, way), glm::cross(ahead, way)))};
}

}  // namespace

Pose lamp_at_head(const Pose& head) { return composed(head, aimed({0.0, 0.12, -0.05})); }

Pose lamp_at_arm(const Pose& head) { return composed(head, aimed({0.26, -0.3, -0.35})); }

glm::dvec3 black_body(double kelvin) {
  constexpr double second_um_k = 14387.77;  // h c / k
  glm::dvec3 light;
  for (int i = 0; i < 3; ++i)
    light[i] = std::pow(wavelengths_um[i], -5.0) / std::expm1(second_um_k / (wavelengths_um[i] * kelvin));
  return light / luminance(light);
}

gpu::LampData lamp_data(const LampSettings& settings, const Pose& head, const std::optional<Pose>& hand) {
  gpu::LampData data{};
  if (!settings.on) return data;
  const Pose at = settings.held == LampHeld::head ? lamp_at_head(head) : hand ? *hand : lamp_at_arm(head);
  const double a_lux = luminance(sun_above_air) / sun_above_air_lx;
  data.at = glm::vec4(glm::vec3(at.position_m - head.position_m),
                      float(gpu::lamp_narrowness(std::cos(0.5 * glm::radians(settings.beam_deg)))));
  data.along = glm::vec4(glm::vec3(at.orientation * glm::dvec3(0.0, 0.0, -1.0)), 0.0f);
  data.intensity = glm::vec4(glm::vec3(settings.candela * a_lux * black_body(settings.kelvin)), 1.0f);
  return data;
}

}  // namespace seascape
