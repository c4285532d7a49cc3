// A model's picture and all smaller copies of it, as textures hold them. Pure.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/image_file.h"

namespace seascape {

// sRGB; data; directions, which stay of unit length; data of which only the red counts.
enum class TexelKind { colour, linear, normal, occlusion };

// All levels of a picture of four channels down to one texel, the first is the picture itself. Means are of light, not
// of sRGB's numbers.
std::vector<Image8> picture_levels(const Image8& picture, TexelKind kind);

// IEC 61966-2-1, of 0 to 1: a byte's light, and the byte nearest to a light.
float light_of_srgb(std::uint8_t value);
std::uint8_t srgb_of_light(float light);

}  // namespace seascape
