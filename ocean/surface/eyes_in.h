// Where the eyes of a frame are.
#pragma once
#include "shaders/shared/frame_data.h"

namespace seascape {

enum class EyesIn {
  air = gpu::eyes_in_air,        // all of them, with all that their near planes reach
  either = gpu::eyes_in_either,  // so near the surface that each pixel has to be asked
  water = gpu::eyes_in_water     // all of them, and nothing of the air before them
};

}  // namespace seascape
