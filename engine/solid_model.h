// A glTF 2.0 model as it is drawn: nodes that may move, meshes, materials with their pictures, levels of detail.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/image_file.h"

namespace seascape {

enum class TextureWrap { repeat, mirrored, clamp };

struct SolidTexture {
  int image = -1;  // of SolidModel::images; -1: none
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
  bool linear = true;       // filtered; false: the nearest texel
  int uv_set = 0;           // 0 or 1
  glm::mat2 uv_axes{1.0f};  // KHR_texture_transform: uv_axes * uv + uv_offset
  glm::vec2 uv_offset{0.0f};
};

enum class AlphaMode { opaque, mask, blend };

// glTF's metallic-roughness material; factors are linear.
struct SolidMaterial {
  std::string name;
  glm::vec4 base_colour{1.0f};
  float metallic = 1.0f, roughness = 1.0f;
  glm::vec3 emissive{0.0f};  // KHR_materials_emissive_strength applied
  float normal_scale = 1.0f, occlusion_strength = 1.0f;
  AlphaMode alpha = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;  // KHR_materials_unlit: the base colour is the light
  SolidTexture base_colour_texture, metallic_roughness_texture, normal_texture, occlusion_texture, emissive_texture;
};

// Triangles in their mesh's own axes.
struct SolidPrimitive {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;             // unit length, one a position; of the faces where the file has none
  std::array<std::vector<glm::vec2>, 2> uvs;  // one a position; empty where the file has none
  std::vector<glm::vec4> colours;             // linear factors of the base colour; likewise
  std::vector<std::uint32_t> indices;         // three a triangle
  int material = -1;                          // of SolidModel::materials, -1: glTF's default
};

struct SolidMesh {
  std::string name;
  std::vector<SolidPrimitive> primitives;
};

// glTF 2.0, section 3.5.3. A matrix that the file gives stands in `matrix`; such a node does not move.
struct SolidNode {
  std::string name;
  int parent = -1;  // of SolidModel::nodes; -1: the model's own axes
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 scale{1.0};
  std::optional<glm::dmat4> matrix;
  int mesh = -1;  // of SolidModel::meshes; -1: none
  // MSFT_lod: nodes that are drawn in its place, with all below them, from near to far; and the least share of the
  // picture's height that it, and then each of them, has to cover (MSFT_screencoverage; empty where the file is
  // silent).
  std::vector<int> coarser;
  std::vector<float> coverage;
  std::string extras;  // JSON text of its extras; empty: none
  glm::dmat4 local() const;
};

// What moves a node: a value between the keys, by the section "Animations" of glTF 2.0.
struct SolidChannel {
  int node = 0;
  enum class Path { translation, rotation, scale } path = Path::translation;
  enum class Interpolation { step, linear, cubic } interpolation = Interpolation::linear;
  std::vector<float> times_s;     // rising
  std::vector<glm::vec4> values;  // one a time, three (in tangent, value, out tangent) where it is cubic
};

struct SolidAnimation {
  std::string name;
  std::vector<SolidChannel> channels;
  double duration_s = 0.0;  // it begins anew then
};

struct SolidModel {
  std::string name;
  std::vector<SolidNode> nodes;
  std::vector<int> order;  // of all nodes, parents first
  // Roots of the scene that the file shows. What neither they nor levels of detail reach is not drawn, and found by its
  // name: hulls.
  std::vector<int> drawn;
  std::vector<SolidMesh> meshes;
  std::vector<SolidMaterial> materials;
  std::vector<Image8> images;  // RGBA, as they lie in the file: colours are sRGB, all else is linear
  std::vector<SolidAnimation> animations;
  std::size_t triangles() const;  // of the finest levels
};

// Throws Error for whatever load_gltf() does, and for skins, morph targets, pictures that are broken or of another kind
// than PNG and JPEG, or of over 2^27 pixels together. Cameras and lights are not read.
SolidModel load_solid_model(const std::filesystem::path& file);
SolidModel load_solid_model_from_memory(std::span<const std::uint8_t> bytes, const std::string& where);

// Room for where nodes are, kept from call to call.
struct MovedNodes {
  std::vector<SolidNode> nodes;
  std::vector<glm::dmat4> placed;
};

// Where each node lies in the model's own axes at a time of an animation; null: as the file has them. The list is the
// room's own; no memory is taken where it is large enough.
const std::vector<glm::dmat4>& place_nodes(const SolidModel& model, const SolidAnimation* animation, double time_s,
                                           MovedNodes& room);
std::vector<glm::dmat4> placed_nodes(const SolidModel& model, const SolidAnimation* animation = nullptr,
                                     double time_s = 0.0);

}  // namespace seascape
