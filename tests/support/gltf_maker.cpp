#include "tests/support/gltf_maker.h"

#include <fmt/format.h>

#include <cstring>

namespace seascape::test {

namespace {
std::string joined(const std::string& list, const std::string& item) { return list.empty() ? item : list + "," + item; }
}  // namespace

int GltfMaker::view(const std::vector<std::uint8_t>& bytes, int stride) {
  data.resize((data.size() + 3) / 4 * 4);
  const std::string step = stride ? fmt::format(R"(,"byteStride":{})", stride) : "";
  views_ = joined(views_,
                  fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}{}}})", data.size(), bytes.size(), step));
  data.insert(data.end(), bytes.begin(), bytes.end());
  return view_count_++;
}

int GltfMaker::view_of(const std::vector<float>& values) {
  std::vector<std::uint8_t> bytes(values.size() * 4);
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return view(bytes, 0);
}

int GltfMaker::accessor(int view, int offset, int component_type, std::size_t count, const std::string& type,
                        const std::string& more) {
  const std::string source = view < 0 ? "" : fmt::format(R"("bufferView":{},"byteOffset":{},)", view, offset);
  accessors_ = joined(accessors_, fmt::format(R"({{{}"componentType":{},"count":{},"type":"{}"{}}})", source,
                                              component_type, count, type, more));
  return accessor_count_++;
}

int GltfMaker::floats(const std::string& type, const std::vector<float>& values) {
  const std::size_t size = static_cast<std::size_t>(type.back() - '0');
  return accessor(view_of(values), 0, 5126, values.size() / size, type);
}

int GltfMaker::indices(int component_type, const std::vector<std::uint32_t>& values) {
  const std::size_t size = component_type == 5121 ? 1 : component_type == 5123 ? 2 : 4;
  std::vector<std::uint8_t> bytes;
  for (const std::uint32_t value : values)
    for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  return accessor(view(bytes, 0), 0, component_type, values.size(), "SCALAR");
}

std::string GltfMaker::json(const std::string& buffer) const {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"buffers":[{}],"bufferViews":[{}],"accessors":[{}],"meshes":[{{"primitives":[{}]}}],)"
      R"("nodes":[{}],"scenes":[{}]{}}})",
      buffer, views_, accessors_, primitives, nodes, scenes.empty() ? R"({"nodes":[0]})" : scenes, extra);
}

std::vector<std::uint8_t> GltfMaker::glb() const {
  std::string text = json(fmt::format(R"({{"byteLength":{}}})", data.size()));
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

std::vector<std::uint8_t> GltfMaker::gltf(const std::string& uri) const {
  const std::string text = json(fmt::format(R"({{"byteLength":{},"uri":"{}"}})", data.size(), uri));
  return {text.begin(), text.end()};
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : letters[group >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace seascape::test
