#include "ocean/inputs/bounds_tree.h"

#include <numeric>

namespace seascape {

BoundsTree::BoundsTree(std::span<const InputBounds> boxes) {
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty()) items_.push_back(i);
  if (items_.empty()) return;
  struct Part {
    std::uint32_t node, first, count;
  };
  nodes_.reserve(items_.size());
  nodes_.push_back({});
  std::vector<Part> parts{{0, 0, std::uint32_t(items_.size())}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    InputBounds box, middles;
    for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
      const InputBounds& b = boxes[items_[i]];
      box.add(b);
      middles.add(0.5 * b.least + 0.5 * b.most);
    }
    nodes_[part.node].box = box;
    if (part.count <= leaf) {
      nodes_[part.node].first = part.first;
      nodes_[part.node].count = part.count;
      continue;
    }
    const glm::dvec2 side = middles.most - middles.least;
    const int axis = side.x >= side.y ? 0 : 1;
    const std::uint32_t half = part.count / 2;
    const auto key = [&](std::uint32_t i) { return 0.5 * boxes[i].least[axis] + 0.5 * boxes[i].most[axis]; };
    // By number where middles are alike: one tree for one list of boxes, whichever library sorts.
    std::nth_element(items_.begin() + part.first, items_.begin() + part.first + half,
                     items_.begin() + part.first + part.count,
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b) || (key(a) == key(b) && a < b); });
    const auto left = std::uint32_t(nodes_.size());
    nodes_[part.node].first = left;
    nodes_.push_back({});
    nodes_.push_back({});
    parts.push_back({left, part.first, half});
    parts.push_back({left + 1, part.first + half, part.count - half});
  }
  boxes_.reserve(items_.size());
  for (const std::uint32_t item : items_) boxes_.push_back(boxes[item]);
}

}  // namespace seascape
