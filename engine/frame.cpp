#include "engine/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "engine/error.h"

namespace seascape {

void Commands::note(std::uint64_t what) {
  ++counts_->commands;
  counts_->hash = (counts_->hash ^ what) * 1099511628211ull;
}

void Commands::bind(const Pipeline& pipeline, const Bindings& bindings,
                    std::initializer_list<std::uint32_t> uniform_offsets, bool facing) {
  pipeline_ = &pipeline;
  const VkPipeline variant = facing ? pipeline.facing() : pipeline.get();
  vkCmdBindPipeline(commands_, pipeline.bind_point(), variant);
  note(pipeline.hash() + (facing ? 1u : 0u));
  PipelineWork& last = work_->back();
  if (!last.pipeline)
    last.pipeline = variant;
  else if (last.pipeline != variant)
    work_->push_back({last.pass, last.pass_number, variant});
  if (VkDescriptorSet set = bindings.get()) {
    assert(uniform_offsets.size() >= pipeline.dynamic_uniforms());
    vkCmdBindDescriptorSets(commands_, pipeline.bind_point(), pipeline.layout(), 0, 1, &set,
                            pipeline.dynamic_uniforms(), uniform_offsets.begin());
    note(2);
  }
}

void Commands::push_bytes(const void* data, std::uint32_t bytes) {
  const std::uint32_t used = pipeline_->push_bytes();
  assert(used <= bytes);
  if (used == 0) return;
  vkCmdPushConstants(commands_, pipeline_->layout(), pipeline_->push_stages(), 0, std::min(used, bytes), data);
  note(3);
}

void Commands::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  vkCmdDispatch(commands_, x, y, z);
  note(4 + (std::uint64_t(x) << 8) + (std::uint64_t(y) << 28) + (std::uint64_t(z) << 48));
  ++counts_->dispatches;
  ++work_->back().dispatches;
}

void Commands::bind_vertices(const VertexList& list, std::uint32_t binding) {
  const VkBuffer buffer = list.buffer->get();
  vkCmdBindVertexBuffers(commands_, binding, 1, &buffer, &list.offset);
  note(5);
}

void Commands::bind_indices(const Buffer& buffer, VkIndexType type) {
  vkCmdBindIndexBuffer(commands_, buffer.get(), 0, type);
  note(6);
}

void Commands::draw(std::uint32_t vertices, std::uint32_t instances) {
  vkCmdDraw(commands_, vertices, instances, 0, 0);
  note(7 + (std::uint64_t(vertices) << 8) + (std::uint64_t(instances) << 32));
  count_draw(std::uint64_t(vertices / 3) * instances);
}

void Commands::draw_indirect(const Buffer& command) {
  vkCmdDrawIndirect(commands_, command.get(), 0, 1, sizeof(VkDrawIndirectCommand));
  note(16);
  count_draw(0);
}

void Commands::draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint64_t nothing) {
  vkCmdDrawIndexed(commands_, indices, instances, 0, 0, 0);
  note(8 + (std::uint64_t(indices) << 8) + (std::uint64_t(instances) << 32));
  count_draw(std::uint64_t(indices / 3) * instances - nothing);
}

void Commands::copy(const Buffer& from, const Image& to, std::span<const VkBufferImageCopy> regions) {
  vkCmdCopyBufferToImage(commands_, from.get(), to.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         std::uint32_t(regions.size()), regions.data());
  for (const VkBufferImageCopy& region : regions) {
    note(11 + (region.bufferOffset << 8) + (std::uint64_t(region.imageExtent.width) << 40) +
         (std::uint64_t(region.imageExtent.height) << 52));
    count_moved({0, 0,
                 std::uint64_t(region.imageExtent.width) * region.imageExtent.height *
                     region.imageSubresource.layerCount * bytes_per_texel(to.spec().format)});
  }
  work_->back().copied_to = to.get();
  ++work_->back().copies;
}

void Commands::copy(const Buffer& from, const Buffer& to) { copy(from, to, {0, 0, from.bytes()}); }

void Commands::copy(const Buffer& from, const Buffer& to, const VkBufferCopy& part) {
  vkCmdCopyBuffer(commands_, from.get(), to.get(), 1, &part);
  note(12 + (part.size << 8));
  if (part.srcOffset + part.dstOffset != 0) note(13 + (part.srcOffset << 8) + (part.dstOffset << 36));
  count_moved({0, 0, part.size});
  ++work_->back().copies;
}

