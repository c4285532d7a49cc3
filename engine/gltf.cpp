#include "engine/gltf.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/files.h"
#include "engine/gltf_reader.h"
#include "engine/tinygltf_library.h"

namespace seascape {

namespace {

constexpr std::size_t most_parts = 65536;

class Builder {
 public:
  Builder(const tinygltf::Model& document, const std::string& where) : document_(document), reader_(document, where) {}

  Model build() {
    for (std::size_t i = 0; i < document_.materials.size(); ++i) {
      const SolidMaterial look = reader_.material(static_cast<int>(i), false);
      model_.materials.push_back(
          {look.name, look.base_colour, look.metallic, look.roughness, look.emissive, look.double_sided});
    }
    SolidModel tree;
    tree.nodes = reader_.nodes(tree.order);
    const std::vector<glm::dmat4> placed = placed_nodes(tree);
    std::vector<bool> shown(tree.nodes.size(), false);
    for (const int root : reader_.roots()) shown[static_cast<std::size_t>(root)] = true;
    for (const int index : tree.order) {
      const std::size_t at = static_cast<std::size_t>(index);
      const SolidNode& node = tree.nodes[at];
      if (node.parent >= 0 && shown[static_cast<std::size_t>(node.parent)]) shown[at] = true;
      for (const int coarser : node.coarser) shown[static_cast<std::size_t>(coarser)] = false;
      if (shown[at] && node.mesh >= 0) add_mesh(node.mesh, placed[at]);
    }
    if (model_.parts.empty()) reader_.fail("has no triangles to draw");
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
  void add_mesh(int mesh, const glm::dmat4& world) {
    for (SolidPrimitive& primitive : reader_.mesh(mesh, false).primitives) {
      if (model_.parts.size() >= most_parts) reader_.fail(fmt::format("has more than {} primitives", most_parts));
      model_.parts.push_back(placed(std::move(primitive), mesh, world));
    }
  }

  MeshPart placed(SolidPrimitive source, int mesh, const glm::dmat4& world) const {
    MeshPart part;
    part.material = source.material;
    part.uvs = std::move(source.uvs[0]);
    part.indices = std::move(source.indices);
    part.positions = std::move(source.positions);
    for (std::size_t i = 0; i < part.positions.size(); ++i) {
      part.positions[i] = glm::vec3(world * glm::dvec4(part.positions[i], 1.0));
      for (int c = 0; c < 3; ++c)
        if (!std::isfinite(part.positions[i][c]))
          reader_.fail(fmt::format("mesh {} has position {} that is not finite", mesh, i));
    }
    const glm::dmat3 axes(world);
    if (glm::determinant(axes) < 0.0)
      for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) std::swap(part.indices[i + 1], part.indices[i + 2]);
    // The cofactor matrix: the inverse transpose times the determinant, which exists even where the inverse does not.
    // Where that has no direction (a flattened node) the face's normal stands in.
    const glm::dmat3 cofactors(glm::cross(axes[1], axes[2]), glm::cross(axes[2], axes[0]),
                               glm::cross(axes[0], axes[1]));
    const double side = glm::determinant(axes) < 0.0 ? -1.0 : 1.0;
    part.normals.resize(part.positions.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < part.normals.size(); ++i) {
      const glm::dvec3 normal = side * (cofactors * glm::dvec3(source.normals[i]));
      const double length = glm::length(normal);
      if (length > 0.0 && std::isfinite(length)) part.normals[i] = glm::vec3(normal / length);
    }
    for (std::size_t i = 0; i < part.indices.size(); ++i)
      if (glm::vec3& normal = part.normals[part.indices[i]]; normal == glm::vec3(0.0f)) {
        const std::uint32_t* corner = &part.indices[i - i % 3];
        normal = face_normal(part.positions[corner[0]], part.positions[corner[1]], part.positions[corner[2]]);
      }
    for (glm::vec3& normal : part.normals)
      if (normal == glm::vec3(0.0f)) normal = glm::vec3(0.0f, 1.0f, 0.0f);
    return part;
  }

  const tinygltf::Model& document_;
  GltfReader reader_;
  Model model_;
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
