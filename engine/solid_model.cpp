#include "engine/solid_model.h"

#include <fmt/format.h>

#include "engine/files.h"
#include "engine/gltf_reader.h"
#include "engine/tinygltf_library.h"

namespace seascape {

namespace {

SolidModel read(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder, const std::string& where) {
  std::vector<GltfPicture> pictures;
  const tinygltf::Model document = parse_gltf(bytes, folder, where, &pictures);
  GltfReader reader(document, where, pictures.size());
  reader.refuse_skins_and_targets();
  SolidModel model;
  model.nodes = reader.nodes(model.order);
  model.drawn = reader.roots();
  for (std::size_t i = 0; i < document.meshes.size(); ++i) model.meshes.push_back(reader.mesh(int(i), true));
  for (std::size_t i = 0; i < document.materials.size(); ++i) model.materials.push_back(reader.material(int(i), true));
  model.animations = reader.animations();
  model.images = reader.images(pictures, folder);
  if (model.triangles() == 0) reader.fail("has no triangles to draw");
  return model;
}

}  // namespace

std::size_t SolidModel::triangles() const {
  std::vector<bool> shown(nodes.size(), false);
  for (const int root : drawn) shown[std::size_t(root)] = true;
  std::size_t count = 0;
  for (const int index : order) {
    const SolidNode& node = nodes[std::size_t(index)];
    if (node.parent >= 0 && shown[std::size_t(node.parent)]) shown[std::size_t(index)] = true;
  }
  for (const SolidNode& node : nodes)
    for (const int coarser : node.coarser) shown[std::size_t(coarser)] = false;
  for (const int index : order) {  // and what lies below them
    const int parent = nodes[std::size_t(index)].parent;
    if (parent >= 0 && !shown[std::size_t(parent)]) shown[std::size_t(index)] = false;
    if (const int mesh = nodes[std::size_t(index)].mesh; mesh >= 0 && shown[std::size_t(index)])
      for (const SolidPrimitive& one : meshes[std::size_t(mesh)].primitives) count += one.indices.size() / 3;
  }
  return count;
}

SolidModel load_solid_model_from_memory(std::span<const std::uint8_t> bytes, const std::string& where) {
  return read(bytes, {}, where);
}

SolidModel load_solid_model(const std::filesystem::path& file) {
  std::error_code fault;
  SolidModel model = read(read_bytes(file), std::filesystem::absolute(file, fault).parent_path(), file.string());
  model.name = file.stem().string();
  return model;
}

}  // namespace seascape
