#include "ocean/places/place_fields.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <utility>

#include "engine/require.h"

namespace seascape {

void for_each_row(int rows, const std::function<void(int)>& row) { tbb::parallel_for(0, rows, row); }

void validate(const PlaceSettings& s) {
  validate(s.windows);
  require(s.rate_hz > 0.0, s.rate_hz, "rate_hz", "above 0");
  require(std::abs(s.level_m) <= 10000.0, s.level_m, "level_m", "from -10000 to 10000");
  require(s.sand >= 0.0 && s.sand <= 1.8, s.sand, "sand", "from 0 to 1.8");
  require(s.growth_m >= 0.0 && s.growth_m <= 1000.0, s.growth_m, "growth_m", "from 0 to 1000");
  require(true, s.flow_to_deg, "flow_to_deg", "finite");
  require(s.flow_mps >= 0.0 && s.flow_mps <= 100.0, s.flow_mps, "flow_mps", "from 0 to 100");
  require(s.flow_period_s > 0.0, s.flow_period_s, "flow_period_s", "above 0");
}

glm::vec4 place_outside(const PlaceSettings& s, InputTarget kind) {
  switch (kind) {
    case InputTarget::level:
      return glm::vec4(float(s.level_m), 0.0f, 0.0f, 0.0f);
    case InputTarget::flow:
      return glm::vec4(float(s.flow_mps * std::sin(glm::radians(s.flow_to_deg))),
                       float(-s.flow_mps * std::cos(glm::radians(s.flow_to_deg))), 0.0f, 0.0f);
    case InputTarget::clip:
      return glm::vec4(s.clip_by_default ? 1.0f : 0.0f, 0.0f, 0.0f, 0.0f);
    default:
      return glm::vec4(0.0f);
  }
}

double place_time_s(const PlaceSettings& s, bool still, double time_s) {
  if (still || !std::isfinite(time_s)) return 0.0;
  const double step = std::floor(time_s * s.rate_hz + 1e-6);
  return std::isfinite(step) ? step / s.rate_hz : time_s;
}

PlaceValues<glm::vec4> place_values(std::shared_ptr<const Inputs> inputs, const PlaceSettings& settings) {
  const glm::vec4 outside = place_outside(settings, inputs->target());
  const bool still = inputs->still();
  const InputBounds moving = inputs->bounds();
  return {outside,
          [inputs = std::move(inputs), outside](glm::dvec2 middle, double texel, double time) {
            return inputs->value(middle, texel, time, outside);
          },
          still, moving};
}

}  // namespace seascape
