#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "engine/files.h"
#include "engine/image_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::error_of;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

Image8 pattern(int width, int height, int channels) {
  Image8 image{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i)
    image.pixels.push_back(static_cast<std::uint8_t>(i * 37 + i / 11));
  return image;
}

std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

// A PNG of another kind, by libpng's own writer.
std::vector<std::uint8_t> other_png(unsigned format, int width, int height, const void* pixels,
                                    const void* palette = nullptr, unsigned colours = 0) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  image.colormap_entries = colours;
  png_alloc_size_t size = 0;
  EXPECT_TRUE(png_image_write_get_memory_size(image, size, 0, pixels, 0, palette));
  std::vector<std::uint8_t> bytes(size);
  EXPECT_TRUE(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, palette));
  bytes.resize(size);
  return bytes;
}

// Control: rows given in the opposite order come back different.
TEST(PngFile, RoundTrip) {
  const TemporaryFolder folder;
  for (const int channels : {3, 4})
    for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {256, 5}, {1, 300}}) {
      const Image8 image = pattern(width, height, channels);
      write_png(folder / "a b.png", image);
      const Image8 back = read_png(folder / "a b.png");
      EXPECT_EQ(back.width, width);
      EXPECT_EQ(back.height, height);
      EXPECT_EQ(back.channels, channels);
      EXPECT_EQ(back.pixels, image.pixels);
    }
  EXPECT_THAT(folder.names(), ElementsAre("a b.png"));
}

// Control: without png_set_sRGB there is no such chunk.
TEST(PngFile, SaysThatItIsSrgbAndIsTheSameEveryTime) {
  const std::vector<std::uint8_t> bytes = png_bytes(pattern(20, 20, 4), "memory");
  EXPECT_THAT(text_of(bytes), HasSubstr("sRGB"));
  EXPECT_EQ(bytes, png_bytes(pattern(20, 20, 4), "memory"));
}

// Control: reading with the file's own number of channels gives one, not three, for a grey picture.
TEST(PngFile, OtherKindsBecomeRgbOrRgba) {
  const std::uint8_t grey[4] = {0, 85, 170, 255};
  Image8 image = read_png_from_memory(other_png(PNG_FORMAT_GRAY, 2, 2, grey), "grey");
  EXPECT_EQ(image.channels, 3);
  EXPECT_THAT(image.pixels, ElementsAre(0, 0, 0, 85, 85, 85, 170, 170, 170, 255, 255, 255));
  const std::uint8_t palette[8] = {10, 20, 30, 255, 40, 50, 60, 128}, places[2] = {1, 0};
  image = read_png_from_memory(other_png(PNG_FORMAT_RGBA_COLORMAP, 2, 1, places, palette, 2), "palette");
  EXPECT_EQ(image.channels, 4);
  EXPECT_THAT(image.pixels, ElementsAre(40, 50, 60, 128, 10, 20, 30, 255));
  const std::uint16_t linear[6] = {0, 65535, 13933, 65535,
                                   0, 0};  // 16-bit linear light; 13933/65535 is sRGB 127.1; libpng takes 1/2.2: 126.1
  image = read_png_from_memory(other_png(PNG_FORMAT_LINEAR_RGB, 2, 1, linear), "linear");
  EXPECT_THAT(image.pixels, ElementsAre(0, 255, testing::AllOf(testing::Ge(126), testing::Le(128)), 255, 0, 0));
}

// A chunk right behind the header, which has 25 bytes after the 8 of the signature.
std::vector<std::uint8_t> with_chunk(std::vector<std::uint8_t> bytes, std::string_view type,
                                     const std::vector<std::uint8_t>& data) {
  const auto big_endian = [](std::vector<std::uint8_t>& to, std::size_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) to.push_back(std::uint8_t(value >> shift));
  };
  std::vector<std::uint8_t> chunk;
  big_endian(chunk, data.size());
  chunk.insert(chunk.end(), type.begin(), type.end());
  chunk.insert(chunk.end(), data.begin(), data.end());
  big_endian(chunk, crc32(0, chunk.data() + 4, static_cast<unsigned>(chunk.size() - 4)));
  bytes.insert(bytes.begin() + 33, chunk.begin(), chunk.end());
  return bytes;
}

std::vector<std::uint8_t> without_chunk(std::vector<std::uint8_t> bytes, std::string_view type) {
  const auto at = std::search(bytes.begin(), bytes.end(), type.begin(), type.end());
  if (at == bytes.end()) return bytes;
  const auto first = at - 4;
  const std::ptrdiff_t size = first[2] * 256 + first[3];
  bytes.erase(first, first + size + 12);
  return bytes;
}

