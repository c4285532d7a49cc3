// Which solid things are seen from where, how finely, and where each of their meshes is drawn. Pure.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "engine/solid_model.h"
#include "engine/view.h"
#include "shaders/shared/solid_data.h"

namespace seascape {

// A model that stands somewhere: its axes in the world, metres from the scene's middle, y above the still sea.
struct SolidThing {
  std::size_t model = 0;
  Pose pose;
  double scale = 1.0;
};

// A mesh of a model, where it hangs on a node, and at which level of detail of which node it is drawn.
struct SolidPart {
  int mesh = 0, node = 0;
  int chosen_by = -1;  // a node with coarser ones; -1: it is drawn at any distance
  int level = 0;       // 0: the node itself
};

// A model ready to be placed.
class PlacedModel {
 public:
  explicit PlacedModel(std::shared_ptr<const SolidModel> model);
  const SolidModel& model() const { return *model_; }
  const std::vector<SolidPart>& parts() const { return parts_; }
  // The ball that holds all that is drawn, in its own axes.
  const glm::dvec3& middle() const { return middle_; }
  double radius() const { return radius_; }
  // Where its nodes are at a time of its first animation, if it has one.
  std::vector<glm::dmat4> nodes_at(double time_s) const;
  // The level that a node shows where the model's ball covers `share` of the picture's height; past its last: nothing
  // is drawn.
  int level(int node, double share) const;

 private:
  void bound();
  std::shared_ptr<const SolidModel> model_;
  std::vector<SolidPart> parts_;
  glm::dvec3 middle_{0.0};
  double radius_ = 0.0;
};

// What is drawn of one part: one instanced draw a primitive of its mesh.
struct SolidDraw {
  std::size_t model = 0, part = 0;
  std::size_t first = 0, count = 0;  // of the instances
};

struct SolidSelection {
  std::vector<SolidDraw> draws;
  std::vector<gpu::SolidInstance> instances;  // relative to the viewer
};

// For all eyes together. `pixels`: of a picture's height.
void select_solids(std::span<const PlacedModel> models, std::span<const SolidThing> things, const Viewpoint& viewpoint,
                   double time_s, SolidSelection& selection);

}  // namespace seascape
