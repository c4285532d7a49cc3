// Kinds of water.
#include "ocean/surface/water_types.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seascape {
namespace {

// Where 1 % of the light is left, m, at 550 and 450 nm, of seven types (facts, from Jerlov 1976), within 5 %; and the
// optics that the picture is drawn with fade it there as well. Control seen: a row with the numbers of another.
TEST(WaterTypes, LightFadesAsJerlovMeasured) {
  struct Known {
    WaterType type;
    double green_m, blue_m;
  };
  for (const Known& known :
       {Known{WaterType::ocean_1, 73, 242}, Known{WaterType::ocean_2, 52, 68}, Known{WaterType::ocean_3, 38, 34},
        Known{WaterType::coast_1, 38, 18}, Known{WaterType::coast_3, 24, 12}, Known{WaterType::coast_5, 15, 8.2},
        Known{WaterType::coast_9, 7.2, 2.9}}) {
    const glm::dvec3 fades = jerlov_attenuation(known.type);
    EXPECT_NEAR(4.605 / fades.y, known.green_m, 0.05 * known.green_m) << int(known.type);
    EXPECT_NEAR(4.605 / fades.z, known.blue_m, 0.05 * known.blue_m) << int(known.type);
    const WaterOptics optics = water_optics(WaterSettings{.type = known.type});
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR((optics.absorption[i] + optics.backscatter[i]) / 0.86, fades[i], 1e-6) << int(known.type);
  }
}

// What fades less is clearer from one type to the next, in green; clear seas are blue, coasts green, and harbours turn
// brown: red comes back as much as green.
TEST(WaterTypes, SeasAreBlueAndCoastsGreen) {
  double before = 0.0;
  for (int type = 0; type <= int(WaterType::ocean_3); ++type) {
    const double fades = jerlov_attenuation(WaterType(type)).y;
    EXPECT_GT(fades, before);
    before = fades;
  }
  const auto back = [](WaterType type) { return radiance_from_below(water_optics(WaterSettings{.type = type})); };
  const glm::dvec3 ocean = back(WaterType::ocean_1), coast = back(WaterType::coast_3),
                   harbour = back(WaterType::coast_9);
  EXPECT_GT(ocean.z, 4.0 * ocean.y);
  EXPECT_GT(coast.y, 1.3 * coast.z);
  EXPECT_GT(coast.y, 1.3 * coast.x);
  EXPECT_GT(harbour.x, 0.8 * harbour.y);
  EXPECT_GT(harbour.x, 2.0 * harbour.z);
  EXPECT_GT(harbour.y, 5.0 * ocean.y);  // bright with what floats in it
}

// Of the light that enters, the colour comes back; and the clearest of the three is seen as far as is asked.
// Control seen: the least attenuation given to the darkest colour.
TEST(WaterTypes, AColourIsAsAsked) {
  for (const glm::dvec3& colour : {glm::dvec3(0.002, 0.02, 0.06), glm::dvec3(0.1, 0.05, 0.01), glm::dvec3(0.3)}) {
    const WaterSettings settings{
        .type = WaterType::colour, .red = colour.x, .green = colour.y, .blue = colour.z, .sight_m = 12.0};
    const WaterOptics optics = water_optics(settings);
    const glm::dvec3 attenuation = optics.absorption + optics.backscatter;
    double least = 1e9;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(0.33 * optics.backscatter[i] / attenuation[i], colour[i], 1e-9);
      EXPECT_GE(optics.absorption[i], 0.0);
      least = std::min(least, attenuation[i]);
    }
    EXPECT_NEAR(3.912 / least, 12.0, 1e-9);
    EXPECT_EQ(optics.backscatter.x, optics.backscatter.z);
  }
}

// What the chlorophyll says stays what it was.
TEST(WaterTypes, ChlorophyllIsTheDefault) {
  const WaterOptics named = water_optics(0.7), by_settings = water_optics(WaterSettings{.chlorophyll_mg_m3 = 0.7});
  EXPECT_EQ(named.absorption, by_settings.absorption);
  EXPECT_EQ(named.backscatter, by_settings.backscatter);
}

}  // namespace
}  // namespace seascape
