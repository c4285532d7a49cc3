// Explore in a window of a virtual display, driven by keys and mouse as a person does. Controls are named beside each
// test; each was seen to fail.
#include <gtest/gtest.h>

#include <csignal>
#include <set>
#include <thread>

#include "app/camera_path.h"
#include "engine/image_file.h"
#include "platform/window.h"
#include "tests/support/desktop.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/run_program.h"

#include "tests/support/x11.h"  // last: X11's macros take common names

namespace seascape {
namespace {

using test::Background;
using test::run_program;
using test::TemporaryFolder;
using test::VirtualDisplay;
using test::wait_until;
using test::WindowManager;
using test::X11Reader;

std::size_t colours_of(const Image8& image) {
  std::set<std::uint32_t> colours;
  for (std::size_t i = 0; i + 2 < image.pixels.size(); i += std::size_t(image.channels))
    colours.insert(std::uint32_t(image.pixels[i]) << 16 | std::uint32_t(image.pixels[i + 1]) << 8 |
                   image.pixels[i + 2]);
  return colours.size();
}

// Of a picture of 200 rows the upper 140, 320 columns from `left` on, three colours.
Image8 upper_rows(const Image8& image, int left) {
  Image8 part{320, 140, 3, {}};
  for (int y = 0; y < part.height; ++y)
    for (int x = left; x < left + part.width; ++x) {
      const std::uint8_t* pixel = &image.pixels[std::size_t((y * image.width + x) * image.channels)];
      part.pixels.insert(part.pixels.end(), pixel, pixel + 3);
    }
  return part;
}

// The program in a small window, with validation on: it ends with exit 1 if there was any message.
class OnADesktop : public testing::Test {
 protected:
  void start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{SEASCAPE_BUILD_DIR "/seascape",
                                   "explore",
                                   "--display",
                                   "window",
                                   "--scene",
                                   "calm",
                                   "--preset",
                                   "low",
                                   "--set",
                                   "msaa=1",
                                   "--set",
                                   "waves.cascades=3",
                                   "--size",
                                   "320x200",
                                   "--out",
                                   (folder_ / "out").string()};
    words.insert(words.end(), more.begin(), more.end());
    program_ =
        std::make_unique<Background>(words, std::vector<std::string>{display_.variable(), "SEASCAPE_VALIDATION=1"});
    ASSERT_TRUE(wait_until([&] {
      window_ = display_.xdotool({"search", "--onlyvisible", "--name", "^Seascape: "});
      window_ = window_.substr(0, window_.find('\n'));
      return !window_.empty() || !program_->running();
    }));
    ASSERT_FALSE(window_.empty()) << program_->err();
    focus();
  }
  void focus() { display_.xdotool({"windowfocus", "--sync", window_}); }
  void key(const std::string& name) { display_.xdotool({"key", name}); }
  // What the program says last after this many lines that begin so: their remainder, or "" if they do not come.
  std::string line(const std::string& beginning, std::size_t which) {
    std::string found;
    wait_until([&] {
      found.clear();
      const std::string text = program_->out();
      std::size_t seen = 0, at = 0;
      for (std::size_t end = text.find('\n'); end != std::string::npos; at = end + 1, end = text.find('\n', at))
        if (text.compare(at, beginning.size(), beginning) == 0 && seen++ == which)
          found = text.substr(at + beginning.size(), end - at - beginning.size());
      return !found.empty() || !program_->running();
    });
    return found;
  }
  Image8 screenshot() {
    key("p");
    const std::string file = line("screenshot: ", screenshots_++);
    EXPECT_NE(file, "") << program_->err();
    return file.empty() ? Image8{} : read_png(file);
  }
  // Screenshots until one has this size: a resize takes a frame or two to arrive.
  Image8 screenshot_of(int width, int height) {
    Image8 image;
    for (int i = 0; i < 10 && (image.width != width || image.height != height) && program_->running(); ++i)
      image = screenshot();
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    return image;
  }
  void expect_clean_end() {
    EXPECT_EQ(program_->exit_code(), 0) << program_->err();
    EXPECT_EQ(program_->err().find("alidation"), std::string::npos) << program_->err();
  }

