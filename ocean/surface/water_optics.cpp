#include "ocean/surface/water_optics.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/fresnel.h"

namespace seascape {

WaterOptics water_optics(double chlorophyll) {
  const double c = std::max(chlorophyll, 1e-3);
  const glm::dvec3 wavelength(620.0, 550.0, 450.0);
  const glm::dvec3 pure(0.2755, 0.0565, 0.00922), shape(0.276, 0.357, 0.944), scatter(0.0012, 0.0019, 0.0045);
  WaterOptics optics;
  for (int i = 0; i < 3; ++i) {
    const double dissolved = 0.2 * std::exp(-0.014 * (wavelength[i] - 440.0));
    optics.absorption[i] = pure[i] + 0.06 * shape[i] * std::pow(c, 0.65) * (1.0 + dissolved);
    const double particles = 0.30 * std::pow(c, 0.62);
    const double share = 0.002 + 0.02 * (0.5 - 0.25 * std::log10(c)) * 550.0 / wavelength[i];
    optics.scattering[i] = scatter[i] + particles * 550.0 / wavelength[i];
    optics.backscatter[i] = 0.5 * scatter[i] + share * particles;
  }
  return optics;
}

glm::dvec3 radiance_from_below(const WaterOptics& optics) {
  constexpr double pi = 3.14159265358979323846;
  return 0.54 * 0.33 / pi * optics.backscatter / (optics.absorption + optics.backscatter);
}

double sun_share_entering(double sine) { return sine > 0.0 ? sine * (1.0 - double(gpu::fresnel(float(sine)))) : 0.0; }

}  // namespace seascape
