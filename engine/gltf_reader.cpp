#include "engine/gltf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/text.h"
#include "engine/tinygltf_library.h"

namespace seascape {

namespace {

constexpr std::size_t most_primitives = 65536;
constexpr std::size_t most_levels = 8;

int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

}  // namespace

void GltfReader::fail(const std::string& what) const { throw Error(where_, what, "export the model again"); }

std::vector<int> GltfReader::roots() const {
  if (!document_.scenes.empty()) {
    const int scene = document_.defaultScene < 0 ? 0 : document_.defaultScene;
    if (static_cast<std::size_t>(scene) >= document_.scenes.size()) fail(fmt::format("scene {} does not exist", scene));
    return document_.scenes[static_cast<std::size_t>(scene)].nodes;
  }
  std::vector<bool> child(document_.nodes.size(), false);
  for (const tinygltf::Node& node : document_.nodes)
    for (const int index : node.children)
      if (index >= 0 && static_cast<std::size_t>(index) < child.size()) child[static_cast<std::size_t>(index)] = true;
  std::vector<int> found;
  for (std::size_t i = 0; i < child.size(); ++i)
    if (!child[i]) found.push_back(static_cast<int>(i));
  return found;
}

// glTF 2.0, section 3.5.3: a matrix by columns, or translation * rotation * scale.
SolidNode GltfReader::node(int index) const {
  const tinygltf::Node& source = document_.nodes[static_cast<std::size_t>(index)];
  const auto finite = [&](const std::vector<double>& values, std::size_t size, const char* name) {
    if (!values.empty() && values.size() != size)
      fail(fmt::format("node {} has a {} of {} numbers", index, name, values.size()));
    for (const double value : values)
      if (!std::isfinite(value) || std::abs(value) > 1e15)
        fail(fmt::format("node {} has a {} out of range", index, name));
    return !values.empty();
  };
  SolidNode node;
  node.name = source.name;
  node.mesh = source.mesh;
  node.extras = source.extras_json_string;
  if (node.mesh >= 0 && static_cast<std::size_t>(node.mesh) >= document_.meshes.size())
    fail(fmt::format("mesh {} does not exist", node.mesh));
  if (finite(source.matrix, 16, "matrix")) {
    node.matrix.emplace();
    for (int i = 0; i < 16; ++i) (*node.matrix)[i / 4][i % 4] = source.matrix[static_cast<std::size_t>(i)];
    return node;
  }
  if (finite(source.translation, 3, "translation"))
    node.translation = {source.translation[0], source.translation[1], source.translation[2]};
  if (finite(source.rotation, 4, "rotation")) {
    const glm::dquat turn(source.rotation[3], source.rotation[0], source.rotation[1], source.rotation[2]);
    const double length = glm::length(turn);
    if (!(length > 1e-6 && length < 1e6)) fail(fmt::format("node {} has a rotation without direction", index));
    node.rotation = turn / length;
  }
  if (finite(source.scale, 3, "scale")) node.scale = {source.scale[0], source.scale[1], source.scale[2]};
  return node;
}

void GltfReader::read_levels(const tinygltf::Node& source, SolidNode& node, std::size_t index) const {
  const auto levels = source.extensions.find("MSFT_lod");
  if (levels == source.extensions.end() || !levels->second.IsObject() || !levels->second.Get("ids").IsArray()) return;
  const tinygltf::Value& ids = levels->second.Get("ids");
  if (ids.ArrayLen() > most_levels)
    fail(fmt::format("node {} has {} levels of detail; at most {} are read", index, ids.ArrayLen(), most_levels));
  for (std::size_t i = 0; i < ids.ArrayLen(); ++i)
    node.coarser.push_back(ids.Get(i).IsInt() ? ids.Get(i).GetNumberAsInt() : -1);
  if (!source.extras.IsObject() || !source.extras.Get("MSFT_screencoverage").IsArray()) return;
  const tinygltf::Value& shares = source.extras.Get("MSFT_screencoverage");
  for (std::size_t i = 0; i < std::min(shares.ArrayLen(), most_levels + 1); ++i)
    node.coverage.push_back(shares.Get(i).IsNumber() ? static_cast<float>(shares.Get(i).GetNumberAsDouble()) : 0.0f);
}

std::vector<SolidNode> GltfReader::nodes(std::vector<int>& order) const {
  const std::size_t count = document_.nodes.size();
  std::vector<SolidNode> made(count);
  std::vector<bool> seen(count, false);
  struct Step {
    int node, parent;
  };
  // Without recursion: a chain of nodes may be long. The scene first, so that what is wrong with it is told of it.
  std::vector<Step> steps;
  const auto add = [&](const std::vector<int>& nodes, int parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) steps.push_back({*node, parent});
  };
  const auto visit = [&] {
    while (!steps.empty()) {
      const Step step = steps.back();
      steps.pop_back();
      if (step.node < 0 || static_cast<std::size_t>(step.node) >= count)
        fail(fmt::format("node {} does not exist", step.node));
      const std::size_t index = static_cast<std::size_t>(step.node);
      if (seen[index]) fail(fmt::format("node {} is met twice: a cycle, or two parents", index));
      seen[index] = true;
      made[index] = node(step.node);
      order.push_back(step.node);
      made[index].parent = step.parent;
      const tinygltf::Node& source = document_.nodes[index];
      add(source.children, step.node);
      read_levels(source, made[index], index);
      add(made[index].coarser, step.parent);
    }
  };
  add(roots(), -1);
  visit();
  // What no scene shows: roots first.
  std::vector<bool> child(count, false);
  for (const tinygltf::Node& source : document_.nodes)
    for (const int index : source.children)
      if (index >= 0 && static_cast<std::size_t>(index) < count) child[static_cast<std::size_t>(index)] = true;
  for (const bool roots_only : {true, false})
    for (std::size_t i = 0; i < count; ++i)
      if (!seen[i] && !(roots_only && child[i])) {
        steps.push_back({static_cast<int>(i), -1});
        visit();
      }
  return made;
}

