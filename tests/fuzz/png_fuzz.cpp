// Any bytes as a PNG, as they are and with the check sums of their chunks mended (or few would get past those): an
// Error or a picture of the size it states, nothing else.
#include <cstdlib>

#include "engine/error.h"
#include "engine/image_file.h"
#include "tests/fuzz/png_sums.h"

namespace {

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
  read(seascape::fuzz::with_sums(data, size));
  return 0;
}
