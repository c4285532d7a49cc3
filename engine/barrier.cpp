#include "engine/barrier.h"

#include <cassert>

namespace seascape {

namespace {

struct Meaning {
  VkPipelineStageFlags stages;
  VkAccessFlags access;
  VkImageLayout layout;
  bool writes;
};

Meaning meaning(Access access) {
  constexpr VkPipelineStageFlags shading = VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
                                           VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
  constexpr VkPipelineStageFlags depth =
      VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  switch (access) {
    case Access::compute_read:
      return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT, VK_IMAGE_LAYOUT_GENERAL, false};
    case Access::compute_write:
      return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT,
              VK_IMAGE_LAYOUT_GENERAL, true};
    case Access::compute_sample:
      return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
              false};
    case Access::surface_read:
      return {shading, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
              false};
    case Access::host_texels:
      return {shading, VK_ACCESS_SHADER_READ_BIT, VK_IMAGE_LAYOUT_GENERAL, false};
    case Access::fragment_sample:
      return {VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT,
              VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, false};
    case Access::vertex_store:
      return {VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL, true};
    case Access::vertex_list:
      return {VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_VERTEX_INPUT_BIT,
              VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT, VK_IMAGE_LAYOUT_GENERAL,
              false};
    case Access::colour_target:
      return {VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
              VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
              VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true};
    case Access::depth_target:
      return {depth, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
              VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, true};
    case Access::depth_resolve:  // Vulkan resolves depth as it does colour
      return {VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
              VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
              VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, true};
    case Access::transfer_read:
      return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, false};
    case Access::transfer_write:
      return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true};
    case Access::host_read:
      return {VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT, VK_IMAGE_LAYOUT_GENERAL, false};
    case Access::present:
      return {VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, false};
  }
  return {};
}

struct Need {
  bool barrier;
  VkPipelineStageFlags from;
  VkAccessFlags from_access;
};

// What must be waited for, and the state after. An execution dependency suffices between a read and a write after it.
Need advance(UseState& state, const Meaning& next, VkImageLayout layout, bool is_image, bool discard) {
  const bool relayout = is_image && (state.layout != layout || discard);
  Need need{false, 0, 0};
  if (next.writes || relayout) {
    need.barrier = relayout || state.write_stages || state.read_stages;
    need.from = state.write_stages | state.read_stages;
    need.from_access = state.read_stages && !state.write_stages ? 0 : state.write_access;
    // A layout change is itself a write; what the barrier makes visible is all that may read until the next one.
    state.write_stages = next.stages;
    state.write_access = next.writes ? next.access : 0;
    state.read_stages = next.writes ? 0 : next.stages;
    state.visible_stages = next.writes ? 0 : next.stages;
    state.visible_access = next.writes ? 0 : next.access;
  } else {
    const bool seen =
        (state.visible_stages & next.stages) == next.stages && (state.visible_access & next.access) == next.access;
    need.barrier = state.write_stages && !seen;
    need.from = state.write_stages;
    need.from_access = state.write_access;
    state.read_stages |= next.stages;
    state.visible_stages |= next.stages;
    state.visible_access |= next.access;
  }
  state.layout = layout;
  return need;
}

}  // namespace

void BarrierBatch::add(const Image& image, Access access, bool discard) {
  const Meaning next = meaning(access);
  UseState& state = image.state();
  const VkImageLayout before = discard ? VK_IMAGE_LAYOUT_UNDEFINED : state.layout;
  const Need need = advance(state, next, next.layout, true, discard);
  if (!need.barrier) return;
  assert(image_count_ < images_.size());
  VkImageMemoryBarrier& b = images_[image_count_++];
  b = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
  b.srcAccessMask = need.from_access;
  b.dstAccessMask = next.access;
  b.oldLayout = before;
  b.newLayout = next.layout;
  b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  b.image = image.get();
  b.subresourceRange = {image.all_aspects(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
  from_ |= need.from ? need.from : VkPipelineStageFlags(VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT);
  to_ |= next.stages;
}

void BarrierBatch::add(const Buffer& buffer, Access access) {
  const Meaning next = meaning(access);
  const Need need = advance(buffer.state(), next, VK_IMAGE_LAYOUT_UNDEFINED, false, false);
  if (!need.barrier) return;
  assert(buffer_count_ < buffers_.size());
  VkBufferMemoryBarrier& b = buffers_[buffer_count_++];
  b = {VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER};
  b.srcAccessMask = need.from_access;
  b.dstAccessMask = next.access;
  b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  b.buffer = buffer.get();
  b.size = VK_WHOLE_SIZE;
  from_ |= need.from ? need.from : VkPipelineStageFlags(VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT);
  to_ |= next.stages;
}

int BarrierBatch::record(VkCommandBuffer commands) {
  if (image_count_ + buffer_count_ == 0) return 0;
  vkCmdPipelineBarrier(commands, from_, to_, 0, 0, nullptr, buffer_count_, buffers_.data(), image_count_,
                       images_.data());
  image_count_ = buffer_count_ = 0;
  from_ = to_ = 0;
  return 1;
}

}  // namespace seascape
