#include "app/boats/line_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seascape {

namespace {

constexpr int sides = 6;
constexpr float model_radius = 0.02f;    // slim, so that the balls around pieces are no larger than these
constexpr double chain_thickness = 3.0;  // of its links' outer width over their wire, or nearly
constexpr double under_water_m = -0.5;   // a line to the ground below is a chain
constexpr std::size_t most_by_hand = 16, most_anchors = 8, most_of_scene = 32;

// A piece of length 1 along +y.
PlacedModel piece(const char* name, const glm::vec3& colour, float metallic, float roughness) {
  SolidModel model;
  model.name = name;
  SolidPrimitive tube;
  for (const float along : {0.0f, 1.0f})
    for (int side = 0; side < sides; ++side) {
      const float about = 2.0f * float(std::numbers::pi) * float(side) / float(sides);
      const glm::vec3 out(std::cos(about), 0.0f, std::sin(about));
      tube.positions.push_back(model_radius * out + glm::vec3(0.0f, along, 0.0f));
      tube.normals.push_back(out);
    }
  for (std::uint32_t side = 0; side < sides; ++side) {
    const std::uint32_t next = (side + 1) % sides;
    for (const std::uint32_t corner : {side, side + sides, next + sides, side, next + sides, next})
      tube.indices.push_back(corner);
  }
  SolidMaterial material;
  material.name = name;
  material.base_colour = glm::vec4(colour, 1.0f);
  material.metallic = metallic;
  material.roughness = roughness;
  tube.material = 0;
  model.materials.push_back(std::move(material));
  model.meshes.push_back({name, {std::move(tube)}});
  SolidNode node;
  node.name = name;
  node.mesh = 0;
  model.nodes.push_back(std::move(node));
  model.order = model.drawn = {0};
  return PlacedModel(std::make_shared<const SolidModel>(std::move(model)));
}

void stretch(SolidThing& thing, const glm::dvec3& from, const glm::dvec3& to, double radius_m) {
  const glm::dvec3 way = to - from;
  const double length = std::max(glm::length(way), 1e-6);
  const glm::dvec3 along = way / length;
  thing.pose.position_m = from;
  // From +y to it the shortest way (1 + cos, sin); straight down any way round is.
  thing.pose.orientation = along.y > -0.999999 ? glm::normalize(glm::dquat(1.0 + along.y, along.z, 0.0, -along.x))
                                               : glm::dquat(0.0, 1.0, 0.0, 0.0);
  thing.scale = length;
  const double thick = radius_m / (length * double(model_radius));
  thing.nodes[0] = glm::dmat4(1.0);
  thing.nodes[0][0].x = thing.nodes[0][2].z = thick;
}

}  // namespace

bool add_line_things(SceneObjects& objects, const SeaBodies& bodies) {
  if (objects.lines) return false;
  std::size_t boats = 0, of_scene = 0;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    if (bodies.moorings().fittings(n).size() > 1) ++boats;
    of_scene += objects.floating[n].floats.moored_m.size();
  }
  const std::size_t lines =
      std::min(2 * boats, most_by_hand) + std::min(boats, most_anchors) + std::min(of_scene, most_of_scene);
  if (lines == 0) return false;
  SceneObjects::Lines room;
  room.first = room.drawn = objects.things.size();
  room.rope = objects.models.size();
  room.chain = room.rope + 1;
  objects.models.push_back(piece("rope", {0.52f, 0.42f, 0.27f}, 0.0f, 0.95f));
  objects.models.push_back(piece("chain", {0.26f, 0.26f, 0.25f}, 0.6f, 0.6f));
  SolidThing thing;
  thing.model = room.rope;
  thing.nodes.assign(1, glm::dmat4(1.0));
  objects.things.resize(room.first + lines * pieces_a_line, thing);
  objects.names.resize(objects.things.size(), "line");
  objects.lines = room;
  return true;
}

void place_lines(SceneObjects& objects, const SeaBodies& bodies, double time_s) {
  if (!objects.lines) return;
  SceneObjects::Lines& room = *objects.lines;
  room.drawn = room.first;
  const std::size_t count =
      std::min(bodies.moorings().lines().size(), (objects.things.size() - room.first) / pieces_a_line);
  std::array<glm::dvec3, pieces_a_line + 1> places;
  for (std::size_t n = 0; n < count; ++n) {
    const SeaBodies::HungLine line = bodies.line_at(n, time_s);
    if (line.chain)
      hang_chain(*line.chain, line.to_m, line.from_m, places);
    else
      hang_line(line.from_m, line.to_m, line.length_m, places);
    const bool metal = line.chain || line.to_m.y < under_water_m;
    const double radius_m = 0.5 * line.diameter_m * (metal ? chain_thickness : 1.0);
    for (std::size_t i = 0; i < pieces_a_line; ++i) {
      SolidThing& thing = objects.things[room.drawn++];
      thing.model = metal ? room.chain : room.rope;
      stretch(thing, places[i], places[i + 1], radius_m);
    }
  }
}

}  // namespace seascape
