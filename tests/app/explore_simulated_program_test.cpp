// Explore in the simulated headset, whose person a script plays, and what of OpenXR is loaded. Controls are named
// beside each test; each was seen to fail.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "app/camera_path.h"
#include "app/input_script_file.h"
#include "engine/files.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::ProgramResult;
using test::run_program;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

constexpr double rate_hz = 32.0;

// Times of frames are exact, and a picture takes a hundredth of a second.
InputScript small_script(std::vector<InputEvent> events) {
  InputScript script;
  script.width = 48;
  script.height = 40;
  script.rate_hz = rate_hz;
  script.events = std::move(events);
  return script;
}

InputEvent head_at(int frame, glm::dvec3 position_m, const ViewAngles& looks = {}) {
  return {frame / rate_hz, TrackerEvent{Tracker::head, Pose{position_m, orientation_from_angles(looks)}}};
}
InputEvent state(int frame, HeadsetState became) { return {frame / rate_hz, became}; }
// Held for some frames.
void hold(std::vector<InputEvent>& events, int frame, int frames, Action action, double value = 1.0) {
  events.push_back({frame / rate_hz, ActionEvent{action, value}});
  events.push_back({(frame + frames) / rate_hz, ActionEvent{action, 0.0}});
}

class ExploreSimulated : public testing::Test {
 protected:
  // With validation on: exit 1 if there was any message.
  ProgramResult explore(std::vector<InputEvent> events, const std::string& out = "out",
                        const std::vector<std::string>& more = {}) {
    std::stable_sort(events.begin(), events.end(),
                     [](const InputEvent& a, const InputEvent& b) { return a.time_s < b.time_s; });
    const std::filesystem::path file = folder_ / "input.json";
    std::ofstream(file) << input_script_text(small_script(std::move(events)));
    return explore_file(file, out, more);
  }
  ProgramResult explore_file(const std::filesystem::path& file, const std::string& out,
                             const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"explore",          "--display", "simulated",   "--scene", "calm",
                                   "--preset",         "low",       "--set",       "msaa=1",  "--set",
                                   "waves.cascades=3", "--input",   file.string(), "--out",   (folder_ / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words, {"SEASCAPE_VALIDATION=1"});
  }
  std::vector<std::string> files(const std::string& out = "out") const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / out))
      if (entry.path().extension() == ".png") names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  // Where the head was as the recording began and as it ended, around what was done from frame 10 on.
  std::pair<Pose, Pose> moved(std::vector<InputEvent> events, int until_frame,
                              const std::vector<std::string>& more = {}) {
    if (std::none_of(events.begin(), events.end(), [](const InputEvent& event) {
          const auto* tracker = std::get_if<TrackerEvent>(&event.what);
          return tracker && tracker->tracker == Tracker::head;
        }))
      events.push_back(head_at(0, {0.3, 1.7, -0.2}));
    hold(events, 6, 2, Action::record);
    hold(events, until_frame, 2, Action::record);
    const std::string out = "moved_" + std::to_string(++moves_);
    const ProgramResult result = explore(std::move(events), out, more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const CameraPath path = load_camera_path((folder_ / out / "recorded_001.json").string());
    EXPECT_GT(path.keys.size(), 1u);
    EXPECT_NEAR(path.duration_s(), (until_frame - 6) / rate_hz, 1.5 / rate_hz);
    return {path.keys.front().pose, path.keys.back().pose};
  }
  TemporaryFolder folder_;
  int moves_ = 0;
};

double yaw_deg(const Pose& pose) { return angles_from_orientation(pose.orientation).yaw_deg; }
double turned_deg(const std::pair<Pose, Pose>& moved) {
  return std::remainder(yaw_deg(moved.second) - yaw_deg(moved.first), 360.0);
}
// How far to its right, up and back the head went, as it looked at the beginning.
glm::dvec3 went(const std::pair<Pose, Pose>& moved) {
  return glm::conjugate(moved.first.orientation) * (moved.second.position_m - moved.first.position_m);
}

