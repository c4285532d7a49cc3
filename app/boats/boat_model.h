// What a model's file says of how it floats and is driven: hull, mass, engine, rudder, sails, oars, seats. Pure.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/solid_model.h"
#include "engine/view.h"
#include "ocean/bodies/boat.h"
#include "ocean/bodies/moorings.h"

namespace seascape {

enum class SeatRole { helm, rower, passenger };

struct BoatSeat {
  SeatRole role = SeatRole::passenger;
  glm::dvec3 at_m{0.0};  // where one sits
  double yaw_deg = 0.0;  // where one looks, clockwise from ahead
};

// In the model's own axes and size.
struct BoatModel {
  HullMesh hull;
  bool is_boat = false;           // made to go ahead; else it goes any way alike
  std::optional<double> mass_kg;  // none: a scene has to say it
  std::optional<glm::dvec3> mass_centre_m;
  std::optional<glm::dmat3> inertia_kg_m2;  // about the centre
  BoatSpec boat;
  std::vector<BoatSeat> seats;
  std::optional<glm::dvec3> moored_at_m;  // where a line or a chain is made fast; none: at bow and stern
  std::optional<glm::dvec3> ring_m;       // of a buoy: where others make fast
};

// Reads the extras of content/models/README.md from the node of the scene's roots that has them, and the hull: the mesh
// of a node outside of the scene called collision, or all that is drawn where that is closed. Throws Error, of which
// `where` is the place, for extras that do not fit and for a model that encloses nothing.
BoatModel boat_model(const SolidModel& model, const std::string& where);

// How a scene has one of them float.
struct FloatSpec {
  BodyLevel level = BodyLevel::hull;
  std::optional<double> mass_kg;
  glm::dvec2 velocity_mps{0.0};      // x, z
  std::vector<glm::dvec2> moored_m;  // x, z of where lines or chains are made fast
  BoatControls controls;
  std::vector<glm::dvec2> course_m;  // x, z of places that she is steered round by; none: her helm stays
  bool fills = false;                // water that comes over the gunwale of an open boat stays in her
  double bail_kg_s = 0.0;            // of it
  bool towed = false;                // held to its course and velocity, free to heave, pitch and roll
};

// The body of a model that is `scale` times as large, at rest at the world's middle. Inertia that the file does not say
// is that of even density. Throws Error, of which `where` is the place, where nobody says a mass.
BodySpec body_spec(const BoatModel& model, const FloatSpec& floats, double scale, const std::string& where);
// Where lines are made fast to one that is so many times as large: a boat's bow and then her stern, a buoy's ring.
BodyFittings fittings_of(const BoatModel& model, double scale);
// Cleats and the ring of a model that stands still, in its own axes. Throws Error, of which `where` is the place, for
// extras that do not fit.
std::vector<glm::dvec3> mooring_points_of(const SolidModel& model, const std::string& where);
// Where a line from that place of the sea is made fast to a thing that lies so, in its own axes.
glm::dvec3 made_fast_at(const BoatModel& model, double scale, const Pose& pose, const glm::dvec2& to_m);
// Her parts that many times as large; what they can give goes with the boat's weight.
BoatSpec scaled(const BoatSpec& boat, double scale);

}  // namespace seascape
