// What shaders are told of the lamp that the viewer carries.
#ifndef SEASCAPE_LAMP_DATA_H
#define SEASCAPE_LAMP_DATA_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

struct LampData {
  vec4 at;         // xyz: from the viewer, m, world axes; w: of its beam lamp_narrowness() (lamp_light.h)
  vec4 along;      // xyz: where it points, of length 1; w: unused
  vec4 intensity;  // rgb: in the middle of the beam, irradiance as the sun's times m^2; w: 1 it shines, 0 it does not
};

SEASCAPE_SHARED_END
#endif
