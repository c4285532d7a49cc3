// Models seen from above: what their triangles cover.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ocean/inputs/input_source.h"
#include "ocean/inputs/mesh_pieces.h"
#include "ocean/inputs/soft_edge.h"

namespace seascape {

namespace {

class Shape final : public InputSource {
 public:
  Shape(const InputSpec& spec, std::vector<MeshPiece> pieces)
      : spec_value_(spec.value),
        from_(std::get<ShapeInput>(spec.shape).from),
        feather_m_(spec.feather_m),
        pieces_(std::move(pieces)) {
    plain_ = plain_value(spec, spec.value);
    std::vector<InputBounds> boxes;
    for (const MeshPiece& piece : pieces_) boxes.push_back(piece.triangle_tree.bounds());
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
  // The share is the largest of all pieces; height and colour are those of the highest triangle, or where there is none
  // of the nearest outline.
  struct Best {
    double share = 0.0, height = 0.0, beyond = std::numeric_limits<double>::infinity();
    bool covered = false;
    glm::vec4 colour{1.0f};
  };

  void look(const MeshPiece& piece, glm::dvec2 p, double footprint_m, double reach, Best& best) const {
    const bool within = piece.over(p, [&](const MeshTriangle& t, double height) {
      if (best.covered && height <= best.height) return;
      best.covered = true, best.height = height, best.colour = t.colour;
    });
    double share = within ? 1.0 : 0.0;
    if (std::max(feather_m_, footprint_m) > 0.0) {
      const BoundsTree::Nearest found =
          piece.outline_tree.nearest(p, within ? soft_depth(feather_m_, footprint_m) : reach, [&](std::uint32_t i) {
            const glm::dvec2 off = p - piece.outline[i].nearest(p).at;
            return glm::dot(off, off);
          });
      if (found.item < 0 && !within) return;
      const double distance = found.item < 0 ? soft_depth(feather_m_, footprint_m) : std::sqrt(found.distance2);
      share = soft_share(within ? distance : -distance, feather_m_, footprint_m) *
              disc_factor(piece.radius_m, feather_m_, footprint_m);
      if (!within && !best.covered && distance < best.beyond) {
        const MeshEdge& edge = piece.outline[std::size_t(found.item)];
        best.beyond = distance, best.height = edge.nearest(p).height, best.colour = edge.colour;
      }
    }
    best.share = std::max(best.share, share);
  }
  glm::vec4 spec_value_, plain_{0.0f};
  ShapeInput::From from_;
  double feather_m_;
  std::vector<MeshPiece> pieces_;
  BoundsTree tree_;
};

}  // namespace

std::unique_ptr<const InputSource> make_shape(const InputSpec& spec, std::vector<std::string>& remarks) {
  const ShapeInput& shape = std::get<ShapeInput>(spec.shape);
  std::vector<MeshPiece> pieces = mesh_pieces(weld(*shape.model, TurnedFrame(shape.at_m, shape.turn_deg), shape.scale));
  if (pieces.empty()) {
    remarks.push_back(
        fmt::format("{}: the model {} covers nothing seen from above and gives nothing; give one with faces that do "
                    "not stand upright",
                    spec.where, shape.file));
    return nullptr;
  }
  return std::make_unique<Shape>(spec, std::move(pieces));
}

}  // namespace seascape
