// Models seen from above: what their triangles cover.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "engine/gltf.h"
#include "ocean/inputs/input_source.h"
#include "ocean/inputs/soft_edge.h"

namespace seascape {

namespace {

struct Corner {
  glm::dvec2 at{0.0};  // on the plane, m
  double height = 0.0;
};
struct Triangle {
  Corner corners[3];
  glm::vec4 colour{1.0f};
};
// A side of one triangle alone.
struct Edge {
  Corner a, b;
  glm::vec4 colour{1.0f};
};

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// Triangles that hang together by their sides and all face up, or all down, with the sides that are their outline: what a closed hull shows
// from above and from below are two such pieces of one outline.
struct Piece {
  std::vector<Triangle> triangles;
  std::vector<Edge> outline;
  double radius_m = 0.0;  // of a disc of its area
  BoundsTree triangle_tree, outline_tree;

  void finish() {
    std::vector<InputBounds> boxes;
    double area = 0.0;
    for (const Triangle& t : triangles) {
      area += 0.5 * std::abs(cross(t.corners[1].at - t.corners[0].at, t.corners[2].at - t.corners[0].at));
      boxes.emplace_back();
      for (const Corner& c : t.corners) boxes.back().add(c.at);
    }
    radius_m = std::sqrt(area / std::numbers::pi);
    triangle_tree = BoundsTree(boxes);
    boxes.clear();
    for (const Edge& e : outline) {
      boxes.emplace_back();
      boxes.back().add(e.a.at);
      boxes.back().add(e.b.at);
    }
    outline_tree = BoundsTree(boxes);
  }
};

class Shape final : public InputSource {
 public:
  Shape(const InputSpec& spec, std::vector<Piece> pieces) : spec_value_(spec.value), from_(std::get<ShapeInput>(spec.shape).from), feather_m_(spec.feather_m), pieces_(std::move(pieces)) {
    plain_ = plain_value(spec, spec.value);
    std::vector<InputBounds> boxes;
    for (const Piece& piece : pieces_) boxes.push_back(piece.triangle_tree.bounds());
    tree_ = BoundsTree(boxes);
  }

  InputSample sample(glm::dvec2 place_m, double footprint_m, double) const override {
    const double reach = soft_reach(feather_m_, footprint_m);
    Best best;
    tree_.at(place_m, reach, [&](std::uint32_t i) { look(pieces_[i], place_m, footprint_m, reach, best); });
    if (!(best.share > 0.0)) return {};
    glm::vec4 value = plain_;
    if (from_ == ShapeInput::From::height) value.x = spec_value_.x + float(best.height);
    if (from_ == ShapeInput::From::material) value = glm::vec4(glm::vec3(best.colour) * best.colour.w, best.colour.w);
    return {value, float(best.share)};
  }
  InputBounds bounds() const override { return tree_.bounds(); }

 private:
  // The share is the largest of all pieces; height and colour are those of the highest triangle, or where there is none of the nearest outline.
  struct Best {
    double share = 0.0, height = 0.0, beyond = std::numeric_limits<double>::infinity();
    bool covered = false;
    glm::vec4 colour{1.0f};
  };

  void look(const Piece& piece, glm::dvec2 p, double footprint_m, double reach, Best& best) const {
    bool within = false;
    piece.triangle_tree.at(p, 0.0, [&](std::uint32_t i) {
      const Triangle& t = piece.triangles[i];
      const glm::dvec2 a = t.corners[0].at, b = t.corners[1].at, c = t.corners[2].at;
      const double whole = cross(b - a, c - a), u = cross(p - a, c - a) / whole, v = cross(b - a, p - a) / whole;
      if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return;
      within = true;
      const double height = t.corners[0].height * (1.0 - u - v) + t.corners[1].height * u + t.corners[2].height * v;
      if (best.covered && height <= best.height) return;
      best.covered = true, best.height = height, best.colour = t.colour;
    });
    double share = within ? 1.0 : 0.0;
    if (std::max(feather_m_, footprint_m) > 0.0) {
      const BoundsTree::Nearest found = piece.outline_tree.nearest(p, within ? soft_depth(feather_m_, footprint_m) : reach, [&](std::uint32_t i) {
        const glm::dvec2 off = p - on(piece.outline[i], p).at;
        return glm::dot(off, off);
      });
      if (found.item < 0 && !within) return;
      const double distance = found.item < 0 ? soft_depth(feather_m_, footprint_m) : std::sqrt(found.distance2);
      share = soft_share(within ? distance : -distance, feather_m_, footprint_m) * disc_factor(piece.radius_m, feather_m_, footprint_m);
      if (!within && !best.covered && distance < best.beyond) {
        const Edge& edge = piece.outline[std::size_t(found.item)];
        best.beyond = distance, best.height = on(edge, p).height, best.colour = edge.colour;
      }
    }
    best.share = std::max(best.share, share);
  }
  static Corner on(const Edge& e, glm::dvec2 p) {
    const glm::dvec2 way = e.b.at - e.a.at;
    const double length2 = glm::dot(way, way), u = length2 > 0.0 ? std::clamp(glm::dot(p - e.a.at, way) / length2, 0.0, 1.0) : 0.0;
    return {e.a.at + way * u, e.a.height + (e.b.height - e.a.height) * u};
  }

  glm::vec4 spec_value_, plain_{0.0f};
  ShapeInput::From from_;
  double feather_m_;
  std::vector<Piece> pieces_;
  BoundsTree tree_;
};

// Vertices at one place count as one, for a model has several where its normals differ.
struct Welded {
  std::vector<Corner> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<glm::vec4> colours;  // one a triangle
};

Welded weld(const Model& model, const TurnedFrame& frame, double scale) {
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
  Welded result;
  for (const MeshPart& part : model.parts) {
    const glm::vec4 colour = part.material >= 0 ? model.materials[std::size_t(part.material)].base_colour : glm::vec4(1.0f);
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

std::vector<Piece> pieces_of(const Welded& w) {
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
  std::map<std::uint32_t, Piece> pieces;
  for (std::uint32_t i = 0; i < w.triangles.size(); ++i) {
    if (facing[i] == 0) continue;
    const auto& t = w.triangles[i];
    pieces[find(i)].triangles.push_back({{w.corners[t[0]], w.corners[t[1]], w.corners[t[2]]}, w.colours[i]});
  }
  for (const auto& [side, triangles] : sides)
    if (triangles.size() == 1)
      pieces[find(triangles[0])].outline.push_back({w.corners[std::get<0>(side)], w.corners[std::get<1>(side)], w.colours[triangles[0]]});
  std::vector<Piece> result;
  for (auto& [number, piece] : pieces) {
    piece.finish();
    result.push_back(std::move(piece));
  }
  return result;
}

}  // namespace

std::unique_ptr<const InputSource> make_shape(const InputSpec& spec, std::vector<std::string>& remarks) {
  const ShapeInput& shape = std::get<ShapeInput>(spec.shape);
  std::vector<Piece> pieces = pieces_of(weld(*shape.model, TurnedFrame(shape.at_m, shape.turn_deg), shape.scale));
  if (pieces.empty()) {
    remarks.push_back(fmt::format("{}: the model {} covers nothing seen from above and gives nothing; give one with faces that do not stand upright", spec.where, shape.file));
    return nullptr;
  }
  return std::make_unique<Shape>(spec, std::move(pieces));
}

}  // namespace seascape
