#include "ocean/surface/surface.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "ocean/mesh/bed_mesh.h"
#include "ocean/mesh/patch_mesh.h"
#include "shaders/shared/frame_data.h"
#include "shaders/shared/solids_above.h"

namespace seascape {

static_assert(gpu::side_in_air == stencil_in_air);

namespace {
// What surface_points.frag writes, for pictures like `picture`.
RenderTarget make_points(Device& device, const RenderTarget& picture, const SurfaceLook& look) {
  TargetSpec spec;
  spec.width = picture.spec().width;
  spec.height = picture.spec().height;
  spec.views = picture.spec().views;
  spec.per_eye = picture.spec().per_eye;
  spec.colour = VK_FORMAT_R32G32B32A32_UINT;
  if (look.anisotropy > 1.0f) spec.second = VK_FORMAT_R32G32_UINT;  // the footprint's two axes
  spec.keep_depth = true;
  spec.stencil = look.underwater;
  spec.clear_colour = false;
  return RenderTarget(device, "surface points", spec);
}

// What solid_below.frag writes, for pictures like `picture`.
RenderTarget make_below(Device& device, const RenderTarget& picture) {
  const EffectScope scope(device, "models");
  TargetSpec spec;
  spec.width = picture.spec().width;
  spec.height = picture.spec().height;
  spec.views = picture.spec().views;
  spec.per_eye = picture.spec().per_eye;
  spec.colour = VK_FORMAT_R16G16B16A16_SFLOAT;
  spec.clear = {0.0f, 0.0f, 0.0f, 0.0f};
  return RenderTarget(device, "below the water", spec);
}

// What solid_above.frag writes for a picture `height` pixels high: about half as fine, as waves blur what is seen in
// it.
RenderTarget make_above(Device& device, std::uint32_t height) {
  const EffectScope scope(device, "models");
  TargetSpec spec;
  spec.height = std::clamp(height / 2, 64u, 768u);
  spec.width = std::uint32_t(gpu::solids_above_sides) * spec.height;
  spec.colour = VK_FORMAT_R16G16B16A16_SFLOAT;
  spec.clear = {0.0f, 0.0f, 0.0f, 0.0f};
  return RenderTarget(device, "above the water", spec);
}

}  // namespace

void ShapesInWater::add_to(std::vector<SpecValue>& values) const {
  if (air > 0) values.push_back({std::uint32_t(gpu::value_air_pockets), std::uint32_t(air)});
  if (portals > 0) values.push_back({std::uint32_t(gpu::value_portals), std::uint32_t(portals)});
}

Surface::Surface(Device& device, ShaderLibrary& shaders, const RenderTarget& picture,
                 std::span<const std::unique_ptr<DrawnPiece>> pieces, const SurfaceLight& light,
                 const SurfaceLook& look)
    : device_(device), look_(look) {
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
  std::size_t copies = 1;
  for (const auto& piece : pieces) {
    if (piece->copies() == 1) continue;
    assert(copied_ == nullptr && "two pieces have copies: which belong together?");
    copied_ = piece.get();
    copies = piece->copies();
  }
  std::vector<SurfaceSlots> slots(copies);
  for (std::size_t copy = 0; copy < copies; ++copy)
    for (const auto& piece : pieces) piece->declare(slots[copy], piece.get() == copied_ ? copy : 0);
  if (look.foam) slots[0].set("foam", gpu::value_foam, 1);
  spec.values = slots[0].values();
  effect_values_ = slots[0].effects();
  const auto set = [&](int constant, std::uint32_t value) { spec.values.push_back({std::uint32_t(constant), value}); };
  set(gpu::value_multiview, !picture.spec().per_eye);
  set(gpu::value_probe, look.probe);
  set(gpu::value_tile_shape, look.tile_shape);
  set(gpu::value_debug, look.debug);
  set(gpu::value_anisotropy, std::bit_cast<std::uint32_t>(look.anisotropy));
  set(gpu::value_deferred, look.deferred);
  if (look.below) set(gpu::value_solids_in_water, 1);
  look.shapes.add_to(spec.values);
  if (look.underwater) set(gpu::value_lamp, 1);
  if (look.shapes.air > 0) effect_values_.push_back({"portals", gpu::value_air_pockets});
  if (look.shapes.portals > 0) effect_values_.push_back({"portals", gpu::value_portals});
  set(gpu::value_sun_map, light.sun_map != VK_NULL_HANDLE);
  // Over a bed what is clipped lies dry.
  const bool clipped = slots[0].value(gpu::value_clip) != 0 && slots[0].value(gpu::value_bed) == 0;
  if (clipped && !look.deferred && picture.spec().samples > 1 && device.facts().sample_shading) {
    spec.fragment = "surface_clip.frag";
    set(gpu::value_clip_samples, std::uint32_t(picture.spec().samples));
  }
  spec.buffers = {{0, gpu::patches_an_instance * sizeof(gpu::PatchInstance), VK_VERTEX_INPUT_RATE_INSTANCE}};
  for (std::uint32_t patch = 0; patch < std::uint32_t(gpu::patches_an_instance); ++patch)
    spec.attributes.push_back(
        {patch, 0, VK_FORMAT_R32G32B32A32_SINT, patch * std::uint32_t(sizeof(gpu::PatchInstance))});
  spec.wireframe = look.wireframe && device.facts().wireframe;
  if (look.deferred) points_ = make_points(device, picture, look);
  if (look.below && look.underwater) above_ = make_above(device, picture.spec().height);
  if (look.below) below_ = make_below(device, picture);
  // The surface is one sheet between water and air, so that a line of sight that begins in the air meets it from above
  // first.
  spec.facing = !spec.wireframe;
  in_air_.pipeline = make_graphics_pipeline(device, shaders, target(picture), spec);
  std::vector<Bound> own{
      {.binding = gpu::slot_frame, .buffer = light.frame_ring, .range = sizeof(gpu::FrameData)},
      {.binding = gpu::slot_sky_map, .view = light.sky_map, .sampler = light.sky_sampler},
      {.binding = gpu::slot_sky_light, .buffer = light.sky_light},
  };
  if (light.sun_map != VK_NULL_HANDLE)
    own.push_back({.binding = gpu::slot_sun_map, .view = light.sun_map, .sampler = light.sun_map_sampler});
  if (look.probe) {
    constexpr auto vertices = VkDeviceSize(gpu::patch_quads + 1) * VkDeviceSize(gpu::patch_quads + 1);
    probe_ = Buffer(device, "probe", probe_patches * vertices * 32,
                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    own.push_back({.binding = gpu::slot_probe, .buffer = &probe_});
  }
  for (const SurfaceSlots& of_copy : slots) {
    std::vector<Bound>& entries = entries_.emplace_back(own);
    entries.insert(entries.end(), of_copy.bound().begin(), of_copy.bound().end());
  }
  if (look.deferred) {
    points_sampler_ = make_sampler(device, "surface points", {false, false, 1.0f});
    std::vector<SpecValue> values = spec.values;
    values.push_back({std::uint32_t(gpu::value_models), look.solids});
    make_light(shaders, picture, in_air_, std::move(values));
  }
  if (look.underwater) make_underwater(shaders, picture, std::move(spec));
  bind();
}

// What lights all pixels once.
void Surface::make_light(ShaderLibrary& shaders, const RenderTarget& picture, Drawing& drawing,
                         std::vector<SpecValue> values) {
  GraphicsSpec once;
  once.vertex = "sky.vert";
  once.fragment = "surface_light.frag";
  once.values = std::move(values);
  once.values.push_back({std::uint32_t(gpu::value_hidden), look_.hidden});
  once.depth_test = once.depth_write = false;
  drawing.light = make_graphics_pipeline(device_, shaders, picture, once);
}

// `spec`: of the surface for eyes in the air.
void Surface::make_underwater(ShaderLibrary& shaders, const RenderTarget& picture, GraphicsSpec spec) {
  const EffectScope scope(device_, "underwater");
  const auto set = [&](int constant, std::uint32_t value) { spec.values.push_back({std::uint32_t(constant), value}); };
  set(gpu::value_underwater, 1);
  if (look_.below) set(gpu::value_solids_above, 1);
  spec.facing = false;
  spec.stencil = Stencil::count;
  in_water_.pipeline = make_graphics_pipeline(device_, shaders, target(picture), spec);
  values_in_water_ = spec.values;
  set(gpu::value_models, 1);  // the bed is kept as they are
  if (look_.deferred) make_light(shaders, picture, in_water_, spec.values);
  GraphicsSpec side;
  side.vertex = "sky.vert";
  side.fragment = "water_side.frag";
  side.values = spec.values;
  side.depth_test = side.depth_write = side.colour = false;
  side.stencil = Stencil::begin_in_water;
  side_pipeline_ = make_graphics_pipeline(device_, shaders, target(picture), side);
  side.vertex = "near_side.vert";
  side.fragment = "near_side.frag";
  NearLines::lay_out(side);
  near_lines_.emplace(device_, shaders, spec.values, entries_);
  near_side_pipeline_ = make_graphics_pipeline(device_, shaders, target(picture), side);
  if (std::none_of(spec.values.begin(), spec.values.end(),
                   [](const SpecValue& v) { return v.id == std::uint32_t(gpu::value_bed) && v.value != 0; }))
    return;
  GraphicsSpec bed = spec;
  bed.vertex = "bed.vert";
  bed.fragment = look_.deferred ? "bed_points.frag" : "bed_in_water.frag";
  bed.stencil = Stencil::in_water;
  bed_pipeline_ = make_graphics_pipeline(device_, shaders, target(picture), bed);
}

std::vector<Bound> Surface::with_below(const std::vector<Bound>& entries) const {
  std::vector<Bound> list = entries;
  if (!look_.below) return list;
  list.push_back({.binding = gpu::slot_solids_in_water, .view = below_.colour().view()});
  if (look_.underwater) list.push_back({.binding = gpu::slot_solids_above, .view = above_.colour().view()});
  return list;
}

void Surface::bind() {
  for (Drawing* drawing : {&in_air_, &in_water_}) {
    drawing->bindings.clear();
    if (!drawing->pipeline) continue;
    for (const std::vector<Bound>& entries : entries_)
      drawing->bindings.emplace_back(device_, drawing->pipeline, with_below(entries), "surface");
    if (look_.deferred) bind_light(*drawing);
  }
  if (side_pipeline_) side_bindings_ = Bindings(device_, side_pipeline_, entries_[0], "water side");
  if (near_side_pipeline_) near_side_bindings_ = Bindings(device_, near_side_pipeline_, entries_[0], "near side");
  bed_bindings_.clear();
  if (bed_pipeline_)
    for (const std::vector<Bound>& entries : entries_)
      bed_bindings_.emplace_back(device_, bed_pipeline_, with_below(entries), "bed in water");
}

// And their depths.
void Surface::add_sides(std::vector<Bound>& entries) const {
  entries.push_back(
      {.binding = gpu::slot_point_depths, .view = points_.depth()->view(), .sampler = points_sampler_.get()});
  if (look_.underwater)
    entries.push_back(
        {.binding = gpu::slot_point_sides, .view = points_.stencil_view(), .sampler = points_sampler_.get()});
}

std::vector<std::vector<Bound>> Surface::bound_with_sides() const {
  std::vector<std::vector<Bound>> of_copies;
  for (const std::vector<Bound>& entries : entries_) {
    of_copies.push_back(with_below(entries));
    if (look_.deferred) add_sides(of_copies.back());
  }
  return of_copies;
}

void Surface::bind_light(Drawing& drawing) {
  drawing.light_bindings.clear();
  for (const std::vector<Bound>& entries : entries_) {
    std::vector<Bound> list = with_below(entries);
    list.push_back({.binding = gpu::slot_points, .view = points_.colour().view(), .sampler = points_sampler_.get()});
    if (points_.second() != nullptr)
      list.push_back(
          {.binding = gpu::slot_footprints, .view = points_.second()->view(), .sampler = points_sampler_.get()});
    add_sides(list);
    drawing.light_bindings.emplace_back(device_, drawing.light, list, "surface light");
  }
}

void Surface::resize(const RenderTarget& picture) {
  if (look_.below) below_ = make_below(device_, picture);
  if (look_.below && look_.underwater) above_ = make_above(device_, picture.spec().height);
  const EffectScope scope(device_, "surface");
  if (look_.deferred) points_ = make_points(device_, picture, look_);
  if (look_.below || look_.deferred) bind();
}

void Surface::set_area(std::uint32_t width, std::uint32_t height) {
  if (look_.deferred) points_.set_area(width, height);
  if (look_.below) below_.set_area(width, height);
}

void Surface::add_points(Uses& uses) const {
  uses.add(use(points_.colour(), Access::fragment_sample));
  if (points_.second() != nullptr) uses.add(use(*points_.second(), Access::fragment_sample));
  uses.add(use(*points_.depth(), Access::fragment_sample));
}

void Surface::add_below(Uses& uses) const {
  if (!look_.below) return;
  uses.add(use(below_.colour(), Access::fragment_sample));
  if (look_.underwater) uses.add(use(above_.colour(), Access::fragment_sample));
}

void Surface::light(Commands& commands, std::uint32_t frame_uniform, EyesIn eyes) const {
  const Drawing& drawn = drawing(eyes);
  commands.bind(drawn.light, drawn.light_bindings[shown()], {frame_uniform, 0u});
  commands.push(gpu::DrawPush{commands.eye()});
  commands.draw(3);
}

void Surface::prepare(Frame& frame, std::uint32_t frame_uniform, Uses& uses) {
  add_below(uses);
  if (!near_lines_ || !near_lines_->any()) return;
  near_lines_->find(frame, frame_uniform, uses, shown());
  near_lines_->add_uses(uses);
}

void Surface::draw(Commands& commands, Frame& frame, const SurfaceSelection& selection, std::uint32_t frame_uniform,
                   EyesIn eyes, bool facing_only) const {
  const Drawing& drawn = drawing(eyes);
  if (&drawn == &in_water_) {
    commands.bind(side_pipeline_, side_bindings_, {frame_uniform, 0u});
    commands.push(gpu::DrawPush{commands.eye()});
    commands.draw(3);
  }
  if (&drawn == &in_water_ && near_lines_->any() && !look_.shapes.any()) {
    commands.bind(near_side_pipeline_, near_side_bindings_, {frame_uniform, 0u});
    commands.push(gpu::DrawPush{commands.eye()});
    near_lines_->draw(commands);
  }
  if (selection.patches.empty()) return;
  commands.bind(drawn.pipeline, drawn.bindings[shown()], {frame_uniform, 0u}, facing_only && eyes == EyesIn::air);
  draw_patches(commands, frame, selection.patches);
}

void Surface::draw_bed(Commands& commands, Frame& frame, const SurfaceSelection& selection,
                       std::uint32_t frame_uniform) const {
  const std::span<const gpu::PatchInstance> patches = BedMesh::patches(selection);
  if (patches.empty()) return;
  commands.bind(bed_pipeline_, bed_bindings_[shown()], {frame_uniform, 0u});
  draw_patches(commands, frame, patches);
}

void Surface::draw_patches(Commands& commands, Frame& frame, std::span<const gpu::PatchInstance> patches) const {
  constexpr std::size_t group = gpu::patches_an_instance;
  const std::size_t instances = (patches.size() + group - 1) / group;
  const VertexList list = frame.vertices(instances * group * sizeof(gpu::PatchInstance));
  const std::size_t missing = instances * group - patches.size();
  auto* filled = std::copy(patches.begin(), patches.end(), static_cast<gpu::PatchInstance*>(list.host));
  std::fill_n(filled, missing, gpu::PatchInstance{patches.back().corner, 1, gpu::patch_nothing});
  commands.push(gpu::DrawPush{commands.eye()});
  commands.bind_vertices(list);
  commands.bind_indices(indices_, VK_INDEX_TYPE_UINT16);
  commands.draw_indexed(index_count_, std::uint32_t(instances), missing * 2u * gpu::patch_quads * gpu::patch_quads);
}

}  // namespace seascape
