// Models as they are drawn. Controls are named beside each test; each was seen to fail.
#include "engine/solid_model.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cmath>

#include "engine/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/gltf_maker.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::error_of;
using test::GltfMaker;
using testing::ElementsAre;
using testing::HasSubstr;

// A right triangle with places in a texture and a colour a corner.
GltfMaker triangle(const std::string& more = "") {
  GltfMaker maker;
  const int places = maker.floats("VEC3", {0, 0, 0, 0, 0, 1, 1, 0, 0}),
            normals = maker.floats("VEC3", {0, 1, 0, 0, 1, 0, 0, 1, 0}), uvs = maker.floats("VEC2", {0, 0, 0, 1, 1, 0}),
            other = maker.floats("VEC2", {2, 2, 2, 3, 3, 2}),
            colours = maker.floats("VEC4", {1, 0, 0, 1, 0, 1, 0, 0.5f, 0, 0, 7, -1});
  maker.primitives =
      fmt::format(R"({{"attributes":{{"POSITION":{},"NORMAL":{},"TEXCOORD_0":{},"TEXCOORD_1":{},"COLOR_0":{}}}{}}})",
                  places, normals, uvs, other, colours, more);
  return maker;
}
SolidModel load(const GltfMaker& maker) { return load_solid_model_from_memory(maker.glb(), "a.glb"); }
std::string fault_of(const GltfMaker& maker) {
  return error_of([&] { load(maker); });
}

Image8 checks(int side, int channels) {
  Image8 image{side, side, channels, {}};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < channels; ++c)
        image.pixels.push_back(c == 3 ? std::uint8_t(100 + x) : ((x / 8 + y / 8) % 2 ? 230 : 20 + 40 * c));
  return image;
}

std::vector<std::uint8_t> jpeg_of(const Image8& image) {
  const tjhandle writer = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(tjCompress2(writer, image.pixels.data(), image.width, 0, image.height, TJPF_RGB, &bytes, &size, TJSAMP_444,
                        95, 0),
            0);
  std::vector<std::uint8_t> made(bytes, bytes + size);
  tjFree(bytes);
  tjDestroy(writer);
  return made;
}

// Controls: COLOR_0 not held to 1; the second places read from the first.
TEST(SolidModel, ReadsCornersWithAllThatIsDrawn) {
  const SolidModel model = load(triangle());
  ASSERT_EQ(model.meshes.size(), 1u);
  const SolidPrimitive& part = model.meshes[0].primitives[0];
  EXPECT_EQ(part.uvs[0][1], glm::vec2(0, 1));
  EXPECT_EQ(part.uvs[1][2], glm::vec2(3, 2));
  EXPECT_EQ(part.colours[1], glm::vec4(0, 1, 0, 0.5f));
  EXPECT_EQ(part.colours[2], glm::vec4(0, 0, 1, 0));
  EXPECT_EQ(model.triangles(), 1u);
  EXPECT_THAT(model.drawn, ElementsAre(0));
}

// Pictures of a buffer, of the text and of a file, PNG and JPEG. Controls: JPEG as BGR; RGB taken for RGBA.
TEST(SolidModel, ReadsPictures) {
  test::TemporaryFolder folder;
  const Image8 rgb = checks(16, 3), rgba = checks(16, 4);
  const std::vector<std::uint8_t> png = png_bytes(rgba, "png"), jpeg = jpeg_of(rgb);
  std::filesystem::create_directory(folder / "a b");
  write_atomically(folder / "a b/c.png", std::span<const std::uint8_t>(png_bytes(rgb, "png")));
  GltfMaker maker = triangle();
  const int view = maker.view(png, 0), jpeg_view = maker.view(jpeg, 0);
  maker.extra = fmt::format(
      R"(,"images":[{{"bufferView":{},"mimeType":"image/png"}},{{"bufferView":{}}},{{"uri":"a%20b/c.png"}},)"
      R"({{"uri":"data:image/png;base64,{}"}}])",
      view, jpeg_view, test::base64(png));
  write_atomically(folder / "model.glb", std::span<const std::uint8_t>(maker.glb()));
  const SolidModel model = load_solid_model(folder / "model.glb");
  EXPECT_EQ(model.name, "model");
  ASSERT_EQ(model.images.size(), 4u);
  EXPECT_EQ(model.images[0].pixels, rgba.pixels);
  EXPECT_EQ(model.images[3].pixels, rgba.pixels);
  int apart = 0;
  for (std::size_t i = 0; i < 16 * 16; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(model.images[2].pixels[4 * i + c], rgb.pixels[3 * i + c]);
      apart = std::max(apart, std::abs(int(model.images[1].pixels[4 * i + c]) - int(rgb.pixels[3 * i + c])));
    }
  EXPECT_LT(apart, 12);  // by JPEG's own loss
  EXPECT_EQ(model.images[1].pixels[3], 255);
  EXPECT_EQ(model.images[2].channels, 4);
}

