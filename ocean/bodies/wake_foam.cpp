#include "ocean/bodies/wake_foam.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

namespace seascape {
namespace {

constexpr double most_rate_per_s = 100.0;  // of a disc
// Estimates, by the look of boats: from which to which height a bow wave comes to break all along, and throws up spray,
// m; the share of the largest section that a transom is, and its Froude number (it runs dry at about 2.5: Maki et al.
// 2005); the jet, m/s; the speed through water, m/s, by which a trail is whole.
constexpr double bow_from_m = 0.04, bow_to_m = 0.3, spray_from_m = 0.12, spray_to_m = 0.8;
constexpr double transom_from = 0.12, transom_to = 0.4, transom_froude_from = 0.6, transom_froude_to = 2.0;
constexpr double jet_from_mps = 0.4, jet_to_mps = 4.0, trail_from_mps = 0.4, trail_to_mps = 4.0;
// What of the water foam comes to cover in a second, or lastingly, where all of it breaks.
constexpr double bow_per_s = 8.0, transom_per_s = 5.0, wash_per_s = 5.0, trail_covers = 0.7;
constexpr double throws_per_s = 150.0;
// By how much a tenth of a second brings the usual draught towards the present one: some five seconds count.
constexpr double usual_share = 0.02;
// Beams behind the hull at which the trail is made wider, once each, to what it is on average until the next.
constexpr double widened_at[] = {2.5, 6.0, 14.0, 30.0, 60.0}, until_next = 1.6;

double smooth(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// The rate by which a disc of a diameter that goes by covers this share of the water on its way.
double passing_rate(double covers, double speed, double diameter) {
  constexpr double mean_chord = std::numbers::pi / 4.0;  // of a disc, in diameters
  return -std::log(1.0 - std::min(covers, 0.95)) * speed / (mean_chord * diameter);
}

}  // namespace

double jet_speed(const PropellerWash& wash, double speed_mps, double density) {
  const double area = 0.25 * std::numbers::pi * wash.diameter_m * wash.diameter_m, v = std::abs(speed_mps);
  return area > 0.0 ? std::sqrt(v * v + 2.0 * std::abs(wash.thrust_n) / (density * area)) - v : 0.0;
}

double bow_wave_m(double speed_mps, double tan_half_entrance, double draught_m, double gravity) {
  if (!(speed_mps > 0.0 && tan_half_entrance > 0.0 && draught_m > 0.0)) return 0.0;
  return 2.2 / (1.0 + speed_mps / std::sqrt(gravity * draught_m)) * tan_half_entrance *
         std::hypot(1.0, tan_half_entrance) * speed_mps * speed_mps / gravity;
}

double WakeFoam::trail_width_m(double beam_m, double behind_m) {
  return beam_m * std::pow(std::max(behind_m / beam_m, 1.0), 0.2);
}

void WakeFoam::remember(const glm::dvec2& at, double beam, double strength) {
  path_.resize(most_places);
  if (path_count_ == most_places) path_first_ = (path_first_ + 1) % most_places, --path_count_;
  path_[std::size_t((path_first_ + path_count_++) % most_places)] = {at, way_m_, beam, strength};
}

// Discs that run along behind the hull where it has been, on both rims of its trail, each as wide as the trail has
// grown since the one before.
void WakeFoam::widen_trail(double rate, Made& made) const {
  const auto place = [&](int i) -> const Place& { return path_[std::size_t((path_first_ + i) % most_places)]; };
  double nearer = 1.0;
  for (const double beams : widened_at) {
    for (int i = path_count_ - 1; i > 0; --i) {
      const Place &older = place(i - 1), &newer = place(i);
      const double way = way_m_ - beams * newer.beam_m;
      if (!(older.way_m <= way && way < newer.way_m)) continue;
      const double part = (way - older.way_m) / (newer.way_m - older.way_m), beam = newer.beam_m,
                   inner = 0.5 * trail_width_m(beam, nearer * beam),
                   outer = 0.5 * trail_width_m(beam, until_next * beams * beam), radius = 0.5 * (outer - inner),
                   strength = std::lerp(older.strength, newer.strength, part),
                   per_s = rate * passing_rate(1.2 * strength * 0.5 * beam / outer, 1.0, 2.0 * radius);
      const glm::dvec2 at = glm::mix(older.at_m, newer.at_m, part), along = newer.at_m - older.at_m;
      const double length = glm::length(along);
      if (!(per_s > 0.0 && length > 0.0)) break;
      const glm::dvec2 aside = (inner + radius) / length * glm::dvec2(-along.y, along.x);
      for (const double side : {-1.0, 1.0})
        made.foam.push_back({at + side * aside, 1.1 * radius, std::min(per_s, most_rate_per_s), 0.2 * radius, true});
      break;
    }
    nearer = until_next * beams;
  }
}

void WakeFoam::step(double dt, const HullMotion& motion, std::span<const HullSection> cut, double part,
                    const std::optional<PropellerWash>& wash, double gravity, double density, Made& made) {
  int stern = 0, bow = int(cut.size()) - 1;
  while (stern <= bow && !(cut[std::size_t(stern)].area_m2 > 0.0)) ++stern;
  while (bow >= stern && !(cut[std::size_t(bow)].area_m2 > 0.0)) --bow;
  const glm::dvec3 to_bow = -motion.pose.to_world[2];
  const double level = std::hypot(to_bow.x, to_bow.z);
  since_s_ += dt, since_place_s_ += dt;
  if (stern > bow || !(level > 0.0)) return;
  const glm::dvec2 ahead = glm::dvec2(to_bow.x, to_bow.z) / level, right(-ahead.y, ahead.x);
  const HullSection &last = cut[std::size_t(stern)], &foremost = cut[std::size_t(bow)];
  const glm::dvec3 middle = 0.5 * (last.velocity_mps + foremost.velocity_mps);
  const double speed = glm::dot(glm::dvec2(middle.x, middle.z), ahead);
  way_m_ += std::abs(speed) * dt;
  if (since_s_ < every_s - 1e-9) return;
  const double times = std::exchange(since_s_, 0.0) / dt;  // all of it in this step
  double beam = 0.0, largest = 0.0;
  for (const HullSection& s : cut) beam = std::max(beam, s.breadth_m), largest = std::max(largest, s.area_m2);
  if (!(beam > 0.0)) return;
  const auto disc = [&](const glm::dvec2& at, double radius, double per_s) {
    if (per_s > 0.0) made.foam.push_back({at, radius, std::min(times * per_s, most_rate_per_s), 0.5 * radius});
  };

  // Two sheets of spray, to either side of a section, and the foam of where they come down (V^2 / 2 g).
  const auto throw_up = [&](const HullSection& from, double climbs, double outwards_mps, double share) {
    const double breaks = share * smooth(bow_from_m, bow_to_m, climbs),
                 flies = share * smooth(spray_from_m, spray_to_m, climbs),
                 radius = std::clamp(climbs, 0.08 * beam, 0.5 * beam);
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec2 at = from.place_m + (0.5 * from.breadth_m + 0.5 * radius) * side * right;
      disc(at, radius, bow_per_s * breaks);
      if (!(flies > 0.0)) continue;
      const glm::dvec2 along =
          0.4 * speed * ahead + outwards_mps * side * right + glm::dvec2(motion.water_mps.x, motion.water_mps.z);
      made.spray.push_back({.at_m = {at.x, from.surface_m + 0.5 * climbs, at.y},
                            .velocity_mps = {along.x, std::sqrt(2.0 * gravity * climbs), along.y},
                            .spread_mps = 0.25 * std::sqrt(2.0 * gravity * climbs),
                            .per_s = std::min(times * throws_per_s * flies, most_thrown_per_s),
                            .width_m = 2.0 * radius,
                            .coarse = 0.7});
    }
  };
  const auto comes_down = [](const HullSection& s) { return std::max(-s.velocity_mps.y, 0.0); };
  const int behind = std::max(bow - 2, stern);
  const double entrance = bow > behind ? std::max(cut[std::size_t(behind)].breadth_m - foremost.breadth_m, 0.0) /
                                             (2.0 * part * (bow - behind))
                                       : 0.0,
               draught = cut[std::size_t((bow + behind) / 2)].draught_m, down = comes_down(foremost);
  throw_up(foremost, bow_wave_m(speed, entrance, draught, gravity) + 0.5 * down * down / gravity,
           0.5 * speed * entrance + 0.5 * down, 1.0);

