#include "app/solids/loaded_models.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

namespace seascape {

namespace {

static_assert(sizeof(gpu::SolidMaterialData) <= solid_material_stride);

constexpr int most_texels = 4096;  // of a picture's larger side: what every device has

std::array<const SolidTexture*, gpu::solid_textures> textures_of(const SolidMaterial& material) {
  return {&material.base_colour_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture};
}

// Whole texels of data serve occlusion as well: only blocks tell them apart.
TexelKind kind_of(int texture, bool blocks) {
  return texture == gpu::solid_base_colour || texture == gpu::solid_emissive ? TexelKind::colour
         : texture == gpu::solid_normal                                      ? TexelKind::normal
         : texture == gpu::solid_occlusion && blocks                         ? TexelKind::occlusion
                                                                             : TexelKind::linear;
}

gpu::SolidMaterialData data_of(const SolidMaterial& material) {
  gpu::SolidMaterialData data{};
  data.base_colour = material.base_colour;
  const float cutoff = material.alpha == AlphaMode::mask ? material.alpha_cutoff : -1.0f;
  data.emissive_cutoff = glm::vec4(material.emissive, cutoff);
  data.surface = {material.metallic, material.roughness, material.normal_scale, material.occlusion_strength};
  data.kind = {material.unlit, material.normal_texture.image >= 0, 0, 0};
  const auto textures = textures_of(material);
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const glm::mat2& axes = textures[i]->uv_axes;
    data.uv_axes[i] = {axes[0], axes[1]};
    data.uv_offset[i] = {textures[i]->uv_offset, float(textures[i]->uv_set), 0.0f};
  }
  return data;
}

LoadedModels::Primitive make_primitive(Device& device, const std::string& name, const SolidPrimitive& source,
                                       std::span<const std::uint32_t> indices, std::size_t no_material) {
  LoadedModels::Primitive primitive;
  primitive.material = source.material >= 0 ? std::size_t(source.material) : no_material;
  primitive.count = std::uint32_t(indices.size());
  if (primitive.count == 0) return primitive;
  std::vector<gpu::SolidVertex> corners(source.positions.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::vec2 first = source.uvs[0].empty() ? glm::vec2(0.0f) : source.uvs[0][i];
    corners[i] = {glm::vec4(source.positions[i], 1.0f), glm::vec4(source.normals[i], 0.0f),
                  glm::vec4(first, source.uvs[1].empty() ? first : source.uvs[1][i]),
                  source.colours.empty() ? glm::vec4(1.0f) : source.colours[i]};
  }
  primitive.vertices = make_filled_buffer(device, name, corners.data(), corners.size() * sizeof corners.front(),
                                          VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  primitive.indices =
      make_filled_buffer(device, name, indices.data(), indices.size_bytes(), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  return primitive;
}

// Behind a model's meshes, those that mirrored parts show once more: there each triangle's corners go the other way
// round, so that its front stays its front.
void add_turned(Device& device, const PlacedModel& placed, LoadedModels::Loaded& loaded) {
  const SolidModel& model = placed.model();
  loaded.meshes.resize(2 * model.meshes.size());
  for (const SolidPart& part : placed.parts()) {
    std::vector<LoadedModels::Primitive>& primitives = loaded.meshes[model.meshes.size() + std::size_t(part.mesh)];
    if (!part.mirrored || !primitives.empty()) continue;
    for (const SolidPrimitive& source : model.meshes[std::size_t(part.mesh)].primitives) {
      std::vector<std::uint32_t> turned = source.indices;
      for (std::size_t i = 0; i + 2 < turned.size(); i += 3) std::swap(turned[i + 1], turned[i + 2]);
      primitives.push_back(make_primitive(device, model.name, source, turned, loaded.materials.size() - 1));
    }
  }
}

Image one_texel(Device& device, std::string_view name, std::array<std::uint8_t, 4> texel) {
  const std::array<Image8, 1> level{Image8{1, 1, 4, {texel.begin(), texel.end()}}};
  return make_texture(device, name, level, TexelKind::linear);
}

}  // namespace

LoadedModels::LoadedModels(Device& device, std::span<const PlacedModel> models, bool blocks)
    : asked_for_blocks_(blocks), in_blocks_(blocks && device.facts().block_textures) {
  const EffectScope scope(device, "models");
  white_ = one_texel(device, "white", {255, 255, 255, 255});
  flat_ = one_texel(device, "flat", {128, 128, 255, 255});
  loaded_.reserve(models.size());
  for (const PlacedModel& model : models) {
    load(device, model.model());
    add_turned(device, model, loaded_.back());
  }
}

// A picture is a texture for each kind of numbers that it is read as.
std::vector<std::array<const Image*, 4>> LoadedModels::load_textures(Device& device, const SolidModel& model,
                                                                     Loaded& loaded) {
  struct Wanted {
    std::size_t image;
    TexelKind kind;
    std::vector<Image8> levels;
    std::vector<BlockLevel> blocks;
  };
  std::vector<Wanted> wanted;
  for (const SolidMaterial& material : model.materials) {
    const auto textures = textures_of(material);
    for (std::size_t t = 0; t < textures.size(); ++t) {
      const TexelKind kind = kind_of(int(t), in_blocks_);
      const std::size_t image = std::size_t(textures[t]->image);
      if (textures[t]->image >= 0 && std::none_of(wanted.begin(), wanted.end(), [&](const Wanted& have) {
            return have.image == image && have.kind == kind;
          }))
        wanted.push_back({image, kind, {}, {}});
    }
  }
  tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) {
    Wanted& one = wanted[i];
    one.levels = picture_levels(model.images[one.image], one.kind);
    const auto fits = std::find_if(one.levels.begin(), one.levels.end(), [](const Image8& level) {
      return std::max(level.width, level.height) <= most_texels;
    });
    one.levels.erase(one.levels.begin(), fits);
    if (in_blocks_) one.blocks = block_levels(one.levels, one.kind);
  });
  std::vector<std::array<const Image*, 4>> made(model.images.size(), {nullptr, nullptr, nullptr, nullptr});
  loaded.textures.reserve(wanted.size());
  for (const Wanted& one : wanted)
    made[one.image][std::size_t(one.kind)] = &loaded.textures.emplace_back(
        one.blocks.empty()
            ? make_texture(device, model.name, one.levels, one.kind)
            : make_block_texture(device, model.name, one.blocks, block_kind(one.levels.front(), one.kind), one.kind));
  return made;
}

