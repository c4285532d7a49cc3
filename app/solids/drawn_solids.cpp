#include "app/solids/drawn_solids.h"

#include <algorithm>
#include <cstring>

#include "shaders/shared/frame_data.h"

namespace seascape {

DrawnSolids::DrawnSolids(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const SurfaceLight& light,
                         const SolidSources& sources, const SolidLook& look)
    : device_(device), shaders_(shaders), from_(sources), light_(light), look_(look) {
  const EffectScope scope(device, "models");
  if (look.depths) depth_sampler_ = make_sampler(device, "solid depths", {.linear = false, .repeat = false});
  make_pipelines(picture);
  if (look_.sun_map != nullptr) make_caster_pipeline();
  bound_.resize(from_.loaded->size());
  for (std::size_t model = 0; model < bound_.size(); ++model) bind(model);
  make_room(sources.things);
}

void DrawnSolids::make_room(std::span<const SolidThing> things) {
  std::size_t most = 0, parts = 0;
  for (const SolidThing& thing : things) most += from_.models[thing.model].most_parts();
  std::size_t nodes = 0;  // of the largest that moves
  for (const PlacedModel& model : from_.models) {
    parts += model.parts().size();
    if (!model.model().animations.empty()) nodes = std::max(nodes, model.model().nodes.size());
  }
  const auto reserve = [&](SolidSelection& selection, std::size_t pictures) {
    selection.seen.reserve(things.size());
    selection.instances.reserve(most * pictures);
    selection.draws.reserve(parts);
    selection.far_first.reserve(parts);
    selection.moved.nodes.reserve(nodes);
    selection.moved.placed.reserve(nodes);
  };
  const auto make = [&](SolidSelection& selection, Room& instances, std::size_t pictures = 1) {
    reserve(selection, pictures);
    for (Buffer& buffer : instances)
      buffer =
          Buffer(device_, "solid instances", std::max(most * pictures, std::size_t{1}) * sizeof(gpu::SolidInstance),
                 VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, HostAccess::write);
  };
  make(selection_, instances_);
  if (look_.below != nullptr) make(in_water_, in_water_instances_);
  if (look_.above != nullptr) make(above_, above_instances_, gpu::solids_above_sides);
  if (look_.sun_map != nullptr) make(casters_, caster_instances_);
}

void DrawnSolids::make_pipelines(const RenderTarget& picture) {
  GraphicsSpec spec;
  spec.vertex = "solid.vert";
  spec.fragment = look_.points ? "solid_points.frag" : "solid.frag";
  spec.values = {{gpu::value_multiview, !picture.spec().per_eye},
                 {gpu::value_tile_shape, look_.tile_shape},
                 {gpu::value_sun_map, light_.sun_map != VK_NULL_HANDLE},
                 {gpu::value_anisotropy, std::bit_cast<std::uint32_t>(look_.anisotropy)},
                 {gpu::value_lamp, look_.underwater}};
  spec.buffers = {{0, sizeof(gpu::SolidVertex), VK_VERTEX_INPUT_RATE_VERTEX},
                  {1, sizeof(gpu::SolidInstance), VK_VERTEX_INPUT_RATE_INSTANCE}};
  for (std::uint32_t i = 0; i < 4; ++i) spec.attributes.push_back({i, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 16 * i});
  for (std::uint32_t i = 0; i < 3; ++i) spec.attributes.push_back({4 + i, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 16 * i});
  spec.facing = true;
  const auto make = [&](GraphicsSpec one, Pipeline& opaque, Pipeline& blended) {
    opaque = make_graphics_pipeline(device_, shaders_, look_.points ? *look_.points : picture, one);
    one.fragment = "solid.frag";
    one.blend = true;
    one.depth_write = false;
    one.values.push_back({gpu::value_blend, true});
    one.values.push_back({gpu::value_depth_sampled, look_.depths != nullptr});
    if (look_.points) one.stencil = Stencil::none;
    blended = make_graphics_pipeline(device_, shaders_, picture, one);
  };
  make(spec, pipeline_, blended_pipeline_);
  if (look_.underwater) {
    const EffectScope scope(device_, "underwater");
    GraphicsSpec one = spec;
    one.stencil = Stencil::in_air;
    make(one, air_side_.opaque, air_side_.blended);
    one.stencil = Stencil::in_water;
    one.values.push_back({gpu::value_underwater, 1});
    look_.shapes.add_to(one.values);
    make(one, water_side_.opaque, water_side_.blended);
  }
  if (look_.below == nullptr) return;
  spec.fragment = "solid_below.frag";
  spec.blend = false;
  spec.depth_write = true;
  spec.values = {{gpu::value_multiview, !picture.spec().per_eye},
                 {gpu::value_wide, true},
                 {gpu::value_sun_map, light_.sun_map != VK_NULL_HANDLE}};
  in_water_pipeline_ = make_graphics_pipeline(device_, shaders_, *look_.below, spec);
  if (look_.above == nullptr) return;
  spec.vertex = "solid_above.vert";
  spec.fragment = "solid_above.frag";
  spec.values = {{gpu::value_sun_map, light_.sun_map != VK_NULL_HANDLE}};
  spec.attributes.push_back({7, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 48});
  above_pipeline_ = make_graphics_pipeline(device_, shaders_, *look_.above, spec);
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
  caster_pipeline_ = make_graphics_pipeline(device_, shaders_, look_.sun_map->target(), spec);
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

void DrawnSolids::bind(std::size_t model) {
  const LoadedModels::Loaded& loaded = (*from_.loaded)[model];
  bound_[model].clear();
  for (const LoadedModels::Material& material : loaded.materials) {
    const SolidSurroundings& around = *from_.around;
    Bound& made = bound_[model].emplace_back();
    std::vector<seascape::Bound> entries{
        {.binding = gpu::slot_frame, .buffer = light_.frame_ring, .range = sizeof(gpu::FrameData)},
        {.binding = gpu::slot_sky_map, .view = light_.sky_map, .sampler = light_.sky_sampler},
        {.binding = gpu::slot_sky_light, .buffer = light_.sky_light},
        {.binding = gpu::slot_solid_material, .buffer = &loaded.material_data, .range = sizeof(gpu::SolidMaterialData)},
        {.binding = gpu::slot_solid_sky, .view = around.sky().view(), .sampler = around.sampler()},
        {.binding = gpu::slot_solid_albedo, .view = around.albedo().view(), .sampler = around.sampler()}};
    for (std::size_t t = 0; t < material.textures.size(); ++t)
      entries.push_back({.binding = std::uint32_t(gpu::slot_solid_base_colour) + std::uint32_t(t),
                         .view = material.textures[t]->view(),
                         .sampler = sampler(material.looks[t])});
    if (light_.sun_map != VK_NULL_HANDLE)
      entries.push_back({.binding = gpu::slot_sun_map, .view = light_.sun_map, .sampler = light_.sun_map_sampler});
    if (!material.blends) {
      made.shown = Bindings(device_, pipeline_, entries, "solid");
      if (look_.underwater) made.shown_underwater = Bindings(device_, water_side_.opaque, entries, "solid underwater");
      if (look_.below != nullptr) made.in_water = Bindings(device_, in_water_pipeline_, entries, "solid in water");
      if (look_.above != nullptr) made.above = Bindings(device_, above_pipeline_, entries, "solid above water");
      if (look_.sun_map != nullptr) made.casting = Bindings(device_, caster_pipeline_, entries, "solid casting");
      continue;
    }
    if (look_.depths)
      entries.push_back(
          {.binding = gpu::slot_sea_depths, .view = look_.depths->view(), .sampler = depth_sampler_.get()});
    made.shown = Bindings(device_, blended_pipeline_, entries, "solid blended");
    if (look_.underwater) made.shown_underwater = Bindings(device_, water_side_.blended, entries, "solid underwater");
  }
}

void DrawnSolids::resize(const Image* depths) {
  if (look_.depths == nullptr) return;
  const EffectScope scope(device_, "models");
  look_.depths = depths;
  for (std::size_t model = 0; model < bound_.size(); ++model) bind(model);
}

void DrawnSolids::update(Frame& frame, const Viewpoint& viewpoint, double time_s, const NearWaterSight& water,
                         const ModelSettings& settings) {
  select_solids(from_.models, things(), viewpoint, time_s, settings.detail, selection_, water);
  if (look_.below != nullptr)
    told_of_water_ = select_in_water(from_.models, water.from_above ? things() : std::span<const SolidThing>(),
                                     viewpoint, time_s, settings.detail, water.highest_m, in_water_);
  slot_ = frame.slot();
  upload(selection_, instances_);
  upload(in_water_, in_water_instances_);
  nearest_above_m_ = 0.0;
  if (look_.above == nullptr || !water.middle_m) return;
  const glm::dvec3& viewer_m = viewpoint.viewer.position_m;
  nearest_above_m_ = select_above(from_.models, things(), viewpoint, *water.middle_m, time_s, settings.detail,
                                  water.highest_m, above_);
  told_of_water_.above = glm::vec4(glm::vec3(*water.middle_m - viewer_m), float(nearest_above_m_));
  upload(above_, above_instances_);
}

void DrawnSolids::upload(const SolidSelection& selection, const Room& room) const {
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

void DrawnSolids::cast(gpu::FrameData& data, const Viewpoint& viewpoint, const ModelSettings& settings, double time_s) {
  if (look_.sun_map == nullptr) return;
  const glm::dvec3& viewer = viewpoint.viewer.position_m;
  sun_ = sun_view(glm::normalize(glm::dvec3(data.sun)), viewer, int(look_.sun_map->target().spec().width),
                  settings.shadow_reach_m);
  sun_.share = look_.sun_map->share();
  select_casters(from_.models, things(), viewpoint, sun_, time_s, settings.detail, casters_);
  if (casters_.instances.empty()) return;
  describe_sun(data, viewer);
  upload(casters_, caster_instances_);
}

void DrawnSolids::describe_sun(gpu::FrameData& data, const glm::dvec3& viewer_m) const {
  if (!casters_.instances.empty()) sun_.describe(data, viewer_m);
}

void DrawnSolids::draw_sun_map(Frame& frame, std::uint32_t frame_uniform) const {
  if (casters_.instances.empty()) return;
  frame.draw_pass("sun map", look_.sun_map->target(), {}, [&](Commands& c) {
    for (const SolidDraw& draw : casters_.draws) {
      const LoadedModels::Loaded& loaded = (*from_.loaded)[draw.model];
      const SolidPart& part = from_.models[draw.model].parts()[draw.part];
      for (const LoadedModels::Primitive& primitive : loaded.meshes[std::size_t(part.mesh)]) {
        const LoadedModels::Material& material = loaded.materials[primitive.material];
        const Bound& bound = bound_[draw.model][primitive.material];
        if (primitive.count == 0 || material.blends) continue;
        c.bind(caster_pipeline_, bound.casting,
               {frame_uniform, std::uint32_t(primitive.material * solid_material_stride)});
        c.bind_vertices({&primitive.vertices, 0, nullptr}, 0);
        c.bind_vertices({&caster_instances_[std::size_t(slot_)], draw.first * sizeof(gpu::SolidInstance), nullptr}, 1);
        c.bind_indices(primitive.indices, VK_INDEX_TYPE_UINT32);
        c.draw_indexed(primitive.count, std::uint32_t(draw.count));
      }
    }
  });
}

void DrawnSolids::add_uses(Uses& uses) const {
  if (look_.sun_map != nullptr) uses.add(use(*look_.sun_map->target().depth(), Access::fragment_sample));
  from_.around->add_uses(uses);
}

void DrawnSolids::draw_for_refraction(Frame& frame, const Uses& uses, std::uint32_t frame_uniform) const {
  if (any_in_water())
    frame.draw_pass("below", *look_.below, uses, [&](Commands& c) {
      draw(c, frame_uniform, in_water_pipeline_, &Bound::in_water, {in_water_, in_water_instances_});
    });
  if (any_above())
    frame.draw_pass("above", *look_.above, uses, [&](Commands& c) {
      draw(c, frame_uniform, above_pipeline_, &Bound::above, {above_, above_instances_});
    });
}

void DrawnSolids::draw(Commands& commands, std::uint32_t frame_uniform, bool blended, EyesIn eyes) const {
  using Through = How::Through;
  const auto one = [&](const Pipeline& pipeline, Bindings Bound::*bindings, Through through) {
    draw(commands, frame_uniform, pipeline, bindings, {selection_, instances_, blended, through});
  };
  if (eyes == EyesIn::air || !look_.underwater)
    return one(blended ? blended_pipeline_ : pipeline_, &Bound::shown, look_.underwater ? Through::air : Through::any);
  // Where the sea is lit later no stencil says whose eye is where, for what lets light through.
  const bool by_pixel = eyes == EyesIn::either && !(blended && look_.points);
  if (eyes == EyesIn::either)
    one(blended ? air_side_.blended : air_side_.opaque, &Bound::shown, by_pixel ? Through::air : Through::any);
  if (eyes == EyesIn::water || by_pixel)
    one(blended ? water_side_.blended : water_side_.opaque, &Bound::shown_underwater, Through::water);
}

void DrawnSolids::draw(Commands& commands, std::uint32_t frame_uniform, const Pipeline& pipeline,
                       Bindings Bound::*bindings, const How& how) const {
  using Through = How::Through;
  const SolidSelection& selection = how.selection;
  for (std::size_t i = 0; i < selection.draws.size(); ++i) {
    const SolidDraw& draw = selection.draws[how.blended ? selection.far_first[i] : i];
    const std::size_t count = how.through == Through::water                      ? draw.through_water
                              : how.through == Through::air && !draw.through_air ? 0
                                                                                 : draw.count;
    if (count == 0) continue;
    const LoadedModels::Loaded& loaded = (*from_.loaded)[draw.model];
    const SolidPart& part = from_.models[draw.model].parts()[draw.part];
    const std::size_t turned = part.mirrored ? loaded.meshes.size() / 2 : 0;
    for (const LoadedModels::Primitive& primitive : loaded.meshes[turned + std::size_t(part.mesh)]) {
      const LoadedModels::Material& material = loaded.materials[primitive.material];
      const Bound& bound = bound_[draw.model][primitive.material];
      if (primitive.count == 0 || material.blends != how.blended) continue;
      commands.bind(pipeline, bound.*bindings,
                    {frame_uniform, 0u, std::uint32_t(primitive.material * solid_material_stride)},
                    !material.double_sided);
      commands.push(gpu::DrawPush{commands.eye()});
      commands.bind_vertices({&primitive.vertices, 0, nullptr}, 0);
      commands.bind_vertices(
          {&how.instances[std::size_t(slot_)], (draw.first + draw.count - count) * sizeof(gpu::SolidInstance), nullptr},
          1);
      commands.bind_indices(primitive.indices, VK_INDEX_TYPE_UINT32);
      commands.draw_indexed(primitive.count, std::uint32_t(count));
    }
  }
}

}  // namespace seascape
