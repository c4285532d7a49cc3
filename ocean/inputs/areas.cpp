// Ellipses, rectangles and whirlpools.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/inputs/input_source.h"
#include "ocean/inputs/soft_edge.h"

namespace seascape {

namespace {

class Area final : public InputSource {
 public:
  Area(const InputSpec& spec, const AreaInput& area)
      : frame_(area.at_m, area.turn_deg),
        half_(0.5 * area.size_m),
        feather_m_(spec.feather_m),
        round_(area.round),
        value_(plain_value(spec, spec.value)) {}

  InputSample sample(glm::dvec2 place_m, double footprint_m, double) const override {
    const glm::dvec2 p = glm::abs(frame_.local(place_m));
    return {value_, float(round_ ? ellipse(p, footprint_m) : rectangle(p, footprint_m))};
  }
  InputBounds bounds() const override { return frame_.bounds({0.0, 0.0}, half_); }

 private:
  // Distance from the edge to the first order, exact for a circle: the implicit function over its gradient (Taubin
  // 1991).
  double ellipse(glm::dvec2 p, double footprint_m) const {
    const glm::dvec2 q = p / half_;
    const double k = glm::length(q), gradient = glm::length(q / half_), radius = std::sqrt(half_.x * half_.y);
    double inside =
        gradient > 0.0 ? std::min(k * (1.0 - k) / gradient, std::min(half_.x, half_.y)) : std::min(half_.x, half_.y);
    inside = std::min(inside,
                      k > 1.0 ? -glm::length(glm::max(p - half_, 0.0)) : inside);  // no nearer than the box around it
    return soft_share(inside, feather_m_, footprint_m) * disc_factor(radius, feather_m_, footprint_m);
  }
  // The two axes' shares multiplied: what a wide footprint sees of it is its area to the last bit.
  double rectangle(glm::dvec2 p, double footprint_m) const {
    double share = 1.0;
    for (int axis = 0; axis < 2; ++axis)
      share *= soft_share(half_[axis] - p[axis], feather_m_, footprint_m) *
               band_factor(half_[axis], feather_m_, footprint_m);
    return share;
  }

  TurnedFrame frame_;
  glm::dvec2 half_;
  double feather_m_;
  bool round_;
  glm::vec4 value_;
};

// Round its middle the water turns as a solid within the core, and with 1 / r outside of it; both parts, and the soft
// end of the swirl, are free of divergence. An inflow sinks within the core, and what it needs comes up where the
// vortex ends.
class Vortex final : public InputSource {
 public:
  Vortex(const InputSpec& spec, const VortexInput& vortex) : vortex_(vortex), feather_m_(spec.feather_m) {}

  InputSample sample(glm::dvec2 place_m, double footprint_m, double) const override {
    const glm::dvec2 p = place_m - vortex_.at_m;
    const double r = glm::length(p), core = std::max(vortex_.core_m, 0.5 * footprint_m);
    // 1 / r over the core's radius, without a division by r, for vectors as long as r.
    const double profile = r <= core ? vortex_.core_m / (core * core) : vortex_.core_m / (r * r);
    const glm::dvec2 clockwise{-p.y, p.x};
    const glm::dvec2 v = (clockwise * vortex_.swirl_mps - p * vortex_.inflow_mps) * profile;
    return {{float(v.x), float(v.y), 0.0f, 0.0f}, float(soft_share(vortex_.reach_m - r, feather_m_, footprint_m))};
  }
  InputBounds bounds() const override { return {vortex_.at_m - vortex_.reach_m, vortex_.at_m + vortex_.reach_m}; }

 private:
  VortexInput vortex_;
  double feather_m_;
};

}  // namespace

TurnedFrame::TurnedFrame(glm::dvec2 at_m, double turn_deg) : at(at_m) {
  const double turn = turn_deg * std::numbers::pi / 180.0;
  cos = std::cos(turn), sin = std::sin(turn);
  if (std::abs(cos) < 1e-15) cos = 0.0;  // quarters of a turn are exact
  if (std::abs(sin) < 1e-15) sin = 0.0;
}

InputBounds TurnedFrame::bounds(glm::dvec2 middle, glm::dvec2 half) const {
  const glm::dvec2 centre = at + turned(middle);
  const glm::dvec2 reach{std::abs(cos) * half.x + std::abs(sin) * half.y,
                         std::abs(sin) * half.x + std::abs(cos) * half.y};
  return {centre - reach, centre + reach};
}

std::unique_ptr<const InputSource> make_area(const InputSpec& spec) {
  return std::make_unique<Area>(spec, std::get<AreaInput>(spec.shape));
}
std::unique_ptr<const InputSource> make_vortex(const InputSpec& spec) {
  return std::make_unique<Vortex>(spec, std::get<VortexInput>(spec.shape));
}

}  // namespace seascape
