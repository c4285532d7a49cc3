// The sea over its bed: how deep it is at a place, and what the waves of the open sea come to there.
#pragma once
#include <array>
#include <memory>
#include <optional>

#include "ocean/places/place_fields.h"
#include "ocean/places/refraction.h"
#include "ocean/places/shallow_water.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

// What a place makes of the waves that come to it; all 1, and nothing shifted, in the open.
struct PlaceWaves {
  std::array<float, gpu::max_cascades> share{
      1.0f, 1.0f, 1.0f, 1.0f,
      1.0f};  // by which each cascade's displacement is multiplied; of one that the sea has not, that of the last
  float ripples = 1.0f;  // the same of waves too short for any cascade, which nothing shelters for long
  float others = 1.0f;   // of the sources beside the waves
  float swash = 0.0f;    // what of the heights of the longest two cascades runs up the shore, whatever the depth
  std::array<float, Refraction::bent_cascades>
      shift_m{};  // how far along its direction a cascade's pattern is taken from (Refraction)
};

// Depth is the still water's height less the bed's. Swash: at the shore linear waves have broken to nothing, but the
// water goes up and down there with the groups that come in, over a height of 0.06 sqrt(H0 L0) (Stockdon et al. 2006,
// eq. 12; H0 the significant height and L0 the deep water's length of the mean wave): the longest waves' heights keep
// as much as that of themselves where the others have broken, less what lies in shelter, and on over the dry bed.
// Shelter is of waves that come from afar. In the lee short waves grow again within regrowth_fetch_m, as long as
// JONSWAP's law has their peak (Hasselmann et al. 1973: w_p = 22 (g^2 / U F)^(1/3)), so that cascades whose mean wave
// is no longer than that are not sheltered, and those of four times as long wholly. Waves that the scene puts at a
// place (along curves) nothing shelters: they shoal by themselves, and break as the law has it for their height
// together with that of the sea's waves as far as these come there. Immutable; any thread.
class Shallows {
 public:
  static constexpr int swash_cascades = gpu::swash_cascades;
  static constexpr double regrowth_fetch_m = 300.0;

  // `bed`: inputs to sea_depth; `level`: to level, null where there are none; `placed`: waves that the scene puts at
  // places. Takes some tenths of a second. Throws Error where the bed is no number.
  Shallows(const SeaState& sea, const WaveBins& bins, const OtherWaves& others, const OtherWaves& placed,
           const PlaceSettings& settings, std::shared_ptr<const Inputs> bed, std::shared_ptr<const Inputs> level);

  double depth_m() const { return -double(outside_bed_.x); }                    // of the open sea
  double bed_m(glm::dvec2 place_m, double footprint_m, double time_s) const;    // above y = 0
  double still_m(glm::dvec2 place_m, double footprint_m, double time_s) const;  // of the still water, dry or not
  PlaceWaves waves(glm::dvec2 place_m, double depth_m) const;
  // Of waves that the scene puts there: by which their displacement is multiplied, and the share of their energy that
  // breaks. Both 0 where it has none.
  struct Placed {
    double share = 0.0, surf = 0.0;
  };
  Placed placed(glm::dvec2 place_m, double depth_m) const;
  // Along which a cascade's pattern is shifted: a unit vector, or 0.
  glm::dvec2 direction(int cascade) const { return refraction_.direction(cascade); }
  // Share of the waves' energy that breaking has taken at a place of this depth, 0 to 1.
  double breaking(double depth_m) const { return water_.breaking(depth_m); }
  // Of the energy that comes to a place of this depth, the share that breaks there, 0 to 1.
  double surf(glm::dvec2 place_m, double depth_m) const {
    return depth_m > 0.0 ? breaking(depth_m) * double(refraction_.shelter(place_m)) : 0.0;
  }
  // The most by which any waves are multiplied anywhere, 1 or more.
  double most_share() const { return most_share_; }
  double swash_m() const {
    return swash_m_;
  }  // from the lowest to the highest of the run-up, for the most part: its significant height
  // How far above the still water the highest of fifty run-ups wets a flat beach: 0.043 sqrt(H0 L0) (Stockdon et al.
  // 2006, eq. 18).
  double run_up_m() const { return swash_m_ * 0.043 / 0.06; }

  bool still() const { return bed_->still() && (level_ == nullptr || level_->still()); }
  InputBounds bounds() const;  // of all that may change the depth

 private:
  std::shared_ptr<const Inputs> bed_, level_;
  PlaceSettings settings_;
  glm::vec4 outside_bed_, outside_level_;
  ShallowWater water_;
  std::optional<ShallowWater> placed_;
  Refraction refraction_;
  int cascades_;
  std::array<float, gpu::max_cascades> regrown_{};  // the share of a cascade's shelter that short waves make up for
  double swash_m_ = 0.0, swash_share_ = 0.0, most_share_ = 1.0;
};

// Of a scene's places; null where it has no inputs to sea_depth.
std::shared_ptr<const Shallows> make_shallows(const SeaState& sea, const WaveBins& bins, const TileSources& others,
                                              const PlaceInputs& inputs);

}  // namespace seascape
