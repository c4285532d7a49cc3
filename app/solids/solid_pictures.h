// A model's pictures as textures.
#pragma once
#include <span>
#include <string_view>

#include "app/solids/picture_levels.h"
#include "engine/resources.h"

namespace seascape {

// All levels of a picture (picture_levels) as a texture. Its larger side is at most `most_side`: levels above are left
// out. Set-up work.
Image make_texture(Device& device, std::string_view name, std::span<const Image8> levels, TexelKind kind,
                   int most_side);

}  // namespace seascape
