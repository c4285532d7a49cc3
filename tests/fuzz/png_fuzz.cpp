// Any bytes as a PNG, as they are and with the check sums of their chunks mended (or few would get past those): an
// Error or a picture of the size it states, nothing else.
#include <cstdlib>

#include "engine/error.h"
#include "engine/image_file.h"

namespace {

// PNG 1.2, appendix D.
std::uint32_t crc(const std::uint8_t* bytes, std::size_t size) {
  std::uint32_t sum = 0xffffffffu;
  for (std::size_t i = 0; i < size; ++i) {
    sum ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? 0xedb88320u ^ sum >> 1 : sum >> 1;
  }
  return ~sum;
}

void read(std::span<const std::uint8_t> bytes) {
  try {
    const seascape::Image8 image = seascape::read_png_from_memory(bytes, "input");
    if (image.pixels.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                                   static_cast<std::size_t>(image.channels))
      std::abort();
  } catch (const seascape::Error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read({data, size});
  std::vector<std::uint8_t> mended(data, data + size);
  for (std::size_t at = 8; mended.size() >= 12 && at <= mended.size() - 12;) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | mended[at + i];
    if (length > mended.size() - at - 12) break;
    const std::uint32_t sum = crc(mended.data() + at + 4, length + 4);
    for (std::size_t i = 0; i < 4; ++i) mended[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    at += 12 + length;
  }
  read(mended);
  return 0;
}
