#include "ocean/drawn/wave_images.h"

#include <spdlog/spdlog.h>

#include <bit>
#include <cmath>

namespace seascape {

WaveImages::WaveImages(Device& device, const SeaState& sea, const WaveQuality& quality, const WaveBins& bins,
                       const SeaStatistics& statistics, double anisotropy, Filled filled, int in_flight)
    : ladder_(bins.ladder), warp_(bins.ladder), statistics_(statistics), chop_(sea.chop), filled_(filled) {
  const EffectScope scope(device, "waves");
  half_ = quality.half_storage || !device.facts().float32_linear;
  if (half_ && !quality.half_storage)
    spdlog::info("waves: {} cannot filter 32-bit tiles; they are stored as 16-bit floats", device.facts().name);
  for (int c = 0; c < bins.cascades; ++c) cascade_moments_.push_back(pattern_moments(bins, c));

  std::vector<ImageSpec> specs;
  for (const int first : {0, 1}) {
    if (first >= bins.cascades) break;
    const int samples = tile_samples(quality, first);
    const int count = first == 0 ? 1 : bins.cascades - 1;
    ImageSpec tile;
    tile.width = tile.height = std::uint32_t(samples);
    tile.layers = std::uint32_t(count);
    tile.levels = std::uint32_t(std::bit_width(unsigned(samples)));
    tile.format = half_ ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
    tile.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (filled_ == Filled::written && !host_may_write(device, tile)) filled_ = Filled::copied;
    specs.push_back(tile);
  }
  for (ImageSpec& tile : specs) {
    if (filled_ == Filled::stored) tile.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (filled_ == Filled::copied) tile.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    tile.host = filled_ == Filled::written;
  }
  copies_.resize(filled_ == Filled::written ? std::size_t(in_flight) : 1);
  for (std::vector<Set>& sets : copies_)
    for (const ImageSpec& tile : specs)
      sets.push_back({sets.empty() ? 0 : 1, int(tile.layers), int(tile.width), int(tile.levels),
                      Image(device, "wave displacement", tile), Image(device, "wave derivatives", tile),
                      Image(device, "wave moments", tile)});
  const EffectScope shared(device, "surface");  // every tile is sampled with them
  smooth_sampler_ = make_sampler(device, "sea, smooth", {true, true, 1.0f});
  pixel_sampler_ = make_sampler(device, "sea, pixels", {true, true, float(anisotropy)});
}

void WaveImages::take(const WaveBins& bins, double chop, const SeaStatistics& statistics) {
  statistics_ = statistics;
  chop_ = chop;
  for (int c = 0; c < cascades(); ++c) cascade_moments_[std::size_t(c)] = pattern_moments(bins, c);
}

void WaveImages::add_reads(Uses& uses) const {
  add_uses(uses, filled_ == Filled::written ? Access::host_texels : Access::surface_read);
}

void WaveImages::add_uses(Uses& uses, Access access, bool whole) const {
  for (const Set& set : sets())
    for (const Image* image : {&set.displacement, &set.derivatives, &set.moments}) uses.add(use(*image, access, whole));
}

void WaveImages::describe(gpu::SeaData& data, glm::dvec2 grid_origin_m) const {
  for (std::size_t i = 0; i < cascade_moments_.size(); ++i) {
    const Cascade& cascade = ladder_[i];
    const double c = std::cos(cascade.rotation_rad) / cascade.side_m,
                 s = std::sin(cascade.rotation_rad) / cascade.side_m;
    const glm::dvec2 origin(c * grid_origin_m.x + s * grid_origin_m.y, -s * grid_origin_m.x + c * grid_origin_m.y);
    gpu::CascadeData& d = data.cascade[i];
    d.tile_from_rest = glm::vec4(float(c), float(s), float(-s), float(c));
    const int samples = sets()[i == 0 ? 0 : 1].samples;
    const double half_texel = 0.5 / samples;
    d.origin = glm::vec4(float(origin.x - std::floor(origin.x) + half_texel),
                         float(origin.y - std::floor(origin.y) + half_texel), float(cascade.side_m / samples),
                         float(shortest_wave(cascade)));
    d.moments = glm::vec4(glm::vec3(cascade_moments_[i].slope_moments), float(longest_wave(cascade)));
    d.decay = glm::vec4(glm::vec3(cascade_moments_[i].decay_per_m2()), 0.0f);
  }
  data.warp = warp_.from(grid_origin_m);
  data.tail = glm::vec4(glm::vec3(statistics_.tail_slope_moments), float(chop_));
  data.footprint.z = float(statistics_.largest_height_m);
}

}  // namespace seascape
