#include "ocean/drawn/drawn_clip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "ocean/waves/half_floats.h"

namespace seascape {

DrawnClip::DrawnClip(Device& device, std::shared_ptr<const ClipVolumes> volumes) : volumes_(std::move(volumes)) {
  const EffectScope scope(device, "clip");
  const auto most = std::size_t(volumes_->most_bodies());
  const auto buffer = [&](const char* name, auto list, std::size_t room) {
    list.resize(list.size() + room);
    return make_filled_buffer(device, name, list.data(), list.size() * sizeof(list[0]),
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  };
  nodes_ = buffer("clip, nodes", volumes_->nodes(), 2 * most);
  buffer_ = buffer("clip, volumes", volumes_->volumes(), most);
  if (!volumes_->hulls().empty()) fill_hulls(device);
  if (most == 0) return;
  for (Buffer& staging : staging_)
    staging = Buffer(device, "clip, staging", (2 * most + 1) * sizeof(gpu::ClipNode) + most * sizeof(gpu::ClipVolume),
                     VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
}

void DrawnClip::update(Frame& frame, const std::shared_ptr<const ClipVolumes>& volumes) {
  if (volumes == volumes_) return;
  assert(volumes->fixed_nodes() == volumes_->fixed_nodes() && volumes->most_bodies() == volumes_->most_bodies());
  volumes_ = volumes;
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  VkDeviceSize filled = 0;
  const auto fill = [&](const auto& list, std::size_t from) {
    const VkDeviceSize one = sizeof(list[0]);
    const VkBufferCopy region{filled, from * one, (list.size() - std::min(from, list.size())) * one};
    if (region.size > 0) std::memcpy(staging.mapped<std::byte>() + filled, &list[from], region.size);
    filled += region.size;
    return region;
  };
  // The first node has the count of all.
  const std::vector<gpu::ClipNode>& all = volumes_->nodes();
  const std::array<gpu::ClipNode, 1> first{all.empty() ? gpu::ClipNode{} : all.front()};
  const VkBufferCopy head = fill(first, 0), nodes = fill(all, std::max<std::size_t>(volumes_->fixed_nodes(), 1)),
                     bodies = fill(volumes_->volumes(), volumes_->fixed_volumes());
  frame.pass(
      "clip",
      {use(staging, Access::transfer_read), use(nodes_, Access::transfer_write), use(buffer_, Access::transfer_write)},
      [&](Commands& c) {
        for (const VkBufferCopy& region : {head, nodes})
          if (region.size > 0) c.copy(staging, nodes_, region);
        if (bodies.size > 0) c.copy(staging, buffer_, bodies);
      });
}

void DrawnClip::add_uses(Uses& uses, Access access) const {
  if (hulls_) uses.add(use(hulls_, access));
  if (volumes_->most_bodies() == 0) return;  // nothing writes them
  uses.add(use(nodes_, access));
  uses.add(use(buffer_, access));
}

void DrawnClip::fill_hulls(Device& device) {
  constexpr auto side = std::uint32_t(gpu::clip_hull_texels);
  const auto layers = std::uint32_t(volumes_->hulls().size());
  ImageSpec spec;
  spec.width = spec.height = side;
  spec.layers = layers;
  spec.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  hulls_ = Image(device, "clip, hulls", spec);
  const std::size_t texels = std::size_t(side) * side;
  const Buffer staging(device, "clip, staging", layers * texels * 8, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                       HostAccess::write);
  std::vector<glm::vec4> whole(texels);
  for (std::uint32_t layer = 0; layer < layers; ++layer) {
    const std::vector<glm::vec3>& map = volumes_->hulls()[layer].texels;
    for (std::size_t i = 0; i < texels; ++i) whole[i] = glm::vec4(map[i], 0.0f);
    halves_from_floats(&whole[0].x, staging.mapped<std::uint16_t>() + layer * texels * 4, texels * 4);
  }
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, layers};
  region.imageExtent = {side, side, 1};
  device.run_now([&](VkCommandBuffer commands) {
    BarrierBatch barriers;
    barriers.add(hulls_, Access::transfer_write, true);
    barriers.record(commands);
    vkCmdCopyBufferToImage(commands, staging.get(), hulls_.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  });
}

}  // namespace seascape
