// A model's pictures as textures, each with all smaller levels.
#pragma once
#include <vector>

#include "engine/image_file.h"
#include "engine/resources.h"

namespace seascape {

enum class TexelKind { colour, linear, normal };  // sRGB; data; directions, which stay of unit length

// All levels down to one texel, the first is the picture itself. Means are of light, not of sRGB's numbers.
std::vector<Image8> picture_levels(const Image8& picture, TexelKind kind);

// The larger side of the first level is at most `most_side`. Set-up work.
Image make_texture(Device& device, std::string_view name, const Image8& picture, TexelKind kind, int most_side);

}  // namespace seascape
