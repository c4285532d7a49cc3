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
  LodChanges changes;
  if (field_) {
    changes = field_->follow(placement, time_s);
  } else {
    changes.fill(whole_change(settings_.windows.resolution));
    field_ = std::make_unique<PlaceField<ShoreTexel>>(shore_values(lines_, shallows_), settings_, placement, time_s);
  }
  if (changed_slices(changes) == 0) return;
  const LodField<ShoreTexel>& field = field_->field();
  const auto copy = [&](DrawnWindows& windows, const auto& part) {
    const int channels = windows.channels();
    windows.copy(
        frame, "gerstner", changes, [&](int slice) { return field.layer(slice); },
        [&](int slice, int, int z, int x, std::span<float> texels) {
          const ShoreTexel* texel = field.texels(slice) + std::int64_t(z) * field.side() + x;
          for (std::size_t at = 0; at < texels.size(); ++texel)
            for (int c = 0; c < channels; ++c) texels[at++] = part(*texel)[c];
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