// The frames that were asked for, of both eyes, of those that show anything; and the same again to the byte. Controls:
// frames counted from 1; the sea's time by a clock.
TEST_F(ExploreSimulated, WritesThePicturesOfTheRightFrames) {
  std::vector<InputEvent> events{head_at(0, {0.0, 1.7, 0.0}), head_at(9, {0.0, 1.7, 0.0}), head_at(16, {2.0, 2.5, 1.0}),
                                 state(7, HeadsetState::off), state(10, HeadsetState::focused)};
  const ProgramResult first = explore(events, "first", {"--every", "4"}),
                      again = explore(events, "again", {"--every", "4"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(again.exit_code, 0) << again.err;
  const std::vector<std::string> expected{"frame_0000_left.png",  "frame_0000_right.png", "frame_0004_left.png",
                                          "frame_0004_right.png", "frame_0012_left.png",  "frame_0012_right.png",
                                          "frame_0016_left.png",  "frame_0016_right.png"};
  ASSERT_EQ(files("first"), expected);
  ASSERT_EQ(files("again"), expected);
  for (const std::string& name : expected) {
    EXPECT_EQ(read_bytes(folder_ / "first" / name), read_bytes(folder_ / "again" / name)) << name;
    const Image8 picture = read_png(folder_ / "first" / name);
    EXPECT_EQ(picture.width, 48) << name;
    EXPECT_EQ(picture.height, 40) << name;
    EXPECT_GT(test::statistics(picture).deviation, 5.0) << name;
  }
  const auto picture = [&](const char* name) { return read_png(folder_ / "first" / name); };
  EXPECT_GT(test::differing_pixels(picture("frame_0000_left.png"), picture("frame_0004_left.png")), 20);  // waves move
  EXPECT_GT(test::differing_pixels(picture("frame_0012_left.png"), picture("frame_0016_left.png")), 200);
  // Without --every there is none; with --frames that many are drawn, however long the script is.
  EXPECT_EQ(explore(events, "none").exit_code, 0);
  EXPECT_TRUE(files("none").empty());
  EXPECT_EQ(explore(events, "five", {"--every", "1", "--frames", "5"}).exit_code, 0);
  EXPECT_EQ(files("five").size(), 10u);
}

// With headset.symmetric each eye is shown the same as without; what is kept of the pictures is wider, and black where
// neither lens nor field lets anything be seen. Controls: the setting not handed to the headset; what is hidden not
// handed to the frame; the eye's part begun at the picture's own edge.
TEST_F(ExploreSimulated, DrawsBothEyesWithOneField) {
  std::vector<InputEvent> events{head_at(0, {0.0, 1.7, 0.0}), head_at(12, {0.5, 1.9, 0.2})};
  hold(events, 8, 2, Action::screenshot);
  EXPECT_EQ(explore(events, "own", {"--every", "4"}).exit_code, 0);
  const ProgramResult one = explore(events, "one", {"--every", "4", "--set", "headset.symmetric=true"});
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(files("own"), files("one"));
  const auto picture = [&](const char* from, const char* name) { return read_png(folder_ / from / name); };
  for (const char* name : {"frame_0004_left.png", "frame_0004_right.png", "frame_0012_left.png"}) {
    const Image8 a = picture("own", name), b = picture("one", name);
    ASSERT_EQ(a.pixels.size(), b.pixels.size()) << name;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(int(a.pixels[i]) - int(b.pixels[i]));
    EXPECT_LT(sum, 0.5 * double(a.pixels.size())) << name;
  }
  for (const char* name : {"screenshot_001_left.png", "screenshot_001_right.png"}) {
    EXPECT_EQ(picture("own", name).width, 48);
    const Image8 wide = picture("one", name);
    ASSERT_EQ(wide.width, 53) << name;  // 2 tan 50 to either side, of which tan 50 + tan 45 are 48 pixels
    int black = 0, in_part = 0;
    for (int i = 0; i < wide.width * wide.height; ++i) {
      const std::uint8_t* pixel = &wide.pixels[std::size_t(4 * i)];
      if (pixel[0] + pixel[1] + pixel[2] != 0) continue;
      const int x = i % wide.width;
      ++black;
      in_part += std::string_view(name).find("left") != std::string_view::npos ? x < 48 : x >= 5;
    }
    EXPECT_EQ(black, 5 * wide.height) << name;
    EXPECT_EQ(in_part, 0) << name;
  }
}

// One turns about one's own head, wherever it stands. Controls: the carrier turned about its own middle; the sign.
TEST_F(ExploreSimulated, TurnsAboutTheHead) {
  std::vector<InputEvent> events;
  hold(events, 10, 3, Action::snap_turn);
  const auto snapped = moved(events, 30);
  EXPECT_NEAR(turned_deg(snapped), 30.0, 1e-4);
  EXPECT_LT(glm::length(went(snapped)), 1e-5);
  events.clear();
  hold(events, 10, 2, Action::snap_turn, -1.0);
  hold(events, 14, 2, Action::snap_turn, -1.0);
  EXPECT_NEAR(turned_deg(moved(events, 30)), -60.0, 1e-4);
}

// Controls: the turn of a frame not times its length; the carrier turned about its own middle.
TEST_F(ExploreSimulated, TurnsForAsLongAsItIsHeld) {
  std::vector<InputEvent> events;
  hold(events, 10, 8, Action::turn, 1.0);
  const auto turned = moved(events, 30);
  EXPECT_NEAR(turned_deg(turned), 60.0 * 8 / rate_hz, 1e-3);
  EXPECT_LT(glm::length(went(turned)), 1e-5);
}

// One moves the way one looks, also where the head is turned in the room. Controls: move_z with its sign; the head's
// yaw left out.
TEST_F(ExploreSimulated, MovesTheWayTheHeadLooks) {
  for (const double yaw : {0.0, 70.0}) {
    std::vector<InputEvent> events{head_at(0, {0.3, 1.7, -0.2}, {yaw, 0.0, 0.0})};
    hold(events, 10, 16, Action::move_z, -1.0);
    const glm::dvec3 way = went(moved(events, 40));
    EXPECT_LT(way.z, -0.3) << yaw;
    EXPECT_NEAR(way.x, 0.0, 1e-3) << yaw;
    EXPECT_NEAR(way.y, 0.0, 1e-3) << yaw;
  }
  std::vector<InputEvent> events;
  hold(events, 10, 16, Action::move_x, 1.0);
  EXPECT_GT(went(moved(events, 40)).x, 0.3);
}

// The head goes where the hand pointed, a deck's height over the water. Controls: the head's own direction taken; the
// jump made when it is pressed, with the hand still down.
TEST_F(ExploreSimulated, TeleportsWhereTheHandPoints) {
  const auto hand = [](int frame, double pitch_deg) {
    return InputEvent{
        frame / rate_hz,
        TrackerEvent{Tracker::right, Pose{{0.2, 1.2, -0.4}, orientation_from_angles({25.0, pitch_deg, 0.0})}}};
  };
  std::vector<InputEvent> events{hand(0, -80.0), hand(14, -80.0), hand(16, -6.0)};
  hold(events, 10, 10, Action::teleport);
  const auto jumped = moved(events, 60);
  EXPECT_NEAR(turned_deg(jumped), 0.0, 1e-4);
  const glm::dvec3 way = went(jumped);
  // 1.2 m over water whose waves are a few decimetres high, at 6 degrees: 11 m away.
  const double far_m = std::hypot(way.x, way.z);
  EXPECT_GT(far_m, 8.0);
  EXPECT_LT(far_m, 15.0);
  EXPECT_NEAR(glm::degrees(std::atan2(way.x, -way.z)), 25.0, 3.0);  // seen from the hand, which is half a metre off
  EXPECT_NEAR(jumped.second.position_m.y, 1.7, 0.6);
}

// Without hands one swims ahead, at a metre a second where one looks, with the eyes just above the waves; let go of it,
// one is back at the height at which one flew. Controls: the head's yaw left out; the eyes at deck height; no climb.
TEST_F(ExploreSimulated, SwimsAheadWithoutHands) {
  const InputEvent head = head_at(0, {0.3, 1.7, -0.2}, {70.0, -20.0, 0.0});
  std::vector<InputEvent> events{head};
  hold(events, 10, 96, Action::swim);
  const auto swum = moved(events, 80);
  const glm::dvec3 way =
      glm::conjugate(heading(swum.first.orientation)) * (swum.second.position_m - swum.first.position_m);
  const double swum_s = 70.0 / rate_hz;
  EXPECT_NEAR(way.z, -(swum_s - (1.0 - std::exp(-2.0 * swum_s)) / 2.0), 1.5 / rate_hz);
  EXPECT_NEAR(way.x, 0.0, 1e-3);
  EXPECT_GT(swum.second.position_m.y, -0.2);  // calm's waves are a few decimetres high
  EXPECT_LT(swum.second.position_m.y, 0.7);
  std::vector<InputEvent> briefly{head};
  hold(briefly, 10, 40, Action::swim);
  EXPECT_NEAR(moved(briefly, 130).second.position_m.y, 1.7, 1e-2);
}

// Both hands pull back under water and come ahead over it, three strokes of 1.4 m/s. Controls: a hand in the air that
// pulls; the head's own movement not taken off.
TEST_F(ExploreSimulated, HandsPullThroughTheWater) {
  const auto strokes = [&](double below_eyes_m) {
    std::vector<InputEvent> events{head_at(0, {0.0, 1.7, 0.0})};
    for (const Tracker hand : {Tracker::left, Tracker::right})
      for (int stroke = 0; stroke < 3; ++stroke)
        for (const auto& [frame, z_m, low] :
             {std::tuple(0, -0.6, true), {16, 0.1, true}, {17, 0.1, false}, {31, -0.6, false}})
          events.push_back(
              {(50 + 32 * stroke + frame) / rate_hz,
               TrackerEvent{hand, Pose{{hand == Tracker::left ? -0.3 : 0.3, 1.7 - (low ? below_eyes_m : -0.3), z_m}}}});
    hold(events, 10, 200, Action::swim);
    return went(moved(events, 146));
  };
  const glm::dvec3 way = strokes(0.55);
  EXPECT_LT(way.z, -1.2);
  EXPECT_GT(way.z, -4.5);
  EXPECT_NEAR(way.x, 0.0, 0.05);
  EXPECT_NEAR(strokes(-0.3).z, 0.0, 1e-3);
  // Hands that keep with a head that is thrown back and forth do not pull.
  std::vector<InputEvent> nodding;
  for (int frame = 0; frame <= 140; frame += 10) {
    const double z_m = frame % 20 == 0 ? -0.3 : 0.3;
    nodding.push_back(head_at(frame, {0.0, 1.7, z_m}));
    nodding.push_back({frame / rate_hz, TrackerEvent{Tracker::left, Pose{{-0.3, 1.15, z_m - 0.3}}}});
  }
  hold(nodding, 10, 200, Action::swim);
  EXPECT_NEAR(went(moved(nodding, 127)).z, 0.0, 1e-3);  // as far on its way as in frame 6, but for what it swam
}

// What a person sets for himself, from the start. Control: the options not handed on; the settings not.
TEST_F(ExploreSimulated, WhoSitsIsSeatedFromTheStart) {
  const std::vector<std::string> sitting{"--set", "headset.seated=true", "--set", "headset.eye_height_m=1.9"};
  const auto sat = moved({head_at(0, {0.3, 1.2, -0.2}), head_at(40, {0.3, 1.2, -0.2})}, 30, sitting);
  EXPECT_NEAR(sat.first.position_m.y, 1.9, 1e-5);
  EXPECT_NEAR(sat.second.position_m.y, 1.9, 1e-5);
  EXPECT_EQ(explore({head_at(0, {0.0, 1.7, 0.0})}, "half", {"--every", "1", "--set", "headset.scale=0.5"}).exit_code,
            0);
  EXPECT_EQ(read_png(folder_ / "half/frame_0000_left.png").width, 48 / 2);
}

// The middle comes under the head, and ahead of it: the viewer is where the scene begins, but for the head's height.
// Control: Action::recentre not obeyed.
TEST_F(ExploreSimulated, RecentresByAnActionAndByTheRuntime) {
  for (const bool by_action : {true, false}) {
    std::vector<InputEvent> events{head_at(0, {1.0, 1.5, 2.0}, {50.0, 0.0, 0.0})};
    if (by_action)
      hold(events, 10, 2, Action::recentre);
    else
      events.push_back(state(10, HeadsetState::recentred));
    const Pose after = moved(events, 30).second;
    EXPECT_LT(glm::length(after.position_m - glm::dvec3(0.0, 1.5, 0.0)), 1e-5) << by_action;
    EXPECT_NEAR(yaw_deg(after), 10.0, 1e-4) << by_action;  // calm's own
  }
}

// A session that is lost, the runtime's menu, a headset taken off, a person who leaves before the script's end.
// Control: a lost session taken for the end.
TEST_F(ExploreSimulated, GoesThroughAllStates) {
  std::vector<InputEvent> events{head_at(0, {0.0, 1.7, 0.0}),        state(3, HeadsetState::unfocused),
                                 state(5, HeadsetState::focused),    state(7, HeadsetState::lost),
                                 state(14, HeadsetState::recentred), state(20, HeadsetState::closed),
                                 head_at(900, {0.0, 1.7, 0.0})};
  hold(events, 3, 1, Action::snap_turn);  // meant for the runtime's menu
  const ProgramResult result = explore(events, "out", {"--every", "1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("the session is lost"));
  std::vector<std::string> expected;
  for (int frame = 0; frame < 20; ++frame)
    if (frame != 7)
      for (const char* eye : {"left", "right"}) expected.push_back(fmt::format("frame_{:04}_{}.png", frame, eye));
  EXPECT_EQ(files(), expected);
}

// Control: an action of an unknown name let through.
TEST_F(ExploreSimulated, SaysWhatIsWrongWithAScript) {
  const auto error_of = [&](const std::string& text) {
    const std::filesystem::path file = folder_ / "input.json";
    std::ofstream(file) << text;
    const ProgramResult result = explore_file(file, "out");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    return result.err;
  };
  EXPECT_THAT(error_of("{\"version\": 1,\n \"events\": [\n  {\"time_s\": 0, \"action\": \"fly_home\", \"value\": 1}]}"),
              HasSubstr("input.json:3: "));
  EXPECT_THAT(error_of("{\"version\": 1,\n \"size\": \"0x40\"}"), HasSubstr("input.json:2: "));
  EXPECT_THAT(error_of("a poem"), HasSubstr("input.json:1: "));
  const ProgramResult missing = explore_file(folder_ / "missing.json", "out");
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("missing.json"));
}

// Libraries that a command opens, as the loader of the system tells them.
std::string loads(std::vector<std::string> words, int exit_code) {
  const ProgramResult result = run_program(words, {"LD_DEBUG=files", "XR_RUNTIME_JSON=/nonexistent.json"});
  EXPECT_EQ(result.exit_code, exit_code);
  EXPECT_THAT(result.err, HasSubstr("libvulkan")) << words[0];
  return result.err;
}

// Nothing of OpenXR is opened by what shows nothing in a headset, nor by the simulated one. The control: what asks for
// a headset does open it. Another: the loader opened by explore without a display.
TEST_F(ExploreSimulated, OpensOpenXrOnlyWhereAHeadsetIsAskedFor) {
  const std::string out = (folder_ / "out").string();
  const std::vector<std::string> small{"--scene", "calm",     "--preset", "low",   "--set",
                                       "msaa=1",  "--frames", "1",        "--out", out};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.end(), small.begin(), small.end());
    return words;
  };
  EXPECT_THAT(loads(with({"explore", "--display", "headless", "--size", "32x32"}), 0), Not(HasSubstr("openxr")));
  EXPECT_THAT(loads(with({"explore", "--display", "simulated", "--size", "32x32"}), 0), Not(HasSubstr("openxr")));
  EXPECT_THAT(loads(with({"replay", "--size", "32x32", "--views", "2"}), 0), Not(HasSubstr("openxr")));
  EXPECT_THAT(loads(with({"explore", "--display", "headset"}), 1), HasSubstr("libopenxr_loader.so.1"));
}

// One line, at once. Control: XR_LOADER_DEBUG not set, where the loader tells it in four lines of its own.
TEST_F(ExploreSimulated, SaysThatThereIsNoRuntime) {
  const ProgramResult result =
      run_program({"explore", "--display", "headset", "--scene", "calm"}, {"XR_RUNTIME_JSON=/nonexistent.json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "seascape: OpenXR: no headset runtime answers; start the headset's runtime (Monado, SteamVR) and see "
            "`seascape doctor`, or take --display window\n");
}

}  // namespace
}  // namespace seascape
