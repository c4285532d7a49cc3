// The volumes of a scene in which there is no water, or in which there is although flat inputs take it away, and the
// bodies of actors beside them: exact, however many and wherever.
#pragma once
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "ocean/inputs/bounds_tree.h"
#include "ocean/inputs/clip_body.h"
#include "ocean/inputs/hull_map.h"
#include "ocean/inputs/input_spec.h"
#include "shaders/shared/clip_volume.h"

namespace seascape {

struct ClipSolid;  // clip_volumes.cpp

// Each is told from its signed distance, or a hull's from its map, at the point itself: nothing of them lies in
// windows, so their edges are as sharp at any distance, and nothing is filled or moved with the viewer. A point walks a
// tree of boxes, of which it meets one node where no volume is near; bodies have a tree of their own after it.
// Immutable but for place(); any number of threads may ask. Copies share the hulls' maps.
class ClipVolumes {
 public:
  // Takes those of `specs` that are volumes, sorted by their order, then the room's still bodies, and has room for
  // others. Throws Error as validate() does, for more than most_input_hulls different models, for more than
  // most_clip_bodies and for a still body that it does not take.
  explicit ClipVolumes(std::span<const InputSpec> specs, const ClipRoom& room = {});

  // How many bodies there may be at once.
  int most_bodies() const { return most_bodies_; }
  // Whether it has the body's hull, and all its numbers are within the ranges of inputs.
  bool takes(const ClipBody& body) const;
  // Has these bodies in place of those it had, as they are (velocity and spin are not read): most_bodies() of them at
  // most, each of which it takes. They decide after the volumes. Allocates in its first call only. Not while anybody
  // asks.
  void place(std::span<const ClipBody> bodies);
  std::span<const ClipBody> bodies() const { return bodies_; }

  // Whether there are hulls of bodies, or may be.
  bool may_have_floors() const { return !hulls_->of_bodies.empty(); }

  std::size_t size() const { return volumes_.size(); }  // with the bodies
  // Whether there is no water at a point (x, height above the still sea's y = 0, z, m), where flat inputs say `flat`:
  // of the volumes that hold it the last decides. No number: `flat`.
  bool clipped(glm::dvec3 at_m, bool flat) const;
  // The same without hulls of bodies, which have a floor of their own: whether the bed lies dry there.
  bool dry(glm::dvec3 at_m, bool flat) const;
  // How far outside a volume a point is, m, below 0 within; of a hull no more than the sign is exact.
  double distance_m(std::size_t volume, glm::dvec3 at_m) const;
  // Whether no water stands in all of a rectangle (x and z, m) however it stands between -height_m and height_m, where
  // flat inputs say `flat` of all of it. Never says so of where there is some.
  bool clipped(glm::dvec2 least_m, glm::dvec2 most_m, double height_m, bool flat) const;

  // What the shaders read (shaders/lib/water_clip.glsl); what place() leaves alone comes first.
  const std::vector<gpu::ClipVolume>& volumes() const { return volumes_; }
  const std::vector<gpu::ClipNode>& nodes() const { return nodes_; }
  std::size_t fixed_volumes() const { return fixed_volumes_; }
  std::size_t fixed_nodes() const { return fixed_nodes_; }
  const std::vector<HullMap>& hulls() const { return hulls_->maps; }

 private:
  struct Box {
    glm::dvec3 least, most;
  };
  struct Hulls {
    std::vector<HullMap> maps;
    std::vector<int> of_bodies;  // the map of each of ClipRoom::hulls
  };
  ClipSolid solid(const ShapeInput& shape, int map) const;
  ClipSolid solid(const ClipBody& body) const;
  void add(const ClipBody& body);
  void add(const ClipSolid& solid, bool takes_away, bool has_floor);
  void add_tree(std::size_t first);
  void add_nodes(std::span<std::uint32_t> numbers);
  bool decided(const glm::dvec3& at_m, bool flat, bool with_floors) const;
  template <class Visit>
  void walk(glm::dvec2 least_m, glm::dvec2 most_m, const Visit& visit) const;

  std::vector<gpu::ClipVolume> volumes_;  // in their order
  std::vector<Box> boxes_;                // of each
  void count_nodes() {
    if (!nodes_.empty()) nodes_.front().more.z = int(nodes_.size());
  }
  std::vector<gpu::ClipNode> nodes_;
  std::vector<std::uint32_t> numbers_;  // of volumes, while a tree is made of them
  std::shared_ptr<const Hulls> hulls_;
  int most_bodies_ = 0;
  std::size_t fixed_volumes_ = 0, fixed_nodes_ = 0;
  std::vector<ClipBody> bodies_;
};

}  // namespace seascape