  TemporaryFolder folder_;
  VirtualDisplay display_;
  std::unique_ptr<Background> program_;
  std::string window_;
  std::size_t screenshots_ = 0;
};

// Controls: without the W key's row in key_from the path stays at its place; without WindowEvents::moved the yaw stays;
// without the call of resize the second picture keeps its size; with a swapchain image left in colour_target for
// presenting, validation makes the exit status 1.
TEST_F(OnADesktop, KeysAndMouseMoveRecordPhotographResizeAndClose) {
  start();
  const Image8 first = screenshot_of(320, 200);
  EXPECT_GT(colours_of(first), 500u);

  key("r");
  EXPECT_EQ(line("path: ", 0), "recording");
  display_.xdotool({"keydown", "w"});
  display_.xdotool({"mousemove", "--window", window_, "280", "100", "mousedown", "3"});
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  for (int i = 0; i < 10; ++i) {
    display_.xdotool({"mousemove_relative", "20", "0"});
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
  }
  display_.xdotool({"mouseup", "3"});
  display_.xdotool({"keyup", "w"});
  key("r");
  const std::string file = line("path: ", 1);
  ASSERT_NE(file, "") << program_->err();
  const CameraPath path = load_camera_path(file);
  ASSERT_GE(path.keys.size(), 3u);
  const Pose from = path.keys.front().pose, to = path.keys.back().pose;
  EXPECT_GT(glm::dot(to.position_m - from.position_m, from.orientation * glm::dvec3(0, 0, -1)),
            1.0);  // forward, at 12 m/s
  EXPECT_GT(angles_from_orientation(to.orientation).yaw_deg, angles_from_orientation(from.orientation).yaw_deg + 5.0);

  key("3");
  EXPECT_EQ(line("travel: ", 0), "ride the waves");
  key("space");
  EXPECT_EQ(line("time: ", 0), "stopped");
  key("v");
  EXPECT_EQ(line("debug view: ", 0), "holes");
  key("F1");

  display_.xdotool({"windowsize", window_, "420", "260"});
  EXPECT_GT(colours_of(screenshot_of(420, 260)), 10u);
  display_.xdotool({"windowsize", window_, "1", "1"});
  screenshot_of(1, 1);
  display_.xdotool({"windowsize", window_, "320", "200"});
  screenshot_of(320, 200);
  key("Escape");
  expect_clean_end();
}

// Minimised or taken off the screen, the window draws nothing, its path's clock stands, and it comes back with its
// picture. Controls: a Window whose begin() always says should_render, or an Explorer that counts hidden time, fails
// here.
TEST_F(OnADesktop, hard_42_a_hidden_window_draws_nothing_and_comes_back) {
  start();
  WindowManager manager(display_);
  const ::Window window = std::stoul(window_);
  screenshot_of(320, 200);
  key("r");
  EXPECT_EQ(line("path: ", 0), "recording");
  const auto began = std::chrono::steady_clock::now();
  const auto wait = [] { std::this_thread::sleep_for(std::chrono::seconds(2)); };
  manager.set_iconic(window, true);  // minimised
  wait();
  manager.set_iconic(window, false);
  screenshot_of(320, 200);
  display_.xdotool({"windowunmap", "--sync", window_});  // taken off the screen
  wait();
  display_.xdotool({"windowmap", "--sync", window_});
  focus();
  screenshot_of(320, 200);
  key("r");
  const std::string file = line("path: ", 1);
  const double all_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  ASSERT_NE(file, "") << program_->err();
  // The path's clock stands still meanwhile: of both times more than half must be missing, however slow this machine
  // is.
  EXPECT_LT(load_camera_path(file).duration_s(), all_s - 2.5);
  manager.close_button(window);
  expect_clean_end();
}

// Control seen: a loop of frames that does not look for a signal is ended by it, without recorded_001.json.
TEST_F(OnADesktop, ASignalKeepsWhatWasRecorded) {
  start();
  key("r");
  ASSERT_EQ(line("path: ", 0), "recording") << program_->err();
  program_->send(SIGTERM);
  EXPECT_EQ(program_->exit_code(), 128 + SIGTERM);
  EXPECT_NE(program_->err().find("seascape: explore: stopped by SIGTERM; "), std::string::npos) << program_->err();
  EXPECT_FALSE(load_camera_path((folder_ / "out/recorded_001.json").string()).keys.empty());
}

// What the window itself shows: on the left the left eye's picture and on the right the right one's, which are what a
// mono replay draws from the places of those eyes. The sea stands still; the panel is off, and no message reaches the
// upper rows, of which the lower half is near water. Controls seen: the window's eyes swapped (the planted fault
// window_eyes_swapped), layer 0 shown twice, and the eyes themselves swapped.
TEST_F(OnADesktop, TwoViewsStandSideBySide) {
  constexpr double apart_m = 0.2;
  const std::vector<std::string> still{"--set", "time.scale=0"};
  start({"--views", "2", "--set", "stereo.eye_distance_m=0.2", still[0], still[1]});
  key("F1");
  key("p");
  const std::string left = line("screenshot: ", 0);
  ASSERT_NE(left, "") << program_->err();
  Image8 seen[2] = {read_png(left), read_png(left.substr(0, left.size() - 9) + "_right.png")};
  EXPECT_EQ(seen[0].width, 320);
  for (Image8& eye : seen) eye = upper_rows(eye, 0);
  EXPECT_GT(test::difference(seen[0], seen[1]).mean, 1e-3) << "the control: eyes that see alike";
  // A moment later, for the panel has to go first.
  const X11Reader reader(display_, std::stoul(window_));
  Image8 shown[2];
  EXPECT_TRUE(wait_until([&] {
    const Image8 window = reader.read();
    for (int eye = 0; eye < 2; ++eye) shown[eye] = upper_rows(window, 320 * eye);
    return test::differing_pixels(shown[0], seen[0]) == 0 && test::differing_pixels(shown[1], seen[1]) == 0;
  })) << "the window shows another picture than the screenshot: left "
      << test::leave(shown[0], "window_left") << ", right " << test::leave(shown[1], "window_right");
  key("Escape");
  expect_clean_end();

  // Each eye's place by hand: half the distance to either side of the head where explore begins (content/scenes/calm).
  const double yaw = glm::radians(10.0);
  CameraPath path;
  for (const int side : {-1, 1}) {
    const double off = 0.5 * side * apart_m;
    path.keys.push_back({double(path.keys.size()),
                         {{off * std::cos(yaw), 1.7, off * std::sin(yaw)}, orientation_from_angles({10.0, -2.0, 0.0})},
                         0.0});
  }
  save_camera_path(path, folder_ / "eyes.json");
  const auto alone = run_program({"replay",
                                  "--scene",
                                  "calm",
                                  "--preset",
                                  "low",
                                  "--set",
                                  "msaa=1",
                                  "--set",
                                  "waves.cascades=3",
                                  still[0],
                                  still[1],
                                  "--size",
                                  "320x200",
                                  "--views",
                                  "1",
                                  "--path",
                                  (folder_ / "eyes.json").string(),
                                  "--fps",
                                  "1",
                                  "--frames",
                                  "2",
                                  "--out",
                                  (folder_ / "alone").string()});
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  for (int eye = 0; eye < 2; ++eye) {
    const auto far_from = [&](int other) {
      const std::string file = "alone/frame_000" + std::to_string(other) + ".png";
      return test::difference(shown[eye], upper_rows(read_png(folder_ / file), 0)).mean;
    };
    EXPECT_LT(far_from(eye), 0.3 * far_from(1 - eye)) << "the window's " << (eye == 0 ? "left" : "right");
  }
}

// Before a window `auto` is measured the first time, and known the second. Control: remember() left out of
// calibrated_preset.
TEST_F(OnADesktop, AutoMeasuresTheDeviceOnce) {
  const std::vector<std::string> words{
      "explore",  "--display", "window", "--scene", "calm", "--size", "64x48", "--out", (folder_ / "out").string(),
      "--frames", "3"};
  const std::vector<std::string> environment{display_.variable(), "XDG_CACHE_HOME=" + folder_.path().string()};
  for (const bool first : {true, false}) {
    const auto ran = run_program(words, environment);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.err.find("auto: measuring") != std::string::npos, first) << ran.err;
    EXPECT_NE(ran.err.find(" for 64x48, one picture, at "), std::string::npos) << ran.err;
  }
}

