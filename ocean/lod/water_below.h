// What the water about a viewer does now: which water stands beneath, and which patches no eye sees as it stands.
#pragma once
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
  // What is known of this call's corners and nodes, found by their place: a table with open addresses.
  template <class Value>
  struct Known {
    struct Slot {
      std::uint64_t key;
      std::uint32_t call;
      Value value;
    };
    std::vector<Slot> slots;
    std::size_t held = 0;
    void begin(std::size_t count);
    template <class Make>
    Value find(std::uint64_t key, std::uint32_t call, const Make& make);
  };
  Known<glm::vec3> corners_;  // displacements
  Known<bool> nodes_;         // whether an eye may see them
  std::uint32_t call_ = 0;
};

}  // namespace seascape
