// A boat's engine, rudder, sails and oars: what is asked of them becomes forces on her body. Pure.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "ocean/bodies/blade_rings.h"
#include "ocean/bodies/bodies.h"
#include "ocean/bodies/handling.h"

namespace seascape {

// All places in the axes of the hull's file: metres, +y up, -z ahead, +x to starboard.
struct BoatEngine {
  PropellerSettings propeller;
  glm::dvec3 at_m{0.0};
  double most_turns_per_s = 20.0, most_power_w = 2e4;
  double most_turn_rad = 0.0;  // an outboard's, either way; 0: it does not turn
};
struct BoatRudder {
  glm::dvec3 at_m{0.0};  // the blade's middle
  double area_m2 = 0.2, aspect = 2.0, most_rad = 0.6;
};
struct BoatSail {
  SailSettings sail;
  glm::dvec3 centre_m{0.0};
};
struct BoatOar {
  glm::dvec3 pivot_m{0.0};
  double length_m = 1.5;  // from the pivot to the blade's middle
  double area_m2 = 0.06;
  bool to_port = false;
};
struct BoatSpec {
  std::optional<BoatEngine> engine;
  std::optional<BoatRudder> rudder;
  std::vector<BoatSail> sails;
  std::vector<BoatOar> oars;  // one a side at most
};

// The actions of the same names (platform/actions.h).
struct BoatControls {
  double throttle = 0.0, helm = 0.0, sheet = 0.5, oar_left = 0.0, oar_right = 0.0;
};

// How her parts stand, for whoever shows them.
struct BoatParts {
  double turns_per_s = 0.0, propeller_rad = 0.0;
  double thrust_n = 0.0;               // of the propeller in the last step, ahead positive
  double helm = 0.0;                   // -1 to 1, where rudder or outboard are by now
  std::array<double, 2> boom_rad{};    // of the first sails, to starboard positive
  std::array<double, 2> luffing{};     // 0 drawing to 1 flogging
  std::array<double, 2> oar_phase{};   // left, right: turns of a stroke, the first half of each in the water
  std::array<double, 2> oar_ahead{};   // rad, how far the blade is ahead of square
  std::array<bool, 2> oar_in_water{};  // dipped
};

class Boat {
 public:
  explicit Boat(BoatSpec spec) : spec_(std::move(spec)) {}
  // Values beyond the actions' ranges are cut to them; no number counts as 0.
  void ask(const BoatControls& controls);
  const BoatControls& asked() const { return asked_; }
  // Her parts' forces of one step on body `n`, of which she is.
  void step(Bodies& bodies, std::size_t n, const BodyWater& water, const HullMedia& media, double end_s, double dt_s);
  // Sets her sails at once as the wind has them; in steps they follow it.
  void trim(const BodyState& state, const HullMedia& media);
  const BoatParts& parts() const { return parts_; }
  // The oars' blades that are in the water as of the last step.
  std::span<const Blade> blades() const { return {blades_.data(), std::size_t(blade_count_)}; }
  const BoatSpec& spec() const { return spec_; }
  std::uint64_t mixed_into(std::uint64_t hash) const;

 private:
  struct Hull;
  struct Flow {
    glm::dvec3 water{0.0};  // past the boat, in her axes, m/s
    double wet = 0.0;       // share of the part that is in the water
  };
  Flow flow_at(const Hull& hull, const glm::dvec3& at_m, double half_m) const;
  void drive(Hull& hull, double dt_s);
  void steer(Hull& hull);
  SailForce wind_in(const BoatSail& sail, const BodyState& state, const HullMedia& media) const;
  void sail(Hull& hull, double dt_s);
  void row(Hull& hull, const BoatOar& oar, double dt_s);
  BoatSpec spec_;
  BoatControls asked_;
  BoatParts parts_;
  std::array<Blade, 2> blades_;
  int blade_count_ = 0;
};

}  // namespace seascape
