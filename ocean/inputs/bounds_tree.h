// Boxes on the plane, sorted so that those at a place, and the one nearest to it, are found in a few steps among
// thousands.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

namespace seascape {

// Along x and z, m. Empty: the least above the most.
struct InputBounds {
  glm::dvec2 least{std::numeric_limits<double>::infinity()}, most{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(least.x <= most.x && least.y <= most.y); }
  void add(glm::dvec2 place) { least = glm::min(least, place), most = glm::max(most, place); }
  void add(const InputBounds& other) { least = glm::min(least, other.least), most = glm::max(most, other.most); }
  InputBounds grown(double by) const { return {least - by, most + by}; }
  // Squared; 0 within.
  double distance2(glm::dvec2 place) const {
    const glm::dvec2 off = glm::max(glm::max(least - place, place - most), glm::dvec2(0.0));
    return glm::dot(off, off);
  }
  bool holds(glm::dvec2 place, double reach) const {
    return place.x >= least.x - reach && place.y >= least.y - reach && place.x <= most.x + reach &&
           place.y <= most.y + reach;
  }
};

// A binary tree over boxes that are cut in halves by the median of their middles, along the longer side (Kay and Kajiya
// 1986 call such trees bounding volume hierarchies). Immutable; items are numbers into what it was made of.
class BoundsTree {
 public:
  BoundsTree() = default;
  explicit BoundsTree(std::span<const InputBounds> boxes);

  bool empty() const { return nodes_.empty(); }
  InputBounds bounds() const { return nodes_.empty() ? InputBounds{} : nodes_[0].box; }

  // visit(item) for each whose box, made larger by `reach`, holds the place; in no certain order.
  template <class Visit>
  void at(glm::dvec2 place, double reach, const Visit& visit) const {
    walk([&](const InputBounds& box) { return box.holds(place, reach); }, visit);
  }

  // visit(item) for each whose box has something of the half line from the place towards +x.
  template <class Visit>
  void rightwards(glm::dvec2 place, const Visit& visit) const {
    walk(
        [&](const InputBounds& box) {
          return box.least.y <= place.y && box.most.y >= place.y && box.most.x >= place.x;
        },
        visit);
  }

  // distance2(item) gives the item's own squared distance; the least one's number and distance, or -1 where none is
  // within `limit`. Of those equally near it is the one that was found first, which depends on the boxes and the place
  // alone.
  struct Nearest {
    std::int64_t item = -1;
    double distance2 = 0.0;
  };
  template <class Distance2>
  Nearest nearest(glm::dvec2 place, double limit, const Distance2& distance2) const {
    Nearest found{-1, limit * limit};
    if (nodes_.empty()) return found;
    std::array<std::uint32_t, 64> stack;
    std::size_t height = 0;
    stack[height++] = 0;
    while (height > 0) {
      const Node& node = nodes_[stack[--height]];
      if (node.box.distance2(place) > found.distance2) continue;
      if (node.count > 0) {
        for (std::uint32_t i = 0; i < node.count; ++i) {
          const std::uint32_t item = items_[node.first + i];
          const double d = distance2(item);
          if (d < found.distance2 || (found.item < 0 && d <= found.distance2)) found = {std::int64_t(item), d};
        }
        continue;
      }
      // The nearer half is looked into first.
      const bool left_first = nodes_[node.first].box.distance2(place) <= nodes_[node.first + 1].box.distance2(place);
      stack[height++] = node.first + (left_first ? 1 : 0);
      stack[height++] = node.first + (left_first ? 0 : 1);
    }
    return found;
  }

 private:
  static constexpr std::uint32_t leaf = 4;
  struct Node {
    InputBounds box;
    std::uint32_t first = 0;  // of its items, or of its two halves, which lie one after the other
    std::uint32_t count = 0;  // 0: it has halves
  };

  template <class Keep, class Visit>
  void walk(const Keep& keep, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, 64> stack;  // deeper than any tree of 2^32 items
    std::size_t height = 0;
    stack[height++] = 0;
    while (height > 0) {
      const Node& node = nodes_[stack[--height]];
      if (!keep(node.box)) continue;
      for (std::uint32_t i = 0; i < node.count; ++i)
        if (keep(boxes_[node.first + i])) visit(items_[node.first + i]);
      if (node.count == 0) {
        stack[height++] = node.first + 1;
        stack[height++] = node.first;
      }
    }
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
  std::vector<InputBounds> boxes_;  // in the order of items_
};

}  // namespace seascape
