// Numbers that follow from a key alone, without a state (SplitMix64: Steele, Lea and Flood 2014).
#pragma once
#include <cstdint>

namespace seascape {

// From one key to the next.
inline constexpr std::uint64_t split_mix_step = 0x9e3779b97f4a7c15u;

// A bijective mix of 64 bits in which every input bit reaches every output bit (Stafford 2011, variant 13).
inline constexpr std::uint64_t split_mix(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  return v ^ (v >> 31);
}

// 53 of its bits as a number in [0, 1).
inline constexpr double share_of(std::uint64_t mixed) { return double(mixed >> 11) * 0x1p-53; }

}  // namespace seascape
