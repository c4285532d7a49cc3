// The lab's curve of adaptive quality's levers: what each step saves, and what it costs the eye.
#pragma once
#include "app/lab/lab.h"
#include "engine/device.h"
#include "engine/shader.h"

namespace seascape {

// Levers on the scenes that have what they lower. The device and the shaders must outlive it.
LabCurve lever_curve(Device& device, ShaderLibrary& shaders);

}  // namespace seascape
