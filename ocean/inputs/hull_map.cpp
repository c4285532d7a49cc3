#include "ocean/inputs/hull_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ocean/inputs/mesh_pieces.h"
#include "shaders/shared/clip_volume.h"

namespace seascape {

namespace {

constexpr int side = gpu::clip_hull_texels;
constexpr float farthest = 8.0f;  // texels: beyond these an outline's distance need not be known

WeldedMesh welded(const Model& model) { return weld(model, TurnedFrame({0.0, 0.0}, 0.0), 1.0); }

struct Reach {
  glm::dvec3 least{std::numeric_limits<double>::infinity()}, most{-std::numeric_limits<double>::infinity()};
  explicit Reach(const WeldedMesh& mesh) {
    for (const MeshCorner& c : mesh.corners)
      least = glm::min(least, {c.at.x, c.height, c.at.y}), most = glm::max(most, {c.at.x, c.height, c.at.y});
  }
  glm::dvec3 size() const { return most - least; }
};

// Of a place in the hull's map.
glm::vec3 texel_at(const std::vector<MeshPiece>& pieces, glm::dvec2 p, double texel_m) {
  const double limit = double(farthest) * texel_m;
  double low = std::numeric_limits<double>::infinity(), high = -low, beyond = limit, nearest = limit, edge_low = 0.0,
         edge_high = 0.0;
  bool known = false;
  for (const MeshPiece& piece : pieces) {
    const InputBounds bounds = piece.triangle_tree.bounds();
    if (bounds.distance2(p) > limit * limit) continue;
    const bool within = piece.over(
        p, [&](const MeshTriangle&, double height) { low = std::min(low, height), high = std::max(high, height); });
    const BoundsTree::Nearest found = piece.outline_tree.nearest(p, limit, [&](std::uint32_t i) {
      const glm::dvec2 off = p - piece.outline[i].nearest(p).at;
      return glm::dot(off, off);
    });
    const double distance = found.item < 0 ? limit : std::sqrt(found.distance2);
    beyond = std::min(beyond, within ? -distance : distance);
    if (within || found.item < 0) continue;
    // The outline's own heights lie beyond it, so that what is read across it ends where the hull does: those of above
    // and of below are as near.
    const double height = piece.outline[std::size_t(found.item)].nearest(p).height;
    if (!known || distance < nearest - 1e-3 * texel_m)
      edge_low = edge_high = height, nearest = distance;
    else if (distance < nearest + 1e-3 * texel_m)
      edge_low = std::min(edge_low, height), edge_high = std::max(edge_high, height);
    known = true;
  }
  const bool covered = low <= high;
  return {float(covered ? low : edge_low), float(covered ? high : edge_high), float(beyond / texel_m)};
}

}  // namespace

std::string hull_fault(const Model& model) {
  const WeldedMesh mesh = welded(model);
  if (mesh.triangles.empty()) return "encloses nothing";
  const std::size_t open = open_sides(mesh);
  if (open > 0)
    return "is not closed: " + std::to_string(open) +
           (open == 1 ? " side of a triangle has" : " sides of triangles have") +
           " nothing beside them that faces the same way";
  const glm::dvec3 size = Reach(mesh).size();
  const double widest = std::max({size.x, size.y, size.z});
  if (!(std::min({size.x, size.y, size.z}) > 1e-6 * widest) || mesh_pieces(mesh).empty()) return "encloses nothing";
  return "";
}

HullMap make_hull_map(const Model& model) {
  const WeldedMesh mesh = welded(model);
  const std::vector<MeshPiece> pieces = mesh_pieces(mesh);
  const Reach reach(mesh);
  HullMap map;
  map.middle_m = 0.5 * (reach.least + reach.most);
  map.half_height_m = 0.5 * reach.size().y;
  map.texel_m = std::max(reach.size().x, reach.size().z) / (side - 2.0 * double(gpu::clip_hull_margin));
  map.texels.resize(std::size_t(side) * side);
  tbb::parallel_for(0, side, [&](int z) {
    for (int x = 0; x < side; ++x) {
      const glm::dvec2 off = (glm::dvec2(x, z) + 0.5 - 0.5 * side) * map.texel_m;
      const glm::vec3 t = texel_at(pieces, glm::dvec2(map.middle_m.x, map.middle_m.z) + off, map.texel_m);
      const auto of_half = [&](float height) { return float((double(height) - map.middle_m.y) / map.half_height_m); };
      map.texels[std::size_t(z) * side + std::size_t(x)] =
          t.z >= farthest ? glm::vec3(0.0f, 0.0f, farthest) : glm::vec3(of_half(t.x), of_half(t.y), t.z);
    }
  });
  return map;
}

glm::vec3 HullMap::read(glm::dvec2 from_middle_m) const {
  const glm::dvec2 at = from_middle_m / texel_m + 0.5 * side - 0.5, cell = glm::floor(at);
  if (!(cell.x >= 0.0 && cell.y >= 0.0 && cell.x < side - 1 && cell.y < side - 1)) return {0.0f, 0.0f, farthest};
  const glm::vec2 f(at - cell);
  const glm::vec3* low = &texels[std::size_t(cell.y) * side + std::size_t(cell.x)];
  const glm::vec3* high = low + side;
  return glm::mix(glm::mix(low[0], low[1], f.x), glm::mix(high[0], high[1], f.x), f.y);
}

}  // namespace seascape
