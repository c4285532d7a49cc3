#include "ocean/bodies/sea_water.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ocean/places/wake_surface.h"

namespace seascape {

double mean_wave_number(const WaveBins& bins) {
  double energy = 0.0, sum = 0.0;
  for (int cascade = 0; cascade < bins.cascades; ++cascade) {
    const int half = bins_of(cascade) / 2;
    const double unit = 2.0 * std::numbers::pi / bins.ladder[cascade].side_m;
    for (int mz = 1 - half; mz < half; ++mz)
      for (int mx = 1 - half; mx < half; ++mx) {
        const glm::dvec2 amplitude(bins.at(cascade, mx, mz).amplitude);
        const double own = glm::dot(amplitude, amplitude);
        energy += own;
        sum += own * unit * std::hypot(mx, mz);
      }
  }
  return energy > 0.0 ? sum / energy : 0.0;
}

void SeaWater::see(const SeaView& view) {
  view_ = view;
  const WaveField& field = view.field();
  if (field.statistics().height_variance == variance_) return;
  variance_ = field.statistics().height_variance;
  double energy = variance_;
  double sum = energy * mean_wave_number(field.bins());
  for (const auto& other : field.others()) {
    // A tile tells no more of its waves than the variances of height and slope, whose ratio is k^2.
    const SourceStatistics own = other->statistics();
    if (!(own.height_variance > 0.0)) continue;
    const double slopes = (own.slope_moments.x + own.slope_moments.y) * double(other->layings().size());
    energy += own.height_variance;
    sum += own.height_variance * std::sqrt(slopes / own.height_variance);
  }
  wave_number_ = energy > 0.0 ? sum / energy : 0.0;
}

void SeaWater::ask(double, double footprint_m, std::span<const glm::dvec2> places, std::span<WaterHere> answers) const {
  ask(std::uint64_t(0), footprint_m, places, answers);
}

void SeaWater::ask_as(std::size_t body, double, double footprint_m, std::span<const glm::dvec2> places,
                      std::span<WaterHere> answers) const {
  ask(std::uint64_t(body) + 1, footprint_m, places, answers);
}

void SeaWater::ask(std::uint64_t without_window_of, double footprint_m, std::span<const glm::dvec2> places,
                   std::span<WaterHere> answers) const {
  thread_local std::vector<QueryAnswer> found;  // a thread's own memory: bodies ask in every step
  if (found.size() < places.size()) found.resize(places.size());
  QueryOptions options;
  options.footprint_m = footprint_m;
  options.viewer_waves = options.actors_bodies = false;
  options.without_window_of = without_window_of;
  view_.query(places, {found.data(), places.size()}, options);
  for (std::size_t n = 0; n < places.size(); ++n) {
    const QueryAnswer& water = found[n];
    WaterHere& here = answers[n];
    here.height_m = water.height_m;
    here.current_mps = water.flow_mps;
    here.velocity_mps = water.orbital_velocity_mps + glm::dvec3(water.flow_mps.x, 0.0, water.flow_mps.y);
    here.still_m = water.still_m;
    here.depth_m = water.depth_m;
    here.dry = water.clipped || water.depth_m <= 0.0;
  }
}

void SeaWater::ground(std::span<const glm::dvec2> places, std::span<double> heights_m) const {
  if (!view_) return std::fill(heights_m.begin(), heights_m.end(), 0.0);
  for (std::size_t n = 0; n < places.size(); ++n) {
    const StillWater still = view_.still_water(places[n], felt_place_texel_m);
    heights_m[n] = still.height_m - still.depth_m;
  }
}

double SeaWater::depth_m(const glm::dvec2& place) const {
  return view_ ? view_.still_water(place, felt_place_texel_m).depth_m : 0.0;
}

std::optional<CalmWater> SeaWater::calm(double, const glm::dvec2& place, double distance_m) const {
  return calm(std::uint64_t(0), place, distance_m);
}

std::optional<CalmWater> SeaWater::calm_as(std::size_t body, double, const glm::dvec2& place, double distance_m) const {
  return calm(std::uint64_t(body) + 1, place, distance_m);
}

std::optional<CalmWater> SeaWater::calm(std::uint64_t without, const glm::dvec2& place, double distance_m) const {
  if (wave_number_ > 0.0) return std::nullopt;
  const glm::dvec2 around(distance_m);
  if (view_.wakes() != nullptr && view_.wakes()->near(place - around, place + around, without)) return std::nullopt;
  QueryOptions options;
  options.viewer_waves = options.actors_bodies = false;
  options.fields = query_clip;
  const QueryAnswer here = view_.query(place, options);
  return CalmWater{here.clipped ? -1e9 : here.still_m, here.flow_mps};
}

}  // namespace seascape
