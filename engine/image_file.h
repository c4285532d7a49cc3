// Pictures on disk: PNG and EXR, written to a temporary name and renamed, so that no half picture is ever left.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace seascape {

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

// All throw Error with the file and the remedy: missing, no permission, disk full, not such a file, broken, too large
// (over 16384 a side), unsupported channels.
void write_png(const std::filesystem::path& file, const Image8& image);
void write_exr(const std::filesystem::path& file, const ImageF& image);  // half floats, ZIP
Image8 read_png(const std::filesystem::path& file);
ImageF read_exr(const std::filesystem::path& file);  // missing colour channels are zero, missing alpha one

}  // namespace seascape
