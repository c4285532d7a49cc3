// The lace that foam breaks up into: a tile of values by which the water is covered, the least first.
#pragma once
#include <cstdint>
#include <vector>

namespace seascape {

// Cells of bubbles of two sizes (Worley 1996), which wrap around. Four bytes a texel: the share of the tile that is
// covered no later than it, evenly from 0 to 1, so that as much of the tile is below a value as the value says; its
// slope along x and z a texel, times 1024, from 128 on; the fine cells alone. Levels from `side`^2 down to one texel,
// one after another, each the mean of the one before.
std::vector<std::uint8_t> foam_pattern(int side);

}  // namespace seascape
