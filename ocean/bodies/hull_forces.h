// What the water and the air do to a hull: the exact pressure on the wetted part of each triangle, and the drag of its
// skin and form.
#pragma once
#include <vector>

#include "ocean/bodies/hull.h"
#include "ocean/bodies/matrix6.h"
#include "ocean/bodies/water_patch.h"

namespace seascape {

struct BodyPose {
  glm::dvec3 centre_m{0.0};  // of mass, in the world
  glm::dmat3 to_world{1.0};  // columns: the body's axes
};

struct HullMedia {
  double gravity_mps2 = 9.81, density_kg_m3 = 1025.0, viscosity_m2_s = 1.1892e-6, air_kg_m3 = 1.2;
  glm::dvec3 wind_mps{0.0};
};

struct HullDrag {
  bool friction = true;  // ITTC-57
  double form = 0.8;     // of a face that goes ahead, per half rho v_n^2
  double suction = 0.2;  // of one that is left behind, no more than empties it
  double wind = 0.8;     // of the dry part, along the wind
};

// Drag is f - resists * v of the body's velocity v, so that an integrator may take it at the step's end, where it is
// stable however light the body. All in world axes about the centre of mass.
struct HullForces {
  Vector6 pressure;  // N, N m
  Matrix6 resists;   // symmetric, positive
  Vector6 carried;   // what `resists` gives for the water's and the air's velocity
  double wetted_m2 = 0.0, submerged_m3 = 0.0;
  glm::dvec3 submerged_centre_m{0.0};  // from the centre of mass; 0 where nothing is submerged
  double facing_down_m2 = 0.0;         // of the wetted part, seen from below
};

// ITTC's friction line of 1957, 0.075 / (log10 Re - 2)^2; its pole at Re 100 is never met: below 1,000 Blasius's
// laminar 1.328 / sqrt(Re), and no less than Re 1.
double friction_coefficient(double reynolds);

class HullClip {
 public:
  HullClip() = default;
  // `mesh` about the centre of mass, in the body's axes.
  explicit HullClip(HullMesh mesh);
  const HullMesh& mesh() const { return mesh_; }

  // The pose and the velocity are the world's.
  const HullForces& forces(const BodyPose& pose, const Vector6& velocity, const WaterPatch& water,
                           const HullMedia& media, const HullDrag& drag, double length_m);

 private:
  // All sums are of the body's own axes, where what a triangle is never changes.
  struct Face {
    glm::dvec3 normal{0.0}, middle{0.0}, turn{0.0};  // turn: middle x normal
    double size_m2 = 0.0;
  };
  struct Corner {
    glm::dvec3 at{0.0};       // from the centre of mass
    double depth = 0.0;       // below the surface, m
    double head = 0.0;        // pressure / (rho g), m
    glm::dvec3 carrier{0.0};  // the water's velocity at the surface there
  };
  struct Pressed {
    glm::dvec3 linear{0.0}, angular{0.0};  // over -rho g
    glm::dvec3 moment{0.0};                // of the submerged volume
    double wetted_m2 = 0.0, submerged_m3 = 0.0, facing_down_m2 = 0.0;
    double head_m3 = 0.0;  // pressure head over area
    void add(const Corner& a, const Corner& b, const Corner& c, const glm::dvec3& area, double size,
             const glm::dvec3& up);
  };
  void clip(const Face& face, const std::array<const Corner*, 3>& t, int wet_corners, const glm::dvec3& up);
  // The drag of many triangles: an even part of each and one along its normal n, at r from the centre of mass.
  struct DragSums {
    void add_even(const glm::dvec3& r, double part, const glm::dvec3& carrier);
    void add_normal(const Face& face, double part, const glm::dvec3& carrier);
    Matrix6 resists() const;
    double even_sum = 0.0;
    glm::dvec3 even_r{0.0};
    std::array<double, 6> even_rr{};  // xx, yy, zz, xy, yz, zx
    std::array<double, 21> along{};   // rows of the upper half
    Vector6 carried;
  };
  struct Flow {
    Vector6 velocity;
    glm::dvec3 wind_mps;
    const HullMedia* media;
    const HullDrag* drag;
    double length_m;
  };
  void resist(const Face& face, const Flow& flow, const glm::dvec3& carrier, double wet_part, double head_m3);

  HullMesh mesh_;
  std::vector<Face> faces_;
  std::vector<Corner> corners_;
  Pressed pressed_;
  DragSums drag_;
  HullForces out_;
};

}  // namespace seascape
