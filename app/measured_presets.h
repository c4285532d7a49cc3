// Measures what the quality presets cost in a scene: their frames drawn in turn, beside a picture without their faults.
#pragma once
#include <array>
#include <functional>

#include "app/camera_path.h"
#include "app/experience.h"
#include "app/preset_costs.h"

namespace seascape {

// `scenes`: one scene at each preset, from low to ultra. `frames` of each are drawn along the path, 30 a second, or
// from the scene's start where there is none. The error is the mean FLIP (app/lab/flip.h), of the start's view and of
// one turned away, against ultra with 2 x 2 pixels for one, four samples each. `step`: called with how many steps of
// how many are done.
PresetCosts measure_presets(Device& device, ShaderLibrary& shaders, const std::array<Scene, 4>& scenes,
                            const ExperienceOptions& options, const CameraPath* path, int frames,
                            const std::function<void(std::size_t, std::size_t)>& step);

}  // namespace seascape
