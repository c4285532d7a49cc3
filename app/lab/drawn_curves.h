// Curves that need a device: the mesh, where waves are computed, levers of adaptive quality, and whole frames.
#pragma once
#include "app/lab/lab.h"
#include "engine/device.h"
#include "engine/shader.h"

namespace seascape {

// mesh, compute, levers, frame. The device and the shaders must outlive them.
std::vector<LabCurve> drawn_curves(Device& device, ShaderLibrary& shaders);

}  // namespace seascape
