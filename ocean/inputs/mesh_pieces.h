// A model's triangles seen from above, in pieces that each have one outline.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/gltf.h"
#include "ocean/inputs/bounds_tree.h"
#include "ocean/inputs/input_source.h"

namespace seascape {

struct MeshCorner {
  glm::dvec2 at{0.0};  // on the plane, m
  double height = 0.0;
};
struct MeshTriangle {
  MeshCorner corners[3];
  glm::vec4 colour{1.0f};
};
// A side of one triangle alone.
struct MeshEdge {
  MeshCorner a, b;
  glm::vec4 colour{1.0f};

  MeshCorner nearest(glm::dvec2 p) const;
};

// Vertices at one place count as one, for a model has several where its normals differ.
struct WeldedMesh {
  std::vector<MeshCorner> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<glm::vec4> colours;  // one a triangle
};
WeldedMesh weld(const Model& model, const TurnedFrame& frame, double scale);

// Sides that are not between two triangles each of which runs along it the other way: of a closed model none. Triangles
// without an area that share two corners do not count.
std::size_t open_sides(const WeldedMesh& mesh);

// Triangles that hang together by their sides and all face up, or all down, with the sides that are their outline: what
// a closed hull shows from above and from below are two such pieces of one outline.
struct MeshPiece {
  std::vector<MeshTriangle> triangles;
  std::vector<MeshEdge> outline;
  double radius_m = 0.0;  // of a disc of its area
  BoundsTree triangle_tree, outline_tree;

  // Calls visit(triangle, height) for each triangle above or below a place; gives whether there is any.
  template <class Visit>
  bool over(glm::dvec2 p, const Visit& visit) const {
    bool any = false;
    triangle_tree.at(p, 0.0, [&](std::uint32_t i) {
      const MeshTriangle& t = triangles[i];
      const auto cross = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
      const glm::dvec2 a = t.corners[0].at, b = t.corners[1].at, c = t.corners[2].at;
      const double whole = cross(b - a, c - a), u = cross(p - a, c - a) / whole, v = cross(b - a, p - a) / whole;
      if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return;
      any = true;
      visit(t, t.corners[0].height * (1.0 - u - v) + t.corners[1].height * u + t.corners[2].height * v);
    });
    return any;
  }
};
// What stands upright covers nothing and is in no piece.
std::vector<MeshPiece> mesh_pieces(const WeldedMesh& mesh);

}  // namespace seascape
