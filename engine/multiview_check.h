// Asks the driver to draw a clipped triangle in both views of a multiview pass, and looks at what it drew: Mesa 22.3's
// software driver leaves the right eye empty (shared/facts/headset.md).
#pragma once
#include "engine/shader.h"

namespace seascape {

// True when both views hold what they should. Waits for the device; some milliseconds.
bool multiview_works(Device& device, ShaderLibrary& shaders);
// The same, looked at once a device: later calls wait for nothing.
bool multiview_known_to_work(Device& device, ShaderLibrary& shaders);

}  // namespace seascape
