// EXR by OpenEXR. The library trusts some sizes that a header states; check_exr_header looks at them first.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>
#include <fmt/format.h>
#include <half.h>

#include "engine/error.h"
#include "engine/exr_header.h"
#include "engine/files.h"
#include "engine/image_file.h"

namespace seascape {

namespace {

constexpr int slab_lines = 64;                                        // read at a time
constexpr std::uint64_t most_chunk_bytes = std::uint64_t{256} << 20;  // of one tile or block of lines, all channels
// Pixels outside the data window cost the file nothing: so many are always allowed, and so many for each byte of the
// file.
constexpr std::uint64_t padding_pixels = std::uint64_t{1} << 22, padding_pixels_a_byte = 256;

class ReadMemory : public Imf::IStream {
 public:
  ReadMemory(std::span<const std::uint8_t> bytes, const std::string& name)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}
  bool read(char out[], int count) override {
    if (count < 0 || at_ > bytes_.size() || static_cast<std::uint64_t>(count) > bytes_.size() - at_)
      throw std::runtime_error("it is cut off");
    std::memcpy(out, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::uint64_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = at; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::uint64_t at_ = 0;
};

class WriteMemory : public Imf::OStream {
 public:
  WriteMemory(const std::string& name, std::string& bytes) : Imf::OStream(name.c_str()), bytes_(bytes) {}
  void write(const char data[], int count) override {
    const std::size_t end = at_ + static_cast<std::size_t>(count);
    if (end > bytes_.size()) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, data, static_cast<std::size_t>(count));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = static_cast<std::size_t>(at); }

 private:
  std::string& bytes_;
  std::size_t at_ = 0;
};

std::uint64_t sample_bytes(const Imf::ChannelList& channels) {
  std::uint64_t bytes = 0;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
    bytes += channel.channel().type == Imf::HALF ? 2 : 4;
  return bytes;
}

std::string names_of(const Imf::ChannelList& channels) {
  std::string names;
  int count = 0;
  for (auto channel = channels.begin(); channel != channels.end() && count < 12; ++channel, ++count)
    names += (names.empty() ? "" : " ") + std::string(channel.name());
  return names.empty() ? "none" : names;
}

bool has_colour(const Imf::ChannelList& channels) {
  return channels.findChannel("R") || channels.findChannel("G") || channels.findChannel("B") ||
         channels.findChannel("Y");
}

// The first part that is a flat picture with colour, or an Error that says what the file has instead.
int colour_part(const Imf::MultiPartInputFile& file, const std::string& where) {
  std::string seen;
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    if (header.hasType() && Imf::isDeepData(header.type())) {
      seen += (seen.empty() ? "" : ", ") + std::string("deep data");
      continue;
    }
    if (has_colour(header.channels())) return part;
    seen += (seen.empty() ? "" : ", ") + ("channels " + names_of(header.channels()));
    if (seen.size() > 200) break;
  }
  throw Error(where, fmt::format("has no flat picture with R, G, B or Y (it has: {})", seen),
              "save it as flat RGB or RGBA");
}

struct Window {
  std::int64_t left = 0, top = 0, width = 0, height = 0;
};

Window window_of(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, std::int64_t{box.max.x} - box.min.x + 1, std::int64_t{box.max.y} - box.min.y + 1};
}

// Refuses what would need more memory than the picture is worth.
void check_sizes(const Imf::Header& header, const Window& shown, const Window& data, std::size_t file_bytes,
                 const std::string& where) {
  const std::int64_t common_width =
      std::min(shown.left + shown.width, data.left + data.width) - std::max(shown.left, data.left);
  const std::int64_t common_height =
      std::min(shown.top + shown.height, data.top + data.height) - std::max(shown.top, data.top);
  const std::int64_t held = std::max<std::int64_t>(common_width, 0) * std::max<std::int64_t>(common_height, 0);
  if (static_cast<std::uint64_t>(shown.width * shown.height - held) >
      std::max(padding_pixels, padding_pixels_a_byte * file_bytes))
    throw Error(where, "is almost all empty: its data window covers too little of its display window",
                "crop it to what it shows");
  // DWAB packs the most lines into a block: 256.
  std::uint64_t block = static_cast<std::uint64_t>(data.width) * 256;
  if (header.hasTileDescription()) {
    const Imf::TileDescription& tile = header.tileDescription();
    block = std::uint64_t{tile.xSize} * tile.ySize;
    block = std::max(block, static_cast<std::uint64_t>(data.width) * tile.ySize);
  }
  if (block * sample_bytes(header.channels()) > most_chunk_bytes)
    throw Error(where, "has tiles or channels too large to read", "save it with scan lines and only R, G, B and A");
}

