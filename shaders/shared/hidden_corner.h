// A corner of a part of a picture that no eye can see.
#ifndef SEASCAPE_HIDDEN_CORNER_H
#define SEASCAPE_HIDDEN_CORNER_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

struct HiddenCorner {
  vec4 at;  // xy: in the picture, normalised device; z: of which eye; w: unused
};

SEASCAPE_SHARED_END
#endif
