// OpenXR's poses and ours.
#pragma once
#include "engine/view.h"
#include "platform/xr_api.h"

namespace seascape {

Pose pose_from(const XrPosef& pose);
XrPosef xr_pose(const Pose& pose);
// Whether it is a place and a direction at all; pose_from() then takes the orientation to unit length.
bool pose_is_sound(const XrPosef& pose);

}  // namespace seascape
