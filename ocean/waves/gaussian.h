// Gaussian numbers by key instead of by sequence: the same wave draws the same pair at every quality, in any order.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

namespace seascape {

// Two independent numbers of mean 0 and variance 1 for wave (mx, mz) of a cascade of the sea `seed`.
glm::dvec2 gaussian_pair(std::uint32_t seed, int cascade, int mx, int mz);

// Uniform in [0, 1) for a key of its own.
double uniform_number(std::uint32_t seed, std::uint32_t key);

}  // namespace seascape