SolidMesh GltfReader::mesh(int mesh, bool look) {
  if (mesh < 0 || static_cast<std::size_t>(mesh) >= document_.meshes.size())
    fail(fmt::format("mesh {} does not exist", mesh));
  const tinygltf::Mesh& source = document_.meshes[static_cast<std::size_t>(mesh)];
  if (source.primitives.size() > most_primitives) fail(fmt::format("has more than {} primitives", most_primitives));
  SolidMesh made;
  made.name = source.name;
  for (const tinygltf::Primitive& one : source.primitives) made.primitives.push_back(primitive(one, mesh, look));
  return made;
}

void GltfReader::count_vertices(std::size_t more) {
  vertices_ += more;
  if (vertices_ > most_model_vertices) fail(fmt::format("has over {} M vertices", most_model_vertices >> 20));
}

// Corner numbers, three a triangle (glTF 2.0, section 3.7.2.1 for strips and fans).
std::vector<std::uint32_t> GltfReader::triangles(const tinygltf::Primitive& primitive, std::size_t vertices,
                                                 int mesh) const {
  const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
  if (mode < TINYGLTF_MODE_TRIANGLES || mode > TINYGLTF_MODE_TRIANGLE_FAN)
    fail(fmt::format("mesh {} has points or lines (mode {}); only triangles are read", mesh, mode));
  std::vector<std::uint32_t> corners;
  if (primitive.indices >= 0) {
    corners = accessors_.indices(primitive.indices);
  } else {
    corners.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) corners[i] = static_cast<std::uint32_t>(i);
  }
  for (const std::uint32_t corner : corners)
    if (corner >= vertices) fail(fmt::format("mesh {} has index {}, past its {} vertices", mesh, corner, vertices));
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (corners.size() % 3 != 0) fail(fmt::format("mesh {} has {} corners, not a multiple of 3", mesh, corners.size()));
    return corners;
  }
  if (corners.size() < 3) fail(fmt::format("mesh {} has a strip or fan of {} corners", mesh, corners.size()));
  std::vector<std::uint32_t> listed;
  listed.reserve((corners.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const bool fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
    const std::uint32_t a = fan ? corners[i + 1] : corners[i];
    const std::uint32_t b = fan ? corners[i + 2] : corners[i + 1 + i % 2];
    const std::uint32_t c = fan ? corners[0] : corners[i + 2 - i % 2];
    if (a != b && b != c && c != a) listed.insert(listed.end(), {a, b, c});  // strips are joined by empty triangles
  }
  return listed;
}

