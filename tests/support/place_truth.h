// The sea with what belongs to places in plain double precision, tile by tile and texel by texel: what vectors and
// shaders are compared with.
#pragma once
#include <optional>
#include <vector>

#include "ocean/places/place_reader.h"
#include "ocean/sea/place_sea.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape::test {

// A PlaceSea that can be read this way too.
class PlaceTruth : public PlaceSea {
 public:
  PlaceTruth(const PlaceInputs& inputs, const WaveField& field);
  PlaceTruth(const PlaceInputs& inputs, const WaveField& field, const ShallowsMix& shallows);

  // The surface at a rest position (m) for a footprint (m), of the tiles' time. Gradients are those that the tiles
  // carry, as pictures have them; second moments are left out. `seen`: as a picture with these windows has it.
  // `dynamic`: null where dynamic waves are left out. `volumes`: null for the scene's own.
  SeaSample sea(const WaveField& field, const WaveTiles& tiles, glm::dvec2 rest_m, double footprint_m,
                const LodPlacement* seen = nullptr, const DynamicSurface* dynamic = nullptr,
                const ClipVolumes* volumes = nullptr) const;

 private:
  // A pattern of waves: which of the field's places, where in its own places it is taken, and what it counts for.
  struct Part {
    std::size_t of;
    glm::dvec2 place;
    double share = 1.0, lift = 1.0;    // of its displacement; of its height
    glm::dvec2 lift_gradient{0.0};     // a metre
    glm::dvec2 along{0.0}, bend{0.0};  // Refraction: the pattern's direction, and the gradient of its shift
    glm::dmat2 warp{0.0};              // of a light sea's longest tile: what the warp's shift grows by along x and z
  };
  // Waves along a curve.
  struct Curved {
    ShorePlace at;
    double share = 0.0;
    glm::dvec2 share_gradient{0.0};
  };
  // Where it is asked: at a time, for a footprint, by a picture's windows or none.
  struct Asked {
    const WaveField& field;
    const WaveTiles& tiles;
    glm::dvec2 rest;
    double footprint_m, time_s;
    const LodPlacement* seen;
  };
  // All of a rest position's, and what stands still there.
  struct Here {
    std::vector<Part> parts;
    std::vector<Curved> curved;
    double level_m = 0.0, bed_m = 0.0, wet = 1.0;
    glm::dvec2 level_gradient{0.0}, bed_gradient{0.0};
  };
  PlaceReading reading(const Asked& asked) const;
  void add_bed(Here& here, const Asked& asked) const;
  void add_curved(Here& here, const Asked& asked) const;
  void carry(Here& here, const Asked& asked) const;
  PlaceInputs inputs_;
  ShallowsMix mix_;
  std::optional<PlaceValues<glm::vec4>> level_, flow_;
  std::optional<PlaceValues<BedTexel>> bed_;
  std::optional<PlaceValues<ShoreTexel>> shore_;
};

// DynamicSurface::sea, at a rest position (m) for a footprint (m).
DynamicSample dynamic_truth(const DynamicSurface& surface, glm::dvec2 rest_m, double footprint_m);

}  // namespace seascape::test
