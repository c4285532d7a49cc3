// A model's pictures in blocks of 4 x 4 texels, which GPUs read as they are: BC1 to BC5. Pure.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "app/solids/picture_levels.h"

namespace seascape {

// By what is kept: three channels; four; red; two. Half a byte, one, half and one a texel.
enum class BlockKind { bc1, bc3, bc4, bc5 };

// How a picture that is read as `kind` lies in blocks. BC5 keeps red and green of a normal map, and green and blue,
// which are roughness and metalness, of other data; BC4 its red, which is occlusion.
BlockKind block_kind(const Image8& picture, TexelKind kind);

struct BlockLevel {
  int width = 0, height = 0;  // texels
  std::vector<std::uint8_t> blocks;
};

// All levels of a picture (picture_levels) in blocks, by all cores. Empty where it would lose too much by it, as one
// does whose neighbouring texels have nothing to do with each other, or where there is next to nothing to gain.
std::vector<BlockLevel> block_levels(std::span<const Image8> levels, TexelKind kind);

}  // namespace seascape
