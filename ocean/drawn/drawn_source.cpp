#include "ocean/drawn/drawn_source.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <string>

#include "ocean/waves/half_floats.h"
#include "ocean/waves/pattern_moments.h"

namespace seascape {

namespace {

// Where a source's layings are counted, where its three images are bound and where its layings are told.
struct SourceSlot {
  const char* name;
  bool along_curves;
  int value, slot;
  std::span<gpu::CascadeData> (*layings)(gpu::SeaData&);
};
constexpr SourceSlot source_slots[] = {
    {"baked", false, gpu::value_baked, gpu::slot_baked, [](gpu::SeaData& sea) { return std::span(&sea.baked, 1); }},
    {"gerstner", false, gpu::value_gerstner, gpu::slot_gerstner,
     [](gpu::SeaData& sea) { return std::span(&sea.gerstner, 1); }},
    {"gerstner", true, gpu::value_shore_waves, gpu::slot_shore,
     [](gpu::SeaData& sea) { return std::span(&sea.shore, 1); }},
    {"wave_particles", false, gpu::value_particles, gpu::slot_particles,
     [](gpu::SeaData& sea) { return std::span<gpu::CascadeData>(sea.particles); }},
};

const SourceSlot& slot_of(const TileSource& source) {
  const auto found = std::find_if(std::begin(source_slots), std::end(source_slots), [&](const SourceSlot& slot) {
    return source.name() == slot.name && slot.along_curves == source.along_curves();
  });
  assert(found != std::end(source_slots) && "shaders know nothing of this source");
  return *found;
}

}  // namespace

DrawnSource::DrawnSource(Device& device, std::shared_ptr<const TileSource> source, bool half)
    : source_(std::move(source)), half_(half || !device.facts().float32_linear) {
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
    levels_.push_back({plane_texels_, size});
    plane_texels_ += (std::size_t(size) * std::size_t(size) + 3) / 4 * 4;  // whole cache lines
  }
  const std::size_t texel = bytes_per_texel(tile.format);
  for (Buffer& staging : staging_)
    staging = Buffer(device, name + ", staging", planes * plane_texels_ * texel, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                     HostAccess::write);
  for (int plane = 0; plane < planes; ++plane)
    for (std::uint32_t level = 0; level < tile.levels; ++level) {
      VkBufferImageCopy region{};
      region.bufferOffset = (std::size_t(plane) * plane_texels_ + levels_[level].offset) * texel;
      region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
      region.imageExtent = {tile.width >> level, tile.height >> level, 1};
      regions_[std::size_t(plane)].push_back(region);
    }
}

void DrawnSource::take(const Sea& sea) {
  const TileSources& sources = sea.spec().sources;
  const auto found =
      std::find_if(sources.begin(), sources.end(), [&](const auto& other) { return alike(*other, *source_); });
  assert(found != sources.end());
  if (*found == source_) return;
  source_ = *found;
  uploaded_ = false;
}

void DrawnSource::update(Frame& frame, const DrawnMoment& moment) {
  const SeaView& view = moment.water;
  if (uploaded_ && view.ticks() == ticks_) return;
  uploaded_ = true;
  ticks_ = view.ticks();
  const TileSources& sources = view.field().others();
  const auto found = std::find(sources.begin(), sources.end(), source_);
  assert(found != sources.end());
  const int tile = view.field().quality().cascades + int(found - sources.begin());
  const WaveTiles& tiles = view.tiles();
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  const std::size_t texel = half_ ? 8 : 16;
  tbb::parallel_for(std::size_t(0), planes * levels_.size(), [&](std::size_t i) {
    const std::size_t plane = i % planes, level = i / planes;
    const auto [offset, size] = levels_[level];
    const glm::vec4* from = tiles.texels(tile, WavePlane(plane), int(level));
    std::byte* to = staging.mapped<std::byte>() + (plane * plane_texels_ + offset) * texel;
    const std::size_t row = std::size_t(size) * texel;
    for (int z = 0; z < size; ++z, from += tiles.stride(tile, int(level)), to += row)
      if (half_)
        halves_from_floats(&from->x, reinterpret_cast<std::uint16_t*>(to), 4 * std::size_t(size));
      else
        std::memcpy(to, from, row);
  });
  Uses uses{use(staging, Access::transfer_read)};
  add_uses(uses, Access::transfer_write, true);
  frame.pass(source_->name().data(), uses, [&](Commands& c) {
    for (std::size_t plane = 0; plane < planes; ++plane) c.copy(staging, images_[plane], regions_[plane]);
  });
}

void DrawnSource::add_uses(Uses& uses, Access access, bool whole) const {
  for (const Image& image : images_) uses.add(use(image, access, whole));
}

void DrawnSource::declare(SurfaceSlots& slots, std::size_t) const {
  const SourceSlot& own = slot_of(*source_);
  slots.set(own.name, own.value, std::uint32_t(source_->layings().size()));
  for (int plane = 0; plane < planes; ++plane) slots.bind(own.slot + plane, images_[std::size_t(plane)]);
}

void DrawnSource::describe(gpu::FrameData& data, glm::dvec2 grid_origin_m) const {
  const std::span<gpu::CascadeData> layings = slot_of(*source_).layings(data.sea);
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
    d.decay = glm::vec4(glm::vec3(pattern_moments(*source_, laying).decay_per_m2()), 0.0f);
  }
}

}  // namespace seascape
