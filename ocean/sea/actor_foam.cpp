#include "ocean/sea/actor_foam.h"

#include <algorithm>

#include "ocean/inputs/input_spec.h"

namespace seascape {

bool ActorFoam::add(const FoamDisc& disc) {
  const auto within = [](double value, const InputRange& range) { return value >= range.least && value <= range.most; };
  constexpr const InputTargetTraits& foam = traits(InputTarget::foam);
  if (!taken_ || kept_.size() - ended_ == most_foam_discs || !within(disc.at_m.x, input_place_range) ||
      !within(disc.at_m.y, input_place_range) || !within(disc.radius_m, input_size_range) ||
      !within(disc.per_s, {foam.least, foam.most}) || !within(disc.feather_m, input_feather_range))
    return false;
  kept_.push_back({0.0, 0.0, disc});
  return true;
}

void ActorFoam::end_step(double end_s, double length_s) {
  for (; ended_ < kept_.size(); ++ended_) kept_[ended_].end_s = end_s, kept_[ended_].length_s = length_s;
}

void ActorFoam::clear() {
  kept_.clear();
  ended_ = 0;
}

void ActorFoam::forget_before(double time_s) {
  const auto first = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.end_s >= time_s; });
  ended_ -= std::size_t(first - kept_.begin());
  kept_.erase(kept_.begin(), first);
}

void ActorFoam::append(double from_s, double to_s, std::vector<FoamDisc>& discs) const {
  constexpr double least_s = 1e-6;  // less is what sums of times are off by
  for (const Kept& kept : kept_) {
    const double for_s = std::min(to_s, kept.end_s + kept.length_s) - std::max(from_s, kept.end_s);
    if (!(for_s > least_s)) continue;
    discs.push_back(kept.disc);
    discs.back().per_s *= for_s / (to_s - from_s);
  }
}

}  // namespace seascape
