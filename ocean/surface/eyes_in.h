// Where the eyes of a frame are.
#pragma once
#include "shaders/shared/frame_data.h"

namespace seascape {

enum class EyesIn {
  air = gpu::eyes_in_air,        // all of them, with all that their near planes reach
  either = gpu::eyes_in_either,  // so near the surface that each pixel has to be asked
  water = gpu::eyes_in_water     // all of them, and nothing of the air before them
};

// Where water rests: within `reach_m` of `rest_m` along x and z, in the world.
struct NearWater {
  glm::dvec2 rest_m{0.0};
  double reach_m = 0.0;
};

}  // namespace seascape
