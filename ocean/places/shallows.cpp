#include "ocean/places/shallows.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace seascape {

namespace {
InputBounds bounds_of(const Inputs& bed, const Inputs* level) {
  InputBounds bounds = bed.bounds();
  if (level != nullptr) bounds.add(level->bounds());
  return bounds;
}

// The square of a height over the highest that a depth leaves, from the share of the energy that breaking leaves:
// ShallowWater's law, the other way about.
double squared_height(float left) {
  return std::cbrt(std::max(1.0 / (double(left) * double(left) * double(left)) - 1.0, 0.0));
}
}  // namespace

Shallows::Shallows(const SeaState& sea, const WaveBins& bins, const OtherWaves& others, const OtherWaves& placed,
                   const PlaceSettings& settings, std::shared_ptr<const Inputs> bed,
                   std::shared_ptr<const Inputs> level)
    : bed_(std::move(bed)),
      level_(std::move(level)),
      settings_(settings),
      outside_bed_(float(-sea.depth_m), 0.0f, 0.0f, 0.0f),
      outside_level_(place_outside(settings, InputTarget::level)),
      water_(sea, bins, others),
      refraction_(sea, bins, water_, bounds_of(*bed_, level_.get()),
                  [this](glm::dvec2 place, double footprint) {
                    return still_m(place, footprint, 0.0) - bed_m(place, footprint, 0.0);
                  }),
      cascades_(bins.cascades) {
  if (placed.wavelength_m > 0.0) placed_.emplace(sea, WaveBins{bins.ladder, 0, {}}, placed);
  double variance = 0.0, frequency = 0.0, longest = 0.0;
  const double wind = std::max(sea.wind_speed_mps, 0.0), gravity = sea.gravity_mps2;
  const double peak = wind > 0.0 ? 22.0 * std::cbrt(gravity * gravity / (wind * regrowth_fetch_m)) : 0.0;
  const double grown_m = peak > 0.0 ? 2.0 * std::numbers::pi * gravity / (peak * peak) : 0.0;
  for (int i = 0; i < cascades_; ++i) {
    const MeanWave wave = mean_wave(sea, bins, i);
    variance += wave.variance;
    frequency += wave.variance * wave.frequency;
    if (i < swash_cascades) longest += wave.variance;
    if (grown_m > 0.0 && wave.wave_number > 0.0)
      regrown_[std::size_t(i)] =
          float(std::clamp(1.0 - 0.5 * std::log2(2.0 * std::numbers::pi / wave.wave_number / grown_m), 0.0, 1.0));
  }
  if (longest > 0.0 && frequency > 0.0) {
    frequency /= variance;
    const double length = 2.0 * std::numbers::pi * sea.gravity_mps2 / (frequency * frequency);
    swash_m_ = 0.06 * std::sqrt(4.0 * std::sqrt(variance) * length);
    swash_share_ = std::min(swash_m_ / (4.0 * std::sqrt(longest)), 1.0);
  }
  // Factors are smooth: steps of a twentieth of the depth miss their highest by less than a thousandth.
  for (double depth = 0.01; depth < 2000.0; depth *= 1.05) {
    for (int i = 0; i < cascades_; ++i) most_share_ = std::max(most_share_, double(water_.factor(i, depth)));
    most_share_ = std::max({most_share_, double(water_.others(depth)), placed_ ? double(placed_->others(depth)) : 0.0});
  }
}

double Shallows::bed_m(glm::dvec2 place, double footprint, double time) const {
  return double(bed_->value(place, footprint, place_time_s(settings_, bed_->still(), time), outside_bed_).x);
}

double Shallows::still_m(glm::dvec2 place, double footprint, double time) const {
  if (level_ == nullptr) return 0.0;
  return double(level_->value(place, footprint, place_time_s(settings_, level_->still(), time), outside_level_).x);
}

PlaceWaves Shallows::waves(glm::dvec2 place, double depth) const {
  PlaceWaves result;
  for (int i = 0; i < cascades_; ++i)
    result.share[std::size_t(i)] =
        water_.factor(i, depth) *
        std::sqrt(refraction_.shelter(i, place) + regrown_[std::size_t(i)] * (1.0f - refraction_.shelter(i, place)));
  for (std::size_t i = std::size_t(cascades_); i < result.share.size(); ++i)
    result.share[i] = cascades_ > 0 ? result.share[std::size_t(cascades_ - 1)] : 1.0f;
  if (cascades_ > 0) result.ripples = water_.factor(cascades_ - 1, depth);
  const float shelter = std::sqrt(refraction_.shelter(place));
  result.others = water_.others(depth) * shelter;
  result.swash = float(swash_share_) * water_.breaking(depth) * shelter;
  for (int i = 0; i < Refraction::bent_cascades; ++i)
    result.shift_m[std::size_t(i)] = float(refraction_.shift(i, place));
  return result;
}

Shallows::Placed Shallows::placed(glm::dvec2 place, double depth) const {
  if (!placed_ || !(depth > 0.0)) return {};
  const float alone = placed_->left(depth), of_sea = water_.left(depth);
  if (!(alone > 1e-12f && of_sea > 1e-12f)) return {0.0, 1.0};  // a film of millimetres
  const double squared = squared_height(alone) + double(refraction_.shelter(place)) * squared_height(of_sea),
               left = 1.0 / std::cbrt(1.0 + squared * squared * squared);
  return {double(placed_->others(depth)) * std::sqrt(std::min(left / double(alone), 1.0)), 1.0 - left};
}

InputBounds Shallows::bounds() const { return bounds_of(*bed_, level_.get()); }

std::shared_ptr<const Shallows> make_shallows(const SeaState& sea, const WaveBins& bins, const TileSources& others,
                                              const PlaceInputs& inputs) {
  auto bed = inputs.of(InputTarget::sea_depth);
  if (bed == nullptr) return nullptr;
  TileSources everywhere, placed;
  for (const auto& source : others) (source->along_curves() ? placed : everywhere).push_back(source);
  return std::make_shared<const Shallows>(sea, bins, other_waves(everywhere), other_waves(placed), inputs.settings,
                                          std::move(bed), inputs.of(InputTarget::level));
}

}  // namespace seascape
