#include "ocean/drawn/level_images.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ocean/waves/half_floats.h"

namespace seascape {

namespace {
constexpr std::size_t texel_bytes = 8;  // four half floats
}

LevelImages::LevelImages(Device& device, const char* effect, int samples, int layers, bool joined)
    : effect_(effect), layers_(layers) {
  const EffectScope scope(device, effect);
  ImageSpec spec;
  spec.width = spec.height = std::uint32_t(samples);
  spec.layers = std::uint32_t(joined ? 2 * layers : layers);
  spec.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  const std::string name = effect;
  images_.emplace_back(device, name + (joined ? ", levels" : ", shift"), spec);
  if (!joined) images_.emplace_back(device, name + ", slope", spec);
  const std::size_t bytes = images_.size() * spec.layers * spec.width * spec.height * texel_bytes;
  for (Buffer& staging : staging_)
    staging = Buffer(device, name + ", staging", bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
}

void LevelImages::fill(Frame& frame, std::span<const Level> levels) {
  const std::uint32_t samples = shift().spec().width;
  const std::size_t texels = std::size_t(samples) * samples;
  regions_.clear();
  for (const Level& level : levels) {
    VkBufferImageCopy region{};
    region.bufferOffset = std::size_t(level.layer) * texels * texel_bytes;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, std::uint32_t(level.layer), 1};
    region.imageExtent = {samples, samples, 1};
    regions_.push_back(region);
  }
  if (regions_.empty()) return;
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  const std::size_t plane_bytes = std::size_t(layers()) * texels * texel_bytes;
  tbb::parallel_for(std::size_t(0), 2 * regions_.size(), [&](std::size_t n) {
    const Level& level = levels[n / 2];
    const glm::vec4* from = (n % 2 == 0 ? level.surface->shift(level.level) : level.surface->slope(level.level)).data();
    halves_from_floats(&from->x,
                       reinterpret_cast<std::uint16_t*>(staging.mapped<std::byte>() + n % 2 * plane_bytes +
                                                        regions_[n / 2].bufferOffset),
                       4 * texels);
  });
  Uses uses{use(staging, Access::transfer_read)};
  add_uses(uses, Access::transfer_write);
  frame.pass(effect_, uses, [&](Commands& c) {
    c.copy(staging, shift(), regions_);
    for (VkBufferImageCopy& region : regions_) {
      region.bufferOffset += plane_bytes;
      if (images_.size() == 1) region.imageSubresource.baseArrayLayer += std::uint32_t(layers_);
    }
    c.copy(staging, slope(), regions_);
  });
}

void LevelImages::add_uses(Uses& uses, Access access) const {
  for (const Image& image : images_) uses.add(use(image, access));
}

// A mesh misses a surface bent by c by at most c d^2 / 8 between vertices d apart, d being a cell's diagonal; and twice
// the height at most.
std::optional<NearMeshError> near_mesh_error(const DynamicSurface::Extent& waves, double reach_m, int steps) {
  if (!(waves.height_m > 1e-4)) return std::nullopt;
  const auto stepped = [&](double value) { return std::exp2(std::ceil(steps * std::log2(value)) / steps); };
  const double bent = stepped(1.1 * waves.bent_per_m), most_m = 2.0 * stepped(waves.height_m);
  NearMeshError near;
  near.reach_m = reach_m;
  for (std::size_t n = 0; n < near.error.octave_m.size(); ++n) {
    const double spacing_m = std::ldexp(MeshError::least_spacing_m, int(n));
    near.error.octave_m[n] =
        std::min({0.25 * bent * spacing_m * spacing_m, MeshError::most_over_spacing * spacing_m, most_m});
  }
  return near;
}

}  // namespace seascape
