// The sea before one's eyes until the first scene is loaded: a low swell under that scene's sky, soon made. It has no
// name.
#pragma once
#include "app/quality.h"
#include "app/scene.h"

namespace seascape {

Scene calm_sea(const Scene& awaited, DeviceClass device);

}  // namespace seascape
