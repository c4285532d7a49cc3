// Foam and spray with a sea of their own, for tests that have nothing else to do with it.
#pragma once
#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "ocean/foam/foam_sea.h"
#include "ocean/foam/spray.h"

namespace seascape::test {

// A flat input of 1 km a side around `at_m` that replaces what is there: of sea_depth a bed of this height (m).
inline InputSpec flat_input(InputTarget to, double value, glm::dvec2 at_m = glm::dvec2(0.0),
                            glm::dvec2 size_m = glm::dvec2(1000.0)) {
  InputSpec spec;
  spec.to = to;
  spec.blend = InputBlend::replace;
  spec.value = {float(value), 0.0f, 0.0f, 0.0f};
  spec.shape = AreaInput{.round = false, .at_m = at_m, .size_m = size_m};
  return spec;
}
// A bed that falls by one in ten along `down`, a unit vector; the water's edge lies at `edge_m`.
inline InputSpec beach(glm::dvec2 edge_m, glm::dvec2 down) {
  InputSpec spec = flat_input(InputTarget::sea_depth, 0.0);
  SplineInput slope;
  slope.points = {{edge_m - 100.0 * down, 1000.0, glm::vec4(10.0f, 0.0f, 0.0f, 0.0f)},
                  {edge_m + 100.0 * down, 1000.0, glm::vec4(-10.0f, 0.0f, 0.0f, 0.0f)}};
  spec.shape = slope;
  return spec;
}
inline PlaceInputs places_of(const std::vector<InputSpec>& specs) {
  PlaceInputs result;
  for (const InputTarget kind : {InputTarget::level, InputTarget::sea_depth, InputTarget::flow, InputTarget::clip}) {
    auto inputs = std::make_shared<const Inputs>(kind, specs);
    if (!inputs->empty()) result.kinds.push_back(std::move(inputs));
  }
  if (std::any_of(specs.begin(), specs.end(), is_volume)) result.volumes = std::make_shared<const ClipVolumes>(specs);
  return result;
}

// All details in one quality, which a test chooses coarse.
inline SeaSpec spec_of(const SeaState& state, const WaveQuality& quality, TileSources others = {},
                       PlaceInputs place = {}) {
  SeaSpec spec;
  spec.state = state;
  spec.sources = std::move(others);
  spec.place = std::move(place);
  spec.drawn = spec.crests = spec.felt = quality;
  spec.crests_velocity = true;
  return spec;
}

struct SeaOfItsOwn {
  explicit SeaOfItsOwn(SeaSpec spec) : own(std::make_unique<Sea>(std::move(spec))) {}
  std::unique_ptr<Sea> own;
};

class OwnFoam : public SeaOfItsOwn, public FoamSea {
 public:
  OwnFoam(const FoamSpec& spec, const SeaState& state, const WaveQuality& quality, TileSources others = {},
          std::shared_ptr<const ShoreLines> shore = nullptr, PlaceInputs place = {})
      : SeaOfItsOwn(spec_of(state, quality, std::move(others), std::move(place))),
        FoamSea(spec, *own, std::move(shore)) {}
};

class OwnSpray : public SeaOfItsOwn, public Spray {
 public:
  OwnSpray(const SpraySettings& settings, const SeaState& state, const WaveQuality& quality, double foam_life_s,
           PlaceInputs place = {})
      : SeaOfItsOwn(spec_of(state, quality, {}, std::move(place))), Spray(settings, *own, foam_life_s) {}
};

}  // namespace seascape::test
