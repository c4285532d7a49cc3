#include "ocean/local/place_fields.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

namespace {
void require(bool holds, double value, const char* name, const char* range) {
  if (!holds || !std::isfinite(value)) throw Error(name, text_from(value) + " is not " + range, std::string("give a number ") + range);
}
}  // namespace

void validate(const PlaceSettings& s) {
  validate(s.windows);
  require(s.rate_hz > 0.0, s.rate_hz, "rate_hz", "above 0");
  require(std::abs(s.level_m) <= 10000.0, s.level_m, "level_m", "from -10000 to 10000");
  require(true, s.flow_to_deg, "flow_to_deg", "finite");
  require(s.flow_mps >= 0.0 && s.flow_mps <= 100.0, s.flow_mps, "flow_mps", "from 0 to 100");
  require(s.flow_period_s > 0.0, s.flow_period_s, "flow_period_s", "above 0");
}

glm::vec4 place_outside(const PlaceSettings& s, InputTarget kind) {
  switch (kind) {
    case InputTarget::level: return glm::vec4(float(s.level_m), 0.0f, 0.0f, 0.0f);
    case InputTarget::flow: return glm::vec4(float(s.flow_mps * std::sin(glm::radians(s.flow_to_deg))), float(-s.flow_mps * std::cos(glm::radians(s.flow_to_deg))), 0.0f, 0.0f);
    case InputTarget::clip: return glm::vec4(s.clip_by_default ? 1.0f : 0.0f, 0.0f, 0.0f, 0.0f);
    default: return glm::vec4(0.0f);
  }
}

double place_time_s(const PlaceSettings& s, const Inputs& inputs, double time_s) {
  if (inputs.still() || !std::isfinite(time_s)) return 0.0;
  return std::floor(time_s * s.rate_hz + 1e-6) / s.rate_hz;
}

PlaceField::PlaceField(std::shared_ptr<const Inputs> inputs, const PlaceSettings& settings, const LodPlacement& placement, double time_s)
    : inputs_(std::move(inputs)),
      outside_(place_outside(settings, inputs_->target())),
      settings_(settings),
      time_s_(place_time_s(settings, *inputs_, time_s)),
      least_(outside_.x),
      most_(outside_.x),
      field_(settings.windows, outside_, placement) {
  for (int i = 0; i < settings.windows.slices; ++i)
    field_.each(i, [&](LodIndex w) { field_.texel(i, w) = value(field_.middle(i, w), field_.texel_m(i)); });
}

glm::vec4 PlaceField::value(glm::dvec2 middle, double texel_m) {
  const glm::vec4 value = inputs_->value(middle, texel_m, time_s_, outside_);
  least_ = std::min(least_, double(value.x));
  most_ = std::max(most_, double(value.x));
  return value;
}

std::uint32_t PlaceField::follow(const LodPlacement& placement, double time_s) {
  const int slices = field_.slices();
  const std::uint32_t all = (1u << slices) - 1u;
  const LodPlacement before = field_.placement();
  const double now = place_time_s(settings_, *inputs_, time_s);
  const bool later = now != time_s_;
  time_s_ = now;
  field_.follow(placement, [&](glm::dvec2 middle, double texel, const glm::vec4&) { return value(middle, texel); });
  std::uint32_t changed = placement.scale.octave != before.scale.octave ? all : 0u;
  for (int i = 0; i < slices; ++i)
    if (placement.first[std::size_t(i)] != before.first[std::size_t(i)]) changed |= 1u << i;
  if (!later) return changed;
  const InputBounds bounds = inputs_->bounds();
  for (int i = 0; i < slices; ++i) {
    const double texel = field_.texel_m(i);
    bool any = false;
    field_.each(i, [&](LodIndex w) {
      const glm::dvec2 middle = field_.middle(i, w);
      if (!bounds.holds(middle, texel)) return;
      field_.texel(i, w) = value(middle, texel);
      any = true;
    });
    if (any) changed |= 1u << i;
  }
  return changed;
}

}  // namespace seascape
