// How much of an input there is near its edge: a soft step that lies inside of the edge, and is never narrower than
// what it is seen with.
#pragma once
#include <algorithm>

namespace seascape {

// The share of a shape at `inside` metres within its edge (below 0: outside). The step is feather_m wide and ends at
// the edge; with a footprint wider than that it becomes so wide about the same middle, so that it reaches (footprint -
// feather) / 2 beyond the edge. Continuous, and with continuous slopes where either width is above 0.
inline double soft_share(double inside, double feather_m, double footprint_m) {
  const double width = std::max(feather_m, footprint_m), off = inside - 0.5 * feather_m;
  if (!(width > 0.0)) return inside >= 0.0 ? 1.0 : 0.0;
  const double u = std::clamp(0.5 + off / width, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}
inline double soft_reach(double feather_m, double footprint_m) {
  return std::max(0.0, 0.5 * (footprint_m - feather_m));
}
// So far within the edge the share is 1.
inline double soft_depth(double feather_m, double footprint_m) {
  return 0.5 * (feather_m + std::max(feather_m, footprint_m));
}

// What a wide footprint's step adds to a shape no wider than itself, as a factor that takes it away again: the integral
// of soft_share() with the feather alone over that with the footprint, across a band of this half width, or over a disc
// of this radius.
inline double band_factor(double half_m, double feather_m, double footprint_m) {
  if (!(footprint_m > feather_m)) return 1.0;
  const auto integral = [&](double width) {  // over one axis, halved
    const double r = half_m - 0.5 * feather_m, h = width > 0.0 ? 0.5 + r / width : 2.0;
    return h >= 1.0 ? r : width * h * h * h * (1.0 - 0.5 * h);
  };
  return integral(feather_m) / integral(footprint_m);
}
inline double disc_factor(double radius_m, double feather_m, double footprint_m) {
  if (!(footprint_m > feather_m)) return 1.0;
  const auto integral = [&](double width) {  // over the plane, divided by pi
    const double r = radius_m - 0.5 * feather_m, h = width > 0.0 ? 0.5 + r / width : 2.0;
    return h >= 1.0 ? r * r + 0.05 * width * width : width * width * h * h * h * h * (0.5 - 0.2 * h);
  };
  return integral(feather_m) / integral(footprint_m);
}

}  // namespace seascape
