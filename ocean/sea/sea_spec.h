// What a sea is made of: the state of its waves, what feeds it beside them, what belongs to its places, and in what
// detail it is asked. Plain values.
#pragma once
#include <memory>
#include <optional>

#include "ocean/places/dynamic_sea_settings.h"
#include "ocean/places/place_fields.h"
#include "ocean/places/wake_settings.h"
#include "ocean/waves/sea_state.h"
#include "ocean/waves/tile_source.h"

namespace seascape {

// In what detail the waves are asked for.
enum class SeaDetail {
  drawn,   // as the picture has them, by the preset
  crests,  // what breaks: foam and spray
  felt,    // what bodies, swimmers, cameras and culling feel: the same at every preset and on every device
};
inline constexpr int sea_details = 3;
// The finest texels of places that `felt` answers read; `drawn` and `crests` have those of the picture's windows.
inline constexpr double felt_place_texel_m = 0.5;

struct SeaSpec {
  SeaState state;
  bool has_waves = true;  // or else only the sources, places and dynamic waves move the water
  TileSources sources;    // what feeds the sea beside its waves
  PlaceInputs place;
  std::optional<DynamicSeaSettings> dynamic_waves;  // none: the effect is not called for
  std::shared_ptr<const Inputs> pressure;           // on dynamic waves; null for none
  std::optional<WakeSettings> wakes;                // likewise
  bool actors_foam = false;                         // whether foam of actors is kept, and has foam simulated

  WaveQuality drawn;
  // Four cascades hold the waves of 0.3 m and more, three those of 2 m and more; 128 samples keep each one's band.
  WaveQuality crests{.resolution = 128, .cascades = 4};
  WaveQuality felt{.resolution = 128, .cascades = 3};
  // Of which details views know how fast the water moves; it takes half as much time again.
  bool drawn_velocity = false, crests_velocity = false, felt_velocity = false;

  const WaveQuality& quality(SeaDetail detail) const {
    return detail == SeaDetail::drawn ? drawn : detail == SeaDetail::crests ? crests : felt;
  }
  bool velocity(SeaDetail detail) const {
    return detail == SeaDetail::drawn ? drawn_velocity : detail == SeaDetail::crests ? crests_velocity : felt_velocity;
  }
};

}  // namespace seascape
