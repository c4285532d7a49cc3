#include "tests/support/solid_maker.h"

#include <cmath>

#include "tests/support/gltf_maker.h"

namespace seascape::test {

void SolidShape::corner(const glm::vec3& at, const glm::vec3& normal) {
  positions.insert(positions.end(), {at.x, at.y, at.z});
  normals.insert(normals.end(), {normal.x, normal.y, normal.z});
}

namespace {

void quad(SolidShape& shape) {
  const auto first = std::uint32_t(shape.positions.size() / 3 - 4);
  for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) shape.indices.push_back(first + corner);
}

}  // namespace

SolidShape solid_box(const glm::vec3& half) {
  SolidShape shape;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 normal(0.0f), u(0.0f), v(0.0f);
      normal[axis] = side;
      u[(axis + 1) % 3] = 1.0f;
      v[(axis + 2) % 3] = side;  // u x v is the normal
      for (const auto& [a, b] : {std::pair(-1.0f, -1.0f), {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}})
        shape.corner(half * (normal + a * u + b * v), normal);
      quad(shape);
    }
  return shape;
}

SolidShape solid_sphere(float radius, int rings) {
  SolidShape shape;
  const float step = 3.14159265f / float(rings);
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < 2 * rings; ++side) {
      for (const auto& [r, s] : {std::pair(ring, side), {ring, side + 1}, {ring + 1, side + 1}, {ring + 1, side}}) {
        const float down = step * float(r), about = step * float(s);
        const glm::vec3 n(std::sin(down) * std::cos(about), std::cos(down), std::sin(down) * std::sin(about));
        shape.corner(radius * n, n);
      }
      quad(shape);
    }
  return shape;
}

SolidShape solid_pile(float radius, float low, float high, int sides) {
  SolidShape shape;
  for (int side = 0; side < sides; ++side) {
    for (const auto& [s, y] : {std::pair(side, high), {side + 1, high}, {side + 1, low}, {side, low}}) {
      const float about = 6.2831853f * float(s) / float(sides);
      const glm::vec3 n(std::cos(about), 0.0f, std::sin(about));
      shape.corner(radius * n + glm::vec3(0.0f, y, 0.0f), n);
    }
    quad(shape);
  }
  return shape;
}

SolidShape solid_plate(float half) {
  SolidShape shape;
  for (const auto& [x, z] : {std::pair(-half, half), {half, half}, {half, -half}, {-half, -half}})
    shape.corner({x, 0.0f, z}, {0.0f, 1.0f, 0.0f});
  quad(shape);
  return shape;
}

std::vector<std::uint8_t> solid_bytes(const SolidShape& shape, const std::string& material, const std::string& nodes,
                                      const std::string& extra) {
  GltfMaker maker;
  std::string attributes = R"("POSITION":)" + std::to_string(maker.floats("VEC3", shape.positions)) + R"(,"NORMAL":)" +
                           std::to_string(maker.floats("VEC3", shape.normals));
  if (!shape.colours.empty()) attributes += R"(,"COLOR_0":)" + std::to_string(maker.floats("VEC4", shape.colours));
  maker.primitives = R"({"attributes":{)" + attributes + R"(},"indices":)" +
                     std::to_string(maker.indices(5125, shape.indices)) + R"(,"material":0})";
  maker.nodes = nodes;
  maker.extra = R"(,"materials":[)" + material + "]" + extra;
  return maker.glb();
}

PlacedModel solid_model(const SolidShape& shape, const std::string& material, const std::string& nodes,
                        const std::string& extra) {
  return PlacedModel(std::make_shared<const SolidModel>(
      load_solid_model_from_memory(solid_bytes(shape, material, nodes, extra), "test.glb")));
}

void stand(SceneObjects& objects, const PlacedModel& model, const Pose& pose, double scale) {
  objects.things.push_back({objects.models.size(), pose, scale});
  objects.models.push_back(model);
  objects.names.push_back("thing " + std::to_string(objects.things.size()));
}

}  // namespace seascape::test
