#include "ocean/surface/near_lines.h"

#include <algorithm>
#include <bit>

#include "shaders/shared/slots.h"

namespace seascape {

NearLines::NearLines(Device& device, ShaderLibrary& shaders, const std::vector<SpecValue>& values,
                     const std::vector<std::vector<Bound>>& entries)
    : device_(device), entries_(entries) {
  corners_pipeline_ = make_compute_pipeline(device, shaders, "near_corners.comp", values);
  lines_pipeline_ = make_compute_pipeline(device, shaders, "near_lines.comp");
  for (Slot& slot : slots_) make(slot, first_room);
}

void NearLines::lay_out(GraphicsSpec& spec) {
  spec.buffers = {{0, sizeof(gpu::NearTriangle), VK_VERTEX_INPUT_RATE_INSTANCE}};
  spec.attributes.clear();
  for (std::uint32_t n = 0; n < 3; ++n)
    spec.attributes.push_back({n, 0, VK_FORMAT_R32G32B32_SFLOAT, n * std::uint32_t(sizeof(gpu::vec4))});
}

void NearLines::make(Slot& slot, std::size_t room) {
  const EffectScope scope(device_, "underwater");
  constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  slot.room = room;
  slot.patches =
      Buffer(device_, "near patches", room * sizeof(gpu::PatchInstance), storage, HostAccess::write);
  slot.corners = Buffer(device_, "near corners", room * gpu::near_corners * sizeof(gpu::vec4), storage);
  slot.masks = Buffer(device_, "near masks", room * sizeof(gpu::uint), storage);
  slot.listed = Buffer(device_, "near triangles", room * gpu::near_triangles * sizeof(gpu::NearTriangle),
                       storage | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  slot.draw = Buffer(device_, "near draw", sizeof(VkDrawIndirectCommand), storage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
  const std::vector<Bound> own{{.binding = gpu::slot_near_patches, .buffer = &slot.patches},
                               {.binding = gpu::slot_near_corners, .buffer = &slot.corners},
                               {.binding = gpu::slot_near_masks, .buffer = &slot.masks},
                               {.binding = gpu::slot_near_listed, .buffer = &slot.listed},
                               {.binding = gpu::slot_near_draw, .buffer = &slot.draw}};
  slot.corners_bindings.clear();
  for (const std::vector<Bound>& entries : entries_) {
    std::vector<Bound> all = entries;
    all.insert(all.end(), own.begin(), own.end());
    slot.corners_bindings.emplace_back(device_, corners_pipeline_, all, "near corners");
  }
  slot.lines_bindings = Bindings(device_, lines_pipeline_, own, "near lines");
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
  patches_ = std::size_t(std::count_if(selection.patches.begin(), selection.patches.end(), may_pass));
  if (patches_ == 0) return;
  Slot& slot = slots_[std::size_t(frame.slot())];
  if (slot.room < patches_) make(slot, std::bit_ceil(patches_));  // its last frame has left the GPU
  std::copy_if(selection.patches.begin(), selection.patches.end(), slot.patches.mapped<gpu::PatchInstance>(), may_pass);
  drawn_ = &slot;
}

void NearLines::find(Frame& frame, std::uint32_t frame_uniform, const Uses& sea, std::size_t copy) {
  const gpu::NearLinesPush push{gpu::uint(patches_), gpu::uint(eyes_)};
  Uses uses = sea;
  uses.add(use(drawn_->corners, Access::compute_write));
  uses.add(use(drawn_->masks, Access::compute_write));
  frame.pass("near corners", uses, [&](Commands& c) {
    c.bind(corners_pipeline_, drawn_->corners_bindings[copy], {frame_uniform});
    c.push(push);
    c.dispatch(std::uint32_t(patches_), 1, 1);
  });
  frame.pass("near lines",
             {use(drawn_->corners, Access::compute_read), use(drawn_->masks, Access::compute_read),
              use(drawn_->listed, Access::compute_write), use(drawn_->draw, Access::compute_write)},
             [&](Commands& c) {
               c.bind(lines_pipeline_, drawn_->lines_bindings);
               c.push(push);
               c.dispatch(1, 1, 1);
             });
}

void NearLines::add_uses(Uses& uses) const {
  if (!any()) return;
  uses.add(use(drawn_->listed, Access::vertex_list));
  uses.add(use(drawn_->draw, Access::vertex_list));
}

void NearLines::draw(Commands& commands) const {
  commands.bind_vertices({&drawn_->listed, 0, nullptr});
  commands.draw_indirect(drawn_->draw);
}

}  // namespace seascape
