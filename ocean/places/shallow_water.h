// How high a sea's waves are where the water is shallow: each cascade's factor at a local depth, by shoaling and by
// breaking.
#pragma once
#include <vector>

#include "ocean/waves/sea_limits.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

// Waves that come from no cascade (Gerstner sets, a baked loop, particles), as one train.
struct OtherWaves {
  double wavelength_m = 0.0;  // of their peak, in the sea's own depth; 0 or less: there are none
  double height_m = 0.0;      // significant
};

// Those of all sources together: of their variance, as long as their waves are in the middle (of logarithms).
OtherWaves other_waves(const TileSources& sources);

// What the waves of a sea, made for its depth_m, come to in water of another depth. Two laws, one after the other:
//
// Shoaling: the flux of energy of each frequency stays, so heights go with Ks = sqrt(cg0 / cg), cg the speed of energy
// of linear theory at the depth and cg0 at the sea's own (Airy 1845; Dean and Dalrymple 1991, eq. 4.116). A cascade's
// is the root of its waves' mean Ks^2, weighted by their variances, so that variances stay right; at most
// most_shoaling, which a wave passes at k h = 1/32, where it is no linear wave any more.
//
// Breaking: of all waves together the significant height H comes to H (1 + (H / (0.594 h))^6)^(-1/6), which is never
// above 0.594 of the depth h: waves in a surf zone are in root mean square 0.42 h high (Thornton and Guza 1982, 1983),
// and the significant height is sqrt(2) of that. The power is ours: half a per cent is lost at 0.56 of the limit. All
// frequencies lose the same share, as Eldeberky and Battjes (1996) found them to.
//
// Left out: bending (refraction.h) and the energy it gathers or spreads, friction at the bed, set-up of the water
// level, and harmonics. A sea whose own depth is too shallow for its height breaks in it too: its factor there is
// below 1.
//
// Immutable; any thread. Two depths alike give the same to the bit.
class ShallowWater {
 public:
  static constexpr double most_shoaling = 4.0;
  static constexpr double most_height_of_depth = seascape::most_height_of_depth;
  // A flat sea breaks as one of this height would, so that its factors go to 0 at the shore too.
  static constexpr double least_height_m = 1e-3;
  // The tables miss the laws by less than this (tests/ocean/places/shallow_water_test.cpp).
  static constexpr double table_error = 1e-3;

  // Of the same sea and bins as the wave field's. Takes some 3 ms (tests/bench/shallows_bench.cpp); a factor is read in
  // 10 ns.
  ShallowWater(const SeaState& sea, const WaveBins& bins, OtherWaves others = {});

  // By which a cascade's heights (and its displacement) are multiplied in water of a depth: 0 to most_shoaling,
  // continuous; 0 where the depth is 0 or less or no number; 1 in the deep of a deep sea, to 1e-6. `cascade` is 0 to
  // bins.cascades - 1; one without waves has the breaking alone.
  float factor(int cascade, double depth_m) const { return at(factors_[std::size_t(cascade)], depth_m); }
  // The same of the other waves.
  float others(double depth_m) const { return at(factors_.back(), depth_m); }
  // By which a cascade's wave numbers rise: k / k0 at each wave's own frequency, weighted by their variances; at most
  // most_steepening, and that where the depth is 0 or less or no number. Slopes rise by this where crests are drawn
  // closer together, and by factor().
  static constexpr double most_steepening = 16.0;
  double steepening(int cascade, double depth_m) const;
  // The share of the shoaled waves' energy that has gone into breaking: 0 in the deep to 1 at the shore.
  float breaking(double depth_m) const { return 1.0f - left(depth_m); }
  float left(double depth_m) const { return at(left_, depth_m); }  // what has not
  // Significant height of all waves (m), shoaled and broken.
  float height_m(double depth_m) const { return at(heights_, depth_m); }

 private:
  using Table = std::vector<float>;  // over evenly spaced logarithms of the depth; below the first in proportion to the
                                     // depth (left_: its square)
  float at(const Table& table, double depth_m) const;
  std::vector<Table> factors_;      // of each cascade, then of the other waves
  std::vector<Table> steepenings_;  // of each cascade
  Table left_, heights_;
};

}  // namespace seascape
