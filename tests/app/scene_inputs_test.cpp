// A scene's inputs: what is read, and that every fault names file, line, key, value, range and remedy.
#include "app/scene_inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "app/commands.h"
#include "app/scene.h"
#include "app/validate.h"
#include "engine/image_file.h"
#include "ocean/inputs/clip_volumes.h"
#include "ocean/inputs/inputs.h"
#include "tests/support/gltf_maker.h"

namespace seascape {
namespace {

const std::vector<std::string> every{"level",  "sea_depth", "flow",          "foam",    "clip",
                                     "albedo", "shadow",    "dynamic_waves", "gerstner"};

// A folder with a model, a height field and a painted picture, which scenes in it name.
std::string scene_file() {
  static const std::string file = [] {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "scene_inputs";
    std::filesystem::create_directories(folder);
    ImageF heights{2, 2, {}};
    for (const float height : {-4.0f, -4.0f, 2.0f, 2.0f})
      heights.pixels.insert(heights.pixels.end(), {height, 0.0f, 0.0f, 1.0f});
    write_exr(folder / "bed.exr", heights);
    heights.pixels[8] = std::numeric_limits<float>::quiet_NaN();
    write_exr(folder / "nan.exr", heights);
    Image8 paint{1, 1, 4, {188, 0, 255, 128}};
    write_png(folder / "paint.png", paint);
    test::GltfMaker maker;
    const int places = maker.floats("VEC3", {-10, 3, -10, 10, 3, -10, 10, 3, 10, -10, 3, 10});
    const int numbers = maker.indices(5123, {0, 1, 2, 0, 2, 3});
    maker.primitives =
        R"({"attributes":{"POSITION":)" + std::to_string(places) + R"(},"indices":)" + std::to_string(numbers) + "}";
    const std::vector<std::uint8_t> bytes = maker.glb();
    std::ofstream(folder / "plane.glb", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    return (folder / "s.json").string();
  }();
  return file;
}

std::vector<InputSpec> read(const std::string& text, const std::vector<std::string>& effects = every) {
  Faults thrown;
  return read_inputs(parse_located_json(text, scene_file()), effects, scene_file(), thrown);
}
// Without the file's name, so that messages can be read.
std::string fault_of(const std::string& text, const std::vector<std::string>& effects = every) {
  try {
    read(text, effects);
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind(scene_file(), 0), 0u) << message;
    return message.substr(scene_file().size());
  }
  return "";
}
glm::vec4 at(InputTarget to, const std::vector<InputSpec>& specs, double x, double z, double time = 0.0) {
  return Inputs(to, specs).value({x, z}, 0.0, time, glm::vec4(0.0f));
}

// Control: any key that is read into another member, or not at all, fails here; seen with the turn of rectangles left
// out.
TEST(SceneInputs, EveryKindIsReadAndGivesWhatItSays) {
  const auto specs = read(R"([
    {"to": "level", "kind": "spline", "points": [[0, 0], {"at_m": [100, 0], "value": 8, "width_m": 30}], "width_m": 20, "value": 12, "blend": "replace", "feather_m": 2, "order": -3},
    {"to": "clip", "kind": "rectangle", "at_m": [500, 0], "size_m": [2, 40], "turn_deg": 90, "value": 1, "weight": 0.5},
    {"to": "foam", "kind": "ellipse", "at_m": [0, 500], "size_m": 20, "value": 3, "follow_waves": true},
    {"to": "flow", "kind": "vortex", "at_m": [1000, 0], "core_m": 4, "swirl_mps": 2, "inflow_mps": 0.5},
    {"to": "sea_depth", "kind": "shape", "file": "plane.glb", "at_m": [0, 1000], "turn_deg": 45, "scale": 2, "from": "height", "value": -50},
    {"to": "sea_depth", "kind": "texture", "file": "bed.exr", "at_m": [0, -1000], "size_m": [100, 200], "scale": 10, "offset": 1, "channels": "r"},
    {"to": "albedo", "kind": "texture", "file": "paint.png", "at_m": [0, 0], "size_m": 10},
    {"to": "shadow", "kind": "trail", "keys": [{"time_s": 5, "at_m": [0, 0]}, {"time_s": 15, "at_m": [100, 0]}], "radius_m": 3, "life_s": 20, "value": [0.5, 1]}
  ])");
  ASSERT_EQ(specs.size(), 8u);
  EXPECT_EQ(specs[0].order, -3);
  EXPECT_EQ(specs[0].blend, InputBlend::replace);
  EXPECT_EQ(specs[0].where, scene_file() + ":2: inputs[0]");
  EXPECT_NEAR(at(InputTarget::level, specs, 0.0, 0.0).x, 12.0, 1e-5);
  EXPECT_NEAR(at(InputTarget::level, specs, 100.0, 12.0).x, 8.0, 1e-5);
  EXPECT_NEAR(at(InputTarget::clip, specs, 518.0, 0.0).x, 0.5, 1e-6);
  EXPECT_EQ(at(InputTarget::foam, specs, 0.0, 509.0).x, 3.0f);
  EXPECT_TRUE(specs[2].follow_waves);
  EXPECT_EQ(specs[3].feather_m, 20.0) << "half of ten cores";
  EXPECT_NEAR(at(InputTarget::flow, specs, 1000.0, -4.0).x, 2.0, 1e-5);
  EXPECT_NEAR(at(InputTarget::flow, specs, 1000.0, -4.0).y, 0.5, 1e-5);
  EXPECT_NEAR(at(InputTarget::sea_depth, specs, 0.0, 1027.0).x, -44.0, 1e-4) << "a corner of the turned square";
  EXPECT_NEAR(at(InputTarget::sea_depth, specs, 0.0, -1090.0).x, -39.0, 1e-4);
  EXPECT_NEAR(at(InputTarget::sea_depth, specs, 0.0, -910.0).x, 21.0, 1e-4);
  const glm::vec4 paint = at(InputTarget::albedo, specs, 0.0, 0.0);
  EXPECT_NEAR(paint.x, 0.5029 * 128 / 255, 1e-4) << "sRGB 188 is half as bright as white";
  EXPECT_NEAR(paint.z, 128.0 / 255, 1e-4);
  EXPECT_NEAR(paint.w, 128.0 / 255, 1e-4);
  EXPECT_EQ(glm::vec2(at(InputTarget::shadow, specs, 50.0, 0.0, 10.0)), glm::vec2(0.5f, 1.0f));
}

// Volumes have a place with its height, are turned in space and take the water away unless they say otherwise; flat
// inputs know nothing of them. Control seen: roll read as pitch.
TEST(SceneInputs, VolumesAreRead) {
  const auto specs = read(R"([
    {"to": "clip", "kind": "sphere", "at_m": [10, -2, 30], "radius_m": 4},
    {"to": "clip", "kind": "box", "at_m": [100, 1, 0], "size_m": [4, 2, 9], "round_m": 0.5, "turn_deg": 90, "order": 2},
    {"to": "clip", "kind": "capsule", "at_m": [200, 0, 0], "radius_m": 1, "length_m": 8, "pitch_deg": 90},
    {"to": "clip", "kind": "cylinder", "at_m": [300, 0, 0], "radius_m": 1, "length_m": 8, "roll_deg": 90, "value": 0}
  ])");
  ASSERT_EQ(specs.size(), 4u);
  EXPECT_TRUE(Inputs(InputTarget::clip, specs).empty());
  const ClipVolumes volumes(specs);
  EXPECT_TRUE(volumes.clipped({10.0, -5.9, 30.0}, false));
  EXPECT_FALSE(volumes.clipped({10.0, 2.1, 30.0}, false));
  EXPECT_TRUE(volumes.clipped({104.4, 1.0, 0.0}, false));
  EXPECT_FALSE(volumes.clipped({104.4, 1.9, 0.0}, false)) << "its edges are round";
  EXPECT_TRUE(volumes.clipped({200.0, 0.0, 3.9}, false)) << "it lies along z";
  EXPECT_FALSE(volumes.clipped({303.9, 0.5, 0.0}, true)) << "it lies along x, and lets the water be";
  EXPECT_TRUE(volumes.clipped({300.0, 1.1, 0.0}, true));
}

