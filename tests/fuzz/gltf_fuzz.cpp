// Any bytes as a model: an Error or a model whose parts agree with themselves, nothing else.
#include <cstdlib>

#include "engine/error.h"
#include "engine/gltf.h"
#include "engine/solid_model.h"

namespace {

void look_at(const seascape::SolidModel& model) {
  for (const seascape::SolidMesh& mesh : model.meshes)
    for (const seascape::SolidPrimitive& part : mesh.primitives) {
      if (part.normals.size() != part.positions.size() || part.indices.size() % 3 != 0) std::abort();
      for (const auto& uvs : part.uvs)
        if (!uvs.empty() && uvs.size() != part.positions.size()) std::abort();
      if (!part.colours.empty() && part.colours.size() != part.positions.size()) std::abort();
      if (part.material >= int(model.materials.size())) std::abort();
      for (const std::uint32_t index : part.indices)
        if (index >= part.positions.size()) std::abort();
    }
  for (const seascape::SolidMaterial& material : model.materials)
    for (const seascape::SolidTexture* texture :
         {&material.base_colour_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture})
      if (texture->image >= int(model.images.size())) std::abort();
  for (const seascape::SolidAnimation& animation : model.animations)
    for (const double time_s : {0.0, 0.3 * animation.duration_s, 1e9}) (void)placed_nodes(model, &animation, time_s);
  if (placed_nodes(model).size() != model.nodes.size() || model.order.size() != model.nodes.size()) std::abort();
  for (const seascape::SolidNode& node : model.nodes)
    if (node.mesh >= int(model.meshes.size()) || node.parent >= int(model.nodes.size())) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const seascape::Model model = seascape::load_gltf_from_memory({data, size}, "input");
    for (const seascape::MeshPart& part : model.parts) {
      if (part.normals.size() != part.positions.size()) std::abort();
      if (!part.uvs.empty() && part.uvs.size() != part.positions.size()) std::abort();
      if (part.indices.size() % 3 != 0) std::abort();
      for (const std::uint32_t index : part.indices)
        if (index >= part.positions.size()) std::abort();
    }
  } catch (const seascape::Error&) {
  }
  try {
    look_at(seascape::load_solid_model_from_memory({data, size}, "input"));
  } catch (const seascape::Error&) {
  }
  return 0;
}
