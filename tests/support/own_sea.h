// Foam and spray with a sea of their own, for tests that have nothing else to do with it.
#pragma once
#include <memory>
#include <utility>

#include "ocean/foam/foam_sea.h"
#include "ocean/foam/spray.h"

namespace seascape::test {

// All details in one quality, which a test chooses coarse.
inline SeaSpec spec_of(const SeaState& state, const WaveQuality& quality, TileSources others = {}) {
  SeaSpec spec;
  spec.state = state;
  spec.sources = std::move(others);
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
          std::shared_ptr<const ShoreLines> shore = nullptr)
      : SeaOfItsOwn(spec_of(state, quality, std::move(others))), FoamSea(spec, *own, std::move(shore)) {}
};

class OwnSpray : public SeaOfItsOwn, public Spray {
 public:
  OwnSpray(const SpraySettings& settings, const SeaState& state, const WaveQuality& quality, double foam_life_s)
      : SeaOfItsOwn(spec_of(state, quality)), Spray(settings, *own, foam_life_s) {}
};

}  // namespace seascape::test