// Control: names taken relative to the working directory find neither file.
TEST(SceneInputs, APictureOfDataIsReadAsItsBytesStand) {
  const auto specs = read(R"([{"to": "clip", "kind": "texture", "file": "paint.png", "at_m": [0, 0], "size_m": 10},
    {"to": "clip", "kind": "texture", "file": ")" +
                          (std::filesystem::path(scene_file()).parent_path() / "paint.png").string() +
                          R"(", "at_m": [50, 0], "size_m": 10}])");
  EXPECT_NEAR(at(InputTarget::clip, specs, 0.0, 0.0).x, 188.0 / 255, 1e-6);
  EXPECT_NEAR(at(InputTarget::clip, specs, 50.0, 0.0).x, 188.0 / 255, 1e-6);
  EXPECT_EQ(std::get<TextureInput>(specs[0].shape).image->width, 1);
}

// Control: a place of the input's own line for that of its value puts points[1] on line 1.
TEST(SceneInputs, FaultsNameLineKeyValueRangeAndRemedy) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({})", ":1: inputs: an object is not a list; write \"inputs\": [{\"to\": \"level\", ...}]"},
      {"[\n3]", ":2: inputs[0]: 3 is not an object; write {\"key\": value, ...}"},
      {R"([{}])",
       ":1: the key 'inputs[0].to' is missing; add \"to\": level, sea_depth, flow, foam, clip, albedo, shadow, "
       "dynamic_waves or gerstner"},
      {R"([{"to": "levl"}])",
       ":1: inputs[0].to: 'levl' is not known (did you mean 'level'?); take level, sea_depth, flow, foam, clip, "
       "albedo, shadow, dynamic_waves or gerstner"},
      {R"([{"to": "level"}])",
       ":1: the key 'inputs[0].kind' is missing; add \"kind\": spline, ellipse, rectangle, vortex, shape, texture, "
       "trail, sphere, box, capsule or cylinder"},
      {"[{\"to\": \"level\",\n\"kind\": 3}]",
       ":2: inputs[0].kind: 3 is not known; take spline, ellipse, rectangle, vortex, shape, texture, trail, sphere, "
       "box, capsule or cylinder"},
      {"[{\"to\": \"level\", \"kind\": \"ellipse\",\n\"weight\": 2}]",
       ":2: inputs[0].weight: 2 is out of range; give a number from 0 to 1"},
      {R"([{"to": "level", "kind": "ellipse", "order": 1.5}])",
       ":1: inputs[0].order: 1.5 is not a whole number; give a whole number"},
      {R"([{"to": "level", "kind": "ellipse", "follow_waves": 1}])",
       ":1: inputs[0].follow_waves: 1 is neither true nor false; give true or false"},
      {R"([{"to": "level", "kind": "ellipse", "blend": "mix"}])",
       ":1: inputs[0].blend: 'mix' is not known (did you mean 'min'?); take add, replace, scale, min or max"},
      {R"([{"to": "level", "kind": "ellipse"}])", ":1: the key 'inputs[0].at_m' is missing; add \"at_m\": [x, z]"},
      {R"([{"to": "level", "kind": "ellipse", "at_m": [0]}])",
       ":1: inputs[0].at_m: a list of 1 is not a list of 2 numbers; write [x, z]"},
      {R"([{"to": "level", "kind": "ellipse", "at_m": [0, 1e9]}])",
       ":1: inputs[0].at_m[1]: 1000000000 is out of range; give a number from -10000000 to 10000000 m"},
      {R"([{"to": "level", "kind": "ellipse", "at_m": [0, 0], "size_m": 0}])",
       ":1: inputs[0].size_m: 0 is out of range; give a number from 0.001 to 1000000 m"},
      {R"([{"to": "foam", "kind": "ellipse", "at_m": [0, 0], "size_m": 1}])",
       ":1: the key 'inputs[0].value' is missing; add \"value\": the share of the water that foam comes to cover in a "
       "second"},
      {R"([{"to": "foam", "kind": "ellipse", "at_m": [0, 0], "size_m": 1, "value": -1}])",
       ":1: inputs[0].value: -1 is out of range; give a number from 0 to 100 1/s"},
      {R"([{"to": "flow", "kind": "ellipse", "at_m": [0, 0], "size_m": 1, "value": 1}])",
       ":1: inputs[0].value: 1 is not a list of 2 numbers; give flow as many: the water's velocity along x and z"},
      {R"([{"to": "level", "kind": "ellipse", "at_m": [0, 0], "size_m": 1, "value": 1, "radius_m": 2}])",
       ":1: unknown key 'inputs[0].radius_m'; remove it, or take one of: to, kind, weight, blend, order, follow_waves, "
       "at_m, size_m, turn_deg, value and feather_m"},
      {R"([{"to": "level", "kind": "spline", "value": 1}])",
       ":1: the key 'inputs[0].points' is missing; add \"points\": [[x, z], [x, z]]"},
      {"[{\"to\": \"level\", \"kind\": \"spline\", \"value\": 1, \"points\": [[0, 0],\n[1]]}]",
       ":2: inputs[0].points[1]: a list of 1 is not a list of 2 numbers; write [x, z]"},
      {R"([{"to": "level", "kind": "spline", "points": [[0, 0]]}])",
       ":1: the key 'inputs[0].value' is missing; add \"value\": the still water's height above y = 0"},
      {R"([{"to": "level", "kind": "spline", "value": 1, "points": [{"at_m": [0, 0], "with_m": 3}]}])",
       ":1: unknown key 'inputs[0].points[0].with_m' (did you mean 'width_m'?); remove it, or take one of: at_m, "
       "width_m and value"},
      {R"([{"to": "level", "kind": "spline", "value": 1, "points": [], "filled": true}])",
       ":1: inputs[0]: filled: the spline is not closed; add \"closed\": true"},
      {R"([{"to": "level", "kind": "vortex", "at_m": [0, 0]}])",
       ":1: inputs[0]: a vortex is no input of level; give it \"to\": \"flow\""},
      {R"([{"to": "flow", "kind": "vortex", "at_m": [0, 0], "core_m": 9, "reach_m": 8}])",
       ":1: inputs[0].reach_m: 8 is out of range; give a number from 9 to 1000000 m"},
      {R"([{"to": "level", "kind": "trail", "value": 1, "keys": [{"at_m": [0, 0]}]}])",
       ":1: the key 'inputs[0].keys[0].time_s' is missing; add \"time_s\": a number from -1000000000 to 1000000000 s"},
      {"[{\"to\": \"level\", \"kind\": \"trail\", \"value\": 1, \"keys\": [{\"time_s\": 0, \"at_m\": [0, "
       "0]},\n{\"time_s\": 1, \"at_m\": [0, 0], \"tme_s\": 2}]}]",
       ":2: unknown key 'inputs[0].keys[1].tme_s' (did you mean 'time_s'?); remove it, or take one of: time_s and "
       "at_m"},
      {R"([{"to": "level", "kind": "texture", "file": "bed.exr", "at_m": [0, 0], "size_m": 1, "channels": "x"}])",
       ":1: inputs[0]: channels: 'x' does not name 1 of the picture's; give so many letters of r, g, b and a, as "
       "\"r\""},
      {R"([{"to": "level", "kind": "sphere", "at_m": [0, 0, 0], "radius_m": 1}])",
       ":1: inputs[0]: a sphere is no input of level; give it \"to\": \"clip\""},
      {R"([{"to": "clip", "kind": "sphere", "at_m": [0, 0], "radius_m": 1}])",
       ":1: inputs[0].at_m: a list of 2 is not a list of 3 numbers; write [x, height, z]"},
      {"[{\"to\": \"clip\", \"kind\": \"sphere\",\n\"at_m\": [0, 20000, 0], \"radius_m\": 1}]",
       ":2: inputs[0].at_m[1]: 20000 is out of range; give a number from -10000 to 10000 m"},
      {R"([{"to": "clip", "kind": "sphere", "at_m": [0, 0, 0]}])",
       ":1: the key 'inputs[0].radius_m' is missing; add \"radius_m\": a number from 0.001 to 1000000 m"},
      {R"([{"to": "clip", "kind": "box", "at_m": [0, 0, 0], "size_m": [1, 0, 1]}])",
       ":1: inputs[0].size_m[1]: 0 is out of range; give a number from 0.001 to 1000000 m"},
      {R"([{"to": "clip", "kind": "box", "at_m": [0, 0, 0], "size_m": [1, 1, 1], "radius_m": 1}])",
       ":1: unknown key 'inputs[0].radius_m'; remove it, or take one of: to, kind, weight, blend, order, follow_waves, "
       "at_m, turn_deg, pitch_deg, roll_deg, size_m, round_m, value and feather_m"},
      {R"([{"to": "clip", "kind": "cylinder", "at_m": [0, 0, 0], "radius_m": 1, "length_m": 2, "value": 2}])",
       ":1: inputs[0].value: 2 is out of range; give a number from 0 to 1"},
      {R"([{"to": "clip", "kind": "capsule", "at_m": [0, 0, 0], "radius_m": 1, "length_m": 1}])",
       ":1: inputs[0]: length_m: 1 is out of range; give a number from 2 to 4000000 m, twice its radius and more"},
      {R"([{"to": "clip", "kind": "shape", "file": "plane.glb", "from": "hull"}])",
       ":1: inputs[0]: file: 'plane.glb' is not closed: 4 sides of triangles have nothing beside them that faces the "
       "same way; close it, an open boat by a deck, or take another \"from\""},
      {R"([{"to": "level", "kind": "texture", "file": 3, "at_m": [0, 0], "size_m": 1}])",
       ":1: inputs[0].file: 3 is no file's name; write \"name.exr\""},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(fault_of(text), message) << text;
  EXPECT_THAT(
      fault_of("[{\"to\": \"level\", \"kind\": \"texture\",\n\"file\": \"no.exr\", \"at_m\": [0, 0], \"size_m\": 1}]"),
      testing::AllOf(testing::StartsWith(":2: inputs[0].file: "), testing::HasSubstr("no.exr")));
  EXPECT_THAT(fault_of(R"([{"to": "level", "kind": "texture", "file": "nan.exr", "at_m": [0, 0], "size_m": 1}])"),
              testing::AllOf(testing::HasSubstr("nan.exr: 1 of its values are NaN or infinite"),
                             testing::HasSubstr("column 0, row 1")));
  EXPECT_THAT(fault_of(R"([{"to": "level", "kind": "shape", "value": 1, "file": "bed.exr"}])"),
              testing::StartsWith(":1: inputs[0].file: "));
  EXPECT_THAT(fault_of(R"([{"to": "level", "kind": "texture", "file": "plane.glb", "at_m": [0, 0], "size_m": 1}])"),
              testing::HasSubstr("the kind '.glb' is no picture's; give an .exr or a .png"));
}

