#include "ocean/surface/surface.h"

#include <algorithm>
#include <bit>

#include "ocean/mesh/patch_mesh.h"
#include "shaders/shared/frame_data.h"

namespace seascape {

namespace {
// Where a tile source's layings are counted and its three images bound (shaders/lib/sea.glsl).
struct SourceSlot {
  std::string_view name;
  std::uint32_t constant, binding;
  bool along_curves = false;
  bool of(const TileSource& source) const { return source.name() == name && source.along_curves() == along_curves; }
};
constexpr SourceSlot slots[] = {
    {"baked", 12, 22}, {"gerstner", 11, 19}, {"gerstner", 28, 44, true}, {"wave_particles", 8, 12}};

// The same of the data of places.
struct PlaceSlot {
  InputTarget kind;
  std::uint32_t constant, binding;
};
constexpr PlaceSlot place_slots[] = {{InputTarget::level, 14, 27},  {InputTarget::sea_depth, 15, 15},
                                     {InputTarget::flow, 16, 29},   {InputTarget::clip, 17, 30},
                                     {InputTarget::albedo, 18, 31}, {InputTarget::shadow, 19, 32}};

// What surface_points.frag writes, for pictures like `picture`.
RenderTarget make_points(Device& device, const RenderTarget& picture, float anisotropy) {
  TargetSpec spec;
  spec.width = picture.spec().width;
  spec.height = picture.spec().height;
  spec.views = picture.spec().views;
  spec.per_eye = picture.spec().per_eye;
  spec.colour = VK_FORMAT_R32G32B32A32_UINT;
  if (anisotropy > 1.0f) spec.second = VK_FORMAT_R32G32_UINT;  // the footprint's two axes
  spec.keep_depth = true;
  spec.clear_colour = false;
  return RenderTarget(device, "surface points", spec);
}

}  // namespace

Surface::Surface(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const WaveImages& waves,
                 std::span<const std::unique_ptr<DrawnSource>> sources, const DrawnDynamicWaves* dynamic_waves,
                 const DrawnPlace* place, const DrawnFoam* foam, const Buffer& frame_ring, const SurfaceLight& light,
                 const SurfaceLook& look)
    : device_(device), waves_(waves), look_(look) {
  const EffectScope scope(device, "surface");
  const auto of_one = patch_indices(gpu::patch_quads);
  constexpr int vertices_a_patch = (gpu::patch_quads + 1) * (gpu::patch_quads + 1);
  static_assert(gpu::patches_an_instance * vertices_a_patch <= 65536, "indices have 16 bits");
  std::vector<std::uint16_t> indices;
  for (int patch = 0; patch < gpu::patches_an_instance; ++patch)
    for (const std::uint16_t index : of_one) indices.push_back(std::uint16_t(patch * vertices_a_patch + index));
  index_count_ = std::uint32_t(indices.size());
  indices_ =
      make_filled_buffer(device, "patch indices", indices.data(), indices.size() * 2, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  GraphicsSpec spec;
  spec.vertex = "surface.vert";
  spec.fragment = look.deferred ? "surface_points.frag" : "surface.frag";
  spec.values = {{0, !picture.spec().per_eye},
                 {1, look.probe},
                 {2, look.tile_shape},
                 {3, look.foam},
                 {4, look.debug},
                 {5, std::bit_cast<std::uint32_t>(look.anisotropy)},
                 {7, std::uint32_t(waves.cascades())},
                 {10, look.deferred},
                 {13, dynamic_waves != nullptr ? dynamic_waves->shift().spec().layers : 0u}};
  spec.values.push_back({21, foam != nullptr});
  for (const PlaceSlot& slot : place_slots) {
    const bool bed = slot.kind == InputTarget::sea_depth;
    spec.values.push_back({slot.constant, place == nullptr ? 0u
                                          : bed            ? std::uint32_t(place->image(slot.kind) != nullptr)
                                                           : std::uint32_t(place->laid(slot.kind))});
  }
  const DrawnClip* clip = place != nullptr ? place->clip_volumes() : nullptr;
  const bool flat_clip = place != nullptr && place->image(InputTarget::clip) != nullptr;
  for (SpecValue& value : spec.values)
    if (value.id == 17) value.value = flat_clip || clip != nullptr;
  const bool bed =
      place != nullptr && place->image(InputTarget::sea_depth) != nullptr;  // what is clipped then lies dry
  if ((flat_clip || clip != nullptr) && !bed && !look.deferred && picture.spec().samples > 1 &&
      device.facts().sample_shading) {
    spec.fragment = "surface_clip.frag";
    spec.values.push_back({9, std::uint32_t(picture.spec().samples)});
  }
  spec.values.push_back({24, (flat_clip ? 1u : 0u) | (clip != nullptr ? 2u : 0u) |
                                 (clip != nullptr && clip->hulls() != nullptr ? 4u : 0u)});
  for (const SourceSlot& slot : slots) spec.values.push_back({slot.constant, 0});
  for (const auto& source : sources)
    for (std::size_t i = 0; i < std::size(slots); ++i)
      if (slots[i].of(source->source()))
        spec.values[spec.values.size() - std::size(slots) + i].value = std::uint32_t(source->source().layings().size());
  spec.buffers = {{0, gpu::patches_an_instance * sizeof(gpu::PatchInstance), VK_VERTEX_INPUT_RATE_INSTANCE}};
  for (std::uint32_t patch = 0; patch < std::uint32_t(gpu::patches_an_instance); ++patch)
    spec.attributes.push_back(
        {patch, 0, VK_FORMAT_R32G32B32A32_SINT, patch * std::uint32_t(sizeof(gpu::PatchInstance))});
  spec.wireframe = look.wireframe && device.facts().wireframe;
  if (look.deferred) points_ = make_points(device, picture, look.anisotropy);
  // The surface is one sheet between water and air, so that a line of sight that begins in the air meets it from above
  // first.
  spec.facing = !spec.wireframe;
  pipeline_ = make_graphics_pipeline(device, shaders, target(picture), spec);
  entries_ = {
      {.binding = 0, .buffer = &frame_ring, .range = sizeof(gpu::FrameData)},
      {.binding = 4, .view = light.sky_map, .sampler = light.sky_sampler},
      {.binding = 5, .buffer = light.sky_light},
      {.binding = 50, .sampler = waves.smooth_sampler()},  // of all images of the sea
      {.binding = 51, .sampler = waves.pixel_sampler()},
  };
  for (const auto& source : sources)
    for (const SourceSlot& slot : slots) {
      if (!slot.of(source->source())) continue;
      entries_.push_back({.binding = slot.binding, .view = source->displacement().view()});
      entries_.push_back({.binding = slot.binding + 1, .view = source->derivatives().view()});
      entries_.push_back({.binding = slot.binding + 2, .view = source->moments().view()});
    }
  if (dynamic_waves != nullptr) {
    entries_.push_back({.binding = 25, .view = dynamic_waves->shift().view()});
    entries_.push_back({.binding = 26, .view = dynamic_waves->slope().view()});
  }
  if (foam != nullptr) {
    entries_.push_back({.binding = 34, .view = foam->windows().view()});
    entries_.push_back({.binding = 35, .view = foam->lace().view()});
  }
  for (const PlaceSlot& slot : place_slots)
    if (place != nullptr && place->image(slot.kind) != nullptr)
      entries_.push_back({.binding = slot.binding, .view = place->image(slot.kind)->view()});
  if (place != nullptr && place->bed_waves() != nullptr)
    entries_.push_back({.binding = 28, .view = place->bed_waves()->view()});
  if (clip != nullptr) {
    entries_.push_back({.binding = 38, .buffer = &clip->node_buffer()});
    entries_.push_back({.binding = 39, .buffer = &clip->volume_buffer()});
    if (clip->hulls() != nullptr) entries_.push_back({.binding = 40, .view = clip->hulls()->view()});
  }
  if (place != nullptr && place->shore() != nullptr) {
    entries_.push_back({.binding = 47, .view = place->shore()->lines().view()});
    entries_.push_back({.binding = 48, .view = place->shore()->ways().view()});
  }
  if (look.probe) {
    constexpr auto vertices = VkDeviceSize(gpu::patch_quads + 1) * VkDeviceSize(gpu::patch_quads + 1);
    probe_ = Buffer(device, "probe", probe_patches * vertices * 32,
                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    entries_.push_back({.binding = 8, .buffer = &probe_});
  }
  for (std::size_t copy = 0; copy < waves.copies().size(); ++copy)
    bindings_.emplace_back(device, pipeline_, entries(copy), "surface");
  if (!look.deferred) return;
  GraphicsSpec once;
  once.vertex = "sky.vert";
  once.fragment = "surface_light.frag";
  once.values = spec.values;
  once.depth_test = once.depth_write = false;
  light_pipeline_ = make_graphics_pipeline(device, shaders, picture, once);
  points_sampler_ = make_sampler(device, "surface points", {false, false, 1.0f});
  bind_light();
}

std::vector<Bound> Surface::entries(std::size_t copy) const {
  std::vector<Bound> list = entries_;
  const VkImageLayout layout = waves_.read_layout();
  for (const WaveImages::Set& set : waves_.copies()[copy]) {
    const std::uint32_t first = set.first == 0 ? 1 : 9;  // shaders/lib/sea.glsl
    list.push_back({.binding = first, .view = set.displacement.view(), .layout = layout});
    list.push_back({.binding = first + 1, .view = set.derivatives.view(), .layout = layout});
    list.push_back({.binding = first + 2, .view = set.moments.view(), .layout = layout});
  }
  return list;
}

void Surface::bind_light() {
  light_bindings_.clear();
  for (std::size_t copy = 0; copy < waves_.copies().size(); ++copy) {
    std::vector<Bound> list = entries(copy);
    list.push_back({.binding = 16, .view = points_.colour().view(), .sampler = points_sampler_.get()});
    if (points_.second() != nullptr)
      list.push_back({.binding = 17, .view = points_.second()->view(), .sampler = points_sampler_.get()});
    list.push_back({.binding = 18, .view = points_.depth()->view(), .sampler = points_sampler_.get()});
    light_bindings_.emplace_back(device_, light_pipeline_, list, "surface light");
  }
}

void Surface::resize(const RenderTarget& picture) {
  if (!look_.deferred) return;
  const EffectScope scope(device_, "surface");
  points_ = make_points(device_, picture, look_.anisotropy);
  bind_light();
}

void Surface::add_points(Uses& uses) const {
  uses.add(use(points_.colour(), Access::fragment_sample));
  if (points_.second() != nullptr) uses.add(use(*points_.second(), Access::fragment_sample));
  uses.add(use(*points_.depth(), Access::fragment_sample));
}

void Surface::light(Commands& commands, std::uint32_t frame_uniform) const {
  commands.bind(light_pipeline_, light_bindings_[waves_.shown()], {frame_uniform, 0u});
  commands.push(gpu::DrawPush{commands.eye()});
  commands.draw(3);
}

void Surface::draw(Commands& commands, Frame& frame, const SurfaceSelection& selection, std::uint32_t frame_uniform,
                   bool from_air) const {
  if (selection.patches.empty()) return;
  constexpr std::size_t group = gpu::patches_an_instance;
  const std::size_t instances = (selection.patches.size() + group - 1) / group;
  const VertexList list = frame.vertices(instances * group * sizeof(gpu::PatchInstance));
  const std::size_t missing = instances * group - selection.patches.size();
  auto* filled =
      std::copy(selection.patches.begin(), selection.patches.end(), static_cast<gpu::PatchInstance*>(list.host));
  std::fill_n(filled, missing, gpu::PatchInstance{selection.patches.back().corner, 1, gpu::patch_nothing});
  commands.bind(pipeline_, bindings_[waves_.shown()], {frame_uniform, 0u}, from_air);
  commands.push(gpu::DrawPush{commands.eye()});
  commands.bind_vertices(list);
  commands.bind_indices(indices_, VK_INDEX_TYPE_UINT16);
  commands.draw_indexed(index_count_, std::uint32_t(instances), missing * 2u * gpu::patch_quads * gpu::patch_quads);
}

}  // namespace seascape
