// validate tells every fault of every file, with file and place.
#include "app/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/commands.h"
#include "app/scene.h"
#include "engine/image_file.h"

namespace seascape {
namespace {

std::filesystem::path made(const std::string& name, const std::string& text) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / name;
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::vector<std::string> faults_of(const std::filesystem::path& file) {
  std::vector<std::string> result;
  for (const Error& fault : validate_file(file).faults) {
    std::string message = fault.what();
    EXPECT_EQ(message.rfind(file.string(), 0), 0u) << message;
    result.push_back(message.substr(file.string().size()));
  }
  return result;
}

// Control: Faults that throws the first one (collect false) leaves one fault here.
TEST(Validate, EveryFaultOfASceneIsTold) {
  const auto file =
      made("bad_scene.json",
           "{\"version\": 1,\n\"effects\": [\"fom\",\n\"clouds\"],\n\"waves\": {\"chop\": 3,\n\"chp\": 1},\n"
           "\"camera\": {\"pitch_deg\": 100},\n\"msaa\": 3}");
  EXPECT_THAT(
      faults_of(file),
      testing::ElementsAre(testing::HasSubstr(":2: effects: unknown effect 'fom' (did you mean 'foam'?)"),
                           testing::HasSubstr(":3: effects: the effect 'clouds' is not built yet"),
                           testing::HasSubstr(":7: msaa: 3 is not one of the numbers it takes; give 1, 2, 4 or 8"),
                           testing::HasSubstr(":4: waves.chop: 3 is out of range; give a number from 0 to 2"),
                           testing::HasSubstr(":5: unknown key 'waves.chp' (did you mean 'chop'?)"),
                           testing::HasSubstr(":6: camera.pitch_deg: 100 is out of range")));
}

// A fault is told once, with its file: those of settings that fit no sea are found again as remarks are looked for, and
// every point of a spline lacks the same value. Controls seen: remarks of a scene with faults; missing_value() of each.
TEST(Validate, AFaultIsToldOnce) {
  EXPECT_THAT(faults_of(made("particles.json",
                             "{\"version\": 1, \"effects\": [\"waves\", \"wave_particles\"],\n"
                             "\"wave_particles\": {\"tile_m\": 4000}}")),
              testing::ElementsAre(testing::HasSubstr("wave_particles.radius_m (of tile_m 4000): 0.25")));
  EXPECT_THAT(faults_of(made("points.json",
                             "{\"version\": 1, \"effects\": [\"foam\"], \"inputs\": [{\"to\": \"foam\",\n"
                             "\"kind\": \"spline\", \"points\": [[0, 0], [1, 1], [2, 2]]}]}")),
              testing::ElementsAre(testing::HasSubstr("the key 'inputs[0].value' is missing")));
}

TEST(Validate, EveryFaultOfAPathIsTold) {
  const auto file = made("bad_path.json",
                         "{\"keys\": [\n{\"time_s\": 0},\n{\"time_s\": 0, \"position_m\": [0, 1, 0], \"yaw\": 1},\n"
                         "{\"time_s\": 2, \"position_m\": [0, \"1\", 0]}]}");
  EXPECT_THAT(faults_of(file),
              testing::ElementsAre(testing::HasSubstr(":1: the key 'version' is missing"),
                                   testing::HasSubstr(":2: the key 'keys[0].position_m' is missing"),
                                   testing::HasSubstr(":3: unknown key 'keys[1].yaw'"),
                                   testing::HasSubstr(":3: keys[1].time_s: 0 does not come after 0"),
                                   testing::HasSubstr(":4: keys[2].position_m[1]: '1' is not a number")));
}

// Told from a scene by its events, unless it has effects. Controls seen: any file with events taken for a script; a
// script taken for a scene; faults that are thrown.
TEST(Validate, EveryFaultOfAnInputScriptIsTold) {
  EXPECT_THAT(faults_of(made("bad_input.json",
                             "{\"version\": 1, \"rate_hz\": 0,\n\"events\": [{\"time_s\": 1, \"action\": \"swimm\", "
                             "\"value\": 1},\n{\"time_s\": 0, \"state\": \"off\"}]}")),
              testing::ElementsAre(testing::HasSubstr(":1: rate_hz: 0 is out of range"),
                                   testing::HasSubstr(":2: events[0].action: 'swimm' is not known"),
                                   testing::HasSubstr(":3: events[1].time_s: 0 comes before 1")));
  EXPECT_THAT(faults_of(made("events_scene.json", "{\"version\": 1, \"effects\": [\"waves\"], \"events\": []}")),
              testing::ElementsAre(testing::HasSubstr(":1: unknown key 'events'")));
  const std::string script =
      "{\"version\": 1, \"events\": [{\"time_s\": 1, \"left\": null, \"right\": null}, "
      "{\"time_s\": 2.5, \"action\": \"swim\", \"value\": 1}]}";
  EXPECT_EQ(validate_file(made("input.json", script)).summary,
            "an input script of 2.5 s with 2 poses, 1 action and 0 states");
  EXPECT_EQ(
      validate_file(
          made("path_with_actions.json",
               "{\"version\": 1, \"keys\": [{\"time_s\": 0, \"position_m\": [0, 1, 0]}], \"actions\": " + script + "}"))
          .summary,
      "a path of 1 key and 0 s, with 2 poses, 1 action and 0 states");
}

// Control: a switch of kinds that lacks .glb fails here.
TEST(Validate, EveryKindIsRead) {
  for (const char* name : {"broken.json", "broken.gltf", "broken.glb", "broken.png", "broken.exr"}) {
    const auto faults = faults_of(made(name, "not this"));
    ASSERT_EQ(faults.size(), 1u) << name;
    EXPECT_THAT(faults[0], testing::Not(testing::HasSubstr("is not known"))) << name;
  }
  EXPECT_THAT(faults_of(made("notes.txt", "")),
              testing::ElementsAre(testing::HasSubstr("the kind '.txt' is not known")));
  EXPECT_EQ(faults_of("/no/such/scene.json").size(), 1u);
  Image8 image;
  image.width = 2, image.height = 1, image.channels = 4, image.pixels.assign(8, 200);
  const auto png = std::filesystem::path(testing::TempDir()) / "two.PNG";
  write_png(png, image);
  EXPECT_EQ(validate_file(png).summary, "a PNG image of 2x1 pixels");
}

TEST(Validate, WhatIsShippedIsSound) {
  for (const char* kind : {"scenes", "paths"})
    for (const auto& entry : std::filesystem::directory_iterator(content_directory() / kind))
      EXPECT_THAT(faults_of(entry.path()), testing::IsEmpty()) << entry.path();
}

// Control: stopping at the first bad file leaves "second" out of what is printed.
TEST(Validate, AllFilesAreCheckedAndAnyFaultIsExitOne) {
  Arguments arguments;
  arguments.files = {made("first.json", "{").string(), made("second.json", "[]").string(),
                     (content_directory() / "scenes" / "calm.json").string()};
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_validate(arguments), 1);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_THAT(errors, testing::HasSubstr("seascape: " + arguments.files[0] + ":1: not valid JSON"));
  EXPECT_THAT(errors, testing::HasSubstr("seascape: " + arguments.files[1] + ":1: the file holds a list"));
  EXPECT_THAT(testing::internal::GetCapturedStdout(), testing::HasSubstr("calm.json: a scene with 2 effects\n"));
  arguments.files.erase(arguments.files.begin(), arguments.files.begin() + 2);
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_validate(arguments), 0);
  testing::internal::GetCapturedStdout();
}

}  // namespace
}  // namespace seascape
