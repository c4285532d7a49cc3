// The foam and spray that a hull makes: at its bow, where it slaps the water, behind its transom, in the propeller's
// wash, and the trail that lasts behind it.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "ocean/bodies/hull_wake.h"
#include "ocean/sea/actor_foam.h"
#include "ocean/sea/actor_spray.h"

namespace seascape {

// A propeller at work.
struct PropellerWash {
  glm::dvec3 at_m{0.0};  // the propeller, in the world
  double diameter_m = 0.4;
  double thrust_n = 0.0;  // either way
};

// How fast a propeller's jet leaves the water that it draws in, m/s: of momentum theory far behind an actuator disc
// (Rankine 1865; Froude 1889), sqrt(v^2 + 2 T / (rho A)) - v.
double jet_speed(const PropellerWash& wash, double speed_mps, double density_kg_m3);

// The height (m) that water climbs to at a bow of this half entrance angle's tangent and draught: 2.2 / (1 + F) tan a /
// cos a U^2 / g, F = U / sqrt(g T) (Noblesse et al. 2008).
double bow_wave_m(double speed_mps, double tan_half_entrance, double draught_m, double gravity_mps2);

// One hull's, with the memory of where it has been. Foam is given ten times a second, each time for as long as that:
// discs of a fleet come to few a step of the sea.
class WakeFoam {
 public:
  struct Made {
    std::vector<FoamDisc> foam;
    std::vector<SprayThrow> spray;
    void clear() { foam.clear(), spray.clear(); }
  };
  // `share`: of a tenth of a second, 0 to 1: when it gives first. Hulls that differ in it take turns.
  explicit WakeFoam(double share = 0.0) : since_s_(share * every_s) {}

  // A step that ends with the sections `cut` (HullWake::cut); appends what is made in it. A disc's rate holds for the
  // step alone.
  void step(double dt_s, const HullMotion& motion, std::span<const HullSection> cut, double part_m,
            const std::optional<PropellerWash>& wash, double gravity_mps2, double density_kg_m3, Made& made);
  // Steps are missing, or the hull was put elsewhere: it has been nowhere.
  void forget() { path_count_ = 0, usual_draught_m_ = 0.0; }
  std::uint64_t hash() const;

  // How wide the trail is, m, so far behind a hull of this beam: as wide as it, and growing as the distance in beams to
  // the power of 1/5.
  static double trail_width_m(double beam_m, double behind_m);
  static constexpr double every_s = 0.1;

 private:
  static constexpr int most_places = 96;
  static constexpr double place_every_s = 0.5;
  struct Place {
    glm::dvec2 at_m;
    double way_m;  // gone in the water until there
    double beam_m;
    double strength;  // 0 to 1, of the foam it left
  };
  void remember(const glm::dvec2& at_m, double beam_m, double strength);
  void widen_trail(double per_step, Made& made) const;
  std::vector<Place> path_;  // a ring
  int path_first_ = 0, path_count_ = 0;
  double since_s_ = 0.0, since_place_s_ = 0.0, way_m_ = 0.0;
  double usual_draught_m_ = 0.0;  // of what lies behind the bow, over some seconds; 0 before it first lay in the water
};

}  // namespace seascape
