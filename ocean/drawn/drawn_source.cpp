#include "ocean/drawn/drawn_source.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "ocean/waves/half_floats.h"

namespace seascape {

DrawnSource::DrawnSource(Device& device, std::shared_ptr<const TileSource> source, bool half)
    : source_(std::move(source)),
      half_(half || !device.facts().float32_linear),
      workspace_(source_->workspace_floats(false)) {
  const EffectScope scope(device, source_->name());
  const std::string name = std::string(source_->name()) + (source_->along_curves() ? " along curves" : "");
  const int samples = source_->samples();
  ImageSpec tile;
  tile.width = tile.height = std::uint32_t(samples);
  tile.levels = std::uint32_t(std::bit_width(unsigned(samples)));
  tile.format = half_ ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
  tile.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  images_ = {Image(device, name + ", displacement", tile), Image(device, name + ", derivatives", tile),
             Image(device, name + ", moments", tile)};
  for (int size = samples; size >= 1; size /= 2) {
    offsets_.push_back(plane_texels_);
    plane_texels_ += (std::size_t(size) * std::size_t(size) + 3) / 4 * 4;  // whole cache lines
  }
  const std::size_t texel = bytes_per_texel(tile.format);
  for (Buffer& staging : staging_)  // cached, since coarser levels are averages of what lies there
    staging = Buffer(device, name + ", staging", planes * plane_texels_ * texel, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                     HostAccess::read);
  for (int plane = 0; plane < planes; ++plane)
    for (std::uint32_t level = 0; level < tile.levels; ++level) {
      VkBufferImageCopy region{};
      region.bufferOffset = (std::size_t(plane) * plane_texels_ + offsets_[level]) * texel;
      region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
      region.imageExtent = {tile.width >> level, tile.height >> level, 1};
      regions_[std::size_t(plane)].push_back(region);
    }
  if (half_) texels_.resize(planes * plane_texels_);
}

void DrawnSource::update(Frame& frame, std::int64_t ticks) {
  if (uploaded_ && ticks == ticks_) return;
  uploaded_ = true;
  ticks_ = ticks;
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  glm::vec4* const first = half_ ? texels_.data() : staging.mapped<glm::vec4>();
  std::array<PlaneLevel, 10> levels{};
  for (std::size_t level = 0; level < offsets_.size(); ++level) {
    for (std::size_t plane = 0; plane < planes; ++plane)
      levels[level].texels[plane] = first + plane * plane_texels_ + offsets_[level];
    levels[level].stride = source_->samples() >> level;
  }
  source_->evaluate(ticks, false, {levels.data(), offsets_.size()}, workspace_);
  if (half_) {
    constexpr std::size_t piece = 1 << 13;  // texels
    tbb::parallel_for(std::size_t(0), (texels_.size() + piece - 1) / piece, [&](std::size_t i) {
      const std::size_t from = i * piece;
      halves_from_floats(&texels_[from].x, staging.mapped<std::uint16_t>() + 4 * from,
                         4 * std::min(piece, texels_.size() - from));
    });
  }
  Uses uses{use(staging, Access::transfer_read)};
  add_uses(uses, Access::transfer_write, true);
  frame.pass(source_->name().data(), uses, [&](Commands& c) {
    for (std::size_t plane = 0; plane < planes; ++plane) c.copy(staging, images_[plane], regions_[plane]);
  });
}

void DrawnSource::add_uses(Uses& uses, Access access, bool whole) const {
  for (const Image& image : images_) uses.add(use(image, access, whole));
}

void DrawnSource::describe(std::span<gpu::CascadeData> layings, glm::dvec2 grid_origin_m) const {
  const glm::dvec3 moments = source_->statistics().slope_moments;
  const double half_texel = 0.5 / source_->samples();
  std::size_t i = 0;
  for (const Laying& laying : source_->layings()) {
    const glm::dvec2 row = glm::dvec2(std::cos(laying.rotation_rad), std::sin(laying.rotation_rad)) / laying.side_m,
                     column(-row.y, row.x);
    const glm::dvec2 from = source_->along_curves()
                                ? glm::dvec2(0.0)
                                : grid_origin_m;  // coordinates along a curve do not count from the grid
    const glm::dvec2 origin = glm::dvec2(glm::dot(row, from), glm::dot(column, from)) + laying.offset;
    gpu::CascadeData& d = layings[i++];
    d.tile_from_rest = glm::vec4(glm::dvec4(row, column));
    d.origin = glm::vec4(float(origin.x - std::floor(origin.x) + half_texel),
                         float(origin.y - std::floor(origin.y) + half_texel), float(laying.side_m / source_->samples()),
                         float(laying.shortest_m));
    d.moments = glm::vec4(glm::vec3(moments), float(laying.longest_m));
  }
}

}  // namespace seascape
