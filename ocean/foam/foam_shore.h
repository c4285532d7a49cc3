// Waves along curves as foam takes them: where each texel of its windows lies along them, and what they do to the water
// there.
#pragma once
#include <memory>
#include <optional>
#include <span>

#include "ocean/foam/foam.h"
#include "ocean/foam/foam_shore_simd.h"
#include "ocean/places/flow_phase.h"
#include "ocean/places/shore_lines.h"
#include "ocean/sea/place_sea.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

// Texels keep the place itself, found when they come into a window, where a surface reads between those of the place
// windows (shore_field.h).
class FoamShore {
 public:
  // `field`: has the waves (WaveField::has_curved).
  FoamShore(std::shared_ptr<const ShoreLines> lines, const LodWindowSettings& windows, const WaveField& field);

  // Whether it was made of these.
  bool is_of(const std::shared_ptr<const ShoreLines>& lines, const WaveField& field) const;

  // Moves the windows. `water`: what a bed makes of the waves; null: the open sea.
  void follow(const LodPlacement& placement, const PlaceSea* water);
  // Other water than before at one texel.
  void take(int slice, LodIndex w, const PlaceSea* water) {
    field_->texel(slice, w) = texel(field_->middle(slice, w), field_->texel_m(slice), water);
  }

  // What they do at a texel.
  struct Moved {
    glm::dvec3 displacement{0.0}, shift_gradient{0.0};  // m; dDx/dx, dDz/dz, dDx/dz
    double variance = 0.0;                              // of the divergence, within the texel
    double whole_variance = 0.0;                        // of it, of all of these waves there
    double height_variance = 0.0, surf = 0.0;           // m^2; the share of it that breaks
  };
  // Of a row's texels at the time of the tiles, carried by `flow_mps` (null: none), whose windows are the same. Gives
  // whether they come to any of them; if not, nothing is written.
  bool row(const FoamRow& row, const WaveField& field, const WaveTiles& tiles, const LodField<glm::vec2>* flow_mps,
           const FlowPhase& phase, std::span<Moved> moved) const;
  double largest_shift_m() const { return largest_shift_m_; }

 private:
  ShorePattern pattern(double footprint_m, const WaveField& field, const WaveTiles& tiles) const;
  struct Texel : ShoreTexelPlace {
    friend Texel operator+(const Texel& a, const Texel& b) { return {{a.place + b.place, a.waves + b.waves}}; }
    friend Texel operator-(const Texel& a, const Texel& b) { return {{a.place - b.place, a.waves - b.waves}}; }
    friend Texel operator*(const Texel& a, float by) { return {{a.place * by, a.waves * by}}; }
  };
  Texel texel(glm::dvec2 middle_m, double texel_m, const PlaceSea* water) const;
  std::shared_ptr<const ShoreLines> lines_;
  std::shared_ptr<const TileSource> source_;
  LodWindowSettings windows_;
  std::optional<LodField<Texel>> field_;  // from the first follow() on
  double height_variance_ = 0.0, largest_shift_m_ = 0.0;
};

}  // namespace seascape