SolidPrimitive GltfReader::primitive(const tinygltf::Primitive& source, int mesh, bool look) {
  const int positions = attribute(source, "POSITION"), normals = attribute(source, "NORMAL");
  const int uvs[2] = {attribute(source, "TEXCOORD_0"), look ? attribute(source, "TEXCOORD_1") : -1};
  const int colours = look ? attribute(source, "COLOR_0") : -1;
  if (positions < 0) fail(fmt::format("mesh {} has a primitive without positions", mesh));
  const std::size_t vertices = accessors_.count(positions);
  count_vertices(vertices);
  for (const int other : {normals, uvs[0], uvs[1], colours})
    if (other >= 0 && accessors_.count(other) != vertices)
      fail(fmt::format("mesh {} has {} positions and {} normals, texture places or colours", mesh, vertices,
                       accessors_.count(other)));
  SolidPrimitive made;
  made.material = source.material;
  if (made.material < -1 || made.material >= static_cast<int>(document_.materials.size()))
    fail(fmt::format("mesh {} names material {}, which does not exist", mesh, made.material));
  made.indices = triangles(source, vertices, mesh);
  const auto read = [&](int accessor, int components, const char* what, const auto& take) {
    const std::vector<float> values = accessors_.floats(accessor, components);
    for (std::size_t i = 0; i < vertices; ++i) {
      const float* at = &values[i * static_cast<std::size_t>(components)];
      for (int c = 0; c < components; ++c)
        if (!std::isfinite(at[c])) fail(fmt::format("mesh {} has {} {} that is not finite", mesh, what, i));
      take(at);
    }
  };
  read(positions, 3, "position", [&](const float* at) { made.positions.emplace_back(at[0], at[1], at[2]); });
  for (std::size_t set = 0; set < 2; ++set)
    if (uvs[set] >= 0)
      read(uvs[set], 2, "texture place", [&](const float* at) { made.uvs[set].emplace_back(at[0], at[1]); });
  if (colours >= 0) {
    const int components = accessors_.components(colours);
    if (components != 3 && components != 4) fail(fmt::format("mesh {} has colours of {} numbers", mesh, components));
    read(colours, components, "colour", [&](const float* at) {
      made.colours.push_back(
          glm::clamp(glm::vec4(at[0], at[1], at[2], components == 4 ? at[3] : 1.0f), glm::vec4(0.0f), glm::vec4(1.0f)));
    });
  }
  if (normals < 0) {
    make_flat(made);
    return made;
  }
  // What is no direction becomes the face's.
  const std::vector<float> directions = accessors_.floats(normals, 3);
  made.normals.resize(vertices, glm::vec3(0.0f));
  for (std::size_t i = 0; i < vertices; ++i) {
    const glm::dvec3 normal(directions[3 * i], directions[3 * i + 1], directions[3 * i + 2]);
    const double length = glm::length(normal);
    if (length > 0.0 && std::isfinite(length)) made.normals[i] = glm::vec3(normal / length);
  }
  for (std::size_t i = 0; i < made.indices.size(); ++i)
    if (glm::vec3& normal = made.normals[made.indices[i]]; normal == glm::vec3(0.0f)) {
      const std::uint32_t* corner = &made.indices[i - i % 3];
      normal = face_normal(made.positions[corner[0]], made.positions[corner[1]], made.positions[corner[2]]);
    }
  for (glm::vec3& normal : made.normals)
    if (normal == glm::vec3(0.0f)) normal = glm::vec3(0.0f, 1.0f, 0.0f);
  return made;
}

// glTF 2.0, section 3.7.2.1: without normals a client shades flat, so every face gets corners of its own.
void GltfReader::make_flat(SolidPrimitive& primitive) {
  count_vertices(primitive.indices.size());
  SolidPrimitive flat;
  flat.material = primitive.material;
  for (std::size_t i = 0; i < primitive.indices.size(); ++i) {
    const std::uint32_t* corner = &primitive.indices[i - i % 3];
    const std::uint32_t from = primitive.indices[i];
    flat.positions.push_back(primitive.positions[from]);
    for (std::size_t set = 0; set < 2; ++set)
      if (!primitive.uvs[set].empty()) flat.uvs[set].push_back(primitive.uvs[set][from]);
    if (!primitive.colours.empty()) flat.colours.push_back(primitive.colours[from]);
    flat.normals.push_back(
        face_normal(primitive.positions[corner[0]], primitive.positions[corner[1]], primitive.positions[corner[2]]));
    flat.indices.push_back(static_cast<std::uint32_t>(i));
  }
  primitive = std::move(flat);
}

glm::vec3 face_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 at(a), normal = glm::cross(glm::dvec3(b) - at, glm::dvec3(c) - at);
  const double length = glm::length(normal);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0.0f, 1.0f, 0.0f);
}

void GltfReader::refuse_skins_and_targets() const {
  for (std::size_t i = 0; i < document_.nodes.size(); ++i)
    if (document_.nodes[i].skin >= 0)
      throw Error(where_,
                  fmt::format("node {} {} has a skin; skins are not drawn", i, in_quotes(document_.nodes[i].name, 60)),
                  "export it without bones, with its parts as nodes that move");
  for (std::size_t i = 0; i < document_.meshes.size(); ++i)
    for (const tinygltf::Primitive& one : document_.meshes[i].primitives)
      if (!one.targets.empty())
        throw Error(
            where_,
            fmt::format("mesh {} {} has morph targets; they are not drawn", i, in_quotes(document_.meshes[i].name, 60)),
            "export it without shape keys");
}

}  // namespace seascape
