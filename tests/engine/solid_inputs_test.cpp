// Broken, huge, cyclic and far-reaching models, each by name: told with file and place, or loaded where the format
// allows it. Controls are named beside each test.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/files.h"
#include "engine/solid_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/gltf_maker.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::GltfMaker;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::StartsWith;
using Bytes = std::vector<std::uint8_t>;

struct Input {
  const char* name;
  Bytes bytes;
  std::string told;  // what the answer holds; empty: it loads
  const char* ending = "glb";
};

std::string_view text_of(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

const std::vector<float> corners{0, 0, 0, 0, 0, 1, 1, 0, 0};

GltfMaker triangle(std::vector<float> places = corners) {
  GltfMaker maker;
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", maker.floats("VEC3", places));
  return maker;
}

// A triangle with further members of its root, of its one primitive, or with other nodes.
Bytes with_root(const std::string& members) {
  GltfMaker maker = triangle();
  maker.extra = "," + members;
  return maker.glb();
}
Bytes with_nodes(const std::string& nodes, const std::string& scene = "") {
  GltfMaker maker = triangle();
  maker.nodes = nodes;
  maker.scenes = scene;
  return maker.glb();
}
Bytes with_primitive(const std::string& members) {
  GltfMaker maker = triangle();
  maker.primitives.pop_back();
  maker.primitives += "," + members + "}";
  return maker.glb();
}
Bytes with_places(std::vector<float> places) { return triangle(std::move(places)).glb(); }
Bytes with_accessor(int component_type, std::size_t count, const std::string& kind, const std::string& more = "",
                    int offset = 0) {
  GltfMaker maker;
  const int view = maker.view_of(corners);
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}}}})",
                                 maker.accessor(view, offset, component_type, count, kind, more));
  return maker.glb();
}
Bytes with_indices(const std::vector<std::uint32_t>& indices, const std::string& mode = "") {
  GltfMaker maker = triangle();
  const int list = maker.indices(5123, indices);
  maker.primitives.pop_back();
  maker.primitives += fmt::format(",\"indices\":{}{}}}", list, mode);
  return maker.glb();
}
Bytes with_picture(const Bytes& picture) {
  GltfMaker maker = triangle();
  const int view = maker.view(picture, 0);
  maker.extra = fmt::format(R"(,"images":[{{"bufferView":{}}}])", view);
  return maker.glb();
}
// `sampler`: the one that its channel names.
Bytes with_animation(const std::vector<float>& times, int sampler = 0) {
  GltfMaker maker = triangle();
  const int input = maker.accessor(maker.view_of(times), 0, 5126, times.size(), "SCALAR");
  const int output = maker.floats("VEC3", std::vector<float>(3 * times.size(), 0.0f));
  maker.extra =
      fmt::format(R"(,"animations":[{{"channels":[{{"sampler":{},"target":{{"node":0,"path":"translation"}}}}],)"
                  R"("samplers":[{{"input":{},"output":{}}}]}}])",
                  sampler, input, output);
  return maker.glb();
}
Bytes with_word(std::size_t at, std::uint32_t value) {  // of a whole file, changed in four bytes
  Bytes bytes = triangle().glb();
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  return bytes;
}
Bytes cut(Bytes bytes, std::size_t size) {
  bytes.resize(size);
  return bytes;
}