// The part of minimising that no virtual display without a window manager shows. Control: && for any of its || fails.
TEST(Window, hard_42_shows_only_with_an_area_on_the_screen) {
  EXPECT_TRUE(window_shows(1, 1, false, true));
  EXPECT_FALSE(window_shows(0, 0, false, true));
  EXPECT_FALSE(window_shows(640, 0, false, true));
  EXPECT_FALSE(window_shows(640, 480, true, true));
  EXPECT_FALSE(window_shows(640, 480, false, false));
}

// Control: without the check of glfwInit the program ends otherwise than in one line.
TEST(Explore, SaysWhatToDoWithoutADisplay) {
  const auto none = run_program({"explore", "--display", "window"}, {"DISPLAY=:9876", "WAYLAND_DISPLAY="});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_EQ(none.err.rfind("seascape: display: no display can be reached", 0), 0u) << none.err;
  EXPECT_NE(none.err.find("--display headless"), std::string::npos);
  const auto headset = run_program({"explore", "--display", "headset"}, {"XR_RUNTIME_JSON=/nowhere/runtime.json"});
  EXPECT_EQ(headset.exit_code, 1);
  EXPECT_EQ(headset.err.rfind("seascape: OpenXR: ", 0), 0u) << headset.err;
  EXPECT_EQ(std::count(headset.err.begin(), headset.err.end(), '\n'), 1) << headset.err;
  EXPECT_NE(headset.err.find("--display window"), std::string::npos) << headset.err;
}

// Control: `auto` that always takes a window fails here.
TEST(Explore, DrawsWithoutADisplay) {
  const TemporaryFolder folder;
  const auto result = run_program({"explore", "--scene", "calm", "--preset", "low", "--set", "msaa=1", "--size",
                                   "160x120", "--frames", "2", "--out", (folder / "out").string()},
                                  {"DISPLAY=", "WAYLAND_DISPLAY=", "SEASCAPE_VALIDATION=1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Image8 image = read_png(folder / "out/explore.png");
  EXPECT_EQ(image.width, 160);
  EXPECT_GT(colours_of(image), 500u);
}

}  // namespace
}  // namespace seascape
