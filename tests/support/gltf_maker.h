// Puts small glTF models together for tests: buffers as bytes, the rest as JSON text.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace seascape::test {

class GltfMaker {
 public:
  // Each returns the number of what it added.
  int view(const std::vector<std::uint8_t>& bytes, int stride);
  int view_of(const std::vector<float>& values);
  int accessor(int view, int offset, int component_type, std::size_t count, const std::string& type,
               const std::string& more = "");
  int floats(const std::string& type, const std::vector<float>& values);
  int indices(int component_type, const std::vector<std::uint32_t>& values);

  std::string json(const std::string& buffer) const;  // `buffer`: the text of the one buffer object
  std::vector<std::uint8_t> glb() const;
  std::vector<std::uint8_t> gltf(const std::string& uri) const;  // its buffer is elsewhere

  std::string primitives;
  std::string nodes = R"({"mesh":0})";
  std::string scenes;  // empty: one scene of node 0
  std::string extra;   // members of the root, each after a comma
  std::vector<std::uint8_t> data;

 private:
  std::string views_, accessors_;
  int view_count_ = 0, accessor_count_ = 0;
};

std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace seascape::test
