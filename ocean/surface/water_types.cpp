#include "ocean/surface/water_types.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace seascape {

namespace {

// At 620, 550 and 450 nm, 1/m. The ocean's types scatter as waters do whose chlorophyll gives their attenuation (Loisel
// and Morel 1998). Of coasts' the attenuation at 514 nm says it (see below).
struct JerlovType {
  glm::dvec3 attenuation, scattering;
  double coast = 0.0;
};
constexpr int jerlov_types = int(WaterType::coast_9) + 1;
const std::array<JerlovType, jerlov_types> jerlov{{{{0.291, 0.063, 0.019}, {0.034, 0.038, 0.047}},
                                                   {{0.296, 0.067, 0.026}, {0.058, 0.063, 0.074}},
                                                   {{0.301, 0.072, 0.036}, {0.097, 0.104, 0.118}},
                                                   {{0.320, 0.089, 0.068}, {0.210, 0.218, 0.232}},
                                                   {{0.359, 0.120, 0.135}, {0.395, 0.399, 0.405}},
                                                   {{0.356, 0.120, 0.250}, {}, 0.134},
                                                   {{0.386, 0.190, 0.390}, {}, 0.209},
                                                   {{0.464, 0.300, 0.560}, {}, 0.332},
                                                   {{0.528, 0.460, 0.890}, {}, 0.53},
                                                   {{0.640, 0.630, 1.600}, {}, 0.872}}};

constexpr double sun_cosine = 0.86;             // in the water, of the high sun that Jerlov's attenuations are of
constexpr double back_share = 0.0183;           // of what particles scatter (Petzold 1972; Mobley 1994, table 3.11)
const glm::dvec3 pure(0.0012, 0.0019, 0.0045);  // scattered by the water itself, half of it back (Morel 1974)

// Petzold's coastal and harbour waters (1972; 514 nm): scattering 0.219 and 1.824 1/m where light fades by 0.229 and
// 0.583 1/m. A power of the attenuation goes through both; the spectrum of what large particles scatter is flat.
double coast_scattering(double attenuation) { return 0.219 * std::pow(attenuation / 0.229, 2.27); }

WaterOptics of_jerlov(const JerlovType& type) {
  const glm::dvec3 scattering = type.coast > 0.0 ? glm::dvec3(coast_scattering(type.coast)) : type.scattering;
  WaterOptics optics;
  optics.scattering = scattering;
  optics.backscatter = 0.5 * pure + back_share * glm::max(scattering - pure, 0.0);
  // Light fades by (a + b_b) / cosine of the sun's path (Gordon 1989, eq. 4).
  optics.absorption = glm::max(type.attenuation * sun_cosine - optics.backscatter, 1e-3);
  return optics;
}

// Of what enters, `colour` is what comes back: R = 0.33 b_b / (a + b_b) (Gordon et al. 1975). All scatter alike; the
// colour that comes back most is seen farthest: 3.912 / (a + b_b) is where a black thing's contrast is down to 2 %.
WaterOptics of_colour(const WaterSettings& settings) {
  const glm::dvec3 back = glm::max(glm::dvec3(settings.red, settings.green, settings.blue), 1e-4) / 0.33;
  const double most = std::max({back.x, back.y, back.z});
  const double least_attenuation = 3.912 / settings.sight_m;
  WaterOptics optics;
  optics.backscatter = glm::dvec3(most * least_attenuation);
  optics.absorption = optics.backscatter / back - optics.backscatter;
  optics.scattering = glm::max(optics.backscatter - 0.5 * pure, 0.0) / back_share + pure;
  return optics;
}

}  // namespace

glm::dvec3 jerlov_attenuation(WaterType type) {
  assert(int(type) < jerlov_types);
  return jerlov[std::size_t(type)].attenuation;
}

WaterOptics water_optics(const WaterSettings& settings) {
  switch (settings.type) {
    case WaterType::chlorophyll:
      return water_optics(settings.chlorophyll_mg_m3);
    case WaterType::colour:
      return of_colour(settings);
    default:
      return of_jerlov(jerlov[std::size_t(settings.type)]);
  }
}

}  // namespace seascape
