#include "app/solids/inside_hulls.h"

#include "app/solids/solid_instances.h"

namespace seascape {

namespace {

// Nodes that are drawn, at any level of detail.
std::vector<bool> drawn_nodes(const SolidModel& model) {
  std::vector<bool> drawn(model.nodes.size(), false);
  for (const int root : model.drawn) drawn[std::size_t(root)] = true;
  for (const int index : model.order) {
    const SolidNode& node = model.nodes[std::size_t(index)];
    if (node.parent >= 0 && drawn[std::size_t(node.parent)]) drawn[std::size_t(index)] = true;
    if (drawn[std::size_t(index)])
      for (const int coarser : node.coarser) drawn[std::size_t(coarser)] = true;
  }
  return drawn;
}

}  // namespace

std::vector<std::shared_ptr<const Model>> hidden_meshes(const SolidModel& model, std::string_view name) {
  std::vector<std::shared_ptr<const Model>> hulls;
  const std::vector<bool> drawn = drawn_nodes(model);
  std::vector<glm::dmat4> placed;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const SolidNode& node = model.nodes[i];
    if (drawn[i] || node.mesh < 0 || !node.name.starts_with(name)) continue;
    if (placed.empty()) placed = placed_nodes(model);
    auto hull = std::make_shared<Model>();
    hull->name = node.name;
    hull->least = glm::vec3(1e30f), hull->most = glm::vec3(-1e30f);
    const bool mirrored = glm::determinant(glm::dmat3(placed[i])) < 0.0;
    for (const SolidPrimitive& primitive : model.meshes[std::size_t(node.mesh)].primitives) {
      MeshPart part;
      part.indices = primitive.indices;
      if (mirrored)
        for (std::size_t k = 0; k + 2 < part.indices.size(); k += 3) std::swap(part.indices[k], part.indices[k + 1]);
      for (const glm::vec3& at : primitive.positions) {
        part.positions.push_back(glm::vec3(placed[i] * glm::dvec4(at, 1.0)));
        hull->least = glm::min(hull->least, part.positions.back());
        hull->most = glm::max(hull->most, part.positions.back());
      }
      hull->parts.push_back(std::move(part));
    }
    hulls.push_back(std::move(hull));
  }
  return hulls;
}

ClipBody hull_body(const SolidThing& thing, int hull) {
  ClipBody body;
  body.hull = hull;
  body.scale = thing.scale;
  body.at_m = thing.pose.position_m;
  body.orientation = thing.pose.orientation;
  return body;
}

}  // namespace seascape
