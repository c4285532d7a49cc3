// Textures of solid things as they are drawn: which texel lies where, and which way a normal map turns the light.
// Controls are named beside each test.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "engine/image_file.h"
#include "tests/support/gltf_maker.h"
#include "tests/support/gpu/frame_shapes.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::GltfMaker;
using test::pose;
using test::SeaShot;

class SolidTextures : public test::GpuTest {};

constexpr std::uint32_t width = 120, height = 90;

// An upright square of 4 m before the eye, its corners in the order left above, right above, right below, left below.
struct Square {
  std::vector<float> uvs{0, 0, 1, 0, 1, 1, 0, 1}, other_uvs{};
  glm::vec3 normal{0.0f, 0.0f, 1.0f};
  Image8 picture{1, 1, 4, {255, 255, 255, 255}};
  std::string material = "{}";                                     // JSON; its texture is number 0
  std::string sampler = R"({"magFilter":9728,"minFilter":9728})";  // the nearest texel
  bool turned = false;                                             // its back is seen
};

SceneObjects scene_of(const Square& square) {
  GltfMaker maker;
  const int picture = maker.view(png_bytes(square.picture, "square"), 0);
  std::vector<float> normals;
  for (int i = 0; i < 4; ++i) normals.insert(normals.end(), {square.normal.x, square.normal.y, square.normal.z});
  const int places = maker.floats("VEC3", {-2, 2, 0, 2, 2, 0, 2, -2, 0, -2, -2, 0});
  const int turned = maker.floats("VEC3", normals), uvs = maker.floats("VEC2", square.uvs);
  std::string attributes = fmt::format(R"("POSITION":{},"NORMAL":{},"TEXCOORD_0":{})", places, turned, uvs);
  if (!square.other_uvs.empty())
    attributes += fmt::format(R"(,"TEXCOORD_1":{})", maker.floats("VEC2", square.other_uvs));
  maker.primitives = fmt::format(R"({{"attributes":{{{}}},"indices":{},"material":0}})", attributes,
                                 maker.indices(5123, {0, 2, 1, 0, 3, 2}));
  maker.extra = fmt::format(
      R"(,"images":[{{"bufferView":{}}}],"samplers":[{}],"textures":[{{"source":0,"sampler":0}}],"materials":[{}])",
      picture, square.sampler, square.material);
  SceneObjects objects;
  test::stand(objects,
              PlacedModel(std::make_shared<const SolidModel>(load_solid_model_from_memory(maker.glb(), "square.glb"))),
              pose({0.0, 6.0, -3.0}, square.turned ? 180.0 : 0.0, 0.0));
  return objects;
}

Image8 drawn(const test::FrameLook& look, const Square& square) {
  std::vector<std::pair<std::string, std::string>> set{{"waves.resolution", "32"},
                                                       {"sky.sun_to_deg", "140"},
                                                       {"sky.sun_elevation_deg", "35"},
                                                       {"models.shadow_texels", "0"}};
  set.insert(set.end(), look.set.begin(), look.set.end());
  SeaShot shot({.scene = "calm",
                .preset = "medium",
                .width = width,
                .height = height,
                .set = set,
                .effects = {{"waves", "models"}},
                .objects = scene_of(square)});
  return shot.picture(pose({0.0, 6.0, 0.0}, 0.0, 0.0), 1.0);
}

// The colour's letter at a share of the way from the picture's middle: of the 2 x 2 texels red, green, blue, yellow.
char letter(const Image8& picture, double x, double y) {
  const auto column = std::size_t(width * (0.5 + 0.5 * x)), row = std::size_t(height * (0.5 + 0.5 * y));
  const std::uint8_t* p = &picture.pixels[4 * (row * width + column)];
  const bool r = p[0] > 90, g = p[1] > 90, b = p[2] > 90;
  return r && g && !b ? 'Y' : r && !g && !b ? 'R' : g && !r && !b ? 'G' : b && !r && !g ? 'B' : '?';
}
std::string letters(const Image8& picture) {
  std::string all;
  for (const double y : {-0.25, 0.25})
    for (const double x : {-0.25, 0.25}) all += letter(picture, x, y);
  return all;
}

