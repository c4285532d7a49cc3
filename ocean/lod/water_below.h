// What the water about a viewer does now: which water stands beneath, and which patches no eye sees as it stands.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "ocean/lod/culling.h"
#include "ocean/lod/surface_selection.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

// The water beneath a viewer, by the waves that a footprint of NearMotion::footprint_m leaves, which fold nowhere: the search always
// ends, and what it finds moves as smoothly as the water does. `viewer_m` in the world; not finite: none.
std::optional<DisplacementBounds::Below> water_below(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& viewer_m,
                                                     const NearMotion& motion);

// Takes the near patches off the list that no eye sees as their water stands, which culling by bounds cannot tell: the water of a node
// of four by four patches lies about its corners, no farther off than `scale` times what a mesh of its size misses. `frusta` as the tree was
// culled with (relative to its grid origin), `tiles` with all waves that are drawn. Looks at patches of up to 4 m.
// Keeps room to work in: no allocation once lists have been as long.
class WaterCulling {
 public:
  void operator()(const WaveField& field, const WaveTiles& tiles, const EyeFrusta& frusta, const glm::dvec3& viewer_m, SurfaceSelection& selection,
                  double scale = 1.0);

 private:
  static constexpr std::uint32_t unknown = 0xffffffff;
  // What is known of this call's corners and nodes: their numbers, found by their place from the tree's least corner, and of a node also its level.
  // A table with open addresses; once it is three quarters full what is new is not remembered, so that a search ends.
  struct Known {
    struct Slot {
      std::uint64_t key;
      std::uint32_t call, index;
    };
    std::vector<Slot> slots;
    std::size_t mask = 0, room = 0;
    std::uint32_t none = unknown;
    void begin(std::size_t count);
    std::uint32_t& find(glm::ivec2 place, int level, std::uint32_t call);
  };
  struct Node {
    std::array<std::uint32_t, 4> corners;
    double off_m;  // how far its water may lie off what lies between its corners
    bool seen;
  };
  Known known_nodes_, known_corners_;
  std::vector<Node> nodes_;
  std::vector<glm::dvec2> corners_m_;  // at rest, in the world
  std::vector<glm::vec3> moved_;       // their displacements
  struct Run {
    std::size_t first;   // of the patches of one node that follow each other
    std::uint32_t node;  // unknown: they are not looked at
  };
  std::vector<Run> runs_;
  std::uint32_t call_ = 0;
};

}  // namespace seascape
