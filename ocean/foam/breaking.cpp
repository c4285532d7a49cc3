#include "ocean/foam/breaking.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "shaders/shared/flow_height.h"
#include "shaders/shared/surface_slope.h"

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

// Between texels of a level: dDx/dx, dDz/dz, dDx/dz at a rest position.
glm::vec3 Breaking::gradient(const WaveTiles& tiles, const Reading& r, glm::dvec2 rest) {
  const double u = glm::dot(r.along_x, rest) + r.offset, v = glm::dot(r.along_z, rest) + r.offset;  // in texels
  const double floor_u = std::floor(u), floor_v = std::floor(v);
  const auto wrapped = [&](double whole) { return int(std::int64_t(whole) & std::int64_t(r.size - 1)); };
  const int x0 = wrapped(floor_u), z0 = wrapped(floor_v), x1 = (x0 + 1) & (r.size - 1), z1 = (z0 + 1) & (r.size - 1);
  const float fx = float(u - floor_u), fz = float(v - floor_v);
  const glm::vec4 *slope = tiles.texels(r.tile, WavePlane::slope, r.level),
                  *shift = tiles.texels(r.tile, WavePlane::shift, r.level);
  const auto texel = [&](int x, int z) {
    const std::ptrdiff_t at = std::ptrdiff_t(z) * r.stride + x;
    return glm::vec3(slope[at].z, slope[at].w, shift[at].w);
  };
  const glm::vec3 low = glm::mix(texel(x0, z0), texel(x1, z0), fx), high = glm::mix(texel(x0, z1), texel(x1, z1), fx);
  return glm::mix(low, high, fz);
}

Breaking::Breaking(Sea& sea, double life_s) : sea_(sea), life_s_(life_s) {
  for (const auto& source : sea.spec().sources) {
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

double Breaking::below(double jacobian, double variance, double threshold) const {
  const double sigma = thinner * std::sqrt(variance) + least_sigma, z = (jacobian - threshold) / sigma;
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
                                place.longest_m, place.shortest_m});
    }
  }
}

void Breaking::add_gradient(const Slice& slice, glm::dvec2 rest, glm::vec3& sum) const {
  for (const Reading& reading : slice.readings) sum += reading.share * gradient(tiles(), reading, rest);
}

double Breaking::share(const FoamRow& row, std::size_t i, const Water& water, const FlowPhase& phase) const {
  const Slice& slice = slices_[std::size_t(row.slice)];
  const glm::dvec2 rest = row.first_m + glm::dvec2(double(i) * row.texel_m, 0.0), flow(water.flow_mps);
  glm::vec3 g(0.0f);
  if (!(water.kept > 0.0)) {
    // The water is moved by others alone.
  } else if (glm::dot(flow, flow) < least_flow_mps * least_flow_mps) {
    add_gradient(slice, rest, g);
  } else {  // two patterns that the flow carries along in turn
    const double way = glm::length(flow) * std::abs(phase.second_s - phase.first_s);
    for (const Reading& reading : slice.readings) {
      const float height =
          reading.share * float(gpu::flow_height(reading.longest_m, reading.shortest_m, way, phase.first));
      g += height * float(phase.first) * gradient(tiles(), reading, rest - phase.first_s * flow);
      g += height * float(1.0 - phase.first) * gradient(tiles(), reading, rest - phase.second_s * flow);
    }
  }
  const glm::dvec3 d = water.kept * glm::dvec3(g) + water.shift_gradient;
  return below(gpu::surface_jacobian(d.x, d.y, d.z, d.z), water.kept * water.kept * slice.variance + water.variance,
               water.sea_variance > 0.0 ? threshold_of(variance_ + water.sea_variance) : threshold_);
}

void Breaking::add(const FoamRow& row, float per_s, std::span<float> gains) const {
  const Slice& slice = slices_[std::size_t(row.slice)];
  for (std::size_t i = 0; i < gains.size(); ++i) {
    glm::vec3 g(0.0f);
    add_gradient(slice, row.first_m + glm::dvec2(double(i) * row.texel_m, 0.0), g);
    gains[i] += per_s * float(below(double(gpu::surface_jacobian(g.x, g.y, g.z, g.z)), slice.variance, threshold_));
  }
}

}  // namespace seascape