void Commands::copy(const Image& from, const Image& to, VkExtent2D part) {
  VkImageCopy region{};
  region.srcSubresource = {from.aspect(), 0, 0, from.spec().layers};
  region.dstSubresource = {to.aspect(), 0, 0, to.spec().layers};
  region.extent = {part.width, part.height, 1};
  vkCmdCopyImage(commands_, from.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.get(),
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  note(14 + (std::uint64_t(part.width) << 8) + (std::uint64_t(part.height) << 32));
  work_->back().copied_to = to.get();
  ++work_->back().copies;
}

void Commands::count_draw(std::uint64_t triangles) {
  ++counts_->draws;
  ++work_->back().draws;
  counts_->triangles += triangles;
  work_->back().triangles += triangles;
}

void Commands::count_moved(const BytesMoved& bytes) {
  counts_->moved += bytes;
  work_->back().moved += bytes;
}

namespace {

constexpr std::uint32_t ring_bytes = 64u << 10;  // a frame's uniforms

Buffer make_vertices(Device& device, VkDeviceSize bytes) {
  return Buffer(device, "frame vertices", bytes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, HostAccess::write);
}

}  // namespace

Frame::Frame(Device& device, VkDeviceSize vertex_bytes)
    : device_(device),
      ring_(device, "frame ring", VkDeviceSize(ring_bytes) * slots,
            VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, HostAccess::write) {
  times_.reserve(max_passes);
  work_.reserve(4 * max_passes);
  for (Slot& slot : slots_) {
    slot.vertices = make_vertices(device, vertex_bytes);
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = device.queue_family();
    VkCommandPool pool_handle = VK_NULL_HANDLE;
    check(vkCreateCommandPool(device.handle(), &pool, nullptr, &pool_handle), "vkCreateCommandPool");
    slot.pool = Owned<VkCommandPool>(device, pool_handle, "frame");
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = pool_handle;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device.handle(), &allocate, &slot.commands), "vkAllocateCommandBuffers");
    VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence_handle = VK_NULL_HANDLE;
    check(vkCreateFence(device.handle(), &fence, nullptr, &fence_handle), "vkCreateFence");
    slot.fence = Owned<VkFence>(device, fence_handle, "frame");
    if (device.facts().timestamps) {
      VkQueryPoolCreateInfo queries{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
      queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
      queries.queryCount = 2 * max_passes;
      VkQueryPool query_handle = VK_NULL_HANDLE;
      check(vkCreateQueryPool(device.handle(), &queries, nullptr, &query_handle), "vkCreateQueryPool");
      slot.queries = Owned<VkQueryPool>(device, query_handle, "frame");
      slot.stamps = Buffer(device, "frame times", 2 * max_passes * sizeof(std::uint64_t),
                           VK_BUFFER_USAGE_TRANSFER_DST_BIT, HostAccess::read);
    }
  }
}

Frame::~Frame() { device_.wait_for_gpu(); }

