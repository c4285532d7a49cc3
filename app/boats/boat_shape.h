// How a boat's parts stand in her model: rudder, engine, propeller, wheel, lever, boom, sails and oars. Pure.
#pragma once
#include <memory>
#include <vector>

#include "app/scene_objects.h"
#include "ocean/bodies/sea_bodies.h"

namespace seascape {

// The parts of a model are nodes of these names (content/models/README.md); what it does not have does not move.
class BoatShape {
 public:
  explicit BoatShape(std::shared_ptr<const SolidModel> model);
  bool moves() const { return !moved_.empty(); }
  // Where all nodes lie in the model's own axes. Takes no memory where `nodes` has been through it before.
  void place(const BoatParts& parts, const BoatControls& asked, double time_s, std::vector<glm::dmat4>& nodes) const;

 private:
  enum class Part { rudder, engine, propeller, helm, throttle, boom, mainsail, jib, oar_left, oar_right };
  struct Moved {
    Part part;
    glm::dvec3 axis;
  };
  glm::dmat4 turn(const Moved& moved, const BoatParts& parts, const BoatControls& asked, double time_s) const;
  std::shared_ptr<const SolidModel> model_;
  std::vector<Moved> moved_;
  std::vector<int> moves_;  // of each node: which of them, or -1
};

// Of all floating things of a scene.
class BoatShapes {
 public:
  explicit BoatShapes(const SceneObjects& objects);
  // Has the things that float where their bodies are at a time (s), their parts as they are driven, and their lines.
  void place(SceneObjects& objects, const SeaBodies& bodies, double time_s) const;

 private:
  std::vector<std::shared_ptr<const BoatShape>> shapes_;  // of each model; null: none of it floats, or nothing moves
};

}  // namespace seascape
