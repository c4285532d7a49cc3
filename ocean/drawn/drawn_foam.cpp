#include "ocean/drawn/drawn_foam.h"

#include <spdlog/spdlog.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "ocean/foam/foam_pattern.h"
#include "ocean/waves/half_floats.h"

namespace seascape {

namespace {
constexpr auto lace_side = std::uint32_t(gpu::foam_lace_texels);

ImageSpec sampled(std::uint32_t side, std::uint32_t layers, std::uint32_t levels, VkFormat format) {
  ImageSpec spec;
  spec.width = spec.height = side;
  spec.layers = layers;
  spec.levels = levels;
  spec.format = format;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  return spec;
}
}  // namespace

DrawnFoam::DrawnFoam(Device& device, std::unique_ptr<FoamSea> foam)
    : sea_(std::move(foam)), settings_(sea_->settings().windows) {
  const EffectScope scope(device, "foam");
  const auto side = std::uint32_t(settings_.resolution), slices = std::uint32_t(settings_.slices);
  windows_ = Image(device, "foam, windows",
                   sampled(side, slices, 1, sea_->spared() ? VK_FORMAT_R16G16_SFLOAT : VK_FORMAT_R16_SFLOAT));
  lace_ = Image(device, "foam, lace",
                sampled(lace_side, 1, std::uint32_t(std::bit_width(lace_side)), VK_FORMAT_R8G8B8A8_UNORM));
  for (Buffer& staging : staging_)
    staging =
        Buffer(device, "foam, staging", std::size_t(bytes_per_texel(windows_.spec().format)) * side * side * slices,
               VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
  fill_lace(device);
  follow_wind(sea_->sea());
}

void DrawnFoam::follow_wind(const Sea& sea) {
  if (waves_ == sea.waves_version()) return;
  waves_ = sea.waves_version();
  const SeaState& state = sea.state();
  const double to = glm::radians(state.wind_to_deg), drawn_out = glm::smoothstep(9.0, 28.0, state.wind_speed_mps);
  wind_ = {std::sin(to), -std::cos(to), 1.0 - 1.0 / (1.0 + 1.5 * drawn_out), 1.0 - 1.0 / (1.0 + 5.0 * drawn_out)};
}

void DrawnFoam::fill_lace(Device& device) {
  const std::vector<std::uint8_t> lace = foam_pattern(int(lace_side));
  const Buffer staging(device, "foam, lace staging", lace.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
  std::memcpy(staging.mapped<std::byte>(), lace.data(), lace.size());
  std::vector<VkBufferImageCopy> levels;
  std::size_t offset = 0;
  for (std::uint32_t level = 0; level < lace_.spec().levels; ++level) {
    VkBufferImageCopy& region = levels.emplace_back();
    region.bufferOffset = offset;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
    region.imageExtent = {lace_side >> level, lace_side >> level, 1};
    offset += std::size_t(4) * (lace_side >> level) * (lace_side >> level);
  }
  device.run_now([&](VkCommandBuffer commands) {
    BarrierBatch barriers;
    barriers.add(lace_, Access::transfer_write, true);
    barriers.record(commands);
    vkCmdCopyBufferToImage(commands, staging.get(), lace_.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           std::uint32_t(levels.size()), levels.data());
  });
}

void DrawnFoam::update(Frame& frame, const DrawnMoment& moment) {
  if (!moment.sea.changing()) follow_wind(moment.sea);
  const std::uint32_t changed = sea_->changed();
  if (const auto fault = sea_->take_fault()) spdlog::warn("{}", *fault);
  const Foam& foam = sea_->foam();
  const LodField<float>& field = foam.field();
  const std::uint32_t all = (1u << settings_.slices) - 1u, of_interest = sea_->spared() ? all : foam.foamy() | drawn_,
                      copied = begun_ ? changed & of_interest : all;
  begun_ = true;
  if (copied == 0) return;
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  const auto side = std::uint32_t(settings_.resolution);
  const std::size_t texels = std::size_t(side) * side, slice_bytes = texels * bytes_per_texel(windows_.spec().format);
  const LodField<float>* const spared = sea_->spared();
  regions_.clear();
  for (int i = 0; i < settings_.slices; ++i) {
    if ((copied >> i & 1u) == 0) continue;
    VkBufferImageCopy region{};
    region.bufferOffset = std::size_t(i) * slice_bytes;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, std::uint32_t(field.layer(i)), 1};
    region.imageExtent = {side, side, 1};
    regions_.push_back(region);
  }
  tbb::parallel_for(std::size_t(0), regions_.size(), [&](std::size_t n) {
    const int layer = int(regions_[n].imageSubresource.baseArrayLayer),
              slice = (layer - field.layer(0) + settings_.slices) % settings_.slices;
    auto* const to = reinterpret_cast<std::uint16_t*>(staging.mapped<std::byte>() + regions_[n].bufferOffset);
    if (spared == nullptr) return halves_from_floats(field.texels(slice), to, texels);
    std::array<float, 2 * 2048> row;
    for (std::size_t z = 0; z < side; ++z) {
      for (std::size_t x = 0; x < side; ++x)
        row[2 * x] = field.texels(slice)[z * side + x], row[2 * x + 1] = spared->texels(slice)[z * side + x];
      halves_from_floats(row.data(), to + 2 * z * side, 2 * std::size_t(side));
    }
  });
  // After a change of the octave other layers hold what slices held: `drawn_` then is all.
  drawn_ = changed == all ? foam.foamy() : (drawn_ & ~copied) | (foam.foamy() & copied);
  frame.pass("foam", {use(staging, Access::transfer_read), use(windows_, Access::transfer_write)},
             [&](Commands& c) { c.copy(staging, windows_, regions_); });
}

void DrawnFoam::declare(SurfaceSlots& slots, std::size_t) const {
  slots.set(gpu::value_foam_kept, 1);
  slots.set(gpu::value_foam_spared, sea_->spared() ? 1 : 0);
  slots.bind(gpu::slot_foam, windows_);
  slots.bind(gpu::slot_foam_lace, lace_);
}

void DrawnFoam::describe(gpu::FrameData& frame, glm::dvec2 grid_origin_m) const {
  gpu::FoamData& data = frame.foam;
  const LodField<float>& field = sea_->foam().field();
  data.windows = lod_windows(settings_, field.placement(), grid_origin_m);
  const glm::dvec2 along(wind_);
  const auto drawn_out = [&](double taken) { return grid_origin_m - taken * glm::dot(grid_origin_m, along) * along; };
  const glm::dvec2 lace = drawn_out(wind_.z), wide = drawn_out(wind_.w), first = lace / double(gpu::foam_side_m);
  const double c = double(gpu::foam_turn_cos), s = double(gpu::foam_turn_sin);
  const glm::dvec2 second =
      glm::dvec2(c * lace.x + s * lace.y, c * lace.y - s * lace.x) / double(gpu::foam_fine_side_m);
  const glm::dvec2 third = glm::dvec2(c * wide.x - s * wide.y, c * wide.y + s * wide.x) / double(gpu::foam_wide_side_m);
  data.origin = glm::vec4(glm::vec2(glm::fract(first)), glm::vec2(glm::fract(second)));
  data.look = glm::vec4(glm::vec2(glm::fract(third)), sea_->fresh(), 0.0f);
  data.wind = wind_;
}

void DrawnFoam::add_uses(Uses& uses) const {
  uses.add(use(windows_, Access::surface_read));
  uses.add(use(lace_, Access::surface_read));
}

}  // namespace seascape
