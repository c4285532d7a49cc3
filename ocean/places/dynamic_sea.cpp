#include "ocean/places/dynamic_sea.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/text.h"
#include "ocean/places/jump_steps.h"
#include "ocean/places/rain.h"

namespace seascape {

namespace {
// This class counts the steps itself.
DynamicWavesSettings one_step(DynamicWavesSettings settings) {
  settings.most_steps = 1;
  return settings;
}
}  // namespace

void validate(const DynamicSeaSettings& s) {
  validate(s.waves);
  validate(s.rain);
  if (!(s.settle_s >= 0.0 && s.settle_s <= 60.0))
    throw Error("settle_s", text_from(s.settle_s) + " is not from 0 to 60", "give a number from 0 to 60");
}

bool still(const DynamicSeaSettings& s, bool pressed) {
  return !(s.waves.depth_m > 0.0) || (!pressed && (!(s.rain.drops_per_m2_s > 0.0) || s.rain.drop_height_m == 0.0));
}

DynamicSea::DynamicSea(const DynamicSeaSettings& settings, std::shared_ptr<const Inputs> pressure)
    : settings_(settings),
      pressure_(pressure && !pressure->empty() ? std::move(pressure) : nullptr),
      viewer_(settings.waves.windows),
      waves_(one_step(settings.waves)),
      surfaces_{std::make_shared<DynamicSurface>(settings.waves)} {
  validate(settings);
}

void DynamicSea::apply(const DynamicSeaSettings& settings) {
  validate(settings);
  waves_.apply(one_step(settings.waves));
  const double rate_hz = settings_.waves.rate_hz;
  if (settings.waves.rate_hz != rate_hz)
    tick_ = std::int64_t(std::floor(double(tick_) / rate_hz * settings.waves.rate_hz + 1e-6));
  settings_ = settings;
  stale_ = stale_ || waves_.active();  // its waves may be sharper
  if (waves_.active()) ++version_;
}

void DynamicSea::step(const Push& push) {
  const DynamicWavesSettings& waves = settings_.waves;
  const LodPlacement& placement = viewer_.placement();
  // Drops raise waves of two of their lengths and thereabouts: they fall as far as the level of those reaches.
  const double octaves =
      std::log2(std::max(settings_.rain.drop_length_m / (4.0 * lod_texel_m(waves.windows, placement, 0)), 1.0));
  const double level_reach = lod_texel_m(waves.windows, placement, std::min(int(octaves), waves.windows.slices - 1)) *
                             waves.windows.resolution / 2;
  // From high up, and of wide windows, that is more water than drops can be counted on: those beyond are too far away
  // to be seen.
  const double most_drops_a_tick = 1000.0, per_m2 = std::max(settings_.rain.drops_per_m2_s / waves.rate_hz, 1e-6);
  const double reach = std::min({level_reach, 0.5 * std::sqrt(most_drops_a_tick / per_m2), 256.0});
  sources_.clear();
  add_rain(settings_.rain, tick_ + 1, 1, waves.rate_hz, placement.viewer, reach, sources_);
  const double dt = 1.0 / waves.rate_hz, end_s = double(tick_ + 1) / waves.rate_hz, middle_s = end_s - 0.5 * dt;
  if (push) push(end_s, dt, sources_);
  ++tick_;
  if (!pressure_)
    waves_.advance(dt, placement, sources_);
  else
    waves_.advance(
        dt, placement, sources_,
        [&](glm::dvec2 place, double side) { return pressure_->value(place, side, middle_s, glm::vec4(0.0f)).x; },
        pressure_->bounds());
}

namespace {
std::optional<std::int64_t> tick_of(double time_s, double rate_hz) {
  if (!(std::abs(time_s * rate_hz) < 0x1p52)) return std::nullopt;
  return std::int64_t(std::floor(time_s * rate_hz + 1e-6));
}
}  // namespace

bool DynamicSea::begins_anew(double time_s) const {
  const std::optional<std::int64_t> now = tick_of(time_s, settings_.waves.rate_hz);
  return now && (!begun_ || *now < tick_ || double(*now - tick_) > longest_s * settings_.waves.rate_hz);
}

bool DynamicSea::update(double time_s, const glm::dvec3& viewer, const Push& push) {
  const DynamicWavesSettings& waves = settings_.waves;
  const std::optional<std::int64_t> now = tick_of(time_s, waves.rate_hz);
  if (!now || !std::isfinite(viewer.x + viewer.y + viewer.z)) return false;
  const bool anew = begins_anew(time_s), was_active = waves_.active();
  // What a sum of frame times loses is no time of its own.
  const double since_s = time_s - double(*now) / waves.rate_hz, ahead_s = since_s > 1e-6 ? since_s : 0.0;
  const bool carried = ahead_s != ahead_s_;
  if (!anew && *now == tick_ && !carried) return false;
  if (anew || *now != tick_)
    viewer_.follow({viewer.x, viewer.z}, viewer.y, anew ? 2.0 * longest_s : double(*now - tick_) / waves.rate_hz);
  if (ahead_s_ > 0.0) stale_ = stale_ || was_active;
  ahead_s_ = 0.0;  // within steps the surface is that of the step before
  if (anew) {
    if (goes_on_) {
      tick_ = *now - (begun_ ? jump_steps(tick_, *now, waves.rate_hz) : 0);
    } else {
      waves_.calm();
      tick_ = *now - std::int64_t(std::ceil(settings_.settle_s * waves.rate_hz));
    }
    begun_ = true;
    while (tick_ < *now) step(nullptr);
  }
  while (tick_ < *now) {
    step(push);
    stale_ = stale_ || was_active || waves_.active();
  }
  ahead_s_ = ahead_s;
  if (!was_active && !waves_.active()) return false;
  stale_ = true;
  ++version_;
  return true;
}

std::shared_ptr<const DynamicSurface> DynamicSea::shared_surface() {
  if (!stale_) return surfaces_[current_];
  for (current_ = 0; current_ < surfaces_.size() && surfaces_[current_].use_count() > 1;) ++current_;
  if (current_ == surfaces_.size()) surfaces_.push_back(std::make_shared<DynamicSurface>(settings_.waves));
  surfaces_[current_]->evaluate(waves_, ahead_s_, velocity_);
  stale_ = false;
  return surfaces_[current_];
}

}  // namespace seascape