void LoadedModels::load(Device& device, const SolidModel& model) {
  Loaded& loaded = loaded_.emplace_back();
  std::vector<SolidMaterial> materials = model.materials;
  materials.emplace_back();  // what has no material has glTF's default
  const auto made = load_textures(device, model, loaded);
  std::vector<std::byte> data(solid_material_stride * materials.size());
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const gpu::SolidMaterialData one = data_of(materials[m]);
    std::memcpy(&data[m * solid_material_stride], &one, sizeof one);
    Material& material = loaded.materials.emplace_back();
    material.blends = materials[m].alpha == AlphaMode::blend;
    material.double_sided = materials[m].double_sided;
    const auto textures = textures_of(materials[m]);
    for (std::size_t t = 0; t < textures.size(); ++t) {
      material.looks[t] = *textures[t];
      material.textures[t] = int(t) == gpu::solid_normal ? &flat_ : &white_;
      if (textures[t]->image < 0) continue;
      const TexelKind kind = kind_of(int(t), in_blocks_);
      material.textures[t] = made[std::size_t(textures[t]->image)][std::size_t(kind)];
    }
  }
  loaded.material_data =
      make_filled_buffer(device, "solid materials", data.data(), data.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  for (const SolidMesh& mesh : model.meshes) {
    std::vector<Primitive>& primitives = loaded.meshes.emplace_back();
    for (const SolidPrimitive& source : mesh.primitives)
      primitives.push_back(make_primitive(device, model.name, source, source.indices, materials.size() - 1));
  }
}

}  // namespace seascape
