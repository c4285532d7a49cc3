// The mesh of the bed before eyes in the water: patches of a quadtree of its own, whose levels follow distance alone.
#pragma once
#include <span>

#include "ocean/mesh/portal_sight.h"
#include "ocean/mesh/quadtree.h"

namespace seascape {

// What of the bed may be seen, metres.
struct BedInSight {
  double lowest_m = 0.0, highest_m = 0.0;  // above the still sea: all of it lies between
  double sight_m = 400.0;                  // as far as an eye sees in the water
  bool earth_curvature = true;
  const PortalSight* portals = nullptr;  // through which alone it is seen
};

class BedMesh {
 public:
  BedMesh();

  // The patches for a viewpoint, as Quadtree::select() has them: those that an eye may see within sight. They stay
  // until the next call. Throws as it does.
  const SurfaceSelection& select(const Viewpoint& viewpoint, const BedInSight& bed);
  // Of a selection: without the skirt, which lies out of sight.
  static std::span<const gpu::PatchInstance> patches(const SurfaceSelection& selection) {
    return std::span(selection.patches).first(selection.patches.size() - std::size_t(selection.skirt_strips));
  }
  // How far vertices may be apart at a distance, over that distance.
  static double spacing_over_distance(double pixels_per_radian);

 private:
  Quadtree tree_;
  Viewpoint over_middle_;  // heights from the middle of the bed's
};

}  // namespace seascape
