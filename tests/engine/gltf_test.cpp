#include "engine/gltf.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/gltf_maker.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::error_of;
using test::GltfMaker;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

// A right triangle in the plane y = 0 that faces up, with a normal for each corner.
const std::vector<float> corner_places{0, 0, 0, 0, 0, 1, 1, 0, 0};
const std::vector<float> corner_normals{0, 1, 0, 0, 1, 0, 0, 2, 0};

GltfMaker triangle() {
  GltfMaker maker;
  const int places = maker.floats("VEC3", corner_places), normals = maker.floats("VEC3", corner_normals);
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{},"NORMAL":{}}}}})", places, normals);
  return maker;
}

Model load(const GltfMaker& maker) { return load_gltf_from_memory(maker.glb(), "a.glb"); }
std::string fault_of(const GltfMaker& maker) {
  return error_of([&] { load(maker); });
}

testing::AssertionResult near(const glm::vec3& a, const glm::vec3& b) {
  if (glm::length(a - b) < 1e-5f) return testing::AssertionSuccess();
  return testing::AssertionFailure() << fmt::format("({}, {}, {}) is not ({}, {}, {})", a.x, a.y, a.z, b.x, b.y, b.z);
}

// Control: without the division by the length the third normal is 2 long.
TEST(Gltf, ReadsATriangle) {
  const Model model = load(triangle());
  ASSERT_EQ(model.parts.size(), 1u);
  const MeshPart& part = model.parts[0];
  EXPECT_THAT(part.indices, ElementsAre(0, 1, 2));
  EXPECT_TRUE(near(part.positions[1], {0, 0, 1}));
  for (const glm::vec3& normal : part.normals) EXPECT_TRUE(near(normal, {0, 1, 0}));
  EXPECT_TRUE(part.uvs.empty());
  EXPECT_EQ(part.material, -1);
  EXPECT_TRUE(near(model.least, {0, 0, 0}));
  EXPECT_TRUE(near(model.most, {1, 0, 1}));
}

// Control: parent and child multiplied the other way round give other positions; without the swap of corners the
// mirrored triangle faces down.
TEST(Gltf, NodesPlaceAndTurnAndMirror) {
  GltfMaker maker = triangle();
  maker.nodes =
      R"({"translation":[10,0,0],"rotation":[0,0.70710678,0,0.70710678],"children":[1]},{"mesh":0,"scale":[2,3,-4]})";
  const MeshPart part = load(maker).parts[0];
  EXPECT_TRUE(near(part.positions[0], {10, 0, 0}));
  EXPECT_TRUE(near(part.positions[1], {6, 0, 0}));  // z 1, scaled to -4, turned a quarter round y: x -4
  EXPECT_TRUE(near(part.positions[2], {10, 0, -2}));
  for (const glm::vec3& normal : part.normals) EXPECT_TRUE(near(normal, {0, 1, 0}));
  const glm::vec3 face = glm::cross(part.positions[part.indices[1]] - part.positions[part.indices[0]],
                                    part.positions[part.indices[2]] - part.positions[part.indices[0]]);
  EXPECT_GT(face.y, 0.0f);
  maker.nodes = R"({"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]})";
  EXPECT_TRUE(near(load(maker).parts[0].positions[2], {6, 6, 7}));
}

// Control: shared corners give the ridge one normal instead of two.
TEST(Gltf, FlatNormalsWhereTheFileHasNone) {
  GltfMaker maker;
  const int places = maker.floats("VEC3", {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0});
  const int corners = maker.indices(5121, {0, 1, 2, 0, 3, 1});
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}},"indices":{}}})", places, corners);
  const MeshPart part = load(maker).parts[0];
  ASSERT_EQ(part.positions.size(), 6u);
  EXPECT_TRUE(near(part.normals[0], {0, 1, 0}));
  EXPECT_TRUE(near(part.normals[3], {1, 0, 0}));
}

// Control: with i % 2 left out every second triangle of the strip is turned round.
TEST(Gltf, StripsAndFans) {
  GltfMaker maker;
  const int places = maker.floats("VEC3", {0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 2, 0, 0});
  const int normals = maker.floats("VEC3", {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0});
  const auto with_mode = [&](int mode) {
    maker.primitives =
        fmt::format(R"({{"attributes":{{"POSITION":{},"NORMAL":{}}},"mode":{}}})", places, normals, mode);
    return load(maker).parts[0];
  };
  EXPECT_THAT(with_mode(5).indices, ElementsAre(0, 1, 2, 1, 3, 2, 2, 3, 4));
  EXPECT_THAT(with_mode(6).indices, ElementsAre(1, 2, 0, 2, 3, 0, 3, 4, 0));
  for (const int mode : {0, 1, 2, 3, 7})
    EXPECT_THAT(error_of([&] { with_mode(mode); }), HasSubstr("only triangles are read"));
  EXPECT_THAT(error_of([&] { with_mode(4); }), HasSubstr("not a multiple of 3"));
}

