// Floats to 16-bit floats, the same bits on every processor.
#pragma once
#include <cstddef>
#include <cstdint>

namespace seascape {

// Each to the nearest half float, ties to the even one, too large ones to infinity (IEEE 754, binary16); NaN stays one.
void halves_from_floats(const float* from, std::uint16_t* to, std::size_t count);

}  // namespace seascape
