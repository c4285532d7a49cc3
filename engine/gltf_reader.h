// Makes plain structures of a parsed glTF document, and checks each number on the way: gltf_document.h parses it,
// gltf.cpp and solid_model.cpp put the structures together.
#pragma once
#include <filesystem>

#include "engine/gltf_document.h"
#include "engine/solid_model.h"

namespace tinygltf {
class Node;
struct Material;
struct Primitive;
class Value;
}  // namespace tinygltf

namespace seascape {

class GltfReader {
 public:
  // Both outlive it. `pictures`: how many the document has.
  GltfReader(const tinygltf::Model& document, const std::string& where, std::size_t pictures = 0)
      : document_(document), where_(where), pictures_(pictures), accessors_(document, where) {}

  // By their own numbers; `order`: parents first. A node met twice is a cycle or has two parents; glTF allows neither.
  std::vector<SolidNode> nodes(std::vector<int>& order) const;
  std::vector<int> roots() const;  // of the scene that is shown, or without scenes all nodes that no other has
  // All primitives of a mesh. `look`: what no hull needs is read too.
  SolidMesh mesh(int mesh, bool look);
  SolidMaterial material(int material, bool look) const;
  // `folder`: where pictures may lie; empty: nowhere.
  std::vector<Image8> images(const std::vector<GltfPicture>& pictures, const std::filesystem::path& folder) const;
  std::vector<SolidAnimation> animations() const;
  void refuse_skins_and_targets() const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  float factor(double value, double least, double most, int material, const char* name) const;
  SolidNode node(int index) const;
  void read_levels(const tinygltf::Node& source, SolidNode& node, std::size_t index) const;
  SolidPrimitive primitive(const tinygltf::Primitive& source, int mesh, bool look);
  std::vector<std::uint32_t> triangles(const tinygltf::Primitive& primitive, std::size_t vertices, int mesh) const;
  void count_vertices(std::size_t more);
  void make_flat(SolidPrimitive& primitive);
  SolidTexture texture(int index, int uv_set, const tinygltf::Value* transform, int material) const;

  const tinygltf::Model& document_;
  const std::string& where_;
  std::size_t pictures_;
  GltfAccessors accessors_;
  std::size_t vertices_ = 0;
};

// The normal of a triangle; up where it has none.
glm::vec3 face_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

}  // namespace seascape
