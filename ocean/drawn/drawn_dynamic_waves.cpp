#include "ocean/drawn/drawn_dynamic_waves.h"

#include <spdlog/spdlog.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/waves/half_floats.h"

namespace seascape {

namespace {
constexpr std::size_t texel_bytes = 8;  // four half floats
}

DrawnDynamicWaves::DrawnDynamicWaves(Device& device, const DynamicSeaSettings& settings) {
  const EffectScope scope(device, "dynamic_waves");
  ImageSpec spec;
  spec.width = spec.height = std::uint32_t(settings.waves.windows.resolution);
  spec.layers = std::uint32_t(settings.waves.windows.slices);
  spec.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  images_ = {Image(device, "dynamic waves, shift", spec), Image(device, "dynamic waves, slope", spec)};
  const std::size_t bytes = images_.size() * spec.layers * spec.width * spec.height * texel_bytes;
  for (Buffer& staging : staging_)
    staging = Buffer(device, "dynamic waves, staging", bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
  mesh_errors_.reserve(spec.layers);
}

void DrawnDynamicWaves::update(Frame& frame, const DrawnMoment& moment) {
  Sea& sea = moment.sea;
  const std::uint64_t version = sea.dynamic_waves()->surface_version();
  if (surface_ != nullptr && version == version_) return;
  version_ = version;
  surface_ = nullptr;  // whose memory the next one may take
  surface_ = sea.dynamic_surface();
  if (const auto fault = sea.take_fault()) spdlog::warn("{}", *fault);
  const DynamicSurface& surface = *surface_;
  const std::uint32_t samples = images_[0].spec().width, layers = images_[0].spec().layers;
  const std::size_t texels = std::size_t(samples) * samples;
  reach_ = {};
  regions_.clear();
  for (int i = 0; i < surface.levels(); ++i) {
    if (surface.still(i)) continue;
    reach_.height_m += surface.extent(i).height_m;
    reach_.shift_m += surface.extent(i).shift_m;
    VkBufferImageCopy region{};
    region.bufferOffset = std::size_t(i) * texels * texel_bytes;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, std::uint32_t(i), 1};
    region.imageExtent = {samples, samples, 1};
    regions_.push_back(region);
  }
  find_mesh_errors();
  if (regions_.empty()) return;
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  const std::size_t plane_bytes = layers * texels * texel_bytes;
  tbb::parallel_for(std::size_t(0), 2 * regions_.size(), [&](std::size_t n) {
    const VkBufferImageCopy& region = regions_[n / 2];
    const int level = int(region.imageSubresource.baseArrayLayer);
    const glm::vec4* from = (n % 2 == 0 ? surface.shift(level) : surface.slope(level)).data();
    halves_from_floats(
        &from->x,
        reinterpret_cast<std::uint16_t*>(staging.mapped<std::byte>() + n % 2 * plane_bytes + region.bufferOffset),
        4 * texels);
  });
  Uses uses{use(staging, Access::transfer_read)};
  add_uses(uses, Access::transfer_write);
  frame.pass("dynamic_waves", uses, [&](Commands& c) {
    c.copy(staging, images_[0], regions_);
    for (VkBufferImageCopy& region : regions_) region.bufferOffset += plane_bytes;
    c.copy(staging, images_[1], regions_);
  });
}

// A mesh misses a surface bent by c by at most c d^2 / 8 between vertices d apart, d being a cell's diagonal; and twice
// the height at most.
void DrawnDynamicWaves::find_mesh_errors() {
  const DynamicSurface& surface = *surface_;
  const auto step_of_two = [](double value) { return std::exp2(std::ceil(std::log2(value))); };
  const gpu::LodWindows windows = surface.windows(glm::dvec2(0.0));
  mesh_errors_.clear();
  for (int i = 0; i < surface.levels(); ++i) {
    const double height_m = surface.extent(i).height_m;
    if (surface.still(i) || !(height_m > 1e-4)) continue;
    const double bent = step_of_two(1.1 * surface.extent(i).bent_per_m), most_m = 2.0 * step_of_two(height_m);
    NearMeshError& near = mesh_errors_.emplace_back();
    // Squares: their corners are the farthest.
    near.reach_m = std::numbers::sqrt2 * std::min(double(windows.reach.x) * std::exp2(i), double(windows.reach.y));
    for (std::size_t n = 0; n < near.error.octave_m.size(); ++n) {
      const double spacing_m = std::ldexp(MeshError::least_spacing_m, int(n));
      near.error.octave_m[n] =
          std::min({0.25 * bent * spacing_m * spacing_m, MeshError::most_over_spacing * spacing_m, most_m});
    }
  }
}

void DrawnDynamicWaves::declare(SurfaceSlots& slots, std::size_t) const {
  slots.set("dynamic_waves", gpu::value_dynamic_levels, images_[0].spec().layers);
  slots.bind(gpu::slot_dynamic_shift, images_[0]);
  slots.bind(gpu::slot_dynamic_slope, images_[1]);
}

void DrawnDynamicWaves::describe(gpu::FrameData& frame, glm::dvec2 grid_origin_m) const {
  gpu::DynamicData& data = frame.sea.dynamic;
  const DynamicSurface& surface = *surface_;
  data.windows = surface.windows(grid_origin_m);
  for (int i = 0; i < surface.levels(); ++i) {
    const bool still = surface.still(i);
    data.level[i] = glm::vec4(glm::vec3(surface.extent(i).slope_moments), still    ? 0.0f
                                                                          : i == 0 ? 1.0f - data.windows.reach.z
                                                                                   : 1.0f);
  }
  data.share = glm::vec4(float(surface.share()), 0.0f, 0.0f, 0.0f);
}

void DrawnDynamicWaves::add_uses(Uses& uses, Access access) const {
  for (const Image& image : images_) uses.add(use(image, access));
}

}  // namespace seascape
