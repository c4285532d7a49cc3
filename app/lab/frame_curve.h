// The lab's curve of whole frames: what a picture's settings take in time, and how far it is from the best there is.
#pragma once
#include "app/lab/lab.h"
#include "app/scene.h"
#include "engine/device.h"
#include "engine/shader.h"

namespace seascape {

// The open sea of a wind, at a preset.
Scene lab_scene(double wind_mps, const LabOptions& options, std::string_view preset);

// Presets, as they are on this device, among random settings. The device and the shaders must outlive it.
LabCurve frame_curve(Device& device, ShaderLibrary& shaders);

}  // namespace seascape
