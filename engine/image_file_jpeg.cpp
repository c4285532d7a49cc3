// JPEG by libjpeg-turbo, as models have it.
#include <fmt/format.h>
#include <turbojpeg.h>

#include <memory>

#include "engine/error.h"
#include "engine/image_file.h"

namespace seascape {

namespace {

// A blank picture is the smallest: a progressive JPEG leaves out up to 32,767 blocks of 8 x 8 pixels by some three
// bytes. With its headers no real file comes near this; a header that promises more is refused before memory is taken.
constexpr std::uint64_t most_pixels_a_byte = 8 * 8 * 4096;

[[noreturn]] void broken(const std::string& where, const std::string& how) {
  throw Error(where, fmt::format("is a broken JPEG ({})", how), "save or copy it again");
}

Image8 read_jpeg(std::span<const std::uint8_t> bytes, const std::string& where) {
  const std::unique_ptr<void, int (*)(tjhandle)> reader(tjInitDecompress(), &tjDestroy);
  if (!reader) throw Error(where, "cannot be read: out of memory", "free some memory");
  int width = 0, height = 0, subsampling = 0, colours = 0;
  const auto length = static_cast<unsigned long>(bytes.size());
  if (tjDecompressHeader3(reader.get(), bytes.data(), length, &width, &height, &subsampling, &colours) != 0)
    broken(where, tjGetErrorStr2(reader.get()));
  if (width < 1 || height < 1) broken(where, "its header is cut off");
  if (width > largest_image_side || height > largest_image_side)
    throw Error(where, fmt::format("is {} x {} pixels, over {} a side", width, height, largest_image_side),
                "scale it down");
  if (std::uint64_t(width) * std::uint64_t(height) > most_pixels_a_byte * bytes.size())
    broken(where, "its header promises more pixels than it holds");
  Image8 image{width, height, 4, {}};
  image.pixels.resize(std::size_t(width) * std::size_t(height) * 4);
  if (tjDecompress2(reader.get(), bytes.data(), length, image.pixels.data(), width, 0, height, TJPF_RGBA,
                    TJFLAG_ACCURATEDCT) != 0 &&
      tjGetErrorCode(reader.get()) == TJERR_FATAL)
    broken(where, tjGetErrorStr2(reader.get()));
  return image;
}

}  // namespace

Image8 read_picture_from_memory(std::span<const std::uint8_t> bytes, const std::string& where) {
  if (bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff) return read_jpeg(bytes, where);
  if (bytes.size() >= 4 && bytes[0] == 0x89 && bytes[1] == 'P') return read_png_from_memory(bytes, where);
  throw Error(where, "is neither a PNG nor a JPEG", "give one of these");
}

}  // namespace seascape
