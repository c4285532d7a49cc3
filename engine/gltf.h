// Reads glTF 2.0 models (.gltf, .glb) into plain meshes.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace seascape {

struct MeshMaterial {
  std::string name;
  glm::vec4 base_colour{1.0f};
  float metallic = 0.0f, roughness = 1.0f;
  glm::vec3 emissive{0.0f};
  bool double_sided = false;
};

// One primitive, in the model's own axes with node transforms applied (metres, +y up, right-handed), triangles only.
struct MeshPart {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // made from the faces where the file has none
  std::vector<glm::vec2> uvs;      // empty where the file has none
  std::vector<std::uint32_t> indices;
  int material = -1;               // of Model::materials, -1: default
};

struct Model {
  std::string name;
  std::vector<MeshPart> parts;
  std::vector<MeshMaterial> materials;
  glm::vec3 least{0.0f}, most{0.0f};
};

// Throws Error for whatever is wrong: missing file or buffer, bad JSON, accessor out of its buffer, unsupported
// extension that the file requires, index past the vertices, non-finite position, node cycle, over 16 M vertices.
Model load_gltf(const std::filesystem::path& file);

}  // namespace seascape
