// The impulses of bodies that touch, and of lines that hold them: each takes what momentum another gives, and no
// energy comes of it.
#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "ocean/bodies/rigid_body.h"

namespace seascape {

// A place where a body touches another, or what stands still where `b` is none.
struct Touch {
  std::size_t a = 0;
  std::optional<std::size_t> b;
  glm::dvec3 at_m{0.0};    // in the world
  glm::dvec3 normal{0.0};  // of length 1, towards a
  double gap_m = 0.0;      // below 0 where they overlap
  double restitution = 0.0, friction = 0.0;
  double impulse_ns = 0.0;  // along the normal: what the solver gives back
};

// A line that is stretched: it pulls a body towards a place, or two bodies towards each other, and never pushes.
struct Pull {
  std::size_t body = 0;
  glm::dvec3 at_m{0.0}, towards{0.0};  // where it holds the body; of length 1
  double stretch_m = 0.0, stiffness_n_m = 0.0, damping_ns_m = 0.0;
  std::optional<std::size_t> other;  // pulled the opposite way, where it is held; none: the world
  glm::dvec3 other_at_m{0.0};        // on the line of `towards`, so that no moment comes of the pair
  double most_n = std::numeric_limits<double>::infinity();  // it gives way beyond
  std::size_t line = 0;                                     // whose pull it is, for who asked
  double impulse_ns = 0.0;                                  // what the solver gives back
};

struct ContactBody {
  BodyMotion* motion = nullptr;
  const BodyMass* mass = nullptr;
  double share = 0.0;  // of the added mass
};

struct SolverSettings {
  int sweeps = 100;            // over all places, at most: they end where nothing changes
  double bounce_mps = 0.3;     // below this nothing bounces, so that what lies still stays
  double overlap_m = 0.003;    // stays, so that what lies on another keeps touching it
  double parts_a_step = 0.25;  // of the rest of an overlap
};

class ContactSolver {
 public:
  // Changes the velocities by impulses (sequential impulses, Catto 2005: Gauss and Seidel's sweeps over all places with
  // Coulomb's friction, in the 6 x 6 masses with what they take of the water), and takes bodies that overlap apart.
  // Places are taken in the order that they come in. Where bouncing off several places at once would give energy
  // nothing bounces, and where friction would there is none.
  void solve(const SolverSettings& settings, double dt_s, std::span<const ContactBody> bodies, std::span<Touch> touches,
             std::span<Pull> pulls);

 private:
  struct Row {                       // of one direction at one place
    Vector6 a, b, takes_a, takes_b;  // how it acts on velocities, and what a unit of impulse changes of them
    double mobility = 0.0;           // m/s a unit of impulse
  };
  struct TouchRows {
    Row normal;
    std::array<Row, 2> along;
    std::array<double, 2> rubs{};
    double wanted_mps = 0.0;
  };
  struct PullRow {
    Row row;
    double softness = 0.0, wanted_mps = 0.0, most_ns = 0.0;
  };
  struct Moving {
    std::size_t body;
    Cholesky6 inverse;
    Matrix6 mass;
    Vector6 velocity, before;
    glm::dvec3 shift{0.0};
    double per_kg = 0.0;
  };
  std::size_t slot(std::span<const ContactBody> bodies, std::size_t body);
  Row row(std::size_t a, const glm::dvec3& at_a, std::optional<std::size_t> b, const glm::dvec3& at_b,
          const glm::dvec3& direction, std::span<const ContactBody> bodies) const;
  double parting(const Row& row, std::size_t a, std::optional<std::size_t> b) const;
  void apply(const Row& row, std::size_t a, std::optional<std::size_t> b, double impulse);
  void push(Touch& touch, TouchRows& rows, double bounce, bool rubs);
  void sweep(std::span<Touch> touches, std::span<Pull> pulls, double bounce, bool rubs, bool backwards);
  bool run(const SolverSettings& settings, std::span<Touch> touches, std::span<Pull> pulls, double bounce, bool rubs);
  void part(const SolverSettings& settings, std::span<const Touch> touches);

  std::vector<std::size_t> slots_;  // of bodies, into moving_; none where nothing touches
  std::vector<Moving> moving_;
  std::vector<TouchRows> rows_;
  std::vector<PullRow> pull_rows_;
  double changed_mps_ = 0.0;  // by the last sweep at most
};

}  // namespace seascape