void Frame::collect(Slot& slot) {
  if (!slot.pending) return;
  const VkFence fence = slot.fence.get();
  check(vkWaitForFences(device_.handle(), 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
  slot.pending = false;
  device_.frames_finished_to(slot.frame);
  if (!slot.queries || slot.passes == 0) return;
  const auto* stamps = slot.stamps.mapped<std::uint64_t>();
  times_.clear();
  const double period = device_.facts().timestamp_period_ns * 1e-6;
  for (std::uint32_t p = 0; p < slot.passes; ++p)
    times_.push_back({slot.names[p], double(stamps[2 * p + 1] - stamps[2 * p]) * period});
  gpu_ms_ = double(stamps[2 * slot.passes - 1] - stamps[0]) * period;
  timed_frame_ = slot.number;
}

void Frame::begin() {
  ++number_;
  Slot& slot = slots_[number_ % slots];
  stages_.clear();
  stages_.time("waiting", [&] { collect(slot); });
  slot.number = number_;
  slot.passes = 0;
  ring_used_ = 0;
  vertices_used_ = 0;
  counts_ = {};
  work_.clear();
  slot.frame = device_.begin_frame();
  const VkFence fence = slot.fence.get();
  check(vkResetFences(device_.handle(), 1, &fence), "vkResetFences");
  check(vkResetCommandPool(device_.handle(), slot.pool.get(), 0), "vkResetCommandPool");
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(slot.commands, &begin), "vkBeginCommandBuffer");
  if (slot.queries) vkCmdResetQueryPool(slot.commands, slot.queries.get(), 0, 2 * max_passes);
  commands_.commands_ = slot.commands;
  commands_.counts_ = &counts_;
  commands_.work_ = &work_;
  commands_.eye_ = 0;
}

std::uint32_t Frame::upload_bytes(const void* data, std::uint32_t bytes) {
  const std::uint32_t alignment = device_.facts().uniform_alignment;
  ring_used_ = (ring_used_ + alignment - 1) / alignment * alignment;
  if (ring_used_ + bytes > ring_bytes)
    throw Error("frame", fmt::format("uniforms exceed {} bytes", ring_bytes),
                "this is a fault of seascape; fewer views avoid it");
  const std::uint32_t offset = std::uint32_t(slot()) * ring_bytes + ring_used_;
  std::memcpy(ring_.mapped<char>() + offset, data, bytes);
  ring_used_ += bytes;
  return offset;
}

VertexList Frame::vertices(VkDeviceSize bytes) {
  Buffer& buffer = slots_[number_ % slots].vertices;
  if (vertices_used_ + bytes >
      buffer.bytes()) {  // the smaller one lives until the frame that draws from it has finished
    buffer = make_vertices(device_, std::max(2 * buffer.bytes(), bytes));
    vertices_used_ = 0;
  }
  const VertexList list{&buffer, vertices_used_, buffer.mapped<char>() + vertices_used_};
  vertices_used_ += (bytes + 15) / 16 * 16;
  return list;
}

void Frame::open(const char* name, BarrierBatch& barriers) {
  Slot& slot = slots_[number_ % slots];
  assert(slot.passes < max_passes);
  device_.label_begin(slot.commands, name);
  if (barriers.record(slot.commands)) {
    ++counts_.barriers;
    commands_.note(1);
  }
  slot.names[slot.passes] = name;
  work_.push_back({name, slot.passes});
  if (slot.queries)
    vkCmdWriteTimestamp(slot.commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, slot.queries.get(), 2 * slot.passes);
  ++counts_.passes;
}

void Frame::begin_pass(const char* name, const Uses& uses) {
  BarrierBatch barriers;
  for (const Use& u : uses) u.image ? barriers.add(*u.image, u.access, u.discard) : barriers.add(*u.buffer, u.access);
  open(name, barriers);
}

void Frame::begin_target(const char* name, const RenderTarget& target, const Uses& uses) {
  BarrierBatch barriers;
  for (const Use& u : uses) u.image ? barriers.add(*u.image, u.access, u.discard) : barriers.add(*u.buffer, u.access);
  if (target.has_colour())
    barriers.add(target.colour(), target.resolved_eye() ? Access::transfer_write : Access::colour_target, true);
  if (target.resolved_eye()) barriers.add(*target.resolved_eye(), Access::colour_target, true);
  if (target.multisampled()) barriers.add(*target.multisampled(), Access::colour_target, true);
  if (target.second()) barriers.add(*target.second(), Access::colour_target, true);
  if (target.depth()) barriers.add(*target.depth(), Access::depth_target, true);
  if (target.resolved_depth()) barriers.add(*target.resolved_depth(), Access::depth_resolve, true);
  open(name, barriers);
  commands_.count_moved({target.loaded_bytes(), target.stored_bytes(), 0});
}

void Frame::begin_eye(const RenderTarget& target, std::size_t pass) {
  const TargetSpec& spec = target.spec();
  if (pass > 0) {  // the eyes share samples and depth
    BarrierBatch barriers;
    if (target.resolved_eye()) barriers.add(*target.resolved_eye(), Access::colour_target, true);
    if (target.multisampled()) barriers.add(*target.multisampled(), Access::colour_target, true);
    if (target.depth() && !spec.keep_depth && !spec.show_depth)
      barriers.add(*target.depth(), Access::depth_target, true);
    counts_.barriers += std::uint64_t(barriers.record(commands_.commands_));
  }
  VkClearValue clears[3]{};
  const std::uint32_t first = target.has_colour() ? 0 : 1;
  for (int i : {0, 2}) std::memcpy(clears[i].color.float32, spec.clear.data(), sizeof clears[i].color.float32);
  clears[1].depthStencil = {0.0f, stencil_in_air};  // reversed depth: infinitely far
  VkRenderPassBeginInfo begin{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
  begin.renderPass = target.render_pass();
  begin.framebuffer = target.framebuffer(pass);
  begin.renderArea = {{0, 0}, {spec.width, spec.height}};
  begin.clearValueCount = 1u - first + spec.depth + (target.second() != nullptr || spec.samples > 1);
  begin.pClearValues = clears + first;
  vkCmdBeginRenderPass(commands_.commands_, &begin, VK_SUBPASS_CONTENTS_INLINE);
  const VkViewport viewport{0.0f, 0.0f, float(spec.width), float(spec.height), 0.0f, 1.0f};
  const VkRect2D scissor{{0, 0}, {spec.width, spec.height}};
  vkCmdSetViewport(commands_.commands_, 0, 1, &viewport);
  vkCmdSetScissor(commands_.commands_, 0, 1, &scissor);
  commands_.note(9);
  commands_.eye_ = std::uint32_t(pass);
}

void Frame::end_eye(const RenderTarget& target, std::size_t pass) {
  vkCmdEndRenderPass(commands_.commands_);
  commands_.eye_ = 0;
  if (!target.resolved_eye()) return;
  BarrierBatch barriers;
  barriers.add(*target.resolved_eye(), Access::transfer_read);
  counts_.barriers += std::uint64_t(barriers.record(commands_.commands_));
  VkImageCopy region{};
  region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, std::uint32_t(pass), 1};
  region.extent = {target.spec().width, target.spec().height, 1};
  vkCmdCopyImage(commands_.commands_, target.resolved_eye()->get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                 target.colour().get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  commands_.note(10);
  commands_.count_moved(
      {0, 0, std::uint64_t(region.extent.width) * region.extent.height * bytes_per_texel(target.spec().colour)});
}

void Frame::end_pass() {
  Slot& slot = slots_[number_ % slots];
  if (slot.queries)
    vkCmdWriteTimestamp(slot.commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, slot.queries.get(), 2 * slot.passes + 1);
  ++slot.passes;
  device_.label_end(slot.commands);
}

void Frame::submit(VkSemaphore wait, VkSemaphore signal) {
  Slot& slot = slots_[number_ % slots];
  if (slot.queries && slot.passes > 0) {
    // By the frame and not by vkGetQueryPoolResults, for which lavapipe waits until the device is idle: the frames in
    // flight would be one.
    BarrierBatch before, after;
    before.add(slot.stamps, Access::transfer_write);
    before.record(slot.commands);
    vkCmdCopyQueryPoolResults(slot.commands, slot.queries.get(), 0, 2 * slot.passes, slot.stamps.get(), 0,
                              sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    after.add(slot.stamps, Access::host_read);
    after.record(slot.commands);
  }
  check(vkEndCommandBuffer(slot.commands), "vkEndCommandBuffer");
  const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &slot.commands;
  submit.waitSemaphoreCount = wait ? 1 : 0;
  submit.pWaitSemaphores = &wait;
  submit.pWaitDstStageMask = &stage;
  submit.signalSemaphoreCount = signal ? 1 : 0;
  submit.pSignalSemaphores = &signal;
  stages_.time("submission", [&] {
    const std::lock_guard lock(device_.queue_mutex());
    check(vkQueueSubmit(device_.queue(), 1, &submit, slot.fence.get()), "vkQueueSubmit");
  });
  slot.pending = true;
}

bool Frame::ready() const {
  return std::all_of(slots_.begin(), slots_.end(), [&](const Slot& slot) {
    if (!slot.pending) return true;
    const VkResult result = vkGetFenceStatus(device_.handle(), slot.fence.get());
    if (result != VK_NOT_READY) check(result, "vkGetFenceStatus");
    return result == VK_SUCCESS;
  });
}

void Frame::finish() {
  collect(slots_[(number_ + 1) % slots]);
  collect(slots_[number_ % slots]);
}

}  // namespace seascape
