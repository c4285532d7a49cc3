// Barriers derived from how buffers and images were used last and how the next pass uses them.
#pragma once
#include <array>

#include "engine/resources.h"

namespace seascape {

enum class Access {
  compute_read,     // storage buffer or sampled image, general layout (a chain of compute passes)
  compute_write,    // storage buffer or image, general layout
  compute_sample,   // sampled image in its read-only layout
  surface_read,     // sampled image or storage buffer in vertex, fragment and compute shaders
  host_texels,      // an image whose texels the host writes between frames, sampled in the same, general layout
  fragment_sample,  // sampled image in the fragment shader
  vertex_store,     // storage buffer written by a vertex shader (test probes)
  vertex_list,      // buffer that a draw reads its vertices or its own arguments from
  colour_target,
  depth_target,
  depth_resolve,  // what a pass resolves its samples' depth into
  transfer_read,
  transfer_write,
  host_read,
  present,
};

// Of each kind in a batch.
inline constexpr std::size_t most_barriers = 40;

// Collects barriers and records them in one command; what needs none adds none.
class BarrierBatch {
 public:
  // `discard`: the content before does not matter.
  void add(const Image& image, Access access, bool discard = false);
  void add(const Buffer& buffer, Access access);
  // Returns how many commands it recorded: 0 or 1.
  int record(VkCommandBuffer commands);

 private:
  std::array<VkImageMemoryBarrier, most_barriers> images_;
  std::array<VkBufferMemoryBarrier, most_barriers> buffers_;
  std::uint32_t image_count_ = 0, buffer_count_ = 0;
  VkPipelineStageFlags from_ = 0, to_ = 0;
};

}  // namespace seascape
