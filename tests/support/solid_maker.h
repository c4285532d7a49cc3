// Small solid things for tests: shapes, models made of them, and things that stand somewhere.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "app/scene_objects.h"

namespace seascape::test {

// Triangles with normals, turned outwards.
struct SolidShape {
  std::vector<float> positions, normals, colours;  // three, three and four a corner; colours may be none
  std::vector<std::uint32_t> indices;
  void corner(const glm::vec3& at, const glm::vec3& normal);
};
SolidShape solid_box(const glm::vec3& half);
SolidShape solid_sphere(float radius, int rings = 48);
// Upright, its axis x = z = 0.
SolidShape solid_pile(float radius, float low, float high, int sides = 96);
// Level, its upper side seen.
SolidShape solid_plate(float half);

inline const char* const unlit_magenta =
    R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0,1,1]},"extensions":{"KHR_materials_unlit":{}}})";

// One mesh of one material (glTF's JSON). `nodes`: JSON of all nodes, of which the first is drawn; `extra`: further
// members of the root, each after a comma.
std::vector<std::uint8_t> solid_bytes(const SolidShape& shape, const std::string& material,
                                      const std::string& nodes = R"({"mesh":0})", const std::string& extra = "");
PlacedModel solid_model(const SolidShape& shape, const std::string& material,
                        const std::string& nodes = R"({"mesh":0})", const std::string& extra = "");

// Adds a model and one thing of it.
void stand(SceneObjects& objects, const PlacedModel& model, const Pose& pose, double scale = 1.0);

}  // namespace seascape::test
