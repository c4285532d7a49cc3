// The volumes of a scene in which there is no water, or in which there is although flat inputs take it away: exact,
// however many and wherever.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/inputs/bounds_tree.h"
#include "ocean/inputs/hull_map.h"
#include "ocean/inputs/input_spec.h"
#include "shaders/shared/clip_volume.h"

namespace seascape {

// Each is told from its signed distance, or a hull's from its map, at the point itself: nothing of them lies in
// windows, so their edges are as sharp at any distance, and nothing is filled or moved with the viewer. A point walks a
// tree of boxes, of which it meets one node where no volume is near. Immutable; any number of threads may ask.
class ClipVolumes {
 public:
  // Takes those of `specs` that are volumes, sorted by their order. Throws Error as validate() does, and for more than
  // most_input_hulls different models.
  explicit ClipVolumes(std::span<const InputSpec> specs);

  std::size_t size() const { return volumes_.size(); }
  // Whether there is no water at a point (x, height above the still sea's y = 0, z, m), where flat inputs say `flat`:
  // of the volumes that hold it the last decides. No number: `flat`.
  bool clipped(glm::dvec3 at_m, bool flat) const;
  // How far outside a volume a point is, m, below 0 within; of a hull no more than the sign is exact.
  double distance_m(std::size_t volume, glm::dvec3 at_m) const;
  // Whether no water stands in all of a rectangle (x and z, m) however it stands between -height_m and height_m, where
  // flat inputs say `flat` of all of it. Never says so of where there is some.
  bool clipped(glm::dvec2 least_m, glm::dvec2 most_m, double height_m, bool flat) const;

  // What the shaders read (shaders/lib/water_clip.glsl).
  const std::vector<gpu::ClipVolume>& volumes() const { return volumes_; }
  const std::vector<gpu::ClipNode>& nodes() const { return nodes_; }
  const std::vector<HullMap>& hulls() const { return hulls_; }

 private:
  struct Box {
    glm::dvec3 least, most;
  };
  void add(const InputSpec& spec, std::vector<const Model*>& models);
  void add_nodes(std::span<std::uint32_t> numbers);
  template <class Visit>
  void walk(glm::dvec2 least_m, glm::dvec2 most_m, const Visit& visit) const;

  std::vector<gpu::ClipVolume> volumes_;  // in their order
  std::vector<Box> boxes_;                // of each
  std::vector<gpu::ClipNode> nodes_;
  std::vector<HullMap> hulls_;
};

}  // namespace seascape