// A PNG's signature and header, and no pixels.
Bytes png_header(std::uint32_t width, std::uint32_t height) {
  Bytes png{0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R'};
  for (const std::uint32_t side : {width, height})
    for (int shift = 24; shift >= 0; shift -= 8) png.push_back(static_cast<std::uint8_t>(side >> shift));
  png.insert(png.end(), {8, 6, 0, 0, 0, 0, 0, 0, 0});
  png.insert(png.end(), {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82});
  return png;
}

std::string chain(int nodes) {
  std::string list;
  for (int i = 0; i + 1 < nodes; ++i) list += fmt::format(R"({{"children":[{}]}},)", i + 1);
  return list + R"({"mesh":0})";
}

Bytes many_values() {
  std::string list = R"({"asset":{"version":"2.0"},"extras":[1)";
  for (int i = 0; i < 1100000; ++i) list += ",1";
  return bytes_of(list + "]}");
}

std::vector<Input> files() {
  const Bytes whole = triangle().glb();
  const std::size_t chunk = 20 + std::size_t(whole[12] | whole[13] << 8);
  const auto buffer = [](const std::string& uri) { return triangle().gltf(uri); };
  const auto picture = [](const std::string& uri) { return with_root(R"("images":[{"uri":")" + uri + R"("}])"); };
  return {{"empty file", {}, ":1: is not valid JSON"},
          {"cut in its header", cut(whole, 16), "is cut off"},
          {"cut in its JSON", cut(whole, 60), "is cut off"},
          {"cut in its data", cut(whole, whole.size() - 5), "is cut off"},
          {"length of more than the file", with_word(8, 1u << 30), "is cut off"},
          {"JSON chunk of 4 GB", with_word(12, 0xfffffff0u), "JSON is cut off"},
          {"data chunk of 4 GB", with_word(chunk, 0xfffffff0u), "binary data is cut off"},
          {"glTF version 1", with_word(4, 1), "is not glTF version 2"},
          {"text that is no JSON", bytes_of("{\n\"asset\":\n"), "is not valid JSON", "gltf"},
          {"zero byte in its JSON", bytes_of(std::string("{\"a\0b\":1}", 9)), "a zero byte in its JSON", "gltf"},
          {"zero byte in a name", with_nodes(R"({"mesh":0,"name":"a\u0000b"})"), ""},
          {"JSON nested 70 deep", bytes_of(std::string(70, '[') + std::string(70, ']')), "is nested deeper", "gltf"},
          {"JSON of over a million values", many_values(), "has more than 1048576 JSON values", "gltf"},
          {"buffer that is not there", buffer("none.bin"), "its buffer 'none.bin' is not there", "gltf"},
          {"buffer above its folder", buffer("../../etc/passwd"), "lies outside of the model's folder", "gltf"},
          {"buffer at the root", buffer("/etc/passwd"), "lies outside of the model's folder", "gltf"},
          {"buffer at an address", buffer("https://a.example/b.bin"), "is at the address", "gltf"},
          {"buffer of broken base64", buffer("data:application/octet-stream;base64,!!!"), "is a broken model", "gltf"},
          {"picture that is not there", picture("none.png"), "its picture 'none.png' is not there"},
          {"picture above its folder", picture("../a.png"), "lies outside of the model's folder"},
          {"picture at an address", picture("http://a.example/b.png"), "cannot be read from there"},
          {"picture of broken base64", picture("data:image/png;base64,!!!"), "picture 0"},
          {"picture of no bytes but a signature", with_picture({0x89, 'P', 'N', 'G'}), "picture 0: is not a PNG"},
          {"picture of no size", with_picture(png_header(0, 16)), "picture 0: is a broken PNG"},
          {"picture of 65536 a side", with_picture(png_header(65536, 65536)), "picture 0: is 65536 x 65536 pixels"},
          {"picture of no pixels that claims many", with_picture(png_header(16000, 16000)), "promises more pixels"},
          {"JPEG of its first bytes", with_picture({0xff, 0xd8, 0xff, 0xe0, 0, 16, 'J', 'F'}), "is a broken JPEG"}};
}

std::vector<Input> contents() {
  const float nan = std::nanf(""), infinite = std::numeric_limits<float>::infinity();
  std::string doubled = R"({"mesh":0,"children":[2]},{"children":[2]},{"mesh":0})";
  return {
      {"accessor past its view", with_accessor(5126, 3, "VEC3", "", 12), "accessor 0 reaches past the end"},
      {"accessor of 2 G elements", with_accessor(5126, 2000000000, "VEC3"), "has 2000000000 elements"},
      {"accessor of doubles", with_accessor(5130, 3, "VEC3"), "accessor 0 is not of 3 numbers"},
      {"accessor of an unknown kind", with_accessor(1234, 3, "VEC3"), "a.glb: "},
      {"positions of two numbers", with_accessor(5126, 3, "VEC2"), "accessor 0 is not of 3 numbers"},
      {"least and most the wrong way round", with_accessor(5126, 3, "VEC3", R"(,"min":[9,9,9],"max":[-9,-9,-9])"), ""},
      {"sparse values alone",
       with_accessor(5126, 3, "VEC3",
                     R"(,"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},)"
                     R"("values":{"bufferView":0}})"),
       ""},
      {"index past its vertices", with_indices({0, 1, 70}), "mesh 0 has index 70, past its 3 vertices"},
      {"two corners", with_indices({0, 1}), "has 2 corners, not a multiple of 3"},
      {"triangles of one corner", with_indices({1, 1, 1, 0, 1, 2}), ""},
      {"points", with_indices({0, 1, 2}, ",\"mode\":0"), "points or lines (mode 0)"},
      {"lines", with_indices({0, 1}, ",\"mode\":1"), "points or lines (mode 1)"},
      {"mode that is none", with_indices({0, 1, 2}, ",\"mode\":9"), "mode 9"},
      {"position that is no number", with_places({0, nan, 0, 0, 0, 1, 1, 0, 0}), "position 0 that is not finite"},
      {"infinite position", with_places({0, 0, 0, 0, 0, infinite, 1, 0, 0}), "position 1 that is not finite"},
      {"all corners at one place", with_places(std::vector<float>(9, 0.0f)), ""},
      {"morph targets", with_primitive(R"("targets":[{"POSITION":0}])"), "mesh 0 '' has morph targets"},
      {"skin", with_nodes(R"({"mesh":0,"skin":0})"), "node 0 '' has a skin"},
      {"node its own child", with_nodes(R"({"mesh":0,"children":[0]})"), "node 0 is met twice"},
      {"cycle of three nodes", with_nodes(R"({"mesh":0,"children":[1]},{"children":[2]},{"children":[0]})"),
       "met twice"},
      {"node of two parents", with_nodes(doubled, R"({"nodes":[0,1]})"), "node 2 is met twice"},
      {"scene of node 10,000,000", with_nodes(R"({"mesh":0})", R"({"nodes":[0,10000000]})"), "node 10000000 does not"},
      {"nodes 50,000 deep", with_nodes(chain(50000)), ""},
      {"two nodes of one name", with_nodes(R"({"mesh":0,"name":"a"},{"name":"a"})"), ""},
      {"no mesh", with_nodes(R"({"name":"empty"})"), "has no triangles to draw"},
      {"mesh without primitives", with_nodes(R"({"mesh":1})"), "mesh 1 does not exist"},
      {"unknown extension that is required", with_root(R"("extensionsRequired":["ACME_x"])"),
       "requires the extension ACME_x"},
      {"unknown extension that is not", with_root(R"("extensionsUsed":["ACME_x"])"), ""},
      {"Draco", with_root(R"("extensionsRequired":["KHR_draco_mesh_compression"])"), "KHR_draco_mesh_compression"},
      {"instances that are required", with_root(R"("extensionsRequired":["EXT_mesh_gpu_instancing"])"), "EXT_mesh_gpu"},
      {"material unlit and shining",
       with_root(R"("materials":[{"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_unlit":{}}}])"), ""},
      {"texture without a picture", with_root(R"("textures":[{}],"materials":[{"normalTexture":{"index":0}}])"),
       "texture 0 has no picture that is a PNG or JPEG"},
      {"texture of a sampler that is not there",
       with_root(R"("images":[{"uri":"data:image/png;base64,AAAA"}],"textures":[{"sampler":7,"source":0}],)"
                 R"("materials":[{"normalTexture":{"index":0}}])"),
       "sampler 7"},
      {"animation whose times fall", with_animation({0, 2, 1}), "animation 0 has times that do not rise"},
      {"animation of a sampler that is not there", with_animation({0, 1}, 5), "animation 0 names sampler 5"},
      {"animation before its beginning", with_animation({-1, 1}), "animation 0 has times that do not rise"}};
}

