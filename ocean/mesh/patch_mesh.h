// The one triangle grid that every patch and skirt strip is drawn with.
#pragma once
#include <cstdint>
#include <vector>

namespace seascape {

// Triangle list over (quads + 1)^2 vertices, vertex (i, j) at index j * (quads + 1) + i; 6 * quads^2 indices. With i
// along +x and j along +z every triangle is counter-clockwise seen from above. Ordered in narrow bands of columns, so
// that a row's vertices are still in a post-transform cache of 32 when the next row needs them.
// Every quad is cut from (i + 1, j) to (i, j + 1): when odd vertices slide onto the even ones below them, what is left
// is exactly the coarser grid with the same cuts, which morphing between levels relies on.
// Throws Error unless 1 <= quads <= 255 (uint16 indices).
std::vector<std::uint16_t> patch_indices(int quads);

}  // namespace seascape
