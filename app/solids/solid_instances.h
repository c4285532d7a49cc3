// Which solid things are seen from where, how finely, and where each of their meshes is drawn. Pure.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/solids/inside_hulls.h"
#include "app/solids/sun_view.h"
#include "engine/solid_model.h"
#include "engine/view.h"
#include "ocean/mesh/portal_sight.h"
#include "shaders/shared/solid_data.h"
#include "shaders/shared/solids_above.h"

namespace seascape {

// A model that stands somewhere: its axes in the world, metres from the scene's middle, y above the still sea.
struct SolidThing {
  std::size_t model = 0;
  Pose pose;
  double scale = 1.0;
  std::vector<glm::dmat4> nodes;  // where its nodes lie in the model's own axes; empty: as the model has them
};

// A mesh of a model, where it hangs on a node, and at which level of detail of which node it is drawn.
struct SolidPart {
  int mesh = 0, node = 0;
  int chosen_by = -1;     // a node with coarser ones; -1: it is drawn at any distance
  int level = 0;          // 0: the node itself
  bool mirrored = false;  // its transform turns front to back, where the file leaves it
};

// A model ready to be placed.
class PlacedModel {
 public:
  explicit PlacedModel(std::shared_ptr<const SolidModel> model);
  const SolidModel& model() const { return *model_; }
  const std::shared_ptr<const SolidModel>& shared_model() const { return model_; }
  const std::vector<SolidPart>& parts() const { return parts_; }
  // What holds no water, in its own axes (app/solids/inside_hulls.h).
  const std::vector<std::shared_ptr<const Model>>& insides() const { return insides_; }
  // The ball that holds all that is drawn, in its own axes.
  const glm::dvec3& middle() const { return middle_; }
  double radius() const { return radius_; }
  // Half the sides of the box around middle() that holds it.
  const glm::dvec3& half_sides() const { return half_sides_; }
  // Most parts that one thing shows at a time.
  std::size_t most_parts() const { return most_parts_; }
  // Where its nodes are at a time of its first animation, if it has one. The list is the room's or one of its own.
  const std::vector<glm::dmat4>& nodes_at(double time_s, MovedNodes& room) const;
  // The level that a node shows where the ball around its own mesh covers `share` of the picture's height; past its
  // last: nothing is drawn.
  int level(int node, double share) const;
  // Whether a node shows anything two-sided, such as a sail, at any of its levels.
  bool sheet(int node) const { return sheets_[std::size_t(node)]; }
  // The ball around a node's mesh, in that node's axes: xyz and radius.
  const glm::dvec4& ball(int node) const { return balls_[std::size_t(node)]; }
  // Half the sides of the box around the ball's middle that holds it, in those axes.
  const glm::dvec3& box(int node) const { return boxes_[std::size_t(node)]; }

 private:
  void bound();
  void count();
  std::shared_ptr<const SolidModel> model_;
  std::vector<SolidPart> parts_;
  std::vector<std::shared_ptr<const Model>> insides_;
  std::vector<glm::dmat4> still_;  // its nodes as the file has them
  std::vector<glm::dvec4> balls_;
  std::vector<glm::dvec3> boxes_;
  std::vector<bool> sheets_;
  std::size_t most_parts_ = 0;
  glm::dvec3 middle_{0.0}, half_sides_{0.0};
  double radius_ = 0.0;
};

// What is drawn of one part: one instanced draw a primitive of its mesh.
struct SolidDraw {
  std::size_t model = 0, part = 0;
  std::size_t first = 0, count = 0;  // of the instances
  double range_m = 0.0;              // of the farthest
  // Whether lines of sight that begin in air may end in it, and so many of its last instances in which those may that
  // begin in water (NearWaterSight).
  bool through_air = true;
  std::size_t through_water = 0;
};

// A part of a thing where it stands: the ball that holds it, on a still sea laid flat, and how far it reaches upwards
// and downwards from the ball's middle. And the radius of its thing's ball.
struct PartBounds {
  glm::dvec3 flat{0.0};
  double radius = 0.0, up_m = 0.0, thing_radius = 0.0;
};

// Which water is about eyes of which some may be in it and some in the air.
struct NearWaterSight {
  double highest_m = 1e9;                // it stands nowhere higher above the still sea, nor as deep in troughs
  bool from_above = true;                // its surface may be seen from above
  double sight_m = 1e9;                  // as far as an eye sees in it
  bool high_air = false;                 // air under water comes up to where it may stand, and is seen from the water
  bool deep_air = false;                 // under open air it is dry below where it may stand
  const PortalSight* portals = nullptr;  // through which alone it is seen; null: everywhere
  // Its surface may be seen from below: what stands above it is then seen about as from here.
  std::optional<glm::dvec3> middle_m;
  // Whether a line of sight that has passed no surface may end in a part: one that began in air, and one that began in
  // water.
  bool through_air(const PartBounds& part) const {
    return portals != nullptr || high_air || deep_air || part.flat.y + part.up_m > -highest_m;
  }
  bool through_water(const PartBounds& part, const glm::dvec3& viewer_m) const;
};

struct SolidSelection {
  std::vector<SolidDraw> draws;
  std::vector<gpu::SolidInstance> instances;  // relative to the viewer; far things first
  std::vector<std::size_t> far_first;         // the draws by their farthest thing

  // Kept from call to call.
  struct Seen {
    const SolidThing* thing;
    double range_m;
    glm::dmat4 world;
  };
  std::vector<Seen> seen;
  MovedNodes moved;
};

// For all eyes together, chosen by the viewer's head. `detail`: ModelSettings.
void select_solids(std::span<const PlacedModel> models, std::span<const SolidThing> things, const Viewpoint& viewpoint,
                   double time_s, double detail, SolidSelection& selection, const NearWaterSight& water = {});

// What of them may be seen under water, which stands nowhere higher than `highest_m` above the still sea. Returns what
// shaders are told of it, but for the picture's size.
gpu::SolidsThroughWater select_in_water(std::span<const PlacedModel> models, std::span<const SolidThing> things,
                                        const Viewpoint& viewpoint, double time_s, double detail, double highest_m,
                                        SolidSelection& selection);

// What stands above water that is nowhere deeper than `deepest_m` below the still sea and may be seen through its
// surface from below, in each of the pictures around `middle_m` (shaders/shared/solids_above.h). Returns how
// near to the middle something may be, in sight or not, m; 0: nothing is in sight.
double select_above(std::span<const PlacedModel> models, std::span<const SolidThing> things, const Viewpoint& viewpoint,
                    const glm::dvec3& middle_m, double time_s, double detail, double deepest_m,
                    SolidSelection& selection);

// What may throw a shadow into the sun's view, a level of detail coarser than the viewer sees it; but sheets at the one
// that is seen: both of their sides are in the map, and a coarser one would lie before the other here and there.
void select_casters(std::span<const PlacedModel> models, std::span<const SolidThing> things, const Viewpoint& viewpoint,
                    const SunView& sun, double time_s, double detail, SolidSelection& selection);

}  // namespace seascape