  // Behind the bow a hull slaps the water where it comes down on it with less of itself in the water than usual. The
  // section that does so hardest stands for all, of which they are a share.
  double slapping = 0.0, hardest_mps = 0.0, mean_draught = 0.0;
  const HullSection* hardest = nullptr;
  for (int i = stern; i < behind; ++i) {
    const HullSection& s = cut[std::size_t(i)];
    mean_draught += s.draught_m / std::max(behind - stern, 1);
    const double out = usual_draught_m_ > 0.0 ? 1.0 - smooth(0.6, 1.1, s.draught_m / usual_draught_m_) : 0.0,
                 slaps_mps = std::sqrt(out) * comes_down(s);
    slapping += smooth(spray_from_m, spray_to_m, 0.5 * slaps_mps * slaps_mps / gravity) / std::max(bow - stern, 1);
    if (slaps_mps > hardest_mps) hardest_mps = slaps_mps, hardest = &s;
  }
  usual_draught_m_ += (usual_draught_m_ > 0.0 ? usual_share : 1.0) * (mean_draught - usual_draught_m_);
  if (hardest != nullptr && slapping > 0.0)
    throw_up(*hardest, 0.5 * hardest_mps * hardest_mps / gravity, 0.7 * hardest_mps, std::min(2.0 * slapping, 1.0));

