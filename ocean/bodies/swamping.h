// Water in a boat: what comes over her gunwale, where it lies, what it weighs and what is bailed.
#pragma once
#include <memory>
#include <vector>

#include "ocean/bodies/hull_forces.h"

namespace seascape {

// The inside of an open boat; without a hull she takes no water.
struct InsideSpec {
  std::shared_ptr<const HullMesh> hull;  // closed by a lid at her gunwale, in the axes of the boat's hull
  double bail_kg_s = 0.0;
  double weir = 0.62;  // of an edge that water runs over: 0.6 to 0.65 where it is sharp
};

// The part of a closed mesh below a level: its volume (m3) and centre.
struct Filled {
  double volume_m3 = 0.0;
  glm::dvec3 centre_m{0.0};
};
Filled below_level(const HullMesh& mesh, const glm::dmat3& to_world, double level_m);

class Inside {
 public:
  Inside() = default;
  // About the mass's centre. Throws Error where the mesh is unfit or has no lid that looks up.
  Inside(const InsideSpec& spec, const glm::dvec3& mass_centre_m, const char* where);

  bool open() const { return volume_m3_ > 0.0; }
  double volume_m3() const { return volume_m3_; }
  // Where so much water lies, still: its level and its centre, from the mass's centre in the world's axes. The level is
  // found to 1e-9 of the volume.
  struct Pool {
    double level_m = 0.0;
    glm::dvec3 centre_m{0.0};
  };
  Pool pool(const glm::dmat3& to_world, double filled_m3) const;
  // What runs in over the gunwale, m3/s; below 0 it runs out. Each length b of it is a weir with the head h of the
  // higher water over it, 2/3 mu b sqrt(2 g) h^(3/2) (Poleni 1717), less where the lower water is above it too
  // (Villemonte 1947). Upside down with her gunwale under she keeps her air.
  double flow_m3_s(const BodyPose& pose, const WaterPatch& water, const Pool& pool, double filled_m3,
                   double gravity_mps2) const;

 private:
  struct Edge {
    glm::dvec3 middle_m{0.0}, along_m{0.0};
  };
  HullMesh mesh_;
  std::vector<Edge> gunwale_;
  double volume_m3_ = 0.0, weir_ = 0.0;
};

// A mass at a place (m from the mass's centre) as the body has it with its own: water has no spin of its own.
Matrix6 mass_at(const glm::dvec3& place_m, double kg);

}  // namespace seascape
