#include "ocean/sea/hand_in_water.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace seascape {

namespace {

constexpr double pi = glm::pi<double>();

// How much of the sphere's height is under water, m.
double wet_height(double depth_m) {
  return std::clamp(depth_m + HandInWater::radius_m, 0.0, 2.0 * HandInWater::radius_m);
}

// A source that gives so much water a second (m^3/s): its profile exp(-pi^2 r^2 / length^2) has an area of length^2 /
// pi.
WaveSource source(const glm::dvec2& at_m, const glm::dvec2& velocity_mps, double flow_m3ps, double depth_m,
                  double length) {
  return {at_m, velocity_mps, length, 0.0, flow_m3ps * pi / (length * length), depth_m};
}

}  // namespace

HandInWater::HandInWater(double texel_m) : ripple_m_(std::max(2.0 * radius_m, 8.0 * texel_m)) {}

double HandInWater::volume_m3(double depth_m) {
  const double h = wet_height(depth_m);
  return pi * h * h * (3.0 * radius_m - h) / 3.0;
}

double HandInWater::section_m2(double depth_m) {
  const double h = wet_height(depth_m), r = radius_m;
  return r * r * std::acos(std::clamp(1.0 - h / r, -1.0, 1.0)) -
         (r - h) * std::sqrt(std::max(0.0, 2.0 * r * h - h * h));
}

void HandInWater::step(SeaStep& step) {
  if (!at_) {
    wet_m3_.reset();
    return;
  }
  const double since_s = std::clamp(step.time_s - at_->time_s, -0.1, 0.1);  // a frame's time at most
  const glm::dvec3 place = at_->place_m + since_s * at_->velocity_mps;
  const glm::dvec2 at(place.x, place.z), along(at_->velocity_mps.x, at_->velocity_mps.z);
  const double depth_m = step.felt().query(at, {.footprint_m = ripple_m_}).height_m - place.y;
  const double wet = volume_m3(depth_m), before = std::exchange(wet_m3_, wet).value_or(wet);
  // What goes in lifts the water by what it displaces, and coming out lets it fall.
  if (wet != before) step.press(source(at, along, (wet - before) / step.dt_s, depth_m - radius_m, ripple_m_));
  // What goes through water pushes it aside before it and draws it in behind: a source and a sink (Rankine 1871).
  const double speed = glm::length(along), flow = section_m2(depth_m) * speed;
  if (flow <= 0.0) return;
  const glm::dvec2 ahead = along * (radius_m / speed);
  step.press(source(at + ahead, along, flow, depth_m, ripple_m_));
  step.press(source(at - ahead, along, -flow, depth_m, ripple_m_));
}

std::uint64_t HandInWater::hash() const { return std::bit_cast<std::uint64_t>(wet_m3_.value_or(-1.0)); }

}  // namespace seascape