void check_channels(const Imf::ChannelList& channels, const std::string& where) {
  if (channels.findChannel("RY") || channels.findChannel("BY"))
    throw Error(where, "stores colour as luminance and subsampled chroma", "save it as RGB or RGBA");
  for (const char* name : {"R", "G", "B", "A", "Y"}) {
    const Imf::Channel* channel = channels.findChannel(name);
    if (channel && (channel->xSampling != 1 || channel->ySampling != 1))
      throw Error(where, fmt::format("has a subsampled channel {}", name), "save it with every channel at full size");
  }
}

// Reads part `part` slab by slab, so that a file that lies about its size fails before its memory is taken.
ImageF read_part(Imf::MultiPartInputFile& file, int part, std::size_t file_bytes, const std::string& where) {
  const Imf::Header& header = file.header(part);
  const Imf::ChannelList& channels = header.channels();
  const Window shown = window_of(header.displayWindow()), data = window_of(header.dataWindow());
  check_sizes(header, shown, data, file_bytes, where);
  check_channels(channels, where);
  const bool grey = !channels.findChannel("R") && !channels.findChannel("G") && !channels.findChannel("B");
  const bool alpha = channels.findChannel("A") != nullptr;
  Imf::InputPart input(file, part);

  ImageF image;
  image.width = static_cast<int>(shown.width);
  image.height = static_cast<int>(shown.height);
  const std::size_t row = static_cast<std::size_t>(shown.width) * 4;
  const std::uint64_t stored = static_cast<std::uint64_t>(data.width * data.height) * sample_bytes(channels);
  if (stored / 1040 <= file_bytes) image.pixels.reserve(row * static_cast<std::size_t>(shown.height));
  std::vector<float> slab(static_cast<std::size_t>(data.width) * slab_lines * 4);
  for (std::int64_t start = 0; start < shown.height; start += slab_lines) {
    const std::int64_t stop = std::min<std::int64_t>(start + slab_lines, shown.height);
    const std::size_t first = image.pixels.size();
    image.pixels.resize(first + row * static_cast<std::size_t>(stop - start), 0.0f);
    float* out = image.pixels.data() + first;
    if (!alpha)
      for (std::size_t i = 3; i < image.pixels.size() - first; i += 4) out[i] = 1.0f;
    const std::int64_t from = std::max(shown.top + start, data.top);
    const std::int64_t to = std::min(shown.top + stop, data.top + data.height);  // one past
    const std::int64_t left = std::max(shown.left, data.left);
    const std::int64_t right = std::min(shown.left + shown.width, data.left + data.width);
    if (from >= to || left >= right) continue;
    Imf::FrameBuffer target;
    const auto insert = [&](const char* name, std::size_t component, double fill) {
      target.insert(name, Imf::Slice::Make(Imf::FLOAT, slab.data() + component,
                                           Imath::V2i(static_cast<int>(data.left), static_cast<int>(from)), data.width,
                                           to - from, 4 * sizeof(float),
                                           static_cast<std::size_t>(data.width) * 4 * sizeof(float), 1, 1, fill));
    };
    insert(grey ? "Y" : "R", 0, 0.0);
    if (!grey) {
      insert("G", 1, 0.0);
      insert("B", 2, 0.0);
    }
    insert("A", 3, 1.0);
    input.setFrameBuffer(target);
    input.readPixels(static_cast<int>(from), static_cast<int>(to - 1));
    for (std::int64_t y = from; y < to; ++y) {
      const float* source = slab.data() + static_cast<std::size_t>(((y - from) * data.width + (left - data.left)) * 4);
      float* goal = out + static_cast<std::size_t>(((y - shown.top - start) * shown.width + (left - shown.left)) * 4);
      for (std::int64_t x = left; x < right; ++x, source += 4, goal += 4) {
        goal[0] = source[0];
        goal[1] = grey ? source[0] : source[1];
        goal[2] = grey ? source[0] : source[2];
        goal[3] = source[3];
      }
    }
  }
  return image;
}

