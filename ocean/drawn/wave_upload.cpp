#include "ocean/drawn/wave_upload.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "ocean/waves/half_floats.h"

namespace seascape {

WaveUpload::WaveUpload(Device& device, const SeaState& sea, const WaveQuality& quality, const WaveBins& bins,
                       WaveImages& images)
    : field_(sea, quality, bins), images_(images), held_(images.copies().size()) {
  const EffectScope scope(device, "waves");
  if (images.filled() == WaveImages::Filled::written)
    find_levels(WaveTileLayout(quality));
  else
    make_copies(device, WaveTileLayout(quality));
}

void WaveUpload::make_copies(Device& device, const WaveTileLayout& layout) {
  // Half floats keep the layout of the floats that they were converted from, padding and all.
  const std::size_t texel = bytes_per_texel(images_.sets()[0].displacement.spec().format);
  for (Buffer& staging :
       staging_)  // cached, since the field reads levels there for the next: coarser ones are their averages
    staging = Buffer(device, "wave staging", planes * layout.plane_texels * texel, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                     HostAccess::read);
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

void WaveUpload::find_levels(const WaveTileLayout& layout) {
  levels_.resize(held_.size());
  places_.resize(held_.size());
  image_layout_ = layout;  // but for where the levels lie
  for (std::size_t copy = 0; copy < held_.size(); ++copy)
    for (const WaveImages::Set& set : images_.copies()[copy])
      for (int layer = 0; layer < set.cascades; ++layer) {
        const int cascade = set.first + layer;
        WaveTileLayout::Tile& tile = image_layout_.tiles[std::size_t(cascade)];
        for (int plane = 0; plane < planes; ++plane)
          for (int level = 0; level < set.levels; ++level) {
            const Image::HostTexels texels =
                set.image(WavePlane(plane)).host_texels(std::uint32_t(level), std::uint32_t(layer));
            levels_[copy].push_back({cascade, level, WavePlane(plane), texels});
            if (images_.half_storage()) continue;
            glm::vec4*& first = places_[copy][std::size_t(cascade)][std::size_t(plane)];
            auto* const here = reinterpret_cast<glm::vec4*>(texels.first);
            if (level == 0) first = here;
            tile.level[std::size_t(level)] = {set.samples >> level, int(texels.row_bytes / sizeof(glm::vec4)),
                                              std::size_t(here - first)};
          }
      }
}

void WaveUpload::take(const WaveBins& bins, double chop, const SeaStatistics& statistics) {
  field_.take(bins, chop, statistics);
  std::fill(held_.begin(), held_.end(), std::nullopt);
}

QueryAnswer WaveUpload::query(glm::dvec2 place_m) const {
  QueryAnswer answer;
  seascape::query(field_, tiles_, {&place_m, 1}, {&answer, 1});
  return answer;
}

void WaveUpload::update(Frame& frame, std::int64_t ticks) {
  // Not an older copy either: selection asks the tiles, which are of the last time that was evaluated.
  const auto held = std::find(held_.begin(), held_.end(), ticks);
  if (held != held_.end() && tiles_.ticks() == ticks) return images_.show(std::size_t(held - held_.begin()));
  if (images_.filled() == WaveImages::Filled::copied) {
    copy(frame, ticks);
    held_[0] = ticks;
    return;
  }
  const auto own = std::size_t(frame.slot());
  write(own, ticks);
  held_[own] = ticks;
  images_.show(own);
}

void WaveUpload::write(std::size_t copy, std::int64_t ticks) {
  if (!images_.half_storage()) {
    tiles_.keep_in(places_[copy], image_layout_);
    field_.evaluate(ticks, tiles_);
    return;
  }
  field_.evaluate(ticks, tiles_);
  constexpr int piece = 32;  // rows
  std::size_t pieces = 0;
  for (const Level& l : levels_[copy])
    pieces += std::size_t((tiles_.samples(l.cascade) >> l.level) + piece - 1) / piece;
  tbb::parallel_for(std::size_t(0), pieces, [&](std::size_t i) {
    for (const Level& l : levels_[copy]) {
      const int size = tiles_.samples(l.cascade) >> l.level;
      const auto here = std::size_t((size + piece - 1) / piece);
      if (i >= here) {
        i -= here;
        continue;
      }
      for (int z = int(i) * piece; z < std::min(size, (int(i) + 1) * piece); ++z)
        halves_from_floats(&tiles_.texels(l.cascade, l.plane, l.level)[z * tiles_.stride(l.cascade, l.level)].x,
                           reinterpret_cast<std::uint16_t*>(l.texels.first + std::size_t(z) * l.texels.row_bytes),
                           4 * std::size_t(size));
      return;
    }
  });
}

void WaveUpload::copy(Frame& frame, std::int64_t ticks) {
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  if (images_.half_storage()) {
    field_.evaluate(ticks, tiles_);
    constexpr std::size_t piece = 1 << 13;  // texels: a quarter of a second-level cache's usual size
    const std::size_t texels = planes * tiles_.layout().plane_texels, pieces = (texels + piece - 1) / piece;
    tbb::parallel_for(std::size_t(0), pieces, [&](std::size_t i) {
      const std::size_t first = i * piece, count = std::min(piece, texels - first);
      halves_from_floats(&tiles_.texels(0, WavePlane::shift, 0)[first].x, staging.mapped<std::uint16_t>() + 4 * first,
                         4 * count);
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