// Controls: KHR_texture_transform's rotation the other way round; the sampler of another texture.
TEST(SolidModel, ReadsMaterials) {
  GltfMaker maker = triangle(R"(,"material":0)");
  const int view = maker.view(png_bytes(checks(8, 4), "png"), 0);
  maker.extra = fmt::format(
      R"(,"images":[{{"bufferView":{0}}}],"samplers":[{{"wrapS":33071,"wrapT":33648,"magFilter":9728}}],)"
      R"("textures":[{{"source":0,"sampler":0}},{{"source":0}}],"materials":[{{"name":"oak","alphaMode":"MASK",)"
      R"("alphaCutoff":0.25,"doubleSided":true,"pbrMetallicRoughness":{{"metallicFactor":0.5,"roughnessFactor":0.7,)"
      R"("baseColorTexture":{{"index":0,"texCoord":1}},"metallicRoughnessTexture":{{"index":1,"extensions":)"
      R"({{"KHR_texture_transform":{{"offset":[0.5,0.25],"rotation":1.5707963,"scale":[2,3],"texCoord":1}}}}}}}},)"
      R"("normalTexture":{{"index":1,"scale":2}},"occlusionTexture":{{"index":1,"strength":0.75}},)"
      R"("emissiveTexture":{{"index":1}},"emissiveFactor":[1,0.5,0],"extensions":{{"KHR_materials_unlit":{{}}}}}}])",
      view);
  const SolidMaterial look = load(maker).materials.at(0);
  EXPECT_EQ(look.name, "oak");
  EXPECT_EQ(look.alpha, AlphaMode::mask);
  EXPECT_FLOAT_EQ(look.alpha_cutoff, 0.25f);
  EXPECT_TRUE(look.double_sided && look.unlit);
  EXPECT_EQ(look.base_colour_texture.image, 0);
  EXPECT_EQ(look.base_colour_texture.uv_set, 1);
  EXPECT_EQ(look.base_colour_texture.wrap_u, TextureWrap::clamp);
  EXPECT_EQ(look.base_colour_texture.wrap_v, TextureWrap::mirrored);
  EXPECT_FALSE(look.base_colour_texture.linear);
  EXPECT_TRUE(look.normal_texture.linear);
  EXPECT_EQ(look.normal_texture.wrap_u, TextureWrap::repeat);
  EXPECT_FLOAT_EQ(look.normal_scale, 2.0f);
  EXPECT_FLOAT_EQ(look.occlusion_strength, 0.75f);
  // The extension's own formula: (u, v) -> offset + (cos u' + sin v', -sin u' + cos v') of the scaled u', v'.
  const SolidTexture& moved = look.metallic_roughness_texture;
  EXPECT_EQ(moved.uv_set, 1);
  const glm::vec2 at = moved.uv_axes * glm::vec2(0.1f, 0.2f) + moved.uv_offset;
  EXPECT_NEAR(at.x, 0.5 + 0.6, 1e-6);
  EXPECT_NEAR(at.y, 0.25 - 0.2, 1e-6);
}

