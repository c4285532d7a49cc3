#include "ocean/waves/wave_upload.h"

#include <tbb/parallel_for.h>

#include "ocean/waves/half_floats.h"

namespace seascape {

WaveUpload::WaveUpload(Device& device, const SeaState& sea, const WaveQuality& quality, const WaveBins& bins, const WaveImages& images)
    : field_(sea, quality, bins), images_(images) {
  const EffectScope scope(device, "waves");
  // Half floats keep the layout of the floats that they were converted from, padding and all.
  const WaveTileLayout layout(quality);
  const std::size_t texel = bytes_per_texel(images.sets()[0].displacement.spec().format);
  for (Buffer& staging : staging_)  // cached, since the field reads levels there for the next: coarser ones are their averages
    staging = Buffer(device, "wave staging", planes * layout.plane_texels * texel, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::read);
  for (const WaveImages::Set& set : images.sets())
    for (int plane = 0; plane < planes; ++plane) {
      copies_.push_back({&set.image(WavePlane(plane)), {}});
      for (int layer = 0; layer < set.cascades; ++layer)
        for (int level = 0; level < set.levels; ++level) {
          const WaveTileLayout::Level& l = layout.level(set.first + layer, level);
          VkBufferImageCopy region{};
          region.bufferOffset = layout.offset(set.first + layer, WavePlane(plane), level) * texel;
          region.bufferRowLength = std::uint32_t(l.stride);
          region.bufferImageHeight = std::uint32_t(l.size);
          region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, std::uint32_t(level), std::uint32_t(layer), 1};
          region.imageExtent = {std::uint32_t(l.size), std::uint32_t(l.size), 1};
          copies_.back().regions.push_back(region);
        }
    }
}

void WaveUpload::take(const WaveBins& bins, double chop, const SeaStatistics& statistics) {
  field_.take(bins, chop, statistics);
  uploaded_ = false;
}

void WaveUpload::update(Frame& frame, std::int64_t ticks) {
  if (uploaded_ && ticks == ticks_) return;
  uploaded_ = true;
  ticks_ = ticks;
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  if (images_.half_storage()) {
    field_.evaluate(ticks, tiles_);
    constexpr std::size_t piece = 1 << 13;  // texels: a quarter of a second-level cache's usual size
    const std::size_t texels = planes * tiles_.layout().plane_texels, pieces = (texels + piece - 1) / piece;
    tbb::parallel_for(std::size_t(0), pieces, [&](std::size_t i) {
      const std::size_t first = i * piece, count = std::min(piece, texels - first);
      halves_from_floats(&tiles_.texels(0, WavePlane::shift, 0)[first].x, staging.mapped<std::uint16_t>() + 4 * first, 4 * count);
    });
  } else {
    tiles_.keep_in({staging.mapped<glm::vec4>(), staging.bytes() / sizeof(glm::vec4)});
    field_.evaluate(ticks, tiles_);
  }
  Uses uses{use(staging, Access::transfer_read)};
  images_.add_uses(uses, Access::transfer_write, true);
  frame.pass("wave upload", uses, [&](Commands& c) {
    for (const Copy& copy : copies_) c.copy(staging, *copy.to, copy.regions);
  });
}

}  // namespace seascape
