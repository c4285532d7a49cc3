// A model's pictures as textures.
#pragma once
#include <span>
#include <string_view>

#include "app/solids/block_texture.h"
#include "engine/resources.h"

namespace seascape {

// All levels of a picture (picture_levels, or block_levels where the device has them) as a texture. Set-up work.
Image make_texture(Device& device, std::string_view name, std::span<const Image8> levels, TexelKind kind);
Image make_block_texture(Device& device, std::string_view name, std::span<const BlockLevel> levels, BlockKind block,
                         TexelKind kind);

}  // namespace seascape