// Controls seen, each taken away in turn: the look at indices past vertices, at the side of a PNG, at times that fall;
// and at nodes met twice, without which the walk along a cycle never ends. (Files outside of the folder that could be
// read: GltfFaults.)
class SolidInputs : public testing::Test {
 protected:
  void expect(const std::vector<Input>& inputs) {
    for (const Input& input : inputs) {
      SCOPED_TRACE(input.name);
      const std::filesystem::path file = folder_ / (std::string("a.") + input.ending);
      write_atomically(file, text_of(input.bytes));
      if (input.told.empty()) {
        const SolidModel model = load_solid_model(file);
        EXPECT_GT(model.triangles(), 0u);
        EXPECT_EQ(placed_nodes(model).size(), model.nodes.size());
        continue;
      }
      const std::string told = test::error_of([&] { (void)load_solid_model(file); });
      EXPECT_THAT(told, StartsWith(file.string() + ":"));
      EXPECT_THAT(told, HasSubstr(input.told));
      EXPECT_EQ(told.find('\n'), told.npos);
    }
  }
  TemporaryFolder folder_;
};

TEST_F(SolidInputs, FilesThatAreBrokenOrReachElsewhere) { expect(files()); }
TEST_F(SolidInputs, ContentsThatAreBrokenHugeOrCyclic) { expect(contents()); }

}  // namespace
}  // namespace seascape
