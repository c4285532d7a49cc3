// The parts of a display's pictures that no eye can see: a headset's lenses cut them off.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace seascape {

struct HiddenMesh {
  // Of each eye: the corners of triangles, three each, in the plane z = -1 before it (tangents, as Fov has them).
  std::array<std::vector<glm::vec2>, 2> corners;
  std::uint64_t version = 0;  // another one has another
};

}  // namespace seascape
