// Pictures on disk: PNG and EXR, written to a temporary name and renamed, so that no half picture is ever left.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace seascape {

inline constexpr int largest_image_side = 16384;

// 8-bit sRGB, `channels` 3 or 4, rows from the top, tightly packed.
struct Image8 {
  int width = 0, height = 0, channels = 4;
  std::vector<std::uint8_t> pixels;
};

// Linear light, RGBA as floats, rows from the top, tightly packed.
struct ImageF {
  int width = 0, height = 0;
  std::vector<float> pixels;
};

// What read_exr does with NaN and infinity: a picture for the sea must be finite; a picture under test may hold
// anything.
enum class Values { finite, any };

// All throw Error with the file and the remedy: missing, no permission, disk full, not such a file, broken, too large
// (over 16384 a side), unsupported channels. What a reader allocates is bounded by what the file really holds.
void write_png(const std::filesystem::path& file, const Image8& image);
// Half floats, ZIP. Finite values beyond +-65504 are clamped to it; NaN and infinity are kept, so that a fault stays
// visible.
void write_exr(const std::filesystem::path& file, const ImageF& image);
// 16-bit, palette and grey pictures become 8-bit RGB, or RGBA where the file has transparency; a gAMA chunk is
// honoured.
Image8 read_png(const std::filesystem::path& file);
// Missing colour channels are zero, missing alpha one; a file with Y alone is grey. The picture is the display window:
// what the data window lacks is zero (alpha zero too where the file has one), what lies outside is cut. Scan lines and
// tiles, any compression, and the first flat part of a multi-part file with colour; deep data and subsampled channels
// are refused.
ImageF read_exr(const std::filesystem::path& file, Values values = Values::finite);

// The channels of a file's first part, in its own order. Throws Error as read_exr does.
std::vector<std::string> exr_channels_from_memory(std::span<const std::uint8_t> bytes, const std::string& where);

// The same on bytes; `where` names them in errors.
Image8 read_png_from_memory(std::span<const std::uint8_t> bytes, const std::string& where);
// A PNG or a JPEG, by its first bytes, its numbers as they are stored: what a PNG says of its colours is ignored.
Image8 read_picture_from_memory(std::span<const std::uint8_t> bytes, const std::string& where);
ImageF read_exr_from_memory(std::span<const std::uint8_t> bytes, const std::string& where,
                            Values values = Values::finite);
std::vector<std::uint8_t> png_bytes(const Image8& image, const std::string& where);
std::string exr_bytes(const ImageF& image, const std::string& where);

}  // namespace seascape
