// JPEG by libjpeg-turbo, as models have it.
#include <fmt/format.h>
#include <turbojpeg.h>

#include <memory>
#include <string_view>

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

// A PNG that says of its colours nothing but that they are sRGB, as glTF takes them whatever a file says (2.0, section
// 3.9.2): libpng would convert them by its other chunks, and 16 bits as linear light. What is broken stays so.
std::vector<std::uint8_t> called_srgb(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t first = 33;  // a signature of 8 bytes, and the header of 25
  constexpr std::uint8_t srgb[] = {0, 0, 0, 1, 's', 'R', 'G', 'B', 0, 0xae, 0xce, 0x1c, 0xe9};  // its sum last
  if (bytes.size() < first) return {bytes.begin(), bytes.end()};
  std::vector<std::uint8_t> made(bytes.begin(), bytes.begin() + first);
  made.reserve(bytes.size() + sizeof srgb);
  made.insert(made.end(), std::begin(srgb), std::end(srgb));
  std::size_t at = first;
  while (bytes.size() - at >= 12) {
    std::uint64_t size = 12;
    for (std::size_t i = 0; i < 4; ++i) size += std::uint64_t{bytes[at + i]} << (24 - 8 * i);
    if (size > bytes.size() - at) break;
    const std::string_view type(reinterpret_cast<const char*>(bytes.data() + at + 4), 4);
    if (type != "gAMA" && type != "cHRM" && type != "sRGB" && type != "iCCP")
      made.insert(made.end(), bytes.begin() + std::ptrdiff_t(at), bytes.begin() + std::ptrdiff_t(at + size));
    at += std::size_t(size);
  }
  made.insert(made.end(), bytes.begin() + std::ptrdiff_t(at), bytes.end());
  return made;
}

}  // namespace

Image8 read_picture_from_memory(std::span<const std::uint8_t> bytes, const std::string& where) {
  if (bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff) return read_jpeg(bytes, where);
  if (bytes.size() >= 4 && bytes[0] == 0x89 && bytes[1] == 'P') return read_png_from_memory(called_srgb(bytes), where);
  throw Error(where, "is neither a PNG nor a JPEG", "give one of these");
}

}  // namespace seascape
