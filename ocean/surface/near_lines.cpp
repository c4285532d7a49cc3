#include "ocean/surface/near_lines.h"

#include <algorithm>

#include "shaders/shared/slots.h"

namespace seascape {

NearLines::NearLines(Device& device, ShaderLibrary& shaders, const std::vector<SpecValue>& values,
                     const std::vector<std::vector<Bound>>& entries) {
  const EffectScope scope(device, "underwater");
  corners_pipeline_ = make_compute_pipeline(device, shaders, "near_corners.comp", values);
  lines_pipeline_ = make_compute_pipeline(device, shaders, "near_lines.comp");
  constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  found_ = Buffer(device, "near corners", room * sizeof(gpu::NearPatch), storage);
  listed_ = Buffer(device, "near triangles", triangle_room * sizeof(gpu::NearTriangle),
                   storage | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  draw_ = Buffer(device, "near draw", sizeof(VkDrawIndirectCommand), storage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
  const std::vector<Bound> own{{.binding = gpu::slot_near_found, .buffer = &found_},
                               {.binding = gpu::slot_near_listed, .buffer = &listed_},
                               {.binding = gpu::slot_near_draw, .buffer = &draw_}};
  for (std::size_t slot = 0; slot < patches_of_.size(); ++slot) {
    patches_of_[slot] = Buffer(device, "near patches", room * sizeof(gpu::PatchInstance), storage, HostAccess::write);
    for (std::vector<Bound> all : entries) {
      all.insert(all.end(), own.begin(), own.end());
      all.push_back({.binding = gpu::slot_near_patches, .buffer = &patches_of_[slot]});
      corners_bindings_[slot].emplace_back(device, corners_pipeline_, all, "near corners");
    }
  }
  lines_bindings_ = Bindings(device, lines_pipeline_, own, "near lines");
}

void NearLines::lay_out(GraphicsSpec& spec) {
  spec.buffers = {{0, sizeof(gpu::NearTriangle), VK_VERTEX_INPUT_RATE_INSTANCE}};
  spec.attributes.clear();
  for (std::uint32_t n = 0; n < 3; ++n)
    spec.attributes.push_back({n, 0, VK_FORMAT_R32G32B32_SFLOAT, n * std::uint32_t(sizeof(gpu::vec4))});
}

void NearLines::choose(Frame& frame, const SurfaceSelection& selection, std::span<const NearWater> near) {
  const auto may_pass = [&](const gpu::PatchInstance& patch) {
    if ((patch.flags & gpu::patch_skirt) != 0) return false;
    const glm::dvec2 least = selection.grid_origin_m + selection.unit_m * glm::dvec2(patch.corner),
                     most = least + selection.unit_m * double(gpu::patch_quads * patch.stride);
    return std::any_of(near.begin(), near.end(), [&](const NearWater& eye) { return eye.touches(least, most); });
  };
  patches_ = 0;
  eyes_ = near.size();
  if (near.empty()) return;
  slot_ = frame.slot();
  auto* const list = patches_of_[std::size_t(slot_)].mapped<gpu::PatchInstance>();
  for (const gpu::PatchInstance& patch : selection.patches)
    if (patches_ < room && may_pass(patch)) list[patches_++] = patch;
}

void NearLines::find(Frame& frame, std::uint32_t frame_uniform, const Uses& sea, std::size_t copy) {
  const gpu::NearLinesPush push{gpu::uint(patches_), gpu::uint(eyes_), gpu::uint(triangle_room)};
  Uses uses = sea;
  uses.add(use(found_, Access::compute_write));
  frame.pass("near corners", uses, [&](Commands& c) {
    c.bind(corners_pipeline_, corners_bindings_[std::size_t(slot_)][copy], {frame_uniform});
    c.push(push);
    c.dispatch(std::uint32_t(patches_), 1, 1);
  });
  frame.pass(
      "near lines",
      {use(found_, Access::compute_read), use(listed_, Access::compute_write), use(draw_, Access::compute_write)},
      [&](Commands& c) {
        c.bind(lines_pipeline_, lines_bindings_);
        c.push(push);
        c.dispatch(1, 1, 1);
      });
}

void NearLines::add_uses(Uses& uses) const {
  if (!any()) return;
  uses.add(use(listed_, Access::vertex_list));
  uses.add(use(draw_, Access::vertex_list));
}

void NearLines::draw(Commands& commands) const {
  commands.bind_vertices({&listed_, 0, nullptr});
  commands.draw_indirect(draw_);
}

}  // namespace seascape
