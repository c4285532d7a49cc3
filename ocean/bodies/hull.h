// A hull as a closed mesh of triangles in the body's own axes, and what its volume weighs.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/gltf.h"

namespace seascape {

// Metres, +Y up, -Z forward; triangles run counter-clockwise seen from outside.
struct HullMesh {
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Vertices within about 1e-7 m become one, and triangles that this leaves without three corners go: models have several
// vertices where their normals differ. Indices have to be within the mesh.
HullMesh welded(const HullMesh& mesh);
// A model's triangles, welded; to be validated.
HullMesh hull_of(const Model& model, double scale);

// Of the volume that a mesh encloses, with density 1.
struct HullVolume {
  double volume_m3 = 0.0;
  glm::dvec3 centre_m{0.0};
  glm::dmat3 inertia_m5{0.0};  // about the centre
};
// Sums over the tetrahedra between the origin and each triangle: exact (Tonon 2004). A mesh that encloses nothing has
// volume 0.
HullVolume volume_of(const HullMesh& mesh);

// Throws Error where an index or a number is bad, a side is not shared by two triangles that run along it opposite
// ways, or the mesh encloses nothing. Triangles of no area are allowed. `where` names the hull in the message.
void validate(const HullMesh& mesh, const char* where);

// A closed box, cylinder (its axis along y) or sphere about the origin; `parts` is the number of parts of a side or a
// turn.
HullMesh box_hull(const glm::dvec3& size_m, int parts = 1);
HullMesh cylinder_hull(double radius_m, double height_m, int parts);
HullMesh sphere_hull(double radius_m, int parts);

}  // namespace seascape
