// The lamp that the viewer carries, at the head or in a hand. Pure.
#pragma once
#include <optional>

#include "app/lamp_settings.h"
#include "engine/view.h"
#include "shaders/shared/lamp_data.h"

namespace seascape {

// Where a lamp on the head is, above the eyes; and one in a hand that nobody tracks, at arm's length before the right
// shoulder. Their beams meet the line of sight some metres off.
Pose lamp_at_head(const Pose& head);
Pose lamp_at_arm(const Pose& head);

// Light of a black body of a temperature at the picture's three wavelengths, of luminance 1 (Planck 1901).
glm::dvec3 black_body(double kelvin);

// What shaders are told; nothing of it shines while it is off. `hand`: the fist that may hold it, its beam along -z;
// nothing: none is tracked. Both in the world.
gpu::LampData lamp_data(const LampSettings& settings, const Pose& head, const std::optional<Pose>& hand);

}  // namespace seascape