// Control: without the search in the closure the input is taken, and nobody would ever ask it.
TEST(SceneInputs, AnInputNeedsTheEffectThatItFeeds) {
  const char* text = "[\n{\"to\": \"foam\", \"kind\": \"ellipse\", \"at_m\": [0, 0], \"size_m\": 1, \"value\": 1}]";
  EXPECT_EQ(fault_of(text, {"waves"}),
            ":2: inputs[0].to: the scene does not name the effect 'foam'; add \"foam\" to \"effects\"");
  EXPECT_EQ(fault_of(text, {"foam"}), "");
  EXPECT_EQ(fault_of(text, {"spray"}),
            ":2: inputs[0].to: the scene does not name the effect 'foam'; add \"foam\" to \"effects\"")
      << "spray needs no foam";
}

// Control: Faults that ends an input at its first fault leaves one fault here; an input without a fault is kept.
TEST(SceneInputs, AllFaultsAreTold) {
  Faults faults(true);
  const auto specs = read_inputs(
      parse_located_json("[\n{\"to\": \"level\", \"kind\": \"ellipse\", \"at_m\": [0, 0],\n\"size_m\": -1,\n\"value\": "
                         "1e9},\n{\"to\": \"x\", \"kind\": \"ellipse\"},\n"
                         "{\"to\": \"level\", \"kind\": \"ellipse\", \"at_m\": [0, 0], \"size_m\": 1, \"value\": 1}]",
                         "s.json"),
      every, "s.json", faults);
  EXPECT_EQ(specs.size(), 1u);
  ASSERT_EQ(faults.list().size(), 3u);
  EXPECT_THAT(faults.list()[0].what(), testing::StartsWith("s.json:3: inputs[0].size_m: -1"));
  EXPECT_THAT(faults.list()[1].what(), testing::StartsWith("s.json:4: inputs[0].value: 1000000000"));
  EXPECT_THAT(faults.list()[2].what(), testing::StartsWith("s.json:5: inputs[1].to: 'x'"));
}

