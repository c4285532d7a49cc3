// Any bytes as an EXR: an Error or a picture of the size it states, nothing else.
#include <cstdlib>

#include "engine/error.h"
#include "engine/image_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const seascape::ImageF image = seascape::read_exr_from_memory({data, size}, "input", seascape::Values::any);
    if (image.pixels.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4)
      std::abort();
  } catch (const seascape::Error&) {
  }
  return 0;
}
