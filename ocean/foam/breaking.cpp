#include "ocean/foam/breaking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {

// As much is never known of a Jacobian between texels.
constexpr double least_sigma = 0.01;
// The Jacobian has the product of two strains besides their sum, and less in its tail than a Gaussian of the
// divergence: measured of seas of 5 to 23 m/s.
constexpr double thinner = 0.94;
// Slower than this, water stands: it has gone a few centimetres before another pattern takes its place.
constexpr double least_flow_mps = 0.02;
constexpr double least_threshold = 0.6, most_threshold = 0.78;

// What a normal number is below in a share of cases.
double quantile(double share) {
  double low = -9.0, high = 0.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::numbers::sqrt2) < share ? low : high) = middle;
  }
  return low;
}

}  // namespace

Breaking::Breaking(Sea& sea, double life_s) : sea_(sea), life_s_(life_s) { take_sources(); }

void Breaking::take_sources() {
  others_variance_ = others_height_variance_ = 0.0;
  for (const auto& source : sea_.spec().sources) {
    const SourceStatistics s = source->statistics();
    others_variance_ += double(source->layings().size()) * (s.slope_moments.x + s.slope_moments.y);
    if (!source->along_curves()) others_height_variance_ += s.height_variance;
  }
}

double Breaking::slope_variance() const {
  const glm::dvec3 moments = sea_.statistics().slope_moments;
  return sea_.chop() * sea_.chop() * (moments.x + moments.y);
}

bool Breaking::ever() const { return 1.0 - most_threshold < 6.0 * std::sqrt(slope_variance() + others_variance_); }

double Breaking::threshold_of(double sea_variance) const {
  return std::clamp(1.0 + lowest_ * (thinner * std::sqrt(sea_variance) + least_sigma), least_threshold, most_threshold);
}

double Breaking::mean_share() const {
  const double sigma = thinner * std::sqrt(variance_) + least_sigma, z = (1.0 - threshold_) / sigma;
  return z > 4.0 ? 0.0 : 0.5 * std::erfc(z / std::numbers::sqrt2);
}

void Breaking::evaluate(std::int64_t ticks) {
  if (view_ && view_.ticks() == ticks && waves_ == sea_.waves_version()) return;
  // Whole, so that a view that knows more of this time may borrow them.
  if (ahead_ && ahead_.ticks() == ticks && ahead_waves_ == sea_.waves_version()) (void)ahead_.tiles();
  view_ = ahead_ = {};  // whose memory the next one may take
  view_ = sea_.view(ticks, SeaDetail::crests);
  waves_ = sea_.waves_version();
  const WaveTiles& tiles = this->tiles();
  variance_ = 0.0;
  for (const WaveField::Place& place : field().places())
    variance_ += double(tiles.texels(place.tile, WavePlane::moments, tiles.levels(place.tile) - 1)->w);
  // In balance W = gain / (gain + 1 / life); a third more, for where it breaks is covered already.
  const double whole = std::min(3.84e-6 * std::pow(sea_.state().wind_speed_mps, 3.41), 0.5),
               breaking = 1.35 * whole / ((1.0 - whole) * life_s_ * foam_breaking_per_s);
  lowest_ = quantile(std::min(breaking, 0.5));
  threshold_ = threshold_of(variance_);
}

void Breaking::prepare(std::int64_t ticks, double share) {
  if (sea_.changing()) return;
  if (!ahead_ || ahead_.ticks() != ticks || ahead_waves_ != sea_.waves_version()) {
    ahead_ = {};
    ahead_ = sea_.view(ticks, SeaDetail::crests);
    ahead_waves_ = sea_.waves_version();
  }
  // All of it a little before it is due, since frames fall as they like.
  ahead_.prepare(1.2 * share);
}

