// Hashes of what steps of the sea depend on.
#pragma once
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>

namespace seascape {

// FNV-1a (Fowler, Noll and Vo 1991) over a value's bytes.
inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  for (int i = 0; i < 8; ++i) hash = (hash ^ (value >> (8 * i) & 0xffu)) * 1099511628211ull;
  return hash;
}
inline std::uint64_t mixed(std::uint64_t hash, double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return mixed(hash, bits);
}
inline std::uint64_t mixed(std::uint64_t hash, const glm::dvec3& value) {
  return mixed(mixed(mixed(hash, value.x), value.y), value.z);
}

}  // namespace seascape
