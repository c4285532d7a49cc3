#include "ocean/places/dynamic_sea.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/text.h"
#include "ocean/places/rain.h"

namespace seascape {

namespace {
// A long step is as exact as a short one (wave_level.h): what this class hands on is one step of the waves each.
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
      surface_(settings.waves) {
  validate(settings);
}

void DynamicSea::advance(std::int64_t ticks) {
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
  add_rain(settings_.rain, tick_ + 1, ticks, waves.rate_hz, placement.viewer, reach, sources_);
  tick_ += ticks;
  const double dt = double(ticks) / waves.rate_hz, middle_s = double(tick_) / waves.rate_hz - 0.5 * dt;
  if (!pressure_)
    waves_.advance(dt, placement, sources_);
  else
    waves_.advance(
        dt, placement, sources_,
        [&](glm::dvec2 place, double side) { return pressure_->value(place, side, middle_s, glm::vec4(0.0f)).x; },
        pressure_->bounds());
}

bool DynamicSea::update(double time_s, const glm::dvec3& viewer) {
  const DynamicWavesSettings& waves = settings_.waves;
  if (!(std::abs(time_s * waves.rate_hz) < 0x1p52) || !std::isfinite(viewer.x + viewer.y + viewer.z)) return false;
  const std::int64_t now = std::int64_t(std::floor(time_s * waves.rate_hz + 1e-6));
  const auto in_ticks = [&](double seconds) { return std::int64_t(std::ceil(seconds * waves.rate_hz)); };
  const bool anew = !begun_ || now < tick_ || now - tick_ > in_ticks(longest_s);
  if (!anew && now == tick_) return false;
  const bool was_active = waves_.active();
  viewer_.follow({viewer.x, viewer.z}, viewer.y, anew ? 2.0 * longest_s : double(now - tick_) / waves.rate_hz);
  const std::int64_t frame = std::max<std::int64_t>(1, waves.most_steps);
  if (anew) {
    begun_ = true;
    waves_.calm();
    tick_ = now - in_ticks(settings_.settle_s);
    while (tick_ < now) advance(1);
  }
  for (std::int64_t left = std::min(now - tick_, frame); left > 0; --left) advance((now - tick_ + left - 1) / left);
  if (!was_active && !waves_.active()) return false;
  surface_.evaluate(waves_);
  return true;
}

}  // namespace seascape
