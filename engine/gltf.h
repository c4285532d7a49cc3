// Reads glTF 2.0 models (.gltf, .glb) into plain meshes.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace seascape {

struct MeshMaterial {
  std::string name;
  glm::vec4 base_colour{1.0f};
  float metallic = 1.0f, roughness = 1.0f;  // glTF's own defaults
  glm::vec3 emissive{0.0f};                 // KHR_materials_emissive_strength applied
  bool double_sided = false;
};

// One primitive, in the model's own axes with node transforms applied (metres, +y up, right-handed), triangles only.
struct MeshPart {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // unit length, one a position; flat ones made from the faces where the file has none
  std::vector<glm::vec2> uvs;      // one a position; empty where the file has none
  std::vector<std::uint32_t> indices;
  int material = -1;  // of Model::materials, -1: default
};

struct Model {
  std::string name;
  std::vector<MeshPart> parts;
  std::vector<MeshMaterial> materials;
  glm::vec3 least{0.0f}, most{0.0f};
};

// Throws Error for whatever is wrong: missing file or buffer, bad JSON (with its line), accessor out of its buffer,
// unsupported extension that the file requires, index past the vertices, non-finite position, node cycle, over 16 M
// vertices, points or lines. Buffers are read only from regular files in the model's folder or below. Triangle strips
// and fans become triangles, a mirrored node has its triangles turned round. Textures, skins, animations, morph
// targets, cameras and lights are not read.
Model load_gltf(const std::filesystem::path& file);
// The same on bytes of a .gltf or .glb; buffers in files of their own are refused. `where` names the bytes in errors.
Model load_gltf_from_memory(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace seascape
