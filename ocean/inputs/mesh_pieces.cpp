#include "ocean/inputs/mesh_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace seascape {

namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

void finish(MeshPiece& piece) {
  std::vector<InputBounds> boxes;
  double area = 0.0;
  for (const MeshTriangle& t : piece.triangles) {
    area += 0.5 * std::abs(cross(t.corners[1].at - t.corners[0].at, t.corners[2].at - t.corners[0].at));
    boxes.emplace_back();
    for (const MeshCorner& c : t.corners) boxes.back().add(c.at);
  }
  piece.radius_m = std::sqrt(area / std::numbers::pi);
  piece.triangle_tree = BoundsTree(boxes);
  boxes.clear();
  for (const MeshEdge& e : piece.outline) {
    boxes.emplace_back();
    boxes.back().add(e.a.at);
    boxes.back().add(e.b.at);
  }
  piece.outline_tree = BoundsTree(boxes);
}

}  // namespace

MeshCorner MeshEdge::nearest(glm::dvec2 p) const {
  const glm::dvec2 way = b.at - a.at;
  const double length2 = glm::dot(way, way),
               u = length2 > 0.0 ? std::clamp(glm::dot(p - a.at, way) / length2, 0.0, 1.0) : 0.0;
  return {a.at + way * u, a.height + (b.height - a.height) * u};
}

WeldedMesh weld(const Model& model, const TurnedFrame& frame, double scale) {
  struct Same {
    bool operator()(const glm::vec3& a, const glm::vec3& b) const { return a == b; }
  };
  struct Hash {
    std::size_t operator()(const glm::vec3& v) const {
      std::uint64_t h = 1469598103934665603ull;
      for (int i = 0; i < 3; ++i) {
        const float plus = v[i] + 0.0f;  // -0 is 0
        std::uint32_t bits;
        std::memcpy(&bits, &plus, 4);
        h = (h ^ bits) * 1099511628211ull;
      }
      return std::size_t(h ^ (h >> 29));
    }
  };
  std::unordered_map<glm::vec3, std::uint32_t, Hash, Same> numbers;
  WeldedMesh result;
  for (const MeshPart& part : model.parts) {
    const glm::vec4 colour =
        part.material >= 0 ? model.materials[std::size_t(part.material)].base_colour : glm::vec4(1.0f);
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
      std::array<std::uint32_t, 3> triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 p = part.positions[part.indices[i + k]];
        const auto [found, added] = numbers.try_emplace(p, std::uint32_t(result.corners.size()));
        if (added) result.corners.push_back({frame.at + frame.turned(scale * glm::dvec2(p.x, p.z)), scale * p.y});
        triangle[k] = found->second;
      }
      result.triangles.push_back(triangle);
      result.colours.push_back(colour);
    }
  }
  return result;
}

std::size_t open_sides(const WeldedMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> runs;  // along a side, one way less the other
  for (const auto& t : mesh.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      runs[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::size_t(std::count_if(runs.begin(), runs.end(), [](const auto& side) { return side.second != 0; }));
}

std::vector<MeshPiece> mesh_pieces(const WeldedMesh& w) {
  // Which way a triangle faces is the sign of its area; what stands upright covers nothing.
  std::vector<int> facing(w.triangles.size(), 0);
  for (std::size_t i = 0; i < w.triangles.size(); ++i) {
    const auto& t = w.triangles[i];
    const glm::dvec2 a = w.corners[t[0]].at, b = w.corners[t[1]].at, c = w.corners[t[2]].at;
    const double area = cross(b - a, c - a);
    const double side = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    facing[i] = area > 1e-9 * side * side ? 1 : area < -1e-9 * side * side ? -1 : 0;
  }
  // Triangles of each side, by its ends and the way they face.
  std::map<std::tuple<std::uint32_t, std::uint32_t, int>, std::vector<std::uint32_t>> sides;
  for (std::uint32_t i = 0; i < w.triangles.size(); ++i)
    for (std::size_t k = 0; facing[i] != 0 && k < 3; ++k) {
      const std::uint32_t a = w.triangles[i][k], b = w.triangles[i][(k + 1) % 3];
      sides[{std::min(a, b), std::max(a, b), facing[i]}].push_back(i);
    }
  std::vector<std::uint32_t> leader(w.triangles.size());
  std::iota(leader.begin(), leader.end(), 0u);
  const auto find = [&](std::uint32_t i) {
    while (leader[i] != i) i = leader[i] = leader[leader[i]];
    return i;
  };
  for (const auto& [side, triangles] : sides)
    for (const std::uint32_t i : triangles) leader[find(i)] = find(triangles[0]);
  std::map<std::uint32_t, MeshPiece> pieces;
  for (std::uint32_t i = 0; i < w.triangles.size(); ++i) {
    if (facing[i] == 0) continue;
    const auto& t = w.triangles[i];
    pieces[find(i)].triangles.push_back({{w.corners[t[0]], w.corners[t[1]], w.corners[t[2]]}, w.colours[i]});
  }
  for (const auto& [side, triangles] : sides)
    if (triangles.size() == 1)
      pieces[find(triangles[0])].outline.push_back(
          {w.corners[std::get<0>(side)], w.corners[std::get<1>(side)], w.colours[triangles[0]]});
  std::vector<MeshPiece> result;
  for (auto& [number, piece] : pieces) {
    finish(piece);
    result.push_back(std::move(piece));
  }
  return result;
}

}  // namespace seascape
