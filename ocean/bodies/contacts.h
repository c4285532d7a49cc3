// What bodies run into: each other, piers, the land, and the ends of their lines.
#pragma once
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ocean/bodies/contact_solver.h"
#include "ocean/bodies/hull.h"

namespace seascape {

// What stands still, by the convex hull of its mesh: a pier's deck and each of its piles are one each.
struct StillCollider {
  std::string name;
  HullMesh mesh;
  glm::dvec3 at_m{0.0};
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
};

// A mooring line: slack it takes nothing. With a weight it is a chain that hangs and lies on the ground as a catenary
// does (chain.h), `to_m` the anchor at its end.
struct MooringLine {
  std::size_t body = 0;
  glm::dvec3 from_m{0.0};  // in the hull's axes
  glm::dvec3 to_m{0.0};    // in the world, or in the axes of `other`'s hull
  double length_m = 10.0;
  double stiffness_n_m = 1e4, damping_ns_m = 1e3;
  std::optional<std::size_t> other;                          // the body at its other end; none: the world
  double weight_n_m = 0.0;                                   // in water, of a chain
  double holds_n = std::numeric_limits<double>::infinity();  // across the ground, before a chain's anchor drags
};

// Heights of the ground at places (x, z), m; very low where there is none.
using LandHeights = std::function<void(std::span<const glm::dvec2> places, std::span<double> heights_m)>;

struct ContactSettings {
  bool between_bodies = true;
  double restitution = 0.2, friction = 0.3;  // of hulls on hulls and piers
  double ground_friction = 0.5;              // on land nothing bounces
  std::vector<StillCollider> still;
  std::vector<MooringLine> lines;
  LandHeights land;  // may be asked from one thread only
  SolverSettings solver;
};

// Impulses of a body in one step, N s.
struct ContactImpulses {
  double hit_ns = 0.0, ground_ns = 0.0, lines_ns = 0.0;
};

struct Collider {  // a body, as contacts know it
  ContactBody body;
  bool asleep = false;
};

class Contacts {
 public:
  // Hulls about their centres of mass. Throws Error where a mesh, a pose or a line is unfit.
  Contacts(const ContactSettings& settings, std::span<const HullMesh> hulls,
           std::span<const glm::dvec3> mass_centres_m);
  ~Contacts();
  Contacts(Contacts&&) noexcept;
  Contacts& operator=(Contacts&&) noexcept;

  // Ends a step: no body has moved further than its velocity has it. What is asleep and is touched by what is not is
  // woken. Depends on nothing but what is given.
  void step(double dt_s, std::span<Collider> bodies, std::span<ContactImpulses> impulses);
  const std::vector<MooringLine>& lines() const;
  // N, of each line as the last step left it, mean over that step; 0 of lines that were set since.
  std::span<const double> tensions_n() const;
  // Throws Error where a line is unfit.
  void set_lines(std::vector<MooringLine> lines);
  // Another place in the world for a line's end.
  void move_end(std::size_t line, const glm::dvec3& to_m);

 private:
  struct World;
  std::unique_ptr<World> world_;
};

// Of a mesh's vertices those that reach furthest in some hundred directions: its convex hull, nearly.
std::vector<glm::dvec3> outermost(const HullMesh& mesh);

}  // namespace seascape
