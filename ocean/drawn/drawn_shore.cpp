#include "ocean/drawn/drawn_shore.h"

namespace seascape {

DrawnShore::DrawnShore(Device& device, std::shared_ptr<const ShoreLines> lines,
                       std::shared_ptr<const Shallows> shallows, const PlaceSettings& settings)
    : lines_(std::move(lines)),
      shallows_(std::move(shallows)),
      settings_(settings),
      of_lines_(device, "gerstner along curves", settings.windows,
                device.facts().float32_linear ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R16G16B16A16_SFLOAT),
      of_ways_(device, "gerstner along curves, ways", settings.windows, VK_FORMAT_R16G16_SFLOAT) {}

void DrawnShore::take(std::shared_ptr<const ShoreLines> lines, std::shared_ptr<const Shallows> shallows) {
  if (lines == lines_ && shallows == shallows_) return;
  lines_ = std::move(lines);
  shallows_ = std::move(shallows);
  if (field_) field_->take(shore_values(lines_, shallows_), settings_);
}

void DrawnShore::update(Frame& frame, const LodPlacement& placement, double time_s) {
  std::uint32_t changed = (1u << settings_.windows.slices) - 1u;
  if (field_) {
    changed = field_->follow(placement, time_s);
  } else {
    field_ = std::make_unique<PlaceField<ShoreTexel>>(shore_values(lines_, shallows_), settings_, placement, time_s);
  }
  if (changed == 0) return;
  const LodField<ShoreTexel>& field = field_->field();
  const auto copy = [&](DrawnWindows& windows, const auto& part) {
    const int channels = windows.channels();
    windows.copy(
        frame, "gerstner", changed, [&](int slice) { return field.layer(slice); },
        [&](int slice, int, int z, std::span<float> texels) {
          std::size_t at = 0;
          const ShoreTexel* row = field.texels(slice) + std::size_t(z) * std::size_t(field.side());
          for (std::int64_t x = 0; x < field.side(); ++x)
            for (int c = 0; c < channels; ++c) texels[at++] = part(row[x])[c];
        });
  };
  const glm::vec4 drawn(1.0f, 1.0f, 1.0f, bytes_per_texel(lines().spec().format) == 16 ? 1.0f : 0.0f);
  copy(of_lines_, [&](const ShoreTexel& texel) { return drawn * texel.line; });
  copy(of_ways_, [](const ShoreTexel& texel) { return texel.way; });
}

void DrawnShore::add_uses(Uses& uses, Access access) const {
  uses.add(use(lines(), access));
  uses.add(use(ways(), access));
}

}  // namespace seascape