// Levels of detail, hulls aside and extras. Controls: levels taken for children; nodes outside the scene dropped.
TEST(SolidModel, KnowsLevelsAndWhatIsNotDrawn) {
  GltfMaker maker = triangle();
  maker.nodes =
      R"({"name":"boat","mesh":0,"translation":[0,1,0],"extras":{"MSFT_screencoverage":[0.5,0.1,0.01],"seascape":{"mass_kg":7}},)"
      R"("extensions":{"MSFT_lod":{"ids":[2,3]}},"children":[1]},{"mesh":0},{"mesh":0,"children":[4]},{"mesh":0},)"
      R"({"mesh":0},{"name":"hull","mesh":0,"children":[6]},{"mesh":0})";
  maker.extra = R"(,"extensionsUsed":["MSFT_lod"])";
  const SolidModel model = load(maker);
  EXPECT_THAT(model.drawn, ElementsAre(0));
  EXPECT_EQ(model.order.size(), 7u);
  EXPECT_THAT(model.nodes[0].coarser, ElementsAre(2, 3));
  EXPECT_THAT(model.nodes[0].coverage, ElementsAre(0.5f, 0.1f, 0.01f));
  EXPECT_THAT(model.nodes[0].extras, HasSubstr("mass_kg"));
  EXPECT_EQ(model.nodes[2].parent, -1);
  EXPECT_EQ(model.nodes[4].parent, 2);
  EXPECT_EQ(model.nodes[5].name, "hull");
  EXPECT_EQ(model.nodes[6].parent, 5);
  EXPECT_EQ(model.triangles(), 2u);  // the boat and its child
  EXPECT_NEAR(placed_nodes(model)[1][3].y, 1.0, 1e-12);
}

// The three interpolations against closed forms, held at the ends, begun anew after the last key. Controls: the tangent
// of a cubic not times its span; a turn mixed without slerp; no repetition.
TEST(SolidModel, MovesNodes) {
  GltfMaker maker = triangle();
  const auto scalars = [&](const std::vector<float>& values) {
    return maker.accessor(maker.view_of(values), 0, 5126, values.size(), "SCALAR");
  };
  const float half = float(std::sqrt(0.5));
  const int times = scalars({0, 2, 4}), linear = maker.floats("VEC3", {0, 0, 0, 4, 0, 0, 4, 8, 0}),
            turns = maker.floats("VEC4", {0, 0, 0, 1, 0, half, 0, half, 0, 1, 0, 0}), two = scalars({0, 4}),
            cubic = maker.floats("VEC3", {0, 0, 0, 1, 1, 1, 0.5f, 0, 0, 0.25f, 0, 0, 3, 1, 1, 0, 0, 0});
  maker.extra = fmt::format(
      R"(,"animations":[{{"name":"row","channels":[{{"sampler":0,"target":{{"node":0,"path":"translation"}}}},)"
      R"({{"sampler":1,"target":{{"node":0,"path":"rotation"}}}},{{"sampler":2,"target":{{"node":0,"path":"scale"}}}}],)"
      R"("samplers":[{{"input":{0},"output":{1}}},{{"input":{0},"output":{2}}},)"
      R"({{"input":{3},"output":{4},"interpolation":"CUBICSPLINE"}}]}}])",
      times, linear, turns, two, cubic);
  const SolidModel model = load(maker);
  ASSERT_EQ(model.animations.size(), 1u);
  const SolidAnimation& row = model.animations[0];
  EXPECT_DOUBLE_EQ(row.duration_s, 4.0);
  const auto at = [&](double time_s) { return placed_nodes(model, &row, time_s)[0]; };
  for (const double again : {0.0, 4.0, 400.0}) {
    const glm::dmat4 place = at(again + 1.0);
    EXPECT_NEAR(place[3].x, 2.0, 1e-9);
    const double scale = glm::length(glm::dvec3(place[0]));
    const double t = 0.25, expected = (2 * t * t * t - 3 * t * t + 1) * 1.0 + 4.0 * (t * t * t - 2 * t * t + t) * 0.5 +
                                      (-2 * t * t * t + 3 * t * t) * 3.0 + 4.0 * (t * t * t - t * t) * 0.25;
    EXPECT_NEAR(scale, expected, 1e-6);
    // A quarter turn in 2 s: an eighth after 1 s, about y from z to x.
    EXPECT_NEAR(place[2].x / glm::length(glm::dvec3(place[2])), std::sin(glm::radians(45.0)), 1e-6);
  }
  EXPECT_NEAR(at(0.5)[2].x / glm::length(glm::dvec3(at(0.5)[2])), std::sin(glm::radians(22.5)), 1e-6);
  EXPECT_NEAR(at(3.0)[3].y, 4.0, 1e-9);
}

