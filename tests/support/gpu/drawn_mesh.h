// The mesh of a frame as the vertex shader put it out, on the processor: where its surface stands at a place, and which
// of its points each pixel shows.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "tests/support/gpu/sea_shot.h"

namespace seascape::test {

// A point of the surface, in the world, above the still sea: before the Earth's curve, which belongs to the viewer.
struct SurfacePoint {
  glm::dvec2 rest{0.0};
  glm::dvec3 at{0.0};
  double footprint_m = 0.0;  // of a vertex: that of the waves it keeps
};

class DrawnMesh {
 public:
  // Of the frame drawn last, for this viewpoint; the shot has options.probe. Throws where the probe holds fewer patches
  // than were drawn.
  DrawnMesh(SeaShot& shot, const Viewpoint& viewpoint);

  // The surface at a rest position, straight between vertices; none where no patch lies.
  std::optional<glm::dvec3> at(const glm::dvec2& rest) const;

  // Of what of it has its rest within `reach_m` of a place, along x and z, the triangles of its patches, in the world;
  // from above their corners go round against the clock.
  using Triangle = std::array<glm::dvec3, 3>;
  std::vector<Triangle> triangles(const glm::dvec2& rest, double reach_m) const;

  // How far a point is from the surface, of what of it has its rest within `reach_m` of a place, along x and z;
  // infinite where none has.
  double distance(const glm::dvec3& point, const glm::dvec2& rest, double reach_m) const;

  // What each pixel's centre shows of it, rows from the top, through the viewpoint's first eye; none where it shows
  // sky. Triangles that reach behind the eye are left out.
  struct Shown {
    SurfacePoint point;
    double depth = 0.0;     // along the axis of sight, metres
    std::size_t patch = 0;  // of the selection
    bool any = false;
  };
  std::vector<Shown> shown(int width, int height) const;

  // Where the viewpoint's first eye sees a point: tangents to the right and upwards, and the depth, negative behind it.
  glm::dvec3 seen(const glm::dvec3& at) const;

  const Viewpoint& viewpoint() const { return viewpoint_; }
  std::size_t patches() const { return patches_.size(); }
  // All vertices, patch after patch, (patch_quads + 1)^2 of each.
  const std::vector<SurfacePoint>& vertices() const { return vertices_; }

 private:
  struct Patch {
    glm::dvec2 low, high;  // of its vertices' rest positions
  };
  Viewpoint viewpoint_;
  bool curved_;
  std::vector<SurfacePoint> vertices_;
  std::vector<Patch> patches_;
  mutable std::size_t found_ = 0;  // the patch that at() found last: asked again first
};

}  // namespace seascape::test
