#include "app/water_height.h"

#include <algorithm>
#include <span>
#include <utility>

namespace seascape {

namespace {

// The fourth cascade begins below waves of two metres or so, and 128 samples keep each cascade's whole band.
constexpr int most_resolution = 128, most_cascades = 3;
constexpr double footprint_m = 0.5;  // of a person's float

WaveQuality coarse(WaveQuality quality) {
  quality.resolution = std::min(quality.resolution, most_resolution);
  quality.cascades = std::min(quality.cascades, most_cascades);
  return quality;
}

WaveBins longest(const WaveBins& drawn) {
  WaveBins bins = drawn;
  bins.cascades = std::min(bins.cascades, most_cascades);
  bins.bins.resize(WaveBins::first(bins.cascades));
  return bins;
}

}  // namespace

WaterHeight::WaterHeight(const SeaState& sea, const WaveQuality& quality, const WaveBins& drawn, TileSources others,
                         PlaceInputs place, ShallowsMix shallows)
    : field_(sea, coarse(quality), longest(drawn), std::move(others)),
      place_(std::move(place), field_, std::move(shallows)) {}

double WaterHeight::at(glm::dvec2 place_m, double time_s) {
  const std::int64_t ticks = ticks_from_seconds(time_s);
  if (!evaluated_ || tiles_.ticks() != ticks) field_.evaluate(ticks, tiles_);
  evaluated_ = true;
  QueryAnswer answer;
  QueryOptions options;
  options.footprint_m = footprint_m;
  place_.query(field_, tiles_, std::span(&place_m, 1), std::span(&answer, 1), options);
  return answer.height_m;
}

}  // namespace seascape
