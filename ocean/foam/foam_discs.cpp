// The part of FoamSea that is of actors: the discs they make, and the trails that outlast other foam.
#include <algorithm>
#include <cmath>
#include <functional>

#include "ocean/foam/foam_rows.h"
#include "ocean/foam/foam_sea.h"
#include "ocean/inputs/soft_edge.h"

namespace seascape {

// Where the water of some of a row's texels stands, in the world; until the next call of this thread.
std::span<const glm::dvec2> FoamSea::standing(const FoamRow& row, std::span<const int> texels, Moved along) const {
  thread_local std::vector<glm::dvec2> places;
  thread_local std::vector<glm::vec3> displaced;
  const auto most = std::size_t(foam_.field().side());
  with_room(places, most), with_room(displaced, most);
  for (const int i : texels) places.push_back(row.first_m + glm::dvec2(double(i) * row.texel_m, 0.0));
  displaced.resize(places.size());
  breaking_.displace(row.slice, places, displaced);
  for (std::size_t n = 0; n < places.size(); ++n) {
    glm::dvec3 d(displaced[n]);
    if (!along.empty()) d += along[std::size_t(texels[n])].displacement;
    places[n] += glm::dvec2(d.x, d.z);
  }
  return places;
}

// Discs cover what they do of a texel's side, as inputs do. Each asks the texels that it may reach and no others: a
// fleet makes a thousand of them a step.
void FoamSea::add_discs(const FoamRow& row, std::span<float> per_s, Moved along,
                        std::span<const FoamDisc> discs) const {
  struct Near {
    const FoamDisc* disc;
    double per_s;
    int first, end;  // texels
  };
  thread_local std::vector<Near> near;
  thread_local std::vector<int> texels, at;
  near.clear();
  const int count = int(per_s.size());
  at.assign(per_s.size(), -1);
  for (const FoamDisc& disc : discs) {
    const double reach = disc.radius_m + soft_reach(disc.feather_m, row.texel_m) + largest_shift_m();
    if (!(std::abs(disc.at_m.y - row.first_m.y) < reach)) continue;
    const double middle = (disc.at_m.x - row.first_m.x) / row.texel_m, wide = reach / row.texel_m;
    const int first = int(std::clamp(std::ceil(middle - wide), 0.0, double(count))),
              end = int(std::clamp(std::floor(middle + wide) + 1.0, 0.0, double(count)));
    if (first >= end) continue;
    near.push_back({&disc, disc.per_s * disc_factor(disc.radius_m, disc.feather_m, row.texel_m), first, end});
    std::fill(at.begin() + first, at.begin() + end, 0);
  }
  if (near.empty()) return;
  with_room(texels, per_s.size());
  for (int i = 0; i < count; ++i)
    if (at[std::size_t(i)] == 0) at[std::size_t(i)] = int(texels.size()), texels.push_back(i);
  const std::span<const glm::dvec2> places = standing(row, texels, along);
  for (const Near& n : near)
    for (int i = n.first; i < n.end; ++i) {
      const glm::dvec2& place = places[std::size_t(at[std::size_t(i)])];
      per_s[std::size_t(i)] += float(
          n.per_s * soft_share(n.disc->radius_m - glm::distance(place, n.disc->at_m), n.disc->feather_m, row.texel_m));
    }
}

// Trails are a field of their own, which there is once something makes one.
void FoamSea::take_lasting() {
  lasting_.clear();
  const auto from = std::stable_partition(discs_.begin(), discs_.end(), [](const FoamDisc& d) { return !d.lasting; });
  if (from == discs_.end()) return;
  if (!trail_) {
    FoamSettings settings = spec_.settings;
    settings.life_s = foam_trail_life_s;
    trail_.emplace(settings);
    trail_->follow(foam_.field().placement(), 0.0f);
    if (flows_) take_flow();
  }
  lasting_.assign(from, discs_.end());
  discs_.erase(from, discs_.end());
}

void FoamSea::step_trail(int slice) {
  if (!trail_) return;
  const auto gain = [&](const FoamRow& row, std::span<float> per_s) { add_discs(row, per_s, {}, lasting_); };
  trail_->step_slice(slice, step_s_, lasting_.empty() ? Foam::Gain() : Foam::Gain(std::cref(gain)));
}

// Foam falls to what the trail has, and not to none: by the gain whose foam that is, in the end.
void FoamSea::add_trail(const FoamRow& row, std::span<float> per_s) const {
  if ((trail_->foamy() >> row.slice & 1u) == 0) return;
  const LodRow<float> trail = trail_->field().row(row.slice, LodIndex(glm::floor(row.first_m / row.texel_m)));
  const auto loss = float(1.0 / spec_.settings.life_s);
  for (std::size_t i = 0; i < per_s.size(); ++i) {
    const float covered = std::min(trail[std::int64_t(i)], 0.95f);
    if (covered > 1e-4f) per_s[i] += loss * covered / (1.0f - covered);
  }
}

}  // namespace seascape
