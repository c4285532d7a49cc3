// On which side of the water each pixel of a frame is: as its picture has it, and as its mesh has it.
#pragma once
#include <cstdint>
#include <vector>

#include "tests/support/gpu/drawn_mesh.h"

namespace seascape::test {

// For each pixel of an eye, rows from the top, whether the frame drawn last takes its eye to be in the water there, by
// the stencil; of a shot whose surface is deferred.
std::vector<bool> wet_pixels(SeaShot& shot, int eye);

// How far along its axis of sight an eye sees what is drawn in each pixel, m, infinite where nothing is: of such a
// shot. Empty where the device keeps depths otherwise than as floats.
std::vector<double> distances(SeaShot& shot, int eye);

// The water that a frame at this time draws at a place, where the processor makes the waves: draws a frame from 2 m
// above it first. (Nobody may keep a view of drawn waves for longer than a frame.)
QueryAnswer drawn_water(SeaShot& shot, const glm::dvec2& at, double time_s);

// The triangles about an eye's near plane.
class NearMesh {
 public:
  // Of what rests within `reach_m` of `rest_m` along x and z.
  NearMesh(const DrawnMesh& mesh, const glm::dvec2& rest_m, double reach_m)
      : triangles_(mesh.triangles(rest_m, reach_m)) {}
  // How often a line upwards from a point leads out of the water, less how often into it: above 0 in the water.
  int sheets_over(const glm::dvec3& at) const;
  // How high the surface stands over a point, m, down to below it: of its sheets the nearest; infinite without any.
  double over(const glm::dvec3& at) const;
  double distance(const glm::dvec3& at) const;
  std::size_t size() const { return triangles_.size(); }

 private:
  std::vector<DrawnMesh::Triangle> triangles_;
};

// Where a pixel's line of sight begins: on the near plane, in the world. `x`, `y` in pixels from the upper left.
glm::dvec3 on_near_plane(const View& eye, double x, double y, std::uint32_t width, std::uint32_t height, double near_m);

}  // namespace seascape::test