  // The transom: the water that it leaves behind closes in a roller.
  double stirred = 0.0;
  if (speed > 0.0 && last.draught_m > 0.0) {
    stirred = smooth(transom_from, transom_to, last.area_m2 / largest) *
              smooth(transom_froude_from, transom_froude_to, speed / std::sqrt(gravity * last.draught_m));
    const double radius = 0.5 * std::max(last.breadth_m, 0.1 * beam);
    disc(last.place_m - (0.5 * part + radius) * ahead, radius, transom_per_s * stirred);
  }
  if (wash && wash->thrust_n != 0.0) {
    // A jet widens as it comes up; the deeper it began, the less of it does.
    const double deep = std::max(last.surface_m - wash->at_m.y, 0.0) / std::max(wash->diameter_m, 1e-3);
    const double strength = smooth(jet_from_mps, jet_to_mps, jet_speed(*wash, speed, density)) * std::exp(-0.3 * deep) *
                            (wash->at_m.y < last.surface_m ? 1.0 : 0.0);
    const double radius = wash->diameter_m, off = (wash->thrust_n > 0.0 ? -1.0 : 1.0) * (wash->diameter_m + radius);
    disc(glm::dvec2(wash->at_m.x, wash->at_m.z) + off * ahead, radius, wash_per_s * strength);
    stirred = std::max(stirred, strength);
  }

  // What lasts of all that. Water that a hull has gone through keeps fine bubbles of its skin's turbulence.
  const double u = std::abs(speed), covers = trail_covers * std::max(smooth(trail_from_mps, trail_to_mps, u), stirred);
  const glm::dvec2 wake = speed >= 0.0 ? last.place_m - (0.5 * part + 0.5 * beam) * ahead
                                       : foremost.place_m + (0.5 * part + 0.5 * beam) * ahead;
  if (const double rate = passing_rate(covers, u, beam); rate > 0.0)
    made.foam.push_back({wake, 0.5 * beam, std::min(times * rate, most_rate_per_s), 0.1 * beam, true});
  if (since_place_s_ >= place_every_s - 1e-9) since_place_s_ = 0.0, remember(wake, beam, covers);
  widen_trail(times * u, made);
}

std::uint64_t WakeFoam::hash() const {
  std::uint64_t hash = std::bit_cast<std::uint64_t>(since_s_) ^ std::rotl(std::bit_cast<std::uint64_t>(way_m_), 17) ^
                       std::rotl(std::bit_cast<std::uint64_t>(since_place_s_), 34) ^
                       std::rotl(std::bit_cast<std::uint64_t>(usual_draught_m_), 47) ^ std::uint64_t(path_count_);
  if (path_count_ == 0) return hash;
  const Place& newest = path_[std::size_t((path_first_ + path_count_ - 1) % most_places)];
  return hash ^ std::rotl(std::bit_cast<std::uint64_t>(newest.at_m.x), 5) ^
         std::rotl(std::bit_cast<std::uint64_t>(newest.at_m.y), 29);
}

}  // namespace seascape
