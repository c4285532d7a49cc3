#include "engine/gltf.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/gltf_document.h"
#include "engine/tinygltf_library.h"

namespace seascape {

namespace {

constexpr std::size_t most_parts = 65536;

class Builder {
 public:
  Builder(const tinygltf::Model& document, const std::string& where)
      : document_(document), where_(where), accessors_(document, where) {}

  Model build() {
    for (const tinygltf::Material& material : document_.materials) model_.materials.push_back(material_from(material));
    visit_nodes();
    if (model_.parts.empty()) fail("has no triangles to draw");
    model_.least = glm::vec3(std::numeric_limits<float>::max());
    model_.most = -model_.least;
    for (const MeshPart& part : model_.parts)
      for (const glm::vec3& position : part.positions) {
        model_.least = glm::min(model_.least, position);
        model_.most = glm::max(model_.most, position);
      }
    return std::move(model_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(where_, what, "export the model again"); }

  float factor(double value, double least, double most, const char* name) const {
    if (!(value >= least && value <= most))
      fail(fmt::format("material {} has a {} of {}; {} to {} is allowed", model_.materials.size(), name, value, least,
                       most));
    return static_cast<float>(value);
  }

  MeshMaterial material_from(const tinygltf::Material& source) const {
    MeshMaterial material;
    material.name = source.name;
    const tinygltf::PbrMetallicRoughness& surface = source.pbrMetallicRoughness;
    if (surface.baseColorFactor.size() == 4)
      for (int c = 0; c < 4; ++c)
        material.base_colour[c] = factor(surface.baseColorFactor[static_cast<std::size_t>(c)], 0.0, 1.0, "base colour");
    material.metallic = factor(surface.metallicFactor, 0.0, 1.0, "metallic factor");
    material.roughness = factor(surface.roughnessFactor, 0.0, 1.0, "roughness factor");
    double strength = 1.0;
    const auto extension = source.extensions.find("KHR_materials_emissive_strength");
    if (extension != source.extensions.end() && extension->second.Has("emissiveStrength") &&
        extension->second.Get("emissiveStrength").IsNumber())
      strength = extension->second.Get("emissiveStrength").GetNumberAsDouble();
    if (source.emissiveFactor.size() == 3)
      for (int c = 0; c < 3; ++c)
        material.emissive[c] = factor(source.emissiveFactor[static_cast<std::size_t>(c)], 0.0, 1.0, "emissive factor") *
                               factor(strength, 0.0, 1e6, "emissive strength");
    material.double_sided = source.doubleSided;
    return material;
  }

  // glTF 2.0, section 3.5.3: a matrix by columns, or translation * rotation * scale.
  glm::dmat4 local_transform(const tinygltf::Node& node, int index) const {
    const auto finite = [&](const std::vector<double>& values, std::size_t size, const char* name) {
      if (!values.empty() && values.size() != size)
        fail(fmt::format("node {} has a {} of {} numbers", index, name, values.size()));
      for (const double value : values)
        if (!std::isfinite(value) || std::abs(value) > 1e15)
          fail(fmt::format("node {} has a {} out of range", index, name));
      return !values.empty();
    };
    if (finite(node.matrix, 16, "matrix")) {
      glm::dmat4 matrix;
      for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
      return matrix;
    }
    glm::dmat4 matrix(1.0);
    if (finite(node.translation, 3, "translation"))
      matrix[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1.0);
    if (finite(node.rotation, 4, "rotation")) {
      const glm::dquat turn(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
      const double length = glm::length(turn);
      if (!(length > 1e-6 && length < 1e6)) fail(fmt::format("node {} has a rotation without direction", index));
      matrix = matrix * glm::mat4_cast(turn / length);
    }
    if (finite(node.scale, 3, "scale"))
      for (int c = 0; c < 3; ++c) matrix[c] *= node.scale[static_cast<std::size_t>(c)];
    return matrix;
  }

  std::vector<int> roots() const {
    if (!document_.scenes.empty()) {
      const int scene = document_.defaultScene < 0 ? 0 : document_.defaultScene;
      if (static_cast<std::size_t>(scene) >= document_.scenes.size())
        fail(fmt::format("scene {} does not exist", scene));
      return document_.scenes[static_cast<std::size_t>(scene)].nodes;
    }
    std::vector<bool> child(document_.nodes.size(), false);
    for (const tinygltf::Node& node : document_.nodes)
      for (const int index : node.children)
        if (index >= 0 && static_cast<std::size_t>(index) < child.size()) child[static_cast<std::size_t>(index)] = true;
    std::vector<int> found;
    for (std::size_t i = 0; i < child.size(); ++i)
      if (!child[i]) found.push_back(static_cast<int>(i));
    return found;
  }

  // Without recursion: a chain of nodes may be long. A node met twice is a cycle or has two parents; glTF allows
  // neither.
  void visit_nodes() {
    struct Step {
      int node;
      glm::dmat4 parent;
    };
    std::vector<Step> steps;
    const auto add = [&](const std::vector<int>& nodes, const glm::dmat4& parent) {
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) steps.push_back({*node, parent});
    };
    std::vector<bool> seen(document_.nodes.size(), false);
    add(roots(), glm::dmat4(1.0));
    while (!steps.empty()) {
      const Step step = steps.back();
      steps.pop_back();
      if (step.node < 0 || static_cast<std::size_t>(step.node) >= document_.nodes.size())
        fail(fmt::format("node {} does not exist", step.node));
      const std::size_t index = static_cast<std::size_t>(step.node);
      if (seen[index]) fail(fmt::format("node {} is met twice: a cycle, or two parents", index));
      seen[index] = true;
      const tinygltf::Node& node = document_.nodes[index];
      const glm::dmat4 world = step.parent * local_transform(node, step.node);
      if (node.mesh >= 0) add_mesh(node.mesh, world);
      add(node.children, world);
    }
  }

  void add_mesh(int mesh, const glm::dmat4& world) {
    if (static_cast<std::size_t>(mesh) >= document_.meshes.size()) fail(fmt::format("mesh {} does not exist", mesh));
    for (const tinygltf::Primitive& primitive : document_.meshes[static_cast<std::size_t>(mesh)].primitives) {
      if (model_.parts.size() >= most_parts) fail(fmt::format("has more than {} primitives", most_parts));
      model_.parts.push_back(part_from(primitive, mesh, world));
    }
  }

  void count_vertices(std::size_t more) {
    vertices_ += more;
    if (vertices_ > most_model_vertices) fail(fmt::format("has over {} M vertices", most_model_vertices >> 20));
  }

  static int attribute(const tinygltf::Primitive& primitive, const char* name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
  }

  // Corner numbers, three a triangle (glTF 2.0, section 3.7.2.1 for strips and fans).
  std::vector<std::uint32_t> triangles(const tinygltf::Primitive& primitive, std::size_t vertices, int mesh) const {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES || mode > TINYGLTF_MODE_TRIANGLE_FAN)
      fail(fmt::format("mesh {} has points or lines (mode {}); only triangles are read", mesh, mode));
    std::vector<std::uint32_t> corners;
    if (primitive.indices >= 0) {
      corners = accessors_.indices(primitive.indices);
    } else {
      corners.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) corners[i] = static_cast<std::uint32_t>(i);
    }
    for (const std::uint32_t corner : corners)
      if (corner >= vertices) fail(fmt::format("mesh {} has index {}, past its {} vertices", mesh, corner, vertices));
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      if (corners.size() % 3 != 0)
        fail(fmt::format("mesh {} has {} corners, not a multiple of 3", mesh, corners.size()));
      return corners;
    }
    if (corners.size() < 3) fail(fmt::format("mesh {} has a strip or fan of {} corners", mesh, corners.size()));
    std::vector<std::uint32_t> listed;
    listed.reserve((corners.size() - 2) * 3);
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
      const bool fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
      const std::uint32_t a = fan ? corners[i + 1] : corners[i];
      const std::uint32_t b = fan ? corners[i + 2] : corners[i + 1 + i % 2];
      const std::uint32_t c = fan ? corners[0] : corners[i + 2 - i % 2];
      if (a != b && b != c && c != a) listed.insert(listed.end(), {a, b, c});  // strips are joined by empty triangles
    }
    return listed;
  }

  MeshPart part_from(const tinygltf::Primitive& primitive, int mesh, const glm::dmat4& world) {
    const int positions = attribute(primitive, "POSITION"), normals = attribute(primitive, "NORMAL");
    const int uvs = attribute(primitive, "TEXCOORD_0");
    if (positions < 0) fail(fmt::format("mesh {} has a primitive without positions", mesh));
    const std::size_t vertices = accessors_.count(positions);
    count_vertices(vertices);
    for (const int other : {normals, uvs})
      if (other >= 0 && accessors_.count(other) != vertices)
        fail(fmt::format("mesh {} has {} positions and {} normals or texture places", mesh, vertices,
                         accessors_.count(other)));

    MeshPart part;
    part.material = primitive.material;
    if (part.material < -1 || part.material >= static_cast<int>(model_.materials.size()))
      fail(fmt::format("mesh {} names material {}, which does not exist", mesh, part.material));
    part.indices = triangles(primitive, vertices, mesh);
    const std::vector<float> place = accessors_.floats(positions, 3);
    part.positions.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
      part.positions[i] = glm::vec3(world * glm::dvec4(place[3 * i], place[3 * i + 1], place[3 * i + 2], 1.0));
      for (int c = 0; c < 3; ++c)
        if (!std::isfinite(part.positions[i][c]))
          fail(fmt::format("mesh {} has position {} that is not finite", mesh, i));
    }
    if (uvs >= 0) {
      const std::vector<float> texture = accessors_.floats(uvs, 2);
      for (std::size_t i = 0; i < vertices; ++i) {
        if (!std::isfinite(texture[2 * i]) || !std::isfinite(texture[2 * i + 1]))
          fail(fmt::format("mesh {} has texture place {} that is not finite", mesh, i));
        part.uvs.emplace_back(texture[2 * i], texture[2 * i + 1]);
      }
    }
    if (glm::determinant(glm::dmat3(world)) < 0.0)
      for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) std::swap(part.indices[i + 1], part.indices[i + 2]);
    if (normals < 0)
      make_flat(part);
    else
      place_normals(part, accessors_.floats(normals, 3), world);
    return part;
  }

  static glm::vec3 face_normal(const MeshPart& part, std::size_t first) {
    const glm::dvec3 a = part.positions[part.indices[first]], b = part.positions[part.indices[first + 1]];
    const glm::dvec3 c = part.positions[part.indices[first + 2]];
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0.0f, 1.0f, 0.0f);
  }

  // glTF 2.0, section 3.7.2.1: without normals a client shades flat, so every face gets corners of its own.
  void make_flat(MeshPart& part) {
    count_vertices(part.indices.size());
    MeshPart flat;
    flat.material = part.material;
    for (std::size_t i = 0; i < part.indices.size(); ++i) {
      flat.positions.push_back(part.positions[part.indices[i]]);
      if (!part.uvs.empty()) flat.uvs.push_back(part.uvs[part.indices[i]]);
      flat.normals.push_back(face_normal(part, i - i % 3));
      flat.indices.push_back(static_cast<std::uint32_t>(i));
    }
    part = std::move(flat);
  }

  // By the inverse transpose; where that has no direction (a zero normal, a flattened node) the face's normal stands
  // in.
  static void place_normals(MeshPart& part, const std::vector<float>& source, const glm::dmat4& world) {
    const glm::dmat3 axes(world);
    // The cofactor matrix: the inverse transpose times the determinant, which exists even where the inverse does not.
    const glm::dmat3 cofactors(glm::cross(axes[1], axes[2]), glm::cross(axes[2], axes[0]),
                               glm::cross(axes[0], axes[1]));
    const double side = glm::determinant(axes) < 0.0 ? -1.0 : 1.0;
    part.normals.resize(part.positions.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < part.normals.size(); ++i) {
      const glm::dvec3 normal = side * (cofactors * glm::dvec3(source[3 * i], source[3 * i + 1], source[3 * i + 2]));
      const double length = glm::length(normal);
      if (length > 0.0 && std::isfinite(length)) part.normals[i] = glm::vec3(normal / length);
    }
    for (std::size_t i = 0; i < part.indices.size(); ++i)
      if (part.normals[part.indices[i]] == glm::vec3(0.0f))
        part.normals[part.indices[i]] = face_normal(part, i - i % 3);
    for (glm::vec3& normal : part.normals)
      if (normal == glm::vec3(0.0f)) normal = glm::vec3(0.0f, 1.0f, 0.0f);
  }

  const tinygltf::Model& document_;
  const std::string& where_;
  GltfAccessors accessors_;
  Model model_;
  std::size_t vertices_ = 0;
};

}  // namespace

Model load_gltf_from_memory(std::span<const std::uint8_t> bytes, const std::string& where) {
  const tinygltf::Model document = parse_gltf(bytes, {}, where);
  return Builder(document, where).build();
}

Model load_gltf(const std::filesystem::path& file) {
  const std::string where = file.string();
  const std::vector<std::uint8_t> bytes = read_bytes(file);
  std::error_code fault;
  const std::filesystem::path folder = std::filesystem::absolute(file, fault).parent_path();
  const tinygltf::Model document = parse_gltf(bytes, folder, where);
  Model model = Builder(document, where).build();
  model.name = file.stem().string();
  return model;
}

}  // namespace seascape
