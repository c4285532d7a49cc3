// The part of Spray that actors throw up.
#include "ocean/foam/spray.h"
#include "ocean/foam/spray_chance.h"

namespace seascape {

void Spray::take_throws(double time_s) {
  throws_.clear();
  if (!(settings_.amount > 0.0)) return;
  sea_.spray().throws().between(time_s - 1.0 / settings_.rate_hz, time_s, [&](const SprayThrow& from, double for_s) {
    throws_.push_back({from, settings_.amount * from.per_s * for_s});
  });
}

// Each throw has chances of its own, by its place in the step: frames do not change the order of what steps made.
void Spray::throw_made(std::int64_t tick) {
  constexpr std::int64_t of_actors = -1;
  const double step = 1.0 / settings_.rate_hz;
  const auto most = std::size_t(settings_.most);
  for (std::size_t i = 0; i < throws_.size(); ++i) {
    const auto& [from, puffs] = throws_[i];
    Chance chance = Chance(settings_.seed).of(tick).of(of_actors).of(std::int64_t(i));
    const double near = 1.0 - smooth_between(2.0 / 3.0, 1.0, glm::length(from.at_m - viewer_) / settings_.range_m);
    const int count = int(near * puffs + chance.next());
    for (int n = 0; n < count && puffs_.size() < most; ++n) {
      Puff p;
      const double later = step * chance.next();
      const glm::dvec3 aside(chance.normal(), 0.5 * chance.normal(), chance.normal());
      p.age_s = -later;
      p.velocity_mps = from.velocity_mps + from.spread_mps * aside;
      const double along = chance.normal(), across = chance.normal();
      p.place_m = from.at_m + 0.5 * from.width_m * glm::dvec3(along, 0.0, across);
      p.above_m = 0.05;
      p.rising_mps = p.velocity_mps.y;
      p.eddy_mps = eddy(chance, 0.8);
      // The coarser, the fewer are fine.
      p.diameter_m =
          finest_drop_m * std::pow(coarsest_drop_m / finest_drop_m, std::pow(chance.next(), 2.5 - 2.0 * from.coarse));
      p.drops = smooth_between(drop_seen_from_m, drop_seen_by_m, p.diameter_m);
      p.radius_m = settings_.size * (1.0 - 0.65 * p.drops) * (0.08 + 0.15 * chance.next());
      p.life_s = settings_.life_s * (0.35 + 0.65 * chance.next());
      p.shape = chance.next();
      feel_air(p);
      puffs_.push_back(p);
    }
  }
}

}  // namespace seascape
