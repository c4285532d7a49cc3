#include "engine/exr_header.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/image_file.h"

namespace seascape {

namespace {

// OpenEXR, "OpenEXR File Layout": magic number, version and flags, then headers of (name, type, size, value), each text
// ended by a zero byte, each header by an empty name, a multi-part file's list of headers by one empty name more.
constexpr std::uint32_t magic = 20000630;
constexpr std::uint32_t multi_part_flag = 0x1000;
constexpr std::size_t longest_name = 255;
constexpr std::size_t most_parts = 1024, most_attributes = 65536, most_channels = 1024;

class Walk {
 public:
  Walk(std::vector<std::uint8_t>& bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  std::uint32_t word() {
    if (bytes_.size() - at_ < 4) broken("it is cut off in its header");
    const std::uint8_t* b = bytes_.data() + at_;
    at_ += 4;
    return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
  }

  std::string_view text() {
    const std::size_t start = at_;
    while (at_ < bytes_.size() && bytes_[at_] != 0 && at_ - start <= longest_name) ++at_;
    if (at_ >= bytes_.size()) broken("it is cut off in its header");
    if (at_ - start > longest_name) broken("a name in its header is too long");
    return {reinterpret_cast<const char*>(bytes_.data() + start), at_++ - start};
  }

  // One header. False when it was empty (the end of a multi-part list).
  bool header() {
    Sizes sizes;
    for (bool first = true;; first = false) {
      const std::string_view name = text();
      if (name.empty()) {
        if (!first) check(sizes);
        return !first;
      }
      if (++attributes_ > most_attributes) broken("its header has too many attributes");
      const std::size_t type_at = at_;
      const std::string_view type = text();
      const std::size_t size = word();
      if (size > bytes_.size() - at_) broken(fmt::format("attribute {} is larger than the file", printable(name)));
      if (type == "preview" || type == "stringvector" || type == "idmanifest") {
        std::fill(bytes_.begin() + static_cast<std::ptrdiff_t>(type_at),
                  bytes_.begin() + static_cast<std::ptrdiff_t>(type_at + type.size()), std::uint8_t{'x'});
      } else if (name == "chunkCount") {
        const std::size_t end = at_ + size;
        if (size != 4 || word() > bytes_.size() / 8) broken("it counts more chunks than it can hold");
        at_ = end;
        continue;
      } else if ((name == "dataWindow" || name == "displayWindow") && type == "box2i" && size == 16) {
        std::int64_t corner[4];
        for (std::int64_t& value : corner) value = static_cast<std::int32_t>(word());
        (name == "dataWindow" ? sizes.data : sizes.shown) = {corner[2] - corner[0] + 1, corner[3] - corner[1] + 1};
        continue;
      } else if (name == "tiles" && type == "tiledesc" && size == 9) {
        sizes.tile = {word(), word()};
        ++at_;
        continue;
      } else if (type == "chlist") {
        // Each channel: a name of one byte or more, its zero byte, and 16 bytes.
        if (size / 18 > most_channels) throw Error(where_, "has too many channels", "save it with only R, G, B and A");
      }
      at_ += size;
    }
  }

  [[noreturn]] void broken(const std::string& how) const {
    throw Error(where_, "is a broken EXR (" + how + ")", "save or copy it again");
  }

 private:
  struct Size {
    std::int64_t width = 0, height = 0;
  };
  struct Sizes {
    Size shown, data, tile;
  };

  void check(const Sizes& sizes) const {
    for (const Size& window : {sizes.shown, sizes.data}) {
      if (window.width < 1 || window.height < 1) broken("a window is missing or empty");
      if (window.width > largest_image_side || window.height > largest_image_side)
        throw Error(where_,
                    fmt::format("is {} x {} pixels, over {} a side", window.width, window.height, largest_image_side),
                    "scale it down");
    }
    // OpenEXR takes 8 bytes for each tile or block of lines, as the file itself must hold; 256 lines is the largest
    // block.
    std::int64_t chunks = (sizes.data.height + 255) / 256;
    if (sizes.tile.width > 0 && sizes.tile.height > 0)
      chunks = ((sizes.data.width - 1) / sizes.tile.width + 1) * ((sizes.data.height - 1) / sizes.tile.height + 1);
    if (static_cast<std::uint64_t>(chunks) > bytes_.size() / 8)
      broken("it is cut off: its header promises more than it holds");
  }

  static std::string printable(std::string_view name) {
    std::string shown(name);
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return shown;
  }

  std::vector<std::uint8_t>& bytes_;
  const std::string& where_;
  std::size_t at_ = 0, attributes_ = 0;
};

}  // namespace

std::vector<std::uint8_t> checked_exr(std::span<const std::uint8_t> bytes, const std::string& where) {
  std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
  Walk walk(copy, where);
  if (bytes.size() < 8 || walk.word() != magic) throw Error(where, "is not an EXR file", "give an OpenEXR picture");
  const std::uint32_t version = walk.word();
  if ((version & 0xff) != 2)
    throw Error(where, fmt::format("is an EXR of version {}", version & 0xff), "save it as version 2");
  if (!(version & multi_part_flag)) {
    walk.header();
    return copy;
  }
  for (std::size_t part = 0; walk.header(); ++part)
    if (part >= most_parts) walk.broken("it has too many parts");
  return copy;
}

}  // namespace seascape
