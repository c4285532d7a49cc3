#include "ocean/drawn/wave_upload.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstring>

#include "ocean/waves/half_floats.h"

namespace seascape {

WaveUpload::WaveUpload(Device& device, Sea& sea, WaveImages& images) : sea_(sea), images_(images) {
  const EffectScope scope(device, "waves");
  const WaveTileLayout layout(sea.spec().drawn);
  if (images.filled() == WaveImages::Filled::written)
    lend_images(layout);
  else
    make_copies(device, layout);
}

WaveUpload::~WaveUpload() {
  view_ = {};
  in_flight_ = {};
  if (images_.filled() == WaveImages::Filled::written) sea_.keep_drawn_in({}, {});
}

void WaveUpload::make_copies(Device& device, const WaveTileLayout& layout) {
  const std::size_t texel = bytes_per_texel(images_.sets()[0].displacement.spec().format);
  image_layout_ = layout;
  for (Buffer& staging : staging_)
    staging = Buffer(device, "wave staging", planes * layout.plane_texels * texel, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                     HostAccess::write);
  for (const WaveImages::Set& set : images_.sets())
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

void WaveUpload::lend_images(const WaveTileLayout& layout) {
  std::vector<WaveTiles::Lent> lent(images_.copies().size());
  image_layout_ = layout;  // but for where the levels lie
  for (std::size_t copy = 0; copy < lent.size(); ++copy)
    for (const WaveImages::Set& set : images_.copies()[copy])
      for (int layer = 0; layer < set.cascades; ++layer) {
        const auto tile = std::size_t(set.first + layer);
        for (std::size_t plane = 0; plane < planes; ++plane)
          for (std::size_t level = 0; level < std::size_t(set.levels); ++level) {
            const Image::HostTexels texels =
                set.image(WavePlane(plane)).host_texels(std::uint32_t(level), std::uint32_t(layer));
            if (images_.half_storage()) {
              lent[copy].halves[tile][level][plane] = {reinterpret_cast<std::uint16_t*>(texels.first),
                                                       std::ptrdiff_t(texels.row_bytes / sizeof(std::uint16_t))};
              continue;
            }
            glm::vec4*& first = lent[copy].floats[tile][plane];
            auto* const here = reinterpret_cast<glm::vec4*>(texels.first);
            if (level == 0) first = here;
            image_layout_.tiles[tile].level[level] = {set.samples >> level, int(texels.row_bytes / sizeof(glm::vec4)),
                                                      std::size_t(here - first)};
          }
      }
  sea_.keep_drawn_in(lent, image_layout_);
}

void WaveUpload::update(Frame& frame, std::int64_t ticks) {
  const auto own = std::size_t(frame.slot());
  in_flight_[own] = view_ = {};  // whose memory the next one may take
  view_ = sea_.view(ticks, SeaDetail::drawn);
  (void)view_.tiles();
  if (images_.filled() == WaveImages::Filled::written) {
    assert(view_.slot() >= 0 && "somebody keeps drawn views for longer than a frame");
    in_flight_[own] = view_;
    return images_.show(std::size_t(view_.slot()));
  }
  const Held wanted{ticks, sea_.waves_version()};
  if (held_ == wanted) return;
  copy(frame);
  held_ = wanted;
}

void WaveUpload::copy(Frame& frame) {
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  const WaveTiles& tiles = view_.tiles();
  const bool half = images_.half_storage();
  const std::size_t texel = half ? 8 : 16;
  // A level of a plane of a cascade at a time.
  constexpr std::size_t levels = 10;
  tbb::parallel_for(std::size_t(0), std::size_t(image_layout_.cascades * planes) * levels, [&](std::size_t i) {
    const int level = int(i % levels), cascade = int(i / levels) % image_layout_.cascades;
    const auto plane = WavePlane(int(i / levels) / image_layout_.cascades);
    if (level >= tiles.levels(cascade)) return;
    const WaveTileLayout::Level& to_level = image_layout_.level(cascade, level);
    std::byte* to = staging.mapped<std::byte>() + image_layout_.offset(cascade, plane, level) * texel;
    const glm::vec4* from = tiles.texels(cascade, plane, level);
    const std::size_t to_row = std::size_t(to_level.stride) * texel, texels = std::size_t(to_level.size);
    for (int z = 0; z < to_level.size; ++z, from += tiles.stride(cascade, level), to += to_row)
      if (half)
        halves_from_floats(&from->x, reinterpret_cast<std::uint16_t*>(to), 4 * texels);
      else
        std::memcpy(to, from, texels * texel);
  });
  Uses uses{use(staging, Access::transfer_read)};
  images_.add_uses(uses, Access::transfer_write, true);
  frame.pass("wave upload", uses, [&](Commands& c) {
    for (const Copy& copy : copies_) c.copy(staging, *copy.to, copy.regions);
  });
}

}  // namespace seascape