// glTF's pictures are taken as they are stored, whatever they say of their gamma and with 8 bits or 16. Controls seen:
// the file as it is; without what it says, but with no sRGB chunk put in.
TEST(PngFile, PicturesOfModelsAreAsStored) {
  const std::uint8_t grey[3] = {0, 85, 170};
  const std::vector<std::uint8_t> plain = other_png(PNG_FORMAT_GRAY, 3, 1, grey);
  const std::vector<std::uint8_t> linear =
      with_chunk(without_chunk(without_chunk(plain, "sRGB"), "gAMA"), "gAMA", {0, 1, 0x86, 0xa0});  // a gamma of 1
  EXPECT_NE(read_png_from_memory(linear, "linear").pixels, read_png_from_memory(plain, "plain").pixels);
  EXPECT_THAT(read_picture_from_memory(linear, "linear").pixels, ElementsAre(0, 0, 0, 85, 85, 85, 170, 170, 170));
  const std::uint16_t sixteen[3] = {0, 85 * 257, 65535};
  EXPECT_THAT(read_picture_from_memory(other_png(PNG_FORMAT_LINEAR_Y, 3, 1, sixteen), "sixteen").pixels,
              ElementsAre(0, 0, 0, 85, 85, 85, 255, 255, 255));
}

// Control: without the walk over the chunks a file without its end mark is read as if whole.
TEST(PngFile, CutAnywhereIsRefused) {
  const std::vector<std::uint8_t> whole = png_bytes(pattern(9, 9, 3), "memory");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(read_png_from_memory(std::span(whole).first(size), "cut"), Error) << size;
  EXPECT_THAT(error_of([&] { read_png_from_memory(std::span(whole).first(40), "cut.png"); }),
              HasSubstr("cut.png: is a broken PNG"));
}

// Control seen: a largest side that is one too many.
TEST(PngFile, TheLargestSideIsRead) {
  const Image8 wide = pattern(largest_image_side, 1, 3);
  EXPECT_EQ(read_png_from_memory(png_bytes(wide, "memory"), "wide").pixels, wide.pixels);
  EXPECT_EQ(read_png_from_memory(png_bytes(pattern(1, largest_image_side, 4), "memory"), "high").height,
            largest_image_side);
}

// Control: with the answer of png_image_finish_read ignored, damage to the pixels passes.
TEST(PngFile, DamageIsRefusedOrHarmless) {
  const std::vector<std::uint8_t> whole = png_bytes(pattern(9, 9, 3), "memory");
  std::size_t refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const std::uint8_t flip : {0x01, 0x80, 0xff}) {
      std::vector<std::uint8_t> damaged = whole;
      damaged[i] ^= flip;
      try {
        const Image8 image = read_png_from_memory(damaged, "damaged");
        EXPECT_EQ(image.pixels, pattern(9, 9, 3).pixels) << i;
      } catch (const Error&) {
        ++refused;
      }
    }
  EXPECT_GT(refused, whole.size() * 2);
}

// Control: without the bound on expansion the reader takes 800 MB before libpng finds the file short.
TEST(PngFile, HeaderThatPromisesTooMuchIsRefused) {
  std::vector<std::uint8_t> bytes = png_bytes(pattern(9, 9, 3), "memory");
  for (const std::size_t at : {18u, 22u}) bytes[at] = 0x40;  // 16393 x 16393
  EXPECT_THAT(error_of([&] { read_png_from_memory(bytes, "a.png"); }), HasSubstr("over 16384 a side"));
  for (const std::size_t at : {18u, 22u}) bytes[at] = 0x3f;
  const unsigned long sum = crc32(0, bytes.data() + 12, 17);  // of the header, or libpng would stop at that
  for (std::size_t i = 0; i < 4; ++i) bytes[29 + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
  EXPECT_THAT(error_of([&] { read_png_from_memory(bytes, "a.png"); }), HasSubstr("promises more pixels"));
}

// Control: each check of png_bytes taken out lets one of these through.
TEST(PngFile, WrongPicturesAreRefused) {
  const TemporaryFolder folder;
  const Image8 good = pattern(4, 4, 4);
  Image8 image = good;
  image.pixels.pop_back();
  EXPECT_THAT(error_of([&] { write_png(folder / "a.png", image); }), HasSubstr("63 bytes"));
  image = good;
  image.channels = 2;
  EXPECT_THAT(error_of([&] { write_png(folder / "a.png", image); }), HasSubstr("2 channels"));
  image = good;
  image.width = 0;
  EXPECT_THAT(error_of([&] { write_png(folder / "a.png", image); }), HasSubstr("0 x 4"));
  image.width = 16385;
  EXPECT_THAT(error_of([&] { write_png(folder / "a.png", image); }), HasSubstr("16385 x 4"));
  EXPECT_THAT(error_of([&] { write_png(folder / "none/a.png", good); }), HasSubstr("folder does not exist"));
  EXPECT_TRUE(folder.names().empty());
  write_atomically(folder / "text.png", std::string_view("not a picture"));
  EXPECT_THAT(error_of([&] { read_png(folder / "text.png"); }), HasSubstr("is not a PNG file"));
  EXPECT_THAT(error_of([&] { read_png(folder / "none.png"); }), HasSubstr("there is no such file"));
}

}  // namespace
}  // namespace seascape
