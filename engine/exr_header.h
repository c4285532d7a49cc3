// Looks at the sizes in an EXR header before OpenEXR takes memory for them.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace seascape {

// A copy of `bytes` that is safe to hand to OpenEXR 3.1: every attribute lies inside the file, counts of chunks and
// channels fit its size, and attributes whose inner sizes OpenEXR trusts (previews, lists of strings, object lists),
// which no picture needs, are renamed to a type that it skips. Throws Error when it is no EXR or its header is broken.
std::vector<std::uint8_t> checked_exr(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace seascape
