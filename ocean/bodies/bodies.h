// Everything that floats: bodies in steps of their own, whatever the frames, from what the water is around each.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ocean/bodies/contacts.h"
#include "ocean/bodies/hull_forces.h"
#include "ocean/bodies/planing_bottom.h"
#include "ocean/bodies/probes.h"
#include "ocean/bodies/rigid_body.h"
#include "ocean/bodies/swamping.h"

namespace seascape {

// hull: the pressure on its clipped triangles. probes: four columns with the hull's waterplane. follow: carried by the
// water's plane, with no inertia.
enum class BodyLevel { hull, probes, follow };

struct BodySettings {
  double rate_hz = 60.0;
  double longest_s = 1.0;                     // a longer jump of the time is not stepped: bodies hold
  int water_samples = 16, probe_samples = 6;  // along the longer side of a body's water; 6 at least
  int most_substeps = 16;
  double sleep_after_s = 2.0, sleep_mps = 0.002, sleep_rad_s = 0.002;
  HullMedia media;
};

struct BodySpec {
  std::string name;
  std::shared_ptr<const HullMesh> hull;
  BodyLevel level = BodyLevel::hull;
  BodyMass mass;                  // about the centre of mass
  glm::dvec3 mass_centre_m{0.0};  // in the hull's axes
  Matrix6 damping;                // of radiated waves and the like: linear, N s/m ..., the body's axes
  HullDrag drag;
  // At the level hull, of one that goes ahead along -z: lift of its bottom, and by its stations (PlaningBottom)
  // added mass in heave, pitch, sway and yaw instead of `mass`'s, and damping in heave and pitch instead of
  // `damping`'s.
  bool planes = false;
  InsideSpec inside;
  glm::dvec3 at_m{0.0};  // of the hull's origin
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 velocity_mps{0.0}, spin_rad_s{0.0};
};

struct BodyState {
  BodyMotion motion;
  glm::dvec3 at_m{0.0};  // of the hull's origin
  double submerged_m3 = 0.0, added_share = 0.0;
  bool asleep = false;
  double filled_m3 = 0.0;   // of water in it
  double slam_mps = 0.0;    // of its speed, what coming onto the water took in the last step
  ContactImpulses contact;  // of the last step
  bool lost = false;        // a number was none: it is held where it was last
};

class Bodies {
 public:
  // Throws Error where a hull, a mass or a collider is unfit. Without contacts bodies go through each other.
  Bodies(const BodySettings& settings, std::vector<BodySpec> specs,
         const std::optional<ContactSettings>& contacts = std::nullopt);

  // Steps to the last whole step before a time (s). The first call begins there.
  void advance(double time_s, const BodyWater& water);
  // One step that ends at a time, for who keeps the time himself.
  void step(double end_s, double dt_s, const BodyWater& water);
  const std::vector<BodyState>& result() const { return states_; }
  const BodySpec& spec(std::size_t body) const { return bodies_[body].spec; }
  const BodySettings& settings() const { return settings_; }
  // Lift that its bottom has of a drift, over speed ahead and drift (PlaningBottom), as of the last step.
  double shed_sideways_kg_m(std::size_t body) const { return bodies_[body].shed_sideways_kg_m; }
  double inside_m3(std::size_t body) const { return bodies_[body].inside.volume_m3(); }  // 0 without an inside

  // Acts in the next step alone, at a place of the world; wakes the body.
  void push(std::size_t body, const glm::dvec3& force_n, const glm::dvec3& at_m);
  // Force and moment about the centre of mass, in the world's axes, that come of its own motion: in the next step
  // alone, and waking nobody.
  void resist(std::size_t body, const Vector6& force);
  void wake(std::size_t body);
  // An impulse at once (N s), as of a hit; wakes the body.
  void hit(std::size_t body, const glm::dvec3& impulse_ns, const glm::dvec3& at_m);
  // Other lines from now on, with contacts; wakes who is held by one. Throws Error where a line is unfit.
  void moor(std::vector<MooringLine> lines);
  std::span<const double> line_tensions_n() const;  // Contacts::tensions_n; none without contacts
  void move_line_end(std::size_t line, const glm::dvec3& to_m) { contacts_->move_end(line, to_m); }
  // So much water stands in it from now on; wakes the body. Nothing without an inside.
  void fill(std::size_t body, double water_m3);
  // Another motion from now on; wakes the body.
  void place(std::size_t body, const BodyMotion& motion);
  // Other gravity, wind and water from the next step on.
  void take(const HullMedia& media) { settings_.media = media; }
  std::uint64_t hash() const;

 private:
  struct Body {
    BodySpec spec;
    double length_m = 0.0, radius_m = 0.0, quickest_rad_s = 0.0;
    Matrix6 stiffness;     // what restores can be no stiffer than, of the body's axes
    double wets_m2 = 0.0;  // seen from below at rest: with that in the water the added mass is whole
    ProbeColumns columns;
    WaterPatch water;
    HullClip clip;  // of its mesh about the centre of mass
    PlaningBottom bottom;
    Vector6 pushed;
    Inside inside;
    Inside::Pool pool;
    double pool_kg = 0.0;
    bool has_own_mass() const { return pool_kg > 0.0 || !bottom.empty(); }  // `laden` counts, its added mass whole
    BodyMass laden;  // with the stations' added mass and the water in it, where there is any
    PlaningBottom::Before stations;
    Matrix6 strips;    // the stations' added mass in the last substep
    Matrix6 sideways;  // theirs of a drift, at rest
    Matrix6 added;     // all of the added mass by now
    ShedMass shed;     // what of that is left behind
    double shed_sideways_kg_m = 0.0;
    double quiet_s = 0.0;
    CalmWater slept_in;
  };
  void step_body(Body& body, BodyState& state, double end_s, double dt_s, const BodyWater& water) const;
  void load(Body& body, const BodyState& state) const;
  static void weigh(Body& body, const glm::dmat3& to_world, double share);
  void let_in(Body& body, BodyState& state, double dt_s) const;
  void substep(Body& body, BodyState& state, double dt_s) const;
  bool sleeps(Body& body, BodyState& state, double end_s, double dt_s, const BodyWater& water) const;
  void ask_water(Body& body, const BodyState& state, double end_s, double dt_s, const BodyWater& water) const;
  void touch(double dt_s);
  BodySettings settings_;
  std::optional<Contacts> contacts_;
  std::vector<Collider> colliders_;
  std::vector<ContactImpulses> impulses_;
  std::vector<BodyMotion> untouched_;
  std::vector<Body> bodies_;
  std::vector<BodyState> states_;
  std::int64_t step_ = 0;
  bool begun_ = false;
};

}  // namespace seascape
