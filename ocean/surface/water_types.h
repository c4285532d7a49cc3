// Kinds of water that a scene may name, and what each absorbs and scatters back.
#pragma once
#include <glm/glm.hpp>

#include "ocean/surface/water_optics.h"
#include "ocean/surface/water_settings.h"

namespace seascape {

// How irradiance fades with depth in one of Jerlov's types under a high sun, 1/m at 620, 550, 450 nm (Jerlov 1976,
// table XXVII, between 600 and 625 nm linearly). Nothing for the two types that are not his.
glm::dvec3 jerlov_attenuation(WaterType type);

// Of the water that the settings describe. A type of Jerlov's says how light fades and not how it is scattered: see the
// source for what that is taken from.
WaterOptics water_optics(const WaterSettings& settings);

}  // namespace seascape