// Control: twice the limit when points are read lets all of them be read before they are counted.
TEST(SceneInputs, ThereIsALimit) {
  std::string many = "[", points = "[";
  for (int i = 0; i < 4097; ++i) many += i == 0 ? "1" : ",1";
  for (int i = 0; i < 65537; ++i) points += i == 0 ? "[0,0]" : ",[0,0]";
  EXPECT_EQ(fault_of(many + "]"), ":1: inputs: a list of 4097; give at most 4096");
  EXPECT_EQ(fault_of(R"([{"to": "level", "kind": "spline", "value": 1, "points": )" + points + "]}]"),
            ":1: inputs[0].points: a list of 65537; give at most 65536");
}

// Foam is built: a whole scene with an input of it, and one that gives nothing, which is told by `validate` and is no
// fault. Control: without the remarks passed on to the verdict nothing is said.
TEST(SceneInputs, ASceneHasThemAndValidateSaysWhatGivesNothing) {
  const std::string text = R"({"version": 1, "effects": ["waves", "foam"], "inputs": [
    {"to": "foam", "kind": "spline", "points": [[0, 0], [50, 0]], "value": 1},
    {"to": "foam", "kind": "spline", "points": [[5, 5], [5, 5]], "value": 1}]})";
  const Scene scene = parse_scene(text, scene_file(), "low");
  ASSERT_EQ(scene.inputs.size(), 2u);
  EXPECT_EQ(Inputs(InputTarget::foam, scene.inputs).size(), 1u);
  ASSERT_FALSE(scene.remarks.empty());
  std::ofstream(scene_file()) << text;
  const FileVerdict verdict = validate_file(scene_file());
  EXPECT_TRUE(verdict.faults.empty());
  EXPECT_EQ(verdict.summary, "a scene with 2 effects and 2 inputs");
  EXPECT_EQ(verdict.remarks, scene.remarks);
  EXPECT_EQ(verdict.remarks.back(),
            scene_file() +
                ":3: inputs[1]: a spline of 2 points at 1 place gives nothing; give 2 points or more that lie apart");
  Arguments arguments;
  arguments.files = {scene_file()};
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_validate(arguments), 0);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::EndsWith("seascape: warning: " + verdict.remarks.back() + "\n"));
  testing::internal::GetCapturedStdout();
}

// What nobody asks for yet is said, once for each kind of data; what somebody does, is not.
TEST(SceneInputs, DataThatNobodyAsksForIsSaidToChangeNothing) {
  const char* ellipse = R"({"to": "%", "kind": "ellipse", "at_m": [0, 0], "size_m": 1, "blend": "scale", "value": 1})";
  for (const InputTargetTraits& target : input_targets) {
    std::string one = target.name == "gerstner"
                          ? R"({"to": "%", "kind": "spline", "points": [[0, 0], [9, 0]], "value": 1})"
                          : ellipse;
    one.replace(one.find('%'), 1, target.name);
    const auto specs = read("[" + one + "," + one + "]");
    const std::vector<std::string> remarks = remarks_of(specs);
    ASSERT_EQ(remarks.size(), target.asked ? 0u : 1u) << target.name;
    if (!target.asked) {
      EXPECT_EQ(remarks[0], scene_file() + ":1: inputs[0]: the sea of this version takes no inputs of " +
                                std::string(target.name) + " yet, and this changes nothing; keep it for a later one");
    }
  }
}

}  // namespace
}  // namespace seascape
