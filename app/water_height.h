// How high the water stands at the camera, for riding it and for staying above it. Pure.
#pragma once
#include "ocean/sea/place_sea.h"
#include "ocean/sea/query.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

// Asks the wave field with the long cascades alone: they hold the same waves as the drawn sea down to a few metres, at
// a part of its cost. Whoever rides does not feel the shorter ones.
class WaterHeight {
 public:
  // The waves that the sea draws, and what its bed makes of them.
  WaterHeight(const SeaState& sea, const WaveQuality& quality, const WaveBins& drawn, TileSources others = {},
              PlaceInputs place = {}, ShallowsMix shallows = {});
  // Other amplitudes of the same waves, as the drawn sea has them while it changes.
  void follow(const WaveBins& drawn, double chop, ShallowsMix shallows) {
    place_.follow(std::move(shallows));
    field_.take(drawn, chop, field_.statistics());
    evaluated_ = false;
  }
  // Metres above the still sea at a world x, z at a time of the sea.
  double at(glm::dvec2 place_m, double time_s);

 private:
  WaveField field_;
  PlaceSea place_;
  WaveTiles tiles_;
  bool evaluated_ = false;
};

}  // namespace seascape