// Each is refused by name, with its place. Control: each refusal taken away in turn reads another message.
TEST(SolidModel, RefusesWhatItCannotDraw) {
  GltfMaker maker = triangle();
  maker.nodes = R"({"mesh":0,"name":"arm","skin":0})";
  EXPECT_THAT(fault_of(maker), HasSubstr("node 0 'arm' has a skin"));
  const std::string text = triangle().primitives;
  maker = triangle(R"(,"targets":[{"POSITION":0}])");
  EXPECT_THAT(fault_of(maker), HasSubstr("mesh 0 '' has morph targets"));
  const auto with = [&](const std::string& extra) {
    GltfMaker one = triangle();
    one.extra = extra;
    return fault_of(one);
  };
  EXPECT_THAT(with(R"(,"extensionsRequired":["KHR_texture_basisu"])"), HasSubstr("KHR_texture_basisu"));
  EXPECT_THAT(with(R"(,"images":[{"bufferView":99}])"), HasSubstr("names buffer view 99, which does not exist"));
  EXPECT_THAT(with(R"(,"images":[{"bufferView":0}])"), HasSubstr("neither a PNG nor a JPEG"));
  EXPECT_THAT(with(R"(,"images":[{"uri":"a.png"}])"), HasSubstr("'a.png' cannot be read from there"));
  EXPECT_THAT(with(R"(,"images":[{}])"), HasSubstr("picture 0 has neither"));
  EXPECT_THAT(with(R"(,"images":3)"), HasSubstr("images is not a list"));
  EXPECT_THAT(with(R"(,"images":[{"uri":"data:image/png;base64,AAAA"}])"), HasSubstr("neither a PNG nor a JPEG"));
  EXPECT_THAT(with(R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":3}}}])"),
              HasSubstr("material 0 names texture 3"));
  EXPECT_THAT(with(R"(,"textures":[{"source":5}],"materials":[{"normalTexture":{"index":0}}])"),
              HasSubstr("texture 0 names picture 5"));
  EXPECT_THAT(with(R"(,"materials":[{"pbrMetallicRoughness":{"roughnessFactor":2}}])"),
              HasSubstr("material 0 has a roughness factor of 2; 0 to 1"));
  EXPECT_THAT(
      with(R"(,"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}],"samplers":[]}])"),
      HasSubstr("moves morph targets"));
  EXPECT_THAT(with(R"(,"animations":[{"channels":[{"sampler":0,"target":{"node":8,"path":"scale"}}],"samplers":[]}])"),
              HasSubstr("moves node 8"));
  EXPECT_THAT(with(R"(,"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"scale"}}],)"
                   R"("samplers":[{"input":0,"output":1}]}])"),
              HasSubstr("accessor 0 is not of 1 numbers"));
  GltfMaker cyclic = triangle();
  cyclic.nodes = R"({"mesh":0,"extensions":{"MSFT_lod":{"ids":[0]}}})";
  EXPECT_THAT(fault_of(cyclic), HasSubstr("node 0 is met twice"));
  cyclic.nodes = R"({"mesh":0},{"children":[2]},{"children":[1]})";
  EXPECT_THAT(fault_of(cyclic), HasSubstr("is met twice"));
}

// Broken pictures of every length, and files that lie. Control: the check of pixels against bytes taken away.
TEST(SolidModel, BrokenPicturesAreTold) {
  const std::vector<std::uint8_t> jpeg = jpeg_of(checks(32, 3));
  for (std::size_t length = 0; length < jpeg.size(); length += 7) {
    try {
      const Image8 image = read_picture_from_memory(std::span(jpeg).first(length), "cut.jpg");
      EXPECT_EQ(image.pixels.size(), 32u * 32u * 4u) << length;  // the rest is grey, as browsers show it
      EXPECT_GT(length, 200u);
    } catch (const Error& fault) {
      EXPECT_THAT(fault.what(), HasSubstr("cut.jpg: is "));
    }
  }
  std::vector<std::uint8_t> huge = jpeg;
  for (std::size_t i = 0; i + 8 < huge.size(); ++i)
    if (huge[i] == 0xff && huge[i + 1] == 0xc0) huge[i + 5] = huge[i + 7] = 0x3f;  // 16,160 a side
  EXPECT_THAT(error_of([&] { (void)read_picture_from_memory(std::span(huge).first(700), "huge.jpg"); }),
              HasSubstr("promises more pixels than it holds"));
}

}  // namespace
}  // namespace seascape
