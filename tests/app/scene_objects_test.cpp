// The things of a scene: what is read, and that every fault names file, line, key, value and remedy.
#include "app/scene_objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/scene.h"
#include "app/validate.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using testing::HasSubstr;

// A folder with a whole and a broken model, beside which the scene lies.
std::filesystem::path folder() {
  static const std::filesystem::path made = [] {
    const std::filesystem::path at = std::filesystem::path(testing::TempDir()) / "scene_objects";
    std::filesystem::create_directories(at);
    std::vector<std::uint8_t> bytes = test::solid_bytes(test::solid_box({0.5f, 0.5f, 0.5f}), "{}");
    const auto write = [&](const char* name) {
      std::ofstream(at / name, std::ios::binary)
          .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    };
    write("box.glb");
    bytes.resize(bytes.size() / 2);
    write("broken.glb");
    return at;
  }();
  return made;
}

std::string scene(const std::string& objects, const std::string& effects = "\"models\"") {
  return "{\"version\": 1, \"effects\": [" + effects + "],\n\"objects\": " + objects + "}";
}

// What loading says first, and that validate says the same, with the file and line.
std::string fault_of(const std::string& text) {
  const std::filesystem::path file = folder() / "s.json";
  std::ofstream(file, std::ios::binary) << text;
  std::string loaded;
  try {
    (void)load_scene(file.string(), "low");
    ADD_FAILURE() << "read: " << text;
  } catch (const Error& error) {
    loaded = error.what();
    EXPECT_FALSE(error.remedy().empty()) << loaded;
  }
  const FileVerdict verdict = validate_file(file);
  EXPECT_TRUE(!verdict.faults.empty() && verdict.faults.front().what() == loaded) << loaded;
  EXPECT_THAT(loaded, testing::StartsWith(file.string() + ":2: "));
  return loaded.substr(std::min(loaded.size(), file.string().size()));
}

// Controls seen: the checks of unknown keys, float, room, whole numbers and the effect, each taken away.
TEST(SceneObjects, FaultsNameFileKeyValueAndRemedy) {
  EXPECT_THAT(fault_of(scene(R"([{"model": "no.glb", "at_m": [0, 0, 0]}])")),
              testing::AllOf(HasSubstr("objects[0].model"), HasSubstr("no.glb")));
  EXPECT_THAT(fault_of(scene(R"([{"model": "broken.glb", "at_m": [0, 0, 0]}])")),
              testing::AllOf(HasSubstr("objects[0].model"), HasSubstr("broken.glb")));
  EXPECT_THAT(fault_of(scene(R"([{"model": "rowing_bot", "at_m": [0, 0, 0]}])")), HasSubstr("rowing_bot"));
  EXPECT_THAT(fault_of(scene(R"([{"model": 3, "at_m": [0, 0, 0]}])")), HasSubstr("is not a model's name"));
  EXPECT_THAT(fault_of(scene(R"([{"at_m": [0, 0, 0]}])")), HasSubstr("'objects[0].model' is missing"));
  EXPECT_THAT(fault_of(scene(R"([{"model": "box.glb"}])")), HasSubstr("'objects[0].at_m' is missing"));
  EXPECT_THAT(fault_of(scene(R"([{"model": "box.glb", "at_m": [0, 0]}])")), HasSubstr("objects[0].at_m"));
  EXPECT_THAT(fault_of(scene(R"([{"model": "box.glb", "at_m": [0, 0, 0], "yaw": 3}])")),
              testing::AllOf(HasSubstr("unknown key 'objects[0].yaw'"), HasSubstr("did you mean 'yaw_deg'?")));
  EXPECT_THAT(fault_of(scene(R"([{"model": "box.glb", "at_m": [0, 0, 0], "scale": 0}])")),
              HasSubstr("objects[0].scale: 0 is out of range"));
  EXPECT_THAT(fault_of(scene(R"([{"model": "box.glb", "at_m": [0, 0, 0], "count": 3}])")), HasSubstr("add \"area_m\""));
  EXPECT_THAT(fault_of(scene(R"([{"model": "box.glb", "at_m": [0, 0, 0], "count": 1.5}])")),
              HasSubstr("1.5 is not a whole number"));
  EXPECT_THAT(fault_of(scene(R"([{"model": "box.glb", "at_m": [0, 0, 0], "float": {}}])")),
              HasSubstr("does not name the effect 'boats'"));
  const auto floating = [&](const std::string& floats) {
    return fault_of(scene(R"([{"model": "box.glb", "at_m": [0, 0, 0], "float": )" + floats + "}]", "\"boats\""));
  };
  EXPECT_THAT(floating("{}"), HasSubstr("box: nobody says how heavy it is"));
  EXPECT_THAT(floating("7"), HasSubstr("objects[0].float: 7 is not an object"));
  EXPECT_THAT(floating(R"({"mass_kg": 0})"), HasSubstr("float.mass_kg: 0 is out of range"));
  EXPECT_THAT(floating(R"({"level": "raft"})"), HasSubstr("float.level: 'raft' is no level"));
  EXPECT_THAT(floating(R"({"throttle": 2})"), HasSubstr("float.throttle: 2 is out of range"));
  EXPECT_THAT(floating(R"({"velocity_mps": [1]})"), HasSubstr("float.velocity_mps"));
  EXPECT_THAT(floating(R"({"moored_m": [[1, 2], 3]})"), HasSubstr("float.moored_m"));
  EXPECT_THAT(floating(R"({"anchored": true})"), HasSubstr("anchored"));
  EXPECT_THAT(fault_of(scene(R"({"model": "box.glb"})")), HasSubstr("is not a list"));
  EXPECT_THAT(fault_of(scene(R"([{"model": "box.glb", "at_m": [0, 0, 0]}])", "\"waves\"")),
              HasSubstr("add \"models\" to its \"effects\""));
}

// Control seen: a known file read as if it were another.
TEST(SceneObjects, AFileIsReadOnceAndThingsAreScattered) {
  const std::string text = scene(R"([{"model": "box.glb", "name": "A", "at_m": [1, 2, 3], "yaw_deg": 90, "scale": 2},
                {"model": "box.glb", "at_m": [50, 0, 0], "count": 40, "area_m": [20, 10], "seed": 5}])");
  const std::string where = (folder() / "s.json").string();
  const Scene first = parse_scene(text, where, "low"), again = parse_scene(text, where, "low");
  const SceneObjects& objects = first.objects;
  ASSERT_EQ(objects.models.size(), 1u);
  ASSERT_EQ(objects.things.size(), 41u);
  EXPECT_EQ(objects.names[0], "A");
  EXPECT_EQ(objects.names[1], "box.glb 1");
  const glm::dvec3 ahead = objects.things[0].pose.orientation * glm::dvec3(0.0, 0.0, -1.0);
  EXPECT_NEAR(ahead.x, 1.0, 1e-9) << "90 degrees clockwise from -z, seen from above";
  EXPECT_EQ(objects.things[0].scale, 2.0);
  for (std::size_t i = 1; i < objects.things.size(); ++i) {
    const glm::dvec3 off = objects.things[i].pose.position_m - glm::dvec3(50.0, 0.0, 0.0);
    EXPECT_LE(std::abs(off.x), 10.0);
    EXPECT_LE(std::abs(off.z), 5.0);
    EXPECT_EQ(off, again.objects.things[i].pose.position_m - glm::dvec3(50.0, 0.0, 0.0));
    for (std::size_t k = 1; k < i; ++k)
      EXPECT_GT(glm::length(objects.things[k].pose.position_m - objects.things[i].pose.position_m), 0.2);
  }
}

}  // namespace
}  // namespace seascape
