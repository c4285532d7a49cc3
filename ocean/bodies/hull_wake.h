// How a hull pushes the water aside: its sections below the waterline, and the wave sources that their change along it
// and in time comes to.
#pragma once
#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/bodies/hull.h"
#include "ocean/bodies/hull_forces.h"
#include "ocean/places/wave_source.h"

namespace seascape {

struct HullMotion {
  BodyPose pose;
  Vector6 velocity;           // world axes, of the pose's centre: m/s, rad/s
  glm::dvec3 water_mps{0.0};  // of the water around the hull, without the hull's own waves
};

// What of one section across the hull is under water.
struct HullSection {
  glm::dvec2 place_m{0.0};  // x and z of the middle of its waterline, or of what is under water
  double surface_m = 0.0;   // the water's height there
  double area_m2 = 0.0, breadth_m = 0.0, draught_m = 0.0;
  double depth_m = 0.0, spread_m2 = 0.0;  // of the area: mean depth, and the variance of it
  glm::dvec3 velocity_mps{0.0};           // of the hull there against the water
};

// Sections lie in the middles of equal parts of the hull's length, across its axis z, and keep the mesh's outline
// there: a step cuts these by the waterline, in any attitude, and not the mesh. The water's height is read once a
// section, so that its slope across the hull is left out.
class HullWake {
 public:
  // `mesh` as the pose has it: about the centre, bow to -z, closed. From 4 to 64 sections.
  explicit HullWake(const HullMesh& mesh, int sections = 20);

  // The surface's height (m) at x and z.
  using Height = std::function<double(const glm::dvec2&)>;
  // Cuts all sections, from the stern to the bow: `cut` has as many. A hull that stands on end, its axis within 12
  // degrees of the vertical, has none under water.
  void cut(const HullMotion& motion, const Height& height, std::span<HullSection> cut) const;
  int sections() const { return int(outlines_.size()); }

  // Appends what pushes the water: the rate at which the hull displaces it (thin ship: Michell 1898, Havelock 1923).
  // Going ahead at U it is -U dA/dx of the wetted area A, which is 0 in sum; down, up and pitching dA/dt, which is the
  // change of what it displaces; sideways as much on one side as is drawn in on the other. None where the hull does not
  // move against the water. `least_length_m`: no source is shorter; 8 texels of the waves' finest window are short
  // enough.
  //
  // Each acts so deep that a wave of a length of four draughts feels of it what it would of the section's whole depth
  // without the source's own length.
  void add_sources(const HullMotion& motion, std::span<const HullSection> cut, double least_length_m,
                   std::vector<WaveSource>& sources) const;

 private:
  // A line of the outline, from..to, in the body's x and y: what is within lies on its left, seen from behind.
  struct Line {
    glm::dvec2 from, to;
  };
  static void cut_outline(std::span<const Line> outline, double depth_of_axis, const glm::dvec2& up,
                          HullSection& section, glm::dvec2& middle);
  std::vector<std::vector<Line>> outlines_;  // from the stern to the bow
  std::vector<double> at_z_;
  double part_m_ = 0.0;
};

}  // namespace seascape
