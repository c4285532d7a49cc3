// Mends the check sums of a PNG's chunks, or few inputs of a fuzzer would get past those.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace seascape::fuzz {

// PNG 1.2, appendix D.
inline std::uint32_t png_sum(const std::uint8_t* bytes, std::size_t size) {
  std::uint32_t sum = 0xffffffffu;
  for (std::size_t i = 0; i < size; ++i) {
    sum ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? 0xedb88320u ^ sum >> 1 : sum >> 1;
  }
  return ~sum;
}

inline std::vector<std::uint8_t> with_sums(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> mended(data, data + size);
  for (std::size_t at = 8; mended.size() >= 12 && at <= mended.size() - 12;) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | mended[at + i];
    if (length > mended.size() - at - 12) break;
    const std::uint32_t sum = png_sum(mended.data() + at + 4, length + 4);
    for (std::size_t i = 0; i < 4; ++i) mended[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    at += 12 + length;
  }
  return mended;
}

}  // namespace seascape::fuzz
