// Any bytes as the picture of a model, JPEG or PNG (with its check sums mended): an Error, or a texture with all its
// levels, and these in blocks. The first byte says as what the picture is read.
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "app/solids/block_texture.h"
#include "engine/error.h"
#include "engine/solid_model.h"
#include "tests/fuzz/png_sums.h"

namespace {

// More pixels than this are read but not made smaller, or a blank picture of a few bytes would take a second.
constexpr std::size_t most_reduced = std::size_t{1} << 20;

// One triangle, whose 36 bytes of positions stand before the picture.
std::vector<std::uint8_t> model_with(const std::vector<std::uint8_t>& picture) {
  const float corners[9] = {0, 0, 0, 0, 0, 1, 1, 0, 0};
  std::vector<std::uint8_t> data(sizeof corners);
  std::memcpy(data.data(), corners, sizeof corners);
  data.insert(data.end(), picture.begin(), picture.end());
  std::string text = fmt::format(
      R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":{}}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],)"
      R"("images":[{{"bufferView":1}}],"textures":[{{"source":0}}],)"
      R"("materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],"nodes":[{{"mesh":0}}]}})",
      data.size(), picture.size());
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<std::uint8_t> bytes;
  const auto word = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  };
  const std::size_t padded = (data.size() + 3) / 4 * 4;
  word(0x46546C67);
  word(2);
  word(28 + text.size() + padded);
  word(text.size());
  word(0x4E4F534A);
  bytes.insert(bytes.end(), text.begin(), text.end());
  word(padded);
  word(0x004E4942);
  bytes.insert(bytes.end(), data.begin(), data.end());
  bytes.resize(bytes.size() + padded - data.size());
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const auto kind = seascape::TexelKind(data[0] % 4);
  try {
    const seascape::SolidModel model =
        seascape::load_solid_model_from_memory(model_with(seascape::fuzz::with_sums(data + 1, size - 1)), "input");
    for (const seascape::Image8& image : model.images) {
      const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
      if (image.channels != 4 || image.pixels.size() != 4 * pixels) std::abort();
      if (pixels > most_reduced) continue;
      const std::vector<seascape::Image8> levels = seascape::picture_levels(image, kind);
      if (levels.back().width != 1 || levels.back().height != 1) std::abort();
      for (const seascape::Image8& level : levels)
        if (level.pixels.size() != 4 * std::size_t(level.width) * std::size_t(level.height)) std::abort();
      const std::vector<seascape::BlockLevel> blocks = seascape::block_levels(levels, kind);
      if (!blocks.empty() && blocks.size() != levels.size()) std::abort();
      for (const seascape::BlockLevel& level : blocks) {
        const std::size_t count = std::size_t(level.width + 3) / 4 * (std::size_t(level.height + 3) / 4);
        if (level.blocks.size() != 8 * count && level.blocks.size() != 16 * count) std::abort();
      }
    }
  } catch (const seascape::Error&) {
  }
  return 0;
}
