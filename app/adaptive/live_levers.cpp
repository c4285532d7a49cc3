#include "app/adaptive/live_levers.h"

#include <algorithm>
#include <cmath>

namespace seascape {

namespace {

constexpr std::string_view picture_scale = "picture scale", mesh = "mesh coarseness", detail = "detail of models",
                           spray = "spray drawn", shadows = "shadow texels", anisotropy = "anisotropy",
                           foam = "foam's rate";

// Which part of DrawnQuality each lever moves.
struct Named {
  std::string_view name;
  double DrawnQuality::*value;
};
constexpr Named named[] = {{picture_scale, &DrawnQuality::scale},
                           {mesh, &DrawnQuality::mesh},
                           {detail, &DrawnQuality::detail},
                           {spray, &DrawnQuality::spray},
                           {shadows, &DrawnQuality::shadows},
                           {anisotropy, &DrawnQuality::anisotropy},
                           {foam, &DrawnQuality::foam}};

// Steps of a lever from 1 to `last`, each `factor` times the one before. What it varies takes time as the value to the
// power `work`. Errors rise evenly with the work saved, up to `error` at the last step: measured, they rise faster at
// first and then slower, and a lever whose first step is the dearest would be moved to its end or not at all.
Lever lever(std::string_view name, double factor, double last, double work, double error, double gpu_share,
            double cpu_share) {
  Lever made;
  made.name = name;
  made.gpu_share = gpu_share;
  made.cpu_share = cpu_share;
  const bool rises = factor > 1.0;
  const double least = std::pow(last, work);
  for (double value = 1.0; rises ? value < last * 1.001 : value > last * 0.999; value *= factor) {
    const double takes = std::pow(value, work);
    made.steps.push_back({value, takes, error * (1.0 - takes) / (1.0 - least)});
  }
  return made;
}

}  // namespace

std::vector<Lever> live_levers(const Lowered& scene) {
  // Steps of 5 % of the picture's area, down to a quarter of it; steps of the mesh as far as the eye sees one less than
  // a turn of the head by 0.2 degrees; models as far as a sail keeps its shape.
  std::vector<Lever> levers{lever(picture_scale, std::sqrt(0.95), 0.5, 2.0, 0.13, 0.5, 0.0),
                            lever(mesh, std::pow(2.0, 0.0625), std::sqrt(2.0), -0.7, 0.063, 0.3, 0.3)};
  if (scene.models) levers.push_back(lever(detail, std::pow(0.5, 0.25), 0.5, 0.5, 0.01, 0.2, 0.1));
  if (scene.spray) levers.push_back(lever(spray, 0.9, 0.3, 1.0, 0.015, 0.1, 0.0));
  if (scene.shadows) levers.push_back(lever(shadows, std::sqrt(0.8), 0.5, 2.0, 0.004, 0.2, 0.0));
  if (scene.anisotropic) levers.push_back(lever(anisotropy, std::pow(0.5, 0.25), 0.25, 0.5, 0.03, 0.1, 0.0));
  if (scene.foam) levers.push_back(lever(foam, 0.5, 0.5, 1.0, 0.01, 0.0, 0.15));
  return levers;
}

DrawnQuality drawn_quality(std::span<const Lever> levers, const LeverLevels& levels) {
  DrawnQuality quality;
  for (const Named& one : named)
    for (std::size_t i = 0; i < levers.size(); ++i)
      if (levers[i].name == one.name) quality.*one.value = levers[i].steps[levels[i]].value;
  return quality;
}

LeverLevels nearest_levels(std::span<const Lever> levers, const DrawnQuality& quality) {
  LeverLevels levels{};
  for (const Named& one : named)
    for (std::size_t i = 0; i < levers.size(); ++i) {
      if (levers[i].name != one.name) continue;
      const auto off = [&](const LeverStep& step) { return std::abs(std::log(step.value / quality.*one.value)); };
      const auto nearest = std::min_element(levers[i].steps.begin(), levers[i].steps.end(),
                                            [&](const LeverStep& a, const LeverStep& b) { return off(a) < off(b); });
      levels[i] = std::uint8_t(nearest - levers[i].steps.begin());
    }
  return levels;
}

}  // namespace seascape
