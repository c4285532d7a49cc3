#include "ocean/sea/actor_foam.h"

#include "ocean/inputs/input_spec.h"

namespace seascape {

bool ActorFoam::add(const FoamDisc& disc) {
  const auto within = [](double value, const InputRange& range) { return value >= range.least && value <= range.most; };
  constexpr const InputTargetTraits& foam = traits(InputTarget::foam);
  if (!taken_ || discs_.in_step() == most_foam_discs || !within(disc.at_m.x, input_place_range) ||
      !within(disc.at_m.y, input_place_range) || !within(disc.radius_m, input_size_range) ||
      !within(disc.per_s, {foam.least, foam.most}) || !within(disc.feather_m, input_feather_range))
    return false;
  discs_.add(disc);
  return true;
}

void ActorFoam::append(double from_s, double to_s, std::vector<FoamDisc>& discs) const {
  discs_.between(from_s, to_s, [&](const FoamDisc& disc, double for_s) {
    discs.push_back(disc);
    discs.back().per_s *= for_s / (to_s - from_s);
  });
}

}  // namespace seascape
