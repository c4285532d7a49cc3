// Parses the bytes of a glTF file into tinygltf's structures, with every limit checked first; gltf.cpp makes meshes of
// them.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
struct Accessor;
}  // namespace tinygltf

namespace seascape {

inline constexpr std::size_t most_model_vertices = std::size_t{1} << 24;

// Where a picture of the document is: in a buffer view, in the text itself ("data:...") or in a file.
struct GltfPicture {
  int view = -1;
  std::string uri;
};

// `folder`: where buffers may lie; empty: nowhere. `pictures`: what is drawn is wanted too, materials' textures and
// animations; null: meshes and nodes alone. Throws Error.
tinygltf::Model parse_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder,
                           const std::string& where, std::vector<GltfPicture>* pictures = nullptr);

// The file that a uri names below a folder, links followed, where it is a plain file. Throws Error.
std::filesystem::path gltf_file_below(const std::filesystem::path& folder, const std::string& uri,
                                      const std::string& where);

// Reads accessors out of their buffers; every one throws Error when a reference, a size or a type is wrong.
class GltfAccessors {
 public:
  GltfAccessors(const tinygltf::Model& document, const std::string& where) : document_(document), where_(where) {}
  std::size_t count(int accessor) const;
  // `components` floats an element; integers are scaled as the file asks (normalised or not), sparse values put in.
  std::vector<float> floats(int accessor, int components) const;
  std::vector<std::uint32_t> indices(int accessor) const;
  int components(int accessor) const;  // of an element
  std::span<const std::uint8_t> bytes(int view) const;

 private:
  struct Block {  // elements in a buffer, `stride` bytes apart
    const std::uint8_t* data = nullptr;
    std::size_t stride = 0;
  };
  const tinygltf::Accessor& checked(int accessor) const;
  Block block(int view, std::size_t offset, std::size_t count, std::size_t element_bytes,
              const std::string& what) const;
  template <class Read>
  void each_sparse(const tinygltf::Accessor& accessor, std::size_t element_bytes, const std::string& what,
                   Read&& read) const;
  [[noreturn]] void fail(const std::string& what) const;

  const tinygltf::Model& document_;
  const std::string& where_;
};

}  // namespace seascape
