#include "ocean/waves/gaussian.h"

#include <cmath>
#include <numbers>

namespace seascape {

namespace {
// A bijective mix of 64 bits in which every input bit reaches every output bit (finaliser of Stafford 2011, variant
// 13).
std::uint64_t mix(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}
}  // namespace

glm::dvec2 gaussian_pair(std::uint32_t seed, int cascade, int mx, int mz) {
  const std::uint64_t key = (std::uint64_t(seed) << 32) | (std::uint64_t(cascade & 0xff) << 24) |
                            (std::uint64_t(mx & 0xfff) << 12) | std::uint64_t(mz & 0xfff);
  const std::uint64_t a = mix(key + 0x9e3779b97f4a7c15u), b = mix(a + 0x9e3779b97f4a7c15u);
  // Box and Muller (1958): u in (0, 1], v in [0, 1).
  const double u = (double(a >> 11) + 1.0) * 0x1p-53, v = double(b >> 11) * 0x1p-53;
  const double radius = std::sqrt(-2.0 * std::log(u)), angle = 2.0 * std::numbers::pi * v;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

double uniform_number(std::uint32_t seed, std::uint32_t key) {
  return double(mix(mix((std::uint64_t(seed) << 32 | key) + 0x9e3779b97f4a7c15u) + 0x9e3779b97f4a7c15u) >> 11) *
         0x1p-53;
}

}  // namespace seascape
