// The shapes that a scene file gives the water: pockets of air, and portals through which alone water is seen.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/faults.h"
#include "app/located_json.h"
#include "app/scene_objects.h"
#include "engine/view.h"

namespace seascape {

struct PlacedShape {
  int form = 0;                    // gpu::shape_box and those that follow it
  int mode = 0;                    // of a portal: gpu::portal_front and those that follow it
  glm::dvec3 half_m{1.0};          // half its sides, or its radius, along its own axes
  std::vector<glm::dvec4> planes;  // of a mesh: normals outwards, and how far off (m)
  double radius_m = 1.0;           // of a ball around its middle that holds it
  Pose pose;                       // of its axes in the world, or in those of a thing
  std::optional<std::size_t> on;   // of SceneObjects::things
  // Of a pocket: where water stands in it, m over its middle; with open_below as Boyle has it.
  std::optional<double> level_m;
  bool open_below = false;
};

struct SceneShapes {
  std::vector<PlacedShape> air, portals;
  bool empty() const { return air.empty() && portals.empty(); }
};

// Reads the list of a scene's key "air" or "portals" into `shapes`; both need the effect `portals`. Meshes are .glb
// files beside the scene, closed and convex. Faults name file and line, key, value, range and remedy.
void read_air(const LocatedJson& list, const std::vector<std::string>& effects, const SceneObjects& objects,
              const std::string& where, Faults& faults, SceneShapes& shapes);
void read_portals(const LocatedJson& list, const std::vector<std::string>& effects, const SceneObjects& objects,
                  const std::string& where, Faults& faults, SceneShapes& shapes);

}  // namespace seascape
