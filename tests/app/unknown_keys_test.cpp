// No object of a scene, of a camera path or of an input script lets a key pass that it does not know, however deep it
// lies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <set>

#include "app/camera_path.h"
#include "app/input_script_file.h"
#include "app/loop_file.h"
#include "app/scene.h"
#include "app/settings.h"
#include "engine/files.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

// For each object of a valid file, the file with one key more in it. `each`: only of the first and every so many after
// it.
std::vector<std::string> with_an_unknown_key(const std::string& text, std::size_t each = 1) {
  std::vector<std::string> files;
  std::size_t number = 0;
  for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1)) {
    if (number++ % each != 0) continue;
    const bool empty = text[text.find_first_not_of(" \n", at + 1)] == '}';
    files.push_back(text.substr(0, at + 1) + (empty ? "\"stray_key\": 0" : "\"stray_key\": 0, ") + text.substr(at + 1));
  }
  return files;
}

using Parse = std::function<void(const std::string&)>;

// Gives how many objects were tried.
std::size_t expect_refused(const std::string& text, const std::string& name, const Parse& parse, std::size_t each = 1) {
  EXPECT_NO_THROW(parse(text)) << name;
  const std::vector<std::string> files = with_an_unknown_key(text, each);
  for (const std::string& file : files) {
    std::string message = "nothing";
    try {
      parse(file);
    } catch (const Error& error) {
      message = error.what();
    }
    EXPECT_THAT(message, testing::AllOf(testing::HasSubstr("unknown key '"), testing::HasSubstr("stray_key'")))
        << name << " takes a key that it does not know: " << file.substr(file.find("\"stray_key"), 80);
  }
  return files.size();
}

// Every group of settings, and every kind of input that has objects of its own or none.
std::string every_object() {
  std::string text = R"({"version": 1, "effects": ["waves", "foam", "level", "flow", "clip", "sea_depth"], "inputs": [
    {"to": "level", "kind": "spline", "value": 1, "points": [{"at_m": [0, 0]}, {"at_m": [9, 0], "value": 2}]},
    {"to": "foam", "kind": "trail", "value": 1, "keys": [{"time_s": 0, "at_m": [0, 0]}, {"time_s": 9, "at_m": [9, 0]}]},
    {"to": "sea_depth", "kind": "ellipse", "at_m": [0, 0], "size_m": 9, "value": 1},
    {"to": "sea_depth", "kind": "rectangle", "at_m": [0, 0], "size_m": [9, 9], "value": 1},
    {"to": "flow", "kind": "vortex", "at_m": [0, 0]},
    {"to": "clip", "kind": "sphere", "at_m": [0, 0, 0], "radius_m": 1},
    {"to": "clip", "kind": "box", "at_m": [0, 0, 0], "size_m": [1, 1, 1]},
    {"to": "clip", "kind": "capsule", "at_m": [0, 0, 0], "radius_m": 1, "length_m": 9},
    {"to": "clip", "kind": "cylinder", "at_m": [0, 0, 0], "radius_m": 1, "length_m": 9}])";
  std::set<std::string> groups;
  for (const Setting& setting : settings_table()) {
    const std::string key(setting.key), group = key.substr(0, key.find('.'));
    if (group != key && groups.insert(group).second) text += ", \"" + group + "\": {}";
  }
  return text + "}";
}

// Controls seen, each fails here: a trail's keys, a spline's points, an input, a group of settings, a scene, a
// path's keys and a loop without their reader's finish().
TEST(UnknownKeys, AreRefusedInEveryObjectOfAScene) {
  const Parse scene = [](const std::string& text) { (void)parse_scene(text, "s.json", "low"); };
  EXPECT_GT(expect_refused(every_object(), "every object", scene), 25u);
  std::size_t number = 0;
  for (const std::string& name : content_names("scenes")) {
    if (test::sanitized && number++ % 4 != 0) continue;
    const std::string file = content_file(name, "scenes").string();
    expect_refused(
        read_text(file, 1 << 20), file, [&](const std::string& text) { (void)parse_scene(text, file, "low"); },
        test::sanitized ? 40 : 1);
  }
}

TEST(UnknownKeys, AreRefusedInEveryObjectOfAPath) {
  const Parse path = [](const std::string& text) { (void)parse_camera_path(text, "p.json"); };
  EXPECT_EQ(expect_refused(R"({"version": 1, "keys": [{"time_s": 0, "position_m": [0, 2, 0]}], "actions":
    {"version": 1, "events": [{"time_s": 0, "left": {"position_m": [0, 2, 0]}}]}})",
                           "a path with actions", path),
            5u);
  EXPECT_EQ(expect_refused(R"({"version": 1, "keys": [{"time_s": 0, "position_m": [0, 2, 0]},
    {"time_s": 1, "position_m": [0, 2, 0], "orientation": [0, 0, 0, 1]}]})",
                           "a path", path),
            3u);
}

// Controls seen: an event, a hand, the fields of view and the script without their reader's finish().
TEST(UnknownKeys, AreRefusedInEveryObjectOfAnInputScript) {
  EXPECT_EQ(
      expect_refused(R"({"version": 1, "fov_deg": {"left": [-1, 1, 1, -1]}, "events": [
    {"time_s": 0, "head": {"position_m": [0, 2, 0]}, "right": {"position_m": [0, 2, 0]}, "state": "focused"},
    {"time_s": 1, "action": "swim", "value": 1}]})",
                     "an input script", [](const std::string& text) { (void)parse_input_script(text, "i.json"); }),
      6u);
}

TEST(UnknownKeys, AreRefusedInARecordedLoop) {
  const test::TemporaryFolder folder;
  const auto fault = [&](const std::string& text) {
    std::ofstream(folder / "loop.json") << text;
    try {
      (void)read_loop(folder.path());
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string loop = R"({"version": 1, "size_m": 8, "texels": 16, "frames": 16, "fps": 8})";
  EXPECT_THAT(fault(loop), testing::HasSubstr("frame_0000.exr: is missing")) << "it is understood";
  EXPECT_THAT(fault(with_an_unknown_key(loop).front()), testing::HasSubstr("unknown key 'stray_key'"));
}

}  // namespace
}  // namespace seascape