// Control: a divisor of 128 instead of 127, or stride taken as packed, changes these values.
TEST(Gltf, IntegersAndStrides) {
  GltfMaker maker;
  // Signed bytes, three and a byte of padding.
  const int view = maker.view({0, 0, 0, 99, 127, 0x80, 0, 99, 0, 0, 64, 99}, 4);
  const int normalised = maker.accessor(view, 0, 5120, 3, "VEC3", R"(,"normalized":true)");
  const int plain = maker.accessor(view, 0, 5120, 3, "VEC3");
  const int uvs = maker.accessor(maker.view({0, 0, 0xff, 0xff, 0xff, 0x7f, 0, 0, 1, 0, 2, 0}, 0), 0, 5123, 3, "VEC2",
                                 R"(,"normalized":true)");
  maker.extra = R"(,"extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"])";
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{},"TEXCOORD_0":{}}}}})", normalised, uvs);
  MeshPart part = load(maker).parts[0];
  EXPECT_TRUE(near(part.positions[1], {1, -1, 0}));
  EXPECT_NEAR(part.positions[2].z, 64.0 / 127.0, 1e-6);
  EXPECT_EQ(part.uvs[0].y, 1.0f);
  EXPECT_NEAR(part.uvs[1].x, 32767.0 / 65535.0, 1e-6);
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", plain);
  part = load(maker).parts[0];
  EXPECT_TRUE(near(part.positions[1], {127, -128, 0}));
}

// Control: without each_sparse the second position stays where the base has it.
TEST(Gltf, SparseValues) {
  GltfMaker maker;
  const int base = maker.view_of(corner_places), places = maker.view({1, 0}, 0),
            values = maker.view_of({5.0f, 6.0f, 7.0f});
  const std::string sparse = fmt::format(
      R"(,"sparse":{{"count":1,"indices":{{"bufferView":{},"componentType":5123}},"values":{{"bufferView":{}}}}})",
      places, values);
  int accessor = maker.accessor(base, 0, 5126, 3, "VEC3", sparse);
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", accessor);
  EXPECT_TRUE(near(load(maker).parts[0].positions[1], {5, 6, 7}));
  accessor = maker.accessor(-1, 0, 5126, 3, "VEC3", sparse);  // on zeros
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", accessor);
  EXPECT_TRUE(near(load(maker).parts[0].positions[1], {5, 6, 7}));
  EXPECT_TRUE(near(load(maker).parts[0].positions[2], {0, 0, 0}));
  accessor = maker.accessor(-1, 0, 5126, 2000001, "VEC3", sparse);
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", accessor);
  EXPECT_THAT(fault_of(maker), HasSubstr("2000001 elements, too many"));
}

// Control: the emissive strength left out gives 0.5.
TEST(Gltf, Materials) {
  GltfMaker maker = triangle();
  maker.extra = R"(,"materials":[{"name":"hull"},{"name":"lamp","doubleSided":true,"emissiveFactor":[0.5,0,1],
    "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":8}},
    "pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.25,"roughnessFactor":0.75}}])";
  maker.primitives.insert(maker.primitives.size() - 1, R"(,"material":1)");
  const Model model = load(maker);
  EXPECT_EQ(model.parts[0].material, 1);
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.materials[0].metallic, 1.0f);
  EXPECT_EQ(model.materials[1].base_colour, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(model.materials[1].emissive, glm::vec3(4, 0, 8));
  EXPECT_EQ(model.materials[1].metallic, 0.25f);
  EXPECT_EQ(model.materials[1].roughness, 0.75f);
  EXPECT_TRUE(model.materials[1].double_sided);
  maker.extra = R"(,"materials":[{},{"pbrMetallicRoughness":{"roughnessFactor":2}}])";
  EXPECT_THAT(fault_of(maker), HasSubstr("material 1 has a roughness factor of 2; 0 to 1"));
}

// Control: a reader that takes the scene's first node only draws one of the two.
TEST(Gltf, OneMeshInTwoPlacesAndOtherScenesLeftOut) {
  GltfMaker maker = triangle();
  maker.nodes = R"({"mesh":0},{"mesh":0,"translation":[0,5,0]},{"mesh":0,"translation":[0,50,0]})";
  maker.scenes = R"({"nodes":[2]},{"nodes":[0,1]})";
  maker.extra = R"(,"scene":1)";
  const Model model = load(maker);
  ASSERT_EQ(model.parts.size(), 2u);
  EXPECT_TRUE(near(model.most, {1, 5, 1}));
}

}  // namespace
}  // namespace seascape
