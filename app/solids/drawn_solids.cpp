#include "app/solids/drawn_solids.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

#include "shaders/shared/frame_data.h"

namespace seascape {

namespace {

// A dynamic offset of a uniform buffer is a multiple of this on every device (Vulkan's required limit).
constexpr VkDeviceSize material_stride = 256;
static_assert(sizeof(gpu::SolidMaterialData) <= material_stride);

std::array<const SolidTexture*, gpu::solid_textures> textures_of(const SolidMaterial& material) {
  return {&material.base_colour_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture};
}

TexelKind kind_of(int texture) {
  return texture == gpu::solid_base_colour || texture == gpu::solid_emissive ? TexelKind::colour
         : texture == gpu::solid_normal                                      ? TexelKind::normal
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

Image one_texel(Device& device, std::string_view name, std::array<std::uint8_t, 4> texel) {
  const std::array<Image8, 1> level{Image8{1, 1, 4, {texel.begin(), texel.end()}}};
  return make_texture(device, name, level, TexelKind::linear, 1);
}

}  // namespace

DrawnSolids::DrawnSolids(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const SurfaceLight& light,
                         std::span<const PlacedModel> models, std::span<const SolidThing> things, const SolidLook& look)
    : device_(device), shaders_(shaders), models_(models), light_(light), look_(look) {
  const EffectScope scope(device, "models");
  white_ = one_texel(device, "white", {255, 255, 255, 255});
  flat_ = one_texel(device, "flat", {128, 128, 255, 255});
  ImageSpec sky;
  sky.width = sky.height = gpu::solid_sky_side;
  sky.layers = gpu::solid_sky_layers;
  sky.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  sky.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  sky_ = Image(device, "solid sky", sky);
  ImageSpec albedo;
  albedo.width = albedo.height = gpu::solid_albedo_side;
  albedo.format = sky.format;
  albedo.usage = sky.usage;
  albedo.array = false;
  albedo_ = Image(device, "solid albedo", albedo);
  sky_sampler_ = make_sampler(device, "solid sky", {.linear = true, .repeat = false});
  if (look.depths) depth_sampler_ = make_sampler(device, "solid depths", {.linear = false, .repeat = false});
  sky_pipeline_ = make_compute_pipeline(device, shaders, "solid_sky.comp");
  albedo_pipeline_ = make_compute_pipeline(device, shaders, "solid_albedo.comp");
  sky_bindings_ = Bindings(device, sky_pipeline_,
                           {{.binding = 0, .view = light.sky_map, .sampler = light.sky_sampler},
                            {.binding = 1, .buffer = light.sky_light},
                            {.binding = 2, .view = sky_.view()}},
                           "solid sky");
  albedo_bindings_ = Bindings(device, albedo_pipeline_, {{.binding = 0, .view = albedo_.view()}}, "solid albedo");
  make_pipelines(picture);
  if (look_.sun_map != nullptr) make_caster_pipeline();
  for (const PlacedModel& model : models) make_model(model.model());
  make_room(things);
}

void DrawnSolids::make_room(std::span<const SolidThing> things) {
  std::size_t most = 0, parts = 0;
  for (const SolidThing& thing : things) most += models_[thing.model].most_parts();
  for (const PlacedModel& model : models_) parts += model.parts().size();
  const auto make = [&](SolidSelection& selection, std::array<Buffer, Frame::slots>& instances) {
    selection.seen.reserve(things.size());
    selection.instances.reserve(most);
    selection.draws.reserve(parts);
    selection.far_first.reserve(parts);
    for (Buffer& buffer : instances)
      buffer = Buffer(device_, "solid instances", std::max(most, std::size_t{1}) * sizeof(gpu::SolidInstance),
                      VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, HostAccess::write);
  };
  make(selection_, instances_);
  if (look_.below != nullptr) make(in_water_, in_water_instances_);
  if (look_.sun_map != nullptr) make(casters_, caster_instances_);
}

void DrawnSolids::make_pipelines(const RenderTarget& picture) {
  GraphicsSpec spec;
  spec.vertex = "solid.vert";
  spec.fragment = look_.points ? "solid_points.frag" : "solid.frag";
  spec.values = {{gpu::value_multiview, !picture.spec().per_eye},
                 {gpu::value_tile_shape, look_.tile_shape},
                 {gpu::value_sun_map, look_.sun_map != nullptr},
                 {gpu::value_anisotropy, std::bit_cast<std::uint32_t>(look_.anisotropy)}};
  spec.buffers = {{0, sizeof(gpu::SolidVertex), VK_VERTEX_INPUT_RATE_VERTEX},
                  {1, sizeof(gpu::SolidInstance), VK_VERTEX_INPUT_RATE_INSTANCE}};
  for (std::uint32_t i = 0; i < 4; ++i) spec.attributes.push_back({i, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 16 * i});
  for (std::uint32_t i = 0; i < 3; ++i) spec.attributes.push_back({4 + i, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 16 * i});
  spec.facing = true;
  pipeline_ = make_graphics_pipeline(device_, shaders_, look_.points ? *look_.points : picture, spec);
  spec.fragment = "solid.frag";
  spec.blend = true;
  spec.depth_write = false;
  spec.values.push_back({gpu::value_blend, true});
  spec.values.push_back({gpu::value_depth_sampled, look_.depths != nullptr});
  blended_pipeline_ = make_graphics_pipeline(device_, shaders_, picture, spec);
  if (look_.below == nullptr) return;
  spec.fragment = "solid_below.frag";
  spec.blend = false;
  spec.depth_write = true;
  spec.values = {{gpu::value_multiview, !picture.spec().per_eye},
                 {gpu::value_wide, true},
                 {gpu::value_sun_map, look_.sun_map != nullptr}};
  in_water_pipeline_ = make_graphics_pipeline(device_, shaders_, *look_.below, spec);
}

// Both sides are drawn: a wall that the sun sees from behind hides it too.
void DrawnSolids::make_caster_pipeline() {
  GraphicsSpec spec;
  spec.vertex = "sun_map.vert";
  spec.fragment = "sun_map.frag";
  spec.buffers = {{0, sizeof(gpu::SolidVertex), VK_VERTEX_INPUT_RATE_VERTEX},
                  {1, sizeof(gpu::SolidInstance), VK_VERTEX_INPUT_RATE_INSTANCE}};
  for (const std::uint32_t i : {0u, 2u, 3u}) spec.attributes.push_back({i, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 16 * i});
  for (std::uint32_t i = 0; i < 3; ++i) spec.attributes.push_back({4 + i, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 16 * i});
  caster_pipeline_ = make_graphics_pipeline(device_, shaders_, *look_.sun_map, spec);
}

VkSampler DrawnSolids::sampler(const SolidTexture& texture) {
  const auto mode = [](TextureWrap wrap) {
    return wrap == TextureWrap::clamp      ? VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE
           : wrap == TextureWrap::mirrored ? VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT
                                           : VK_SAMPLER_ADDRESS_MODE_REPEAT;
  };
  const int key = int(texture.wrap_u) + 3 * int(texture.wrap_v) + 9 * int(texture.linear);
  for (const auto& [have, one] : samplers_)
    if (have == key) return one.get();
  SamplerSpec spec;
  spec.linear = texture.linear;
  spec.across = mode(texture.wrap_u);
  spec.up = mode(texture.wrap_v);
  spec.anisotropy = texture.linear ? look_.anisotropy : 1.0f;
  return samplers_.emplace_back(key, make_sampler(device_, "solid texture", spec)).second.get();
}

// A picture is a texture for each kind of numbers that it is read as.
std::vector<std::array<const Image*, 3>> DrawnSolids::make_textures(const SolidModel& model, Drawn& drawn) {
  struct Wanted {
    std::size_t image;
    TexelKind kind;
    std::vector<Image8> levels;
  };
  std::vector<Wanted> wanted;
  for (const SolidMaterial& material : model.materials) {
    const auto textures = textures_of(material);
    for (std::size_t t = 0; t < textures.size(); ++t) {
      const TexelKind kind = kind_of(int(t));
      const std::size_t image = std::size_t(textures[t]->image);
      if (textures[t]->image >= 0 && std::none_of(wanted.begin(), wanted.end(), [&](const Wanted& have) {
            return have.image == image && have.kind == kind;
          }))
        wanted.push_back({image, kind, {}});
    }
  }
  tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) {
    wanted[i].levels = picture_levels(model.images[wanted[i].image], wanted[i].kind);
  });
  std::vector<std::array<const Image*, 3>> made(model.images.size(), {nullptr, nullptr, nullptr});
  drawn.textures.reserve(wanted.size());
  for (const Wanted& one : wanted)
    made[one.image][std::size_t(one.kind)] =
        &drawn.textures.emplace_back(make_texture(device_, model.name, one.levels, one.kind, look_.most_texels));
  return made;
}

