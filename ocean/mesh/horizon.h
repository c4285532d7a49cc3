// How far the surface must be drawn for a viewer so that nothing is missing below the horizon.
#pragma once

namespace seascape {

// Distance in metres from a viewer whose eye is `eye_height_m` above the still sea (0 where it is below) past which no
// water that rises at most `wave_height_m` can be seen, with 30 % to spare. On the curved Earth: the tangent's length
// sqrt(2 R h + h^2) of the eye (facts: "Horizon") plus that of the crests. Without curvature the sea has no end: as far
// as leaves less than 0.01 degrees between the edge and the true horizon, if that is more.
double horizon_distance(double eye_height_m, double wave_height_m, bool earth_curvature);

}  // namespace seascape
