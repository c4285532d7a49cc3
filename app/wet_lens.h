// What water a viewer's eyes carry on their lenses: drops, from when they come out of the sea.
#pragma once
#include <array>
#include <span>

#include "ocean/sea/sea.h"
#include "ocean/surface/lens_drops.h"

namespace seascape {

class WetLens {
 public:
  // Frames of so long before a moment are all that its drops depend on.
  static constexpr double remembers_s = LensDrops::life_s + 1.0;

  // Goes on to a time of the sea, with each eye's lens `lens_m` before it. Whether a lens is in the water is asked of
  // the felt sea without its history, in the lens's middle, so that a replay gives the same wherever it starts.
  // `in_air`: surely none is.
  void step(Sea& sea, const Viewpoint& viewpoint, double lens_m, double time_s, bool in_air);
  // What is there now; of this until the next step.
  std::span<const gpu::LensDrop> drops() const { return listed_; }

 private:
  std::array<LensDrops, 2> lenses_;
  std::vector<gpu::LensDrop> listed_;
};

}  // namespace seascape
