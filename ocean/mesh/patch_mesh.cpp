#include "ocean/mesh/patch_mesh.h"

#include <algorithm>
#include <string>

#include "engine/error.h"

namespace seascape {

std::vector<std::uint16_t> patch_indices(int quads) {
  if (quads < 1 || quads > 255)
    throw Error("lod.patch_quads", "is " + std::to_string(quads) + ", outside 1 to 255", "use 16, 32 or 64", 2);
  // 15 columns: 16 vertices a row, so that two rows fit a cache of 32.
  constexpr int band = 15;
  std::vector<std::uint16_t> indices;
  indices.reserve(static_cast<std::size_t>(quads) * static_cast<std::size_t>(quads) * 6);
  const auto index = [&](int i, int j) { return static_cast<std::uint16_t>(j * (quads + 1) + i); };
  for (int first = 0; first < quads; first += band)
    for (int j = 0; j < quads; ++j)
      for (int i = first; i < std::min(first + band, quads); ++i)
        for (const std::uint16_t v :
             {index(i, j), index(i, j + 1), index(i + 1, j), index(i + 1, j), index(i, j + 1), index(i + 1, j + 1)})
          indices.push_back(v);
  return indices;
}

}  // namespace seascape
