// Where the horizon lies: geometry of a sphere, and of a plane. Includes nothing of the code it judges.
#pragma once
#include <cmath>

namespace truth {

inline constexpr double mean_earth_radius_m = 6371e3;  // IUGG's mean radius R1, to 200 m

// Angle below the level of the line where a sight touches a sphere of still water, for an eye that stands this high
// above it: cos(dip) = R / (R + h). Written by the tangent, which loses nothing where h is small. A plane's (radius
// infinite) is 0.
inline double horizon_dip(double eye_height_m, double radius_m) {
  if (std::isinf(radius_m)) return 0.0;
  return std::atan(std::sqrt(2.0 * radius_m * eye_height_m + eye_height_m * eye_height_m) / radius_m);
}

}  // namespace truth