void DrawnSolids::make_model(const SolidModel& model) {
  Drawn& drawn = drawn_.emplace_back();
  std::vector<SolidMaterial> materials = model.materials;
  materials.emplace_back();  // what has no material has glTF's default
  const std::vector<std::array<const Image*, 3>> made = make_textures(model, drawn);
  std::vector<std::byte> data(material_stride * materials.size());
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const gpu::SolidMaterialData one = data_of(materials[m]);
    std::memcpy(&data[m * material_stride], &one, sizeof one);
    Material& material = drawn.materials.emplace_back();
    material.blends = materials[m].alpha == AlphaMode::blend;
    material.double_sided = materials[m].double_sided;
    const auto textures = textures_of(materials[m]);
    for (std::size_t t = 0; t < textures.size(); ++t) {
      material.samplers[t] = sampler(*textures[t]);
      material.textures[t] = int(t) == gpu::solid_normal ? &flat_ : &white_;
      if (textures[t]->image < 0) continue;
      material.textures[t] = made[std::size_t(textures[t]->image)][std::size_t(kind_of(int(t)))];
    }
  }
  drawn.material_data =
      make_filled_buffer(device_, "solid materials", data.data(), data.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  for (const SolidMesh& mesh : model.meshes) {
    std::vector<Mesh>& primitives = drawn.meshes.emplace_back();
    for (const SolidPrimitive& source : mesh.primitives) {
      Mesh& primitive = primitives.emplace_back();
      primitive.material = source.material >= 0 ? std::size_t(source.material) : materials.size() - 1;
      primitive.count = std::uint32_t(source.indices.size());
      if (primitive.count == 0) continue;
      std::vector<gpu::SolidVertex> corners(source.positions.size());
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::vec2 first = source.uvs[0].empty() ? glm::vec2(0.0f) : source.uvs[0][i];
        corners[i] = {glm::vec4(source.positions[i], 1.0f), glm::vec4(source.normals[i], 0.0f),
                      glm::vec4(first, source.uvs[1].empty() ? first : source.uvs[1][i]),
                      source.colours.empty() ? glm::vec4(1.0f) : source.colours[i]};
      }
      primitive.vertices =
          make_filled_buffer(device_, model.name, corners.data(), corners.size() * sizeof corners.front(),
                             VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
      primitive.indices = make_filled_buffer(device_, model.name, source.indices.data(), source.indices.size() * 4,
                                             VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    }
  }
  bind(drawn);
}

void DrawnSolids::bind(Drawn& drawn) {
  for (Material& material : drawn.materials) {
    std::vector<Bound> entries{
        {.binding = gpu::slot_frame, .buffer = light_.frame_ring, .range = sizeof(gpu::FrameData)},
        {.binding = gpu::slot_sky_map, .view = light_.sky_map, .sampler = light_.sky_sampler},
        {.binding = gpu::slot_sky_light, .buffer = light_.sky_light},
        {.binding = gpu::slot_solid_material, .buffer = &drawn.material_data, .range = sizeof(gpu::SolidMaterialData)},
        {.binding = gpu::slot_solid_sky, .view = sky_.view(), .sampler = sky_sampler_.get()},
        {.binding = gpu::slot_solid_albedo, .view = albedo_.view(), .sampler = sky_sampler_.get()}};
    for (std::size_t t = 0; t < material.textures.size(); ++t)
      entries.push_back({.binding = std::uint32_t(gpu::slot_solid_base_colour) + std::uint32_t(t),
                         .view = material.textures[t]->view(),
                         .sampler = material.samplers[t]});
    if (look_.sun_map != nullptr)
      entries.push_back({.binding = gpu::slot_sun_map, .view = light_.sun_map, .sampler = light_.sun_map_sampler});
    if (!material.blends) {
      material.bindings = Bindings(device_, pipeline_, entries, "solid");
      if (look_.below != nullptr) material.in_water = Bindings(device_, in_water_pipeline_, entries, "solid in water");
      if (look_.sun_map != nullptr) material.casting = Bindings(device_, caster_pipeline_, entries, "solid casting");
      continue;
    }
    if (look_.depths)
      entries.push_back(
          {.binding = gpu::slot_sea_depths, .view = look_.depths->view(), .sampler = depth_sampler_.get()});
    material.blended = Bindings(device_, blended_pipeline_, entries, "solid blended");
  }
}

void DrawnSolids::resize(const Image* depths) {
  if (look_.depths == nullptr) return;
  const EffectScope scope(device_, "models");
  look_.depths = depths;
  for (Drawn& drawn : drawn_) bind(drawn);
}

void DrawnSolids::update(Frame& frame, const Image& sky_map, const glm::vec4& water_reflectance, bool sky_is_new,
                         std::span<const SolidThing> things, const Viewpoint& viewpoint, double time_s,
                         double highest_m, const ModelSettings& settings) {
  if (!lit_)
    frame.pass("solid albedo", {use(albedo_, Access::compute_write, true)}, [&](Commands& c) {
      c.bind(albedo_pipeline_, albedo_bindings_);
      c.dispatch(gpu::solid_albedo_side / 8, gpu::solid_albedo_side / 8, 1);
    });
  if (!lit_ || sky_is_new || lit_by_ != water_reflectance)
    frame.pass("solid sky",
               {use(sky_map, Access::compute_sample), use(*light_.sky_light, Access::compute_read),
                use(sky_, Access::compute_write, true)},
               [&](Commands& c) {
                 c.bind(sky_pipeline_, sky_bindings_);
                 c.push(gpu::SolidSkyPush{water_reflectance});
                 c.dispatch(gpu::solid_sky_side / 8, gpu::solid_sky_side / 8, gpu::solid_sky_layers);
               });
  lit_ = true;
  lit_by_ = water_reflectance;
  select_solids(models_, things, viewpoint, time_s, settings.detail, selection_);
  if (look_.below != nullptr)
    told_of_water_ = select_in_water(models_, things, viewpoint, time_s, settings.detail, highest_m, in_water_);
  slot_ = frame.slot();
  upload(selection_, instances_);
  upload(in_water_, in_water_instances_);
}

void DrawnSolids::upload(const SolidSelection& selection, const std::array<Buffer, Frame::slots>& room) const {
  if (selection.instances.empty()) return;
  std::memcpy(room[std::size_t(slot_)].mapped<gpu::SolidInstance>(), selection.instances.data(),
              selection.instances.size() * sizeof(gpu::SolidInstance));
}

void DrawnSolids::describe(gpu::FrameData& data) const {
  if (look_.below == nullptr) return;
  data.solids = told_of_water_;
  data.solids.reach.z = float(look_.below->spec().width);
  data.solids.reach.w = float(look_.below->spec().height);
}

void DrawnSolids::cast(gpu::FrameData& data, std::span<const SolidThing> things, const Viewpoint& viewpoint,
                       const ModelSettings& settings, double time_s) {
  if (look_.sun_map == nullptr) return;
  const glm::dvec3& viewer = viewpoint.viewer.position_m;
  const SunView sun =
      sun_view(glm::normalize(glm::dvec3(data.sun)), viewer, int(look_.sun_map->spec().width), settings.shadow_reach_m);
  select_casters(models_, things, viewpoint, sun, time_s, settings.detail, casters_);
  if (casters_.instances.empty()) return;
  sun.describe(data, viewer);
  upload(casters_, caster_instances_);
}

void DrawnSolids::draw_sun_map(Frame& frame, std::uint32_t frame_uniform) const {
  if (casters_.instances.empty()) return;
  frame.draw_pass("sun map", *look_.sun_map, {}, [&](Commands& c) {
    for (const SolidDraw& draw : casters_.draws) {
      const Drawn& drawn = drawn_[draw.model];
      const SolidPart& part = models_[draw.model].parts()[draw.part];
      for (const Mesh& primitive : drawn.meshes[std::size_t(part.mesh)]) {
        const Material& material = drawn.materials[primitive.material];
        if (primitive.count == 0 || material.blends) continue;
        c.bind(caster_pipeline_, material.casting,
               {frame_uniform, std::uint32_t(primitive.material * material_stride)});
        c.bind_vertices({&primitive.vertices, 0, nullptr}, 0);
        c.bind_vertices({&caster_instances_[std::size_t(slot_)], draw.first * sizeof(gpu::SolidInstance), nullptr}, 1);
        c.bind_indices(primitive.indices, VK_INDEX_TYPE_UINT32);
        c.draw_indexed(primitive.count, std::uint32_t(draw.count));
      }
    }
  });
}

void DrawnSolids::add_uses(Uses& uses) const {
  if (look_.sun_map != nullptr) uses.add(use(*look_.sun_map->depth(), Access::fragment_sample));
  uses.add(use(sky_, Access::fragment_sample));
  uses.add(use(albedo_, Access::fragment_sample));
}

void DrawnSolids::draw(Commands& commands, std::uint32_t frame_uniform, Kind kind) const {
  const bool blended = kind == Kind::blended;
  const Pipeline& pipeline = blended ? blended_pipeline_ : kind == Kind::opaque ? pipeline_ : in_water_pipeline_;
  const SolidSelection& selection = kind == Kind::in_water ? in_water_ : selection_;
  const Buffer& instances = (kind == Kind::in_water ? in_water_instances_ : instances_)[std::size_t(slot_)];
  for (std::size_t i = 0; i < selection.draws.size(); ++i) {
    const SolidDraw& draw = selection.draws[blended ? selection.far_first[i] : i];
    const Drawn& drawn = drawn_[draw.model];
    const SolidPart& part = models_[draw.model].parts()[draw.part];
    for (const Mesh& primitive : drawn.meshes[std::size_t(part.mesh)]) {
      const Material& material = drawn.materials[primitive.material];
      if (primitive.count == 0 || material.blends != blended) continue;
      commands.bind(pipeline,
                    blended                ? material.blended
                    : kind == Kind::opaque ? material.bindings
                                           : material.in_water,
                    {frame_uniform, 0u, std::uint32_t(primitive.material * material_stride)},
                    !material.double_sided && !part.mirrored);
      commands.push(gpu::DrawPush{commands.eye()});
      commands.bind_vertices({&primitive.vertices, 0, nullptr}, 0);
      commands.bind_vertices({&instances, draw.first * sizeof(gpu::SolidInstance), nullptr}, 1);
      commands.bind_indices(primitive.indices, VK_INDEX_TYPE_UINT32);
      commands.draw_indexed(primitive.count, std::uint32_t(draw.count));
    }
  }
}

}  // namespace seascape
