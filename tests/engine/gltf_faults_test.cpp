// Broken and hostile models: each must be told in words, and never crash, hang or take memory without bound.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>

#include "engine/files.h"
#include "engine/gltf.h"
#include "tests/support/expect_error.h"
#include "tests/support/gltf_maker.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::error_of;
using test::GltfMaker;
using test::TemporaryFolder;
using testing::HasSubstr;

const std::vector<float> corner_places{0, 0, 0, 0, 0, 1, 1, 0, 0};

GltfMaker triangle() {
  GltfMaker maker;
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", maker.floats("VEC3", corner_places));
  return maker;
}

std::string fault_of(const GltfMaker& maker) {
  return error_of([&] { load_gltf_from_memory(maker.glb(), "a.glb"); });
}

std::string fault_of(const std::string& text) {
  return error_of([&] {
    load_gltf_from_memory({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "a.gltf");
  });
}

std::string_view text_of(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Controls: inside() answering yes to every regular file reads the buffer above the folder, and the one through the
// link; without its refusal tinygltf's own "File not found" is told of all.
TEST(GltfFaults, BuffersOnlyFromTheModelsFolder) {
  const TemporaryFolder folder;
  const GltfMaker maker = triangle();
  std::filesystem::create_directories(folder / "model/below");
  const std::string_view data = text_of(maker.data);
  write_atomically(folder / "above.bin", data);
  write_atomically(folder / "model/beside it.bin", data);
  write_atomically(folder / "model/below/b.bin", data);
  std::filesystem::create_symlink("../above.bin", folder / "model/link.bin");
  ASSERT_EQ(mkfifo((folder / "model/pipe.bin").c_str(), 0600), 0);
  const auto load = [&](const std::string& uri) {
    write_atomically(folder / "model/a.gltf", text_of(maker.gltf(uri)));
    return load_gltf(folder / "model/a.gltf");
  };
  EXPECT_EQ(load("beside%20it.bin").parts.size(), 1u);
  EXPECT_EQ(load("below/b.bin").name, "a");
  EXPECT_EQ(load("data:application/octet-stream;base64," + test::base64(maker.data)).parts[0].positions[1].z, 1.0f);
  const std::string outside = "' lies outside of the model's folder; put its buffers beside it";
  const std::pair<const char*, std::string> refused[] = {
      {"../above.bin", "is a broken model: its buffer '../above.bin" + outside},
      {"../none.bin", "is a broken model: its buffer '../none.bin" + outside},
      {"..%2Fabove.bin", "is a broken model: its buffer '../above.bin" + outside},
      {"link.bin", "is a broken model: its buffer 'link.bin" + outside},
      {"/etc/passwd", "is a broken model: its buffer '/etc/passwd" + outside},
      {"pipe.bin", "is a broken model: its buffer 'pipe.bin' is no plain file"},
      {"none.bin", "is a broken model: its buffer 'none.bin' is not there"},
      {"below", "is a broken model: its buffer 'below' is a folder"},
      {"file:///etc/passwd", "buffer 0 is at the address 'file:///etc/passwd'; copy it beside the model"},
      {"http://localhost/a.bin", "buffer 0 is at the address 'http://localhost/a.bin'; copy it beside the model"}};
  for (const auto& [uri, told] : refused)
    EXPECT_THAT(error_of([&, uri = uri] { load(uri); }), HasSubstr("a.gltf: " + told)) << uri;
  write_atomically(folder / "model/short.bin", data.substr(1));
  EXPECT_THAT(error_of([&] { load("short.bin"); }), HasSubstr("File size mismatch"));
  write_atomically(folder / "model/empty.bin", std::string_view());
  EXPECT_THAT(error_of([&] { load("empty.bin"); }), HasSubstr("File is empty"));
  write_atomically(folder / "model/a.glb", text_of(maker.glb()));
  EXPECT_EQ(load_gltf(folder / "model/a.glb").parts.size(), 1u);
  EXPECT_THAT(error_of([&] { load_gltf(folder / "none.glb"); }), HasSubstr("there is no such file"));
  EXPECT_THAT(error_of([&] { load_gltf(folder.path()); }), HasSubstr("is a folder"));
}

// Control: without the look at the empty folder in inside(), /etc/hostname is read.
TEST(GltfFaults, NoFilesFromMemory) {
  const std::string text(text_of(triangle().gltf("/etc/hostname")));
  EXPECT_THAT(fault_of(text), HasSubstr("File not found"));
}

// Control: each check of split() and check_asset() taken out changes one of these answers.
TEST(GltfFaults, WhatIsNoModel) {
  EXPECT_THAT(fault_of(std::string()), HasSubstr("a.gltf:1: is not valid JSON"));
  EXPECT_THAT(fault_of(std::string("{\n\"asset\": {\n,}}")), HasSubstr("a.gltf:3: is not valid JSON"));
  EXPECT_THAT(fault_of(std::string("[]")), HasSubstr("is not a glTF file"));
  EXPECT_THAT(fault_of(std::string("{}")), HasSubstr("no asset.version"));
  EXPECT_THAT(fault_of(std::string(R"({"asset":{"version":"1.0"}})")), HasSubstr("version 1.0, not 2"));
  EXPECT_THAT(fault_of(std::string(R"({"asset":{"version":"2.1","minVersion":"2.1"}})")), HasSubstr("newer glTF"));
  EXPECT_THAT(fault_of(std::string(R"({"asset":{"version":"2.0"}})")), HasSubstr("no triangles"));
  EXPECT_THAT(fault_of(R"({"asset":{"version":"2.0"}})" + std::string("\0{", 2)), HasSubstr("a zero byte in its JSON"));
  GltfMaker maker = triangle();
  maker.extra = R"(,"extensionsRequired":["KHR_draco_mesh_compression"])";
  EXPECT_THAT(fault_of(maker), HasSubstr("requires the extension KHR_draco_mesh_compression"));
}

// Control: without the depth the first is read to its end; without the count the second, of 3.6 MB, takes over 900 MB.
TEST(GltfFaults, JsonBombs) {
  std::string deep = R"({"asset":{"version":"2.0","extras":)";
  for (int i = 0; i < 100000; ++i) deep += "[";
  EXPECT_THAT(fault_of(deep), HasSubstr("nested deeper than 64"));
  std::string wide = R"({"asset":{"version":"2.0"},"nodes":[{})";
  for (int i = 0; i < 1200000; ++i) wide += ",{}";
  EXPECT_THAT(fault_of(wide + "]}"), HasSubstr("more than 1048576 JSON values"));
}

// Control: without `seen` the first makes 65536 parts and the second never ends.
TEST(GltfFaults, NodesThatGoRound) {
  GltfMaker maker = triangle();
  maker.nodes = R"({"mesh":0,"children":[1]},{"children":[0]})";
  EXPECT_THAT(fault_of(maker), HasSubstr("node 0 is met twice"));
  maker.nodes = R"({"children":[0]})";
  EXPECT_THAT(fault_of(maker), HasSubstr("node 0 is met twice"));
  maker.nodes = R"({"children":[1,1]},{"mesh":0})";
  EXPECT_THAT(fault_of(maker), HasSubstr("node 1 is met twice"));
  maker.nodes = R"({"children":[7]})";
  EXPECT_THAT(fault_of(maker), HasSubstr("node 7 does not exist"));
  maker.nodes.clear();
  for (int i = 0; i < 50000; ++i) maker.nodes += fmt::format(R"({{"children":[{}]}},)", i + 1);
  maker.nodes += R"({"mesh":0})";
  EXPECT_EQ(load_gltf_from_memory(maker.glb(), "chain").parts.size(), 1u);
}

// Control: a bound that forgets the accessor's own offset, or the last element's size, lets one of these read past the
// end.
TEST(GltfFaults, AccessorsOutOfTheirBuffers) {
  struct Case {
    int view, offset, type, count;
    const char *kind, *more, *message;
  };
  const std::vector<std::uint8_t> bytes(48);
  for (const Case& c : std::vector<Case>{{0, 0, 5126, 6, "VEC3", "", "past the end"},
                                         {0, 16, 5126, 3, "VEC3", "", "past the end"},
                                         {1, 8, 5126, 3, "VEC3", "", "past the end"},
                                         {0, -4, 5126, 3, "VEC3", "", ""},
                                         {9, 0, 5126, 3, "VEC3", "", "buffer view 9, which does not exist"},
                                         {2, 0, 5126, 3, "VEC3", "", "stride of 4 bytes for elements of 12"},
                                         {0, 0, 5126, 3, "VEC2", "", "not of 3 numbers"},
                                         {0, 0, 5126, 3, "MAT3", "", "not of 3 numbers"},
                                         {0, 0, 5125, 3, "VEC3", "", "not of 3 numbers"},
                                         {0, 0, 5126, 0, "VEC3", "", "has 0 elements"},
                                         {0, 0, 5126, 2000000000, "VEC3", "", "2000000000 elements"},
                                         {-1, 0, 5126, 3, "VEC3", "", "has no data"}}) {
    GltfMaker maker;
    maker.view(bytes, 0);
    maker.view(bytes, 16);
    maker.view(bytes, 4);
    const int accessor = maker.accessor(c.view, c.offset, c.type, static_cast<std::size_t>(c.count), c.kind, c.more);
    maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", accessor);
    if (*c.message)
      EXPECT_THAT(fault_of(maker), HasSubstr(c.message)) << c.kind << c.offset;
    else
      EXPECT_NO_THROW(load_gltf_from_memory(maker.glb(), "negative offsets are read as none"));
  }
}

// Control: without the check against the accessor's count the sparse index writes past the values.
TEST(GltfFaults, SparseOutOfRange) {
  for (const auto& [count, index, values] :
       {std::tuple{1, 3, 12}, {0, 0, 12}, {4, 0, 48}, {-1, 0, 12}, {1, 0, 8}, {2, 0, 24}}) {
    GltfMaker maker;
    const int base = maker.view_of(corner_places);
    const int places = maker.view({static_cast<std::uint8_t>(index)}, 0);
    const int changed = maker.view(std::vector<std::uint8_t>(static_cast<std::size_t>(values)), 0);
    const int accessor = maker.accessor(
        base, 0, 5126, 3, "VEC3",
        fmt::format(
            R"(,"sparse":{{"count":{},"indices":{{"bufferView":{},"componentType":5121}},"values":{{"bufferView":{}}}}})",
            count, places, changed));
    maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", accessor);
    EXPECT_NE(fault_of(maker), "") << count << ' ' << index;
  }
}

// Control: without the loop over the corners the triangle reads a position that is not there.
TEST(GltfFaults, WrongReferences) {
  GltfMaker maker;
  const int places = maker.floats("VEC3", corner_places), few = maker.floats("VEC3", {0, 1, 0});
  const int corners = maker.indices(5123, {0, 1, 3}), numbers = maker.floats("VEC3", {0, 1, 2});
  const auto with = [&](const std::string& rest) {
    maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}{})", places, rest);
    return fault_of(maker);
  };
  EXPECT_THAT(with(fmt::format("}},\"indices\":{}}}", corners)), HasSubstr("index 3, past its 3 vertices"));
  EXPECT_THAT(with(fmt::format("}},\"indices\":{}}}", numbers)), HasSubstr("whole numbers"));
  EXPECT_NE(with("},\"indices\":77}"), "");
  EXPECT_THAT(with("},\"material\":0}"), HasSubstr("material 0, which does not exist"));
  EXPECT_THAT(with("},\"material\":-5}"), HasSubstr("material -5, which does not exist"));
  EXPECT_THAT(with(fmt::format(",\"NORMAL\":{}}}}}", few)), HasSubstr("3 positions and 1 normals"));
  EXPECT_THAT(with(",\"NORMAL\":55}}"), HasSubstr("accessor 55 does not exist"));
  maker.primitives = fmt::format(R"({{"attributes":{{"NORMAL":{}}}}})", places);
  EXPECT_THAT(fault_of(maker), HasSubstr("without positions"));
  maker = triangle();
  maker.nodes = R"({"mesh":3})";
  EXPECT_THAT(fault_of(maker), HasSubstr("mesh 3 does not exist"));
  maker = triangle();
  maker.extra = R"(,"scene":4)";
  EXPECT_THAT(fault_of(maker), HasSubstr("scene 4 does not exist"));
}

