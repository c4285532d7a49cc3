// The hull of Wigley (1942), of which a formula says what is within, and as a model: below its waterline a parabola
// along and across, above it upright to a deck.
#pragma once
#include <array>
#include <cmath>
#include <memory>

#include "engine/gltf.h"

namespace seascape::test {

// Along z, its bow to -z, its waterline at y = 0.
struct Wigley {
  double length_m = 12.0, beam_m = 3.0, draught_m = 1.2, freeboard_m = 0.8;

  double half_breadth(double y, double z) const {
    const double along = 2.0 * z / length_m, down = y < 0.0 ? y / draught_m : 0.0;
    return 0.5 * beam_m * (1.0 - along * along) * (1.0 - down * down);
  }
  bool holds(double x, double y, double z) const {
    return y > -draught_m && y < freeboard_m && std::abs(z) < 0.5 * length_m && std::abs(x) < half_breadth(y, z);
  }
};

// Closed; every triangle has its own vertices, as flat normals make them. Without its deck it is open.
inline std::shared_ptr<Model> wigley_model(const Wigley& hull, bool deck = true) {
  constexpr int along = 64, down = 24;
  auto model = std::make_shared<Model>();
  MeshPart part;
  const auto point = [&](int i, int j, double side) {  // j: from the keel to the waterline, and one more to the deck
    const double z = (double(i) / along - 0.5) * hull.length_m,
                 y = j <= down ? (double(j) / down - 1.0) * hull.draught_m : hull.freeboard_m;
    return glm::vec3(float(side * hull.half_breadth(y, z)), float(y), float(z));
  };
  const auto triangle = [&](const std::array<glm::vec3, 3>& p) {
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) return;
    for (const glm::vec3& corner : p) {
      part.indices.push_back(std::uint32_t(part.positions.size()));
      part.positions.push_back(corner);
      part.normals.push_back({0.0f, 1.0f, 0.0f});
    }
  };
  const auto quad = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    triangle({a, b, c});
    triangle({a, c, d});
  };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j <= down; ++j) {
      quad(point(i, j, 1.0), point(i, j + 1, 1.0), point(i + 1, j + 1, 1.0), point(i + 1, j, 1.0));
      quad(point(i + 1, j, -1.0), point(i + 1, j + 1, -1.0), point(i, j + 1, -1.0), point(i, j, -1.0));
    }
    if (deck)
      quad(point(i, down + 1, 1.0), point(i, down + 1, -1.0), point(i + 1, down + 1, -1.0),
           point(i + 1, down + 1, 1.0));
  }
  model->parts.push_back(part);
  return model;
}

}  // namespace seascape::test