// Red, green above blue, yellow, without light: where each texel lies, by the wrapping, the set of places and
// KHR_texture_transform that a file names. Controls seen: v the other way round in place_in(); the second set read from
// the first.
TEST_F(SolidTextures, TexelsLieWhereTheFileSays) {
  Square plain;
  plain.picture = {2, 2, 4, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255}};
  const auto material = [](const std::string& more, const std::string& rest = "") {
    return R"({"extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":{"baseColorTexture":{"index":0)" + more +
           "}}" + rest + "}";
  };
  plain.material = material("");
  const test::FrameLook& look = test::frame_looks[0];
  EXPECT_EQ(letters(drawn(look, plain)), "RGBY");
  Square beyond = plain;
  beyond.uvs = {1, 0, 2, 0, 2, 1, 1, 1};  // one picture further on
  const auto wrapped = [&](const char* mode) {
    beyond.sampler = fmt::format(R"({{"magFilter":9728,"minFilter":9728,"wrapS":{},"wrapT":10497}})", mode);
    return letters(drawn(look, beyond));
  };
  EXPECT_EQ(wrapped("10497"), "RGBY") << "repeated";
  EXPECT_EQ(wrapped("33648"), "GRYB") << "mirrored";
  EXPECT_EQ(wrapped("33071"), "GGYY") << "clamped";
  Square second = plain;
  second.other_uvs = {1, 1, 0, 1, 0, 0, 1, 0};
  second.material = material(R"(,"texCoord":1)");
  EXPECT_EQ(letters(drawn(look, second)), "YBGR");
  Square moved = plain;
  moved.material = material(R"(,"extensions":{"KHR_texture_transform":{"offset":[0.5,0]}})");
  EXPECT_EQ(letters(drawn(look, moved)), "GRYB");
  moved.material = material(R"(,"extensions":{"KHR_texture_transform":{"rotation":1.5707963}})");
  EXPECT_EQ(letters(drawn(look, moved)), "BRYG") << "u' = v, v' = -u";
  Square back = plain;
  back.turned = true;
  EXPECT_EQ(letters(drawn(look, back)).find_first_of("RGBY"), std::string::npos);
  back.material = material("", R"(,"doubleSided":true)");
  EXPECT_EQ(letters(drawn(look, back)), "GRYB");
}

// A normal map of one direction against a square that has that normal itself, with its picture upright, turned by a
// quarter and mirrored, from before and from behind: the same light. Controls seen: the tangents of
// lib/solid_light.glsl as they were, half a turn off; one of them alone; the back not reversed.
TEST_F(SolidTextures, NormalMapsTurnTheLightAsTheFormatSays) {
  const glm::vec3 n = glm::normalize(glm::vec3(0.45f, 0.5f, 0.74f));
  Square mapped;
  mapped.picture.pixels = {0, 0, 0, 255};
  for (int c = 0; c < 3; ++c) mapped.picture.pixels[std::size_t(c)] = std::uint8_t(std::lround(127.5f * (n[c] + 1.0f)));
  const auto material = [](const std::string& more) {
    return R"({"doubleSided":true,"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.6})" + more + "}";
  };
  mapped.material = material(R"(,"normalTexture":{"index":0})");
  Square bare;
  bare.material = material("");
  struct Layout {
    std::vector<float> uvs;
    glm::vec3 normal;  // u * n.x - v * n.y + n.z, of the directions of u and v
  };
  const Layout layouts[] = {{{0, 0, 1, 0, 1, 1, 0, 1}, {n.x, n.y, n.z}},
                            {{1, 0, 1, 1, 0, 1, 0, 0}, {-n.y, n.x, n.z}},
                            {{1, 0, 0, 0, 0, 1, 1, 1}, {-n.x, n.y, n.z}}};
  const auto mean = [](const Image8& picture) {
    glm::dvec3 sum(0.0);
    for (std::size_t y = height / 3; y < height * 2 / 3; ++y)
      for (std::size_t x = width / 3; x < width * 2 / 3; ++x)
        for (int c = 0; c < 3; ++c) sum[c] += picture.pixels[4 * (y * width + x) + std::size_t(c)];
    return sum / double((height * 2 / 3 - height / 3) * (width * 2 / 3 - width / 3));
  };
  double most_apart = 0.0;  // of the layouts, or they would show nothing
  for (const test::FrameLook& look : {*std::begin(test::frame_looks), *std::prev(std::end(test::frame_looks))})
    for (const bool turned : {false, true}) {
      glm::dvec3 first(0.0);
      for (const Layout& layout : layouts) {
        mapped.uvs = layout.uvs;
        bare.normal = layout.normal;
        mapped.turned = bare.turned = turned;
        const glm::dvec3 seen = mean(drawn(look, mapped)), truth = mean(drawn(look, bare));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], truth[c], 2.5) << look.name << turned << c;
        if (&layout == &layouts[0]) first = truth;
        most_apart = std::max(most_apart, glm::length(truth - first));
      }
    }
  EXPECT_GT(most_apart, 15.0);
}

}  // namespace
}  // namespace seascape