void Breaking::at(std::int64_t ticks, double texel_m, int slices) {
  evaluate(ticks);
  const WaveField& field = this->field();
  const WaveTiles& tiles = this->tiles();
  slices_.resize(std::size_t(slices));
  for (int i = 0; i < slices; ++i) {
    const double footprint = std::ldexp(texel_m, i);
    const WaveField::Filter filter = field.filter(footprint);
    Slice& slice = slices_[std::size_t(i)];
    slice.readings.clear();
    slice.displaced = plan_queries(field, tiles, {.footprint_m = footprint, .fields = 0});
    slice.variance = 0.0;
    for (std::size_t p = 0; p < field.places().size(); ++p) {
      const int tile = field.places()[p].tile, last = tiles.levels(tile) - 1;
      // One level, the nearer of two.
      const int level = std::min(filter.level[p] + (filter.between[p] > 0.5f ? 1 : 0), last);
      // What has four texels a wave at most is left to the variance.
      const WaveField::Place& place = field.places()[p];
      const float share = level == last || 4.0 * footprint > place.longest_m ? 0.0f : filter.share[p];
      const double all = double(tiles.texels(tile, WavePlane::moments, last)->w);
      double kept = 0.0;
      if (share > 0.0f && level > 0) {
        const int size = tiles.layout().level(tile, level).size;
        for (int z = 0; z < size; ++z)
          for (int x = 0; x < size; ++x) {
            const glm::vec4& s =
                tiles.texels(tile, WavePlane::slope, level)[std::ptrdiff_t(z) * tiles.stride(tile, level) + x];
            kept += double((s.z + s.w) * (s.z + s.w));
          }
        kept /= double(size) * size;
      } else if (share > 0.0f) {
        kept = all;
      }
      slice.variance += std::max(all - double(share) * double(share) * kept, 0.0);
      if (!(share > 0.0f)) continue;
      const int size = tiles.layout().level(tile, level).size;
      const double texels = place.inverse_side * size,
                   middle = 0.5 / double(tiles.samples(tile)) * size -
                            0.5;  // of a coarser level, between those it is the mean of
      slice.readings.push_back({tile, level, size, tiles.stride(tile, level), share,
                                texels * glm::dvec2(place.cosine, place.sine),
                                texels * glm::dvec2(-place.sine, place.cosine), place.offset * size + middle,
                                glm::vec3(place.decay_per_m2)});
    }
  }
}

void Breaking::add(const FoamRow& row, float per_s, const BreakingWater& water, const FlowPhase& phase,
                   std::span<float> gains) const {
  const Slice& slice = slices_[std::size_t(row.slice)];
  std::array<BreakingLayer, most_breaking_layers> layers;
  std::size_t count = 0;
  // Warped derivatives count as straight ones here: the strain, a twentieth at most, is far less than the Jacobian's
  // own deviation.
  const PatternWarp& warp = field().warp();
  WarpRow warped{};
  for (std::size_t i = 0; warp && i < warped.waves.size(); ++i) {
    const PatternWarp::Wave& wave = warp.waves()[i];
    warped.waves[i] = {glm::dot(wave.along, row.first_m) + wave.phase, wave.along.x * row.texel_m, float(wave.way.x),
                       float(wave.way.y)};
  }
  for (const Reading& r : slice.readings)
    layers[count++] = {tiles().texels(r.tile, WavePlane::slope, r.level),
                       tiles().texels(r.tile, WavePlane::shift, r.level),
                       r.size - 1,
                       r.stride,
                       glm::dot(r.along_x, row.first_m) + r.offset,
                       glm::dot(r.along_z, row.first_m) + r.offset,
                       r.along_x.x * row.texel_m,
                       r.along_z.x * row.texel_m,
                       float(r.along_x.x),
                       float(r.along_x.y),
                       r.decay_per_m2,
                       r.share,
                       warp && r.tile == 0 ? &warped : nullptr};
  const BreakingLaw law{float(thinner),        float(least_sigma),    float(least_threshold),
                        float(most_threshold), float(lowest_),        float(threshold_),
                        float(variance_),      float(slice.variance), float(least_flow_mps)};
  breaking_row({layers.data(), count}, law, water, phase, per_s, gains);
}

void Breaking::displace(int slice, std::span<const glm::dvec2> rest, std::span<glm::vec3> displacements) const {
  displace_points(slices_[std::size_t(slice)].displaced, rest.data(), displacements.data(), rest.size());
}

}  // namespace seascape
