#include "ocean/waves/gaussian.h"

#include <cmath>
#include <numbers>

#include "ocean/waves/split_mix.h"

namespace seascape {

glm::dvec2 gaussian_pair(std::uint32_t seed, int cascade, int mx, int mz) {
  const std::uint64_t key = (std::uint64_t(seed) << 32) | (std::uint64_t(cascade & 0xff) << 24) |
                            (std::uint64_t(mx & 0xfff) << 12) | std::uint64_t(mz & 0xfff);
  const std::uint64_t a = split_mix(key + split_mix_step), b = split_mix(a + split_mix_step);
  // Box and Muller (1958): u in (0, 1], v in [0, 1).
  const double u = (double(a >> 11) + 1.0) * 0x1p-53, v = share_of(b);
  const double radius = std::sqrt(-2.0 * std::log(u)), angle = 2.0 * std::numbers::pi * v;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

double uniform_number(std::uint32_t seed, std::uint32_t key) {
  return share_of(split_mix(split_mix((std::uint64_t(seed) << 32 | key) + split_mix_step) + split_mix_step));
}

}  // namespace seascape