// Control: without the check after the transform the infinite corner reaches the bounds.
TEST(GltfFaults, NumbersOutOfRange) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    GltfMaker maker;
    std::vector<float> places = corner_places;
    places[4] = bad;
    maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", maker.floats("VEC3", places));
    EXPECT_THAT(fault_of(maker), HasSubstr("position 1 that is not finite"));
  }
  GltfMaker maker;
  maker.primitives =
      fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", maker.floats("VEC3", std::vector<float>(9, 1e30f)));
  maker.nodes = R"({"mesh":0,"scale":[1e12,1,1]})";
  EXPECT_THAT(fault_of(maker), HasSubstr("not finite"));
  for (const char* node :
       {R"("rotation":[0,0,0,0])", R"("scale":[1,1])", R"("matrix":[1])", R"("translation":[1e300,0,0])"}) {
    GltfMaker other = triangle();
    other.nodes = fmt::format(R"({{"mesh":0,{}}})", node);
    EXPECT_THAT(fault_of(other), HasSubstr("node 0 has a ")) << node;
  }
}

// Control: without count_vertices this makes 40 M vertices from a file of a few kilobytes of JSON and one buffer.
TEST(GltfFaults, TooManyVertices) {
  GltfMaker maker;
  const std::size_t count = std::size_t{1} << 20;
  const int places = maker.accessor(maker.view(std::vector<std::uint8_t>(count * 4 + 8), 4), 0, 5120, count, "VEC3");
  maker.primitives = fmt::format(R"({{"attributes":{{"POSITION":{0},"NORMAL":{0}}},"mode":5}})", places);
  maker.nodes.clear();
  maker.scenes = R"({"nodes":[0)";
  for (int i = 0; i < 40; ++i) {
    maker.nodes += (i ? "," : "") + std::string(R"({"mesh":0})");
    if (i) maker.scenes += fmt::format(",{}", i);
  }
  maker.scenes += "]}";
  EXPECT_THAT(fault_of(maker), HasSubstr("has over 16 M vertices"));
}