void refuse_not_finite(const ImageF& image, const std::string& where) {
  std::size_t count = 0, first = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (!std::isfinite(image.pixels[i])) {
      if (count == 0) first = i / 4;
      ++count;
    }
  if (count == 0) return;
  const std::size_t width = static_cast<std::size_t>(image.width);
  throw Error(where,
              fmt::format("{} of its values are NaN or infinite, the first at column {}, row {}", count, first % width,
                          first / width),
              "repair the picture");
}

}  // namespace

std::string exr_bytes(const ImageF& image, const std::string& where) {
  if (image.width < 1 || image.height < 1 || image.width > largest_image_side || image.height > largest_image_side)
    throw Error(where, fmt::format("a picture of {} x {} pixels cannot be written", image.width, image.height),
                fmt::format("choose 1 to {} a side", largest_image_side));
  const std::size_t width = static_cast<std::size_t>(image.width),
                    needed = width * static_cast<std::size_t>(image.height) * 4;
  if (image.pixels.size() != needed)
    throw Error(where, fmt::format("the picture has {} values where its size needs {}", image.pixels.size(), needed),
                "this is a fault of the program: report it");
  std::vector<half> halves(needed);
  constexpr float largest_half = 65504.0f;
  for (std::size_t i = 0; i < needed; ++i) {
    const float value = image.pixels[i];
    halves[i] = half(std::isfinite(value) ? std::clamp(value, -largest_half, largest_half) : value);
  }
  std::string bytes;
  try {
    Imf::Header header(image.width, image.height, 1.0f, Imath::V2f(0.0f, 0.0f), 1.0f, Imf::INCREASING_Y,
                       Imf::ZIP_COMPRESSION);
    Imf::FrameBuffer source;
    const char* names[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < 4; ++c) {
      header.channels().insert(names[c], Imf::Channel(Imf::HALF));
      source.insert(names[c], Imf::Slice(Imf::HALF, reinterpret_cast<char*>(halves.data() + c), 4 * sizeof(half),
                                         width * 4 * sizeof(half)));
    }
    WriteMemory stream(where, bytes);
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(source);
    file.writePixels(image.height);
  } catch (const std::exception& fault) {
    throw Error(where, fmt::format("cannot be made an EXR ({})", fault.what()), "free some memory");
  }
  return bytes;
}

void write_exr(const std::filesystem::path& file, const ImageF& image) {
  write_atomically(file, exr_bytes(image, file.string()));
}

ImageF read_exr_from_memory(std::span<const std::uint8_t> bytes, const std::string& where, Values values) {
  const std::vector<std::uint8_t> checked = checked_exr(bytes, where);
  ImageF image;
  try {
    ReadMemory stream(checked, where);
    Imf::MultiPartInputFile file(stream);
    image = read_part(file, colour_part(file, where), bytes.size(), where);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& fault) {
    throw Error(where, fmt::format("is a broken EXR ({})", fault.what()), "save or copy it again");
  }
  if (values == Values::finite) refuse_not_finite(image, where);
  return image;
}

std::vector<std::string> exr_channels_from_memory(std::span<const std::uint8_t> bytes, const std::string& where) {
  const std::vector<std::uint8_t> checked = checked_exr(bytes, where);
  std::vector<std::string> names;
  try {
    ReadMemory stream(checked, where);
    const Imf::MultiPartInputFile file(stream);
    const Imf::ChannelList& channels = file.header(0).channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) names.emplace_back(channel.name());
  } catch (const std::exception& fault) {
    throw Error(where, fmt::format("is a broken EXR ({})", fault.what()), "save or copy it again");
  }
  return names;
}

ImageF read_exr(const std::filesystem::path& file, Values values) {
  return read_exr_from_memory(read_bytes(file), file.string(), values);
}

}  // namespace seascape
