#include "ocean/local/drawn_place.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ocean/local/flow_phase.h"
#include "ocean/waves/half_floats.h"

namespace seascape {

namespace {

struct Format {
  VkFormat format;
  int channels;
  bool half;
};

// Heights of lakes in mountains need whole floats, where the device samples those.
Format format_of(InputTarget kind, bool whole) {
  switch (kind) {
    case InputTarget::level: return whole ? Format{VK_FORMAT_R32_SFLOAT, 1, false} : Format{VK_FORMAT_R16_SFLOAT, 1, true};
    case InputTarget::clip: return {VK_FORMAT_R16_SFLOAT, 1, true};
    case InputTarget::albedo: return {VK_FORMAT_R16G16B16A16_SFLOAT, 4, true};
    default: return {VK_FORMAT_R16G16_SFLOAT, 2, true};
  }
}

}  // namespace

DrawnPlace::DrawnPlace(Device& device, const PlaceInputs& inputs) : settings_(inputs.settings) {
  validate(settings_);
  for (const auto& kind : inputs.kinds) {
    const std::string name(traits(kind->target()).name);
    const EffectScope scope(device, name);
    const Format format = format_of(kind->target(), device.facts().float32_linear);
    ImageSpec spec;
    spec.width = spec.height = std::uint32_t(settings_.windows.resolution);
    spec.layers = std::uint32_t(settings_.windows.slices);
    spec.format = format.format;
    spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    Drawn drawn{kind->target(), nullptr, kind, format.channels, format.half, Image(device, name + ", windows", spec), {}};
    const std::size_t bytes = std::size_t(spec.layers) * spec.width * spec.height * bytes_per_texel(spec.format);
    for (Buffer& staging : drawn.staging) staging = Buffer(device, name + ", staging", bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
    drawn_.push_back(std::move(drawn));
  }
  const EffectScope scope(device, traits(drawn_.front().kind).name);
  sampler_ = make_sampler(device, "places", {});
}

void DrawnPlace::update(Frame& frame, double time_s, const glm::dvec3& viewer) {
  if (!std::isfinite(viewer.x + viewer.y + viewer.z)) return;
  // Where a place is read from follows from the viewer alone, at once: a picture does not depend on those before it.
  placement_ = lod_placement(settings_.windows, {viewer.x, viewer.z}, lod_scale(settings_.windows, viewer.y));
  for (Drawn& drawn : drawn_) {
    std::uint32_t changed = (1u << settings_.windows.slices) - 1u;
    if (drawn.field) changed = drawn.field->follow(placement_, time_s);
    else drawn.field = std::make_unique<PlaceField>(drawn.inputs, settings_, placement_, time_s);
    if (changed != 0) copy(frame, drawn, changed);
  }
}

void DrawnPlace::copy(Frame& frame, Drawn& drawn, std::uint32_t slices) {
  const LodField<glm::vec4>& field = drawn.field->field();
  const std::uint32_t side = drawn.image.spec().width;
  const std::size_t texels = std::size_t(side) * side, texel_bytes = bytes_per_texel(drawn.image.spec().format);
  const auto channels = std::size_t(drawn.channels);
  const Buffer& staging = drawn.staging[std::size_t(frame.slot())];
  std::vector<VkBufferImageCopy> regions;
  for (int i = 0; i < field.slices(); ++i) {
    if ((slices >> i & 1u) == 0) continue;
    VkBufferImageCopy region{};
    region.bufferOffset = std::size_t(i) * texels * texel_bytes;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, std::uint32_t(field.layer(i)), 1};
    region.imageExtent = {side, side, 1};
    regions.push_back(region);
    tbb::parallel_for(0u, side, [&](std::uint32_t row) {
      const glm::vec4* from = field.texels(i) + std::size_t(row) * side;
      std::byte* to = staging.mapped<std::byte>() + region.bufferOffset + std::size_t(row) * side * texel_bytes;
      std::array<float, 4 * 2048> line;
      for (std::uint32_t x = 0; x < side; ++x)
        for (std::size_t c = 0; c < channels; ++c) line[x * channels + c] = from[x][int(c)];
      if (drawn.half) halves_from_floats(line.data(), reinterpret_cast<std::uint16_t*>(to), side * channels);
      else std::memcpy(to, line.data(), side * channels * sizeof(float));
    });
  }
  frame.pass(traits(drawn.kind).name.data(), {use(staging, Access::transfer_read), use(drawn.image, Access::transfer_write)},
             [&](Commands& c) { c.copy(staging, drawn.image, regions); });
}

void DrawnPlace::describe(gpu::PlaceData& data, glm::dvec2 grid_origin_m, double time_s) const {
  data.windows = lod_windows(settings_.windows, placement_, grid_origin_m);
  const glm::vec4 current = place_outside(settings_, InputTarget::flow);
  data.outside = glm::vec4(float(settings_.level_m), settings_.clip_by_default ? 1.0f : 0.0f, current.x, current.y);
  const FlowPhase phase = flow_phase(time_s, settings_.flow_period_s);
  data.flow = glm::vec4(float(phase.first_s), float(phase.second_s), float(phase.first), float(0.5 * settings_.flow_period_s));
}

void DrawnPlace::add_uses(Uses& uses, Access access) const {
  for (const Drawn& drawn : drawn_) uses.add(use(drawn.image, access));
}

const DrawnPlace::Drawn* DrawnPlace::drawn(InputTarget kind) const {
  const auto found = std::find_if(drawn_.begin(), drawn_.end(), [&](const Drawn& d) { return d.kind == kind; });
  return found == drawn_.end() ? nullptr : &*found;
}
const Image* DrawnPlace::image(InputTarget kind) const {
  const Drawn* found = drawn(kind);
  return found == nullptr ? nullptr : &found->image;
}
const PlaceField* DrawnPlace::field(InputTarget kind) const {
  const Drawn* found = drawn(kind);
  return found == nullptr ? nullptr : found->field.get();
}

double DrawnPlace::level_m() const {
  const PlaceField* level = field(InputTarget::level);
  return level == nullptr ? 0.0 : std::max(std::abs(level->least()), std::abs(level->most()));
}

}  // namespace seascape