// Control: with the binary chunk's 8 header bytes left out of its bound, the cut file reads past its end (seen under
// asan).
TEST(GltfFaults, CutOrDamagedBinaryFiles) {
  const std::vector<std::uint8_t> whole = triangle().glb();
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(load_gltf_from_memory(std::span(whole).first(size), "cut"), Error) << size;
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const std::uint8_t flip : {0x01, 0x10, 0xff}) {
      std::vector<std::uint8_t> damaged = whole;
      damaged[i] ^= flip;
      try {
        load_gltf_from_memory(damaged, "damaged");
      } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("damaged"));
      }
    }
  std::vector<std::uint8_t> late = whole;
  const std::size_t size_at = 20 + (whole[12] | whole[13] << 8);
  late[size_at] = static_cast<std::uint8_t>(late[size_at] + 8);
  EXPECT_THAT(error_of([&] { load_gltf_from_memory(late, "late"); }), HasSubstr("binary data is cut off"));
}

// Control: without check_buffers each of these buffers is a copy of the binary chunk.
TEST(GltfFaults, ManyBuffersOverOneChunk) {
  const GltfMaker maker = triangle();
  const std::string text = maker.json(R"({"byteLength":36},{"byteLength":36},{"byteLength":36})");
  EXPECT_THAT(fault_of(text), HasSubstr("buffer 0 has no uri"));
  for (const char* buffer : {R"({"byteLength":0,"uri":"a"})", R"({"byteLength":-1,"uri":"a"})", R"({"uri":"a"})",
                             R"({"byteLength":99999999999,"uri":"a"})"})
    EXPECT_THAT(fault_of(maker.json(buffer)), HasSubstr("byteLength that is not")) << buffer;
  EXPECT_THAT(fault_of(maker.json(R"({"byteLength":36,"uri":7})")), HasSubstr("uri that is not a name"));
  EXPECT_THAT(fault_of(maker.json("7")), HasSubstr("buffer 0 is not an object"));
}

}  // namespace
}  // namespace seascape
