// Explore in a headset beside a desktop with its mirror. Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "app/explorer.h"
#include "engine/image_file.h"
#include "platform/headless.h"
#include "tests/support/gpu/desk.h"
#include "tests/support/gpu/picture.h"

#include "tests/support/x11.h"  // last: X11's macros take common names

namespace seascape {
namespace {

using test::TemporaryFolder;
using test::WindowManager;
using Desk = test::DeskTest;

constexpr int side = 320;  // of an eye's picture, pixels

// Each overlay has widgets of its own, whatever another one does between. Controls seen:
// begin() without its context, end() without it.
TEST_F(Desk, OverlaysLiveTogether) {
  WindowOptions options;
  options.waits = false;
  auto first_window = std::make_unique<Window>(*system_, *device_, options);
  auto first = first_window->make_overlay();
  Window second_window(*system_, *device_, options);
  const auto second = second_window.make_overlay();
  const auto widgets = [](Overlay& overlay, float width) {
    overlay.begin(true);
    ImGui::SetNextWindowSize({width, 50.0f});
    ImGui::Begin("one");
    const float is = ImGui::GetWindowWidth();
    ImGui::End();
    return is;
  };
  for (int i = 0; i < 3; ++i) {
    first_window->begin();
    second_window.begin();
    EXPECT_EQ(widgets(*first, 111.0f), 111.0f);
    EXPECT_EQ(widgets(*second, 222.0f), 222.0f);
    first->end();
    second->end();
  }
  first.reset();
  first_window.reset();
  second_window.begin();
  EXPECT_EQ(widgets(*second, 222.0f), 222.0f);
  second->end();
}

// Stands for a headset: it tracks a head, lends its images and takes them back, which are red from then on.
class OnAHead final : public Display {
 public:
  OnAHead(Device& device, std::function<bool(int frame)> script) : device_(device), script_(std::move(script)) {
    ImageSpec spec{side, side, 2};
    spec.format = VK_FORMAT_R8G8B8A8_SRGB;
    spec.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                 VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    image_ = Image(device, "lent", spec);
    lent_ = std::make_shared<LentImages>(LentImages{side, side, {image_.get()}, {}});
  }
  const char* name() const override { return "a head"; }
  int views() const override { return 2; }
  bool tracks_head() const override { return true; }
  std::optional<Pose> head() const override { return Pose{{0.0, 1.7, 0.0}}; }
  DisplayFrame begin() override {
    DisplayFrame frame;
    frame.closed = !script_(frame_++);
    frame.time_s = frame_ / 72.0;
    frame.period_s = 1.0 / 72.0;
    frame.width = frame.height = side;
    frame.lent = lent_;
    return frame;
  }
  Viewpoint viewpoint(const Pose& carrier) const override {
    HeadlessOptions eyes;
    eyes.width = eyes.height = side;
    return Headless(eyes).viewpoint(composed(carrier, *head()));
  }
  void end(Frame& frame, const RenderTarget* picture, const Image*) override {
    if (!picture) return;
    frame.submit();
    frame.finish();
    shown_ = read_picture(device_, picture->colour(), {side, side}, 0);
    device_.run_now([&](VkCommandBuffer commands) {
      constexpr VkClearColorValue red{{1.0f, 0.0f, 0.0f, 1.0f}};
      constexpr VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 2};
      BarrierBatch barriers;
      barriers.add(picture->colour(), Access::transfer_write, true);
      barriers.record(commands);
      vkCmdClearColorImage(commands, image_.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &red, 1, &all);
    });
  }
  const Image8& shown() const { return shown_; }

 private:
  Device& device_;
  std::function<bool(int)> script_;
  Image image_;
  std::shared_ptr<const LentImages> lent_;
  Image8 shown_;
  int frame_ = 0;
};

// Explore in a headset while someone stands at the desk: keys there keep pictures and a path, go through the mirror's
// views, and closing its window is not the end. Controls seen: a screenshot read from the picture after its frame (all
// red); input_ without the desk's; an Explorer that ends with the mirror's window.
TEST_F(Desk, ExploreServesHeadAndDesk) {
  const TemporaryFolder folder;
  const std::vector<std::string> words{"explore",
                                       "--scene",
                                       "calm",
                                       "--preset",
                                       "low",
                                       "--set",
                                       "msaa=1",
                                       "--set",
                                       "waves.cascades=3",
                                       "--set",
                                       "time.scale=0",
                                       "--out",
                                       (folder / "out").string()};
  const Arguments arguments = parse_arguments(words);
  Program program;
  program.device = std::move(device_);
  program.preset = "low";
  program.scene = scene_from(arguments, "low");
  enum { opening, keeping, recording, going_round, from_behind, closing, after } step = opening;
  int since = 0;
  std::string window;
  bool done = false;
  const auto next = [&](auto to) {
    step = to;
    since = 0;
  };
  const auto exists = [&](const char* name) { return std::filesystem::exists(folder / "out" / name); };
  const auto kept_of_third = [&] {
    const std::filesystem::directory_iterator files(folder / "out");
    return std::any_of(begin(files), end(files),
                       [](const auto& file) { return file.path().string().ends_with("_third.png"); });
  };
  // Again and again, for a busy machine loses keys.
  const auto press_every = [&](int frames, const char* key) {
    if ((since - 1) % frames != 0) return;
    display_.xdotool({"windowfocus", "--sync", window});
    display_.xdotool({"key", key});
  };
  const auto script = [&](int) {
    ++since;
    if (since > 3000) return false;
    switch (step) {
      case opening:
        window = display_.xdotool({"search", "--onlyvisible", "--name", "mirror"});
        window = window.substr(0, window.find('\n'));
        if (!window.empty()) next(keeping);
        break;
      case keeping:
        press_every(50, "p");
        if (exists("screenshot_001_right.png")) next(recording);
        break;
      case recording:
        press_every(50, "r");  // begins and ends
        if (exists("recorded_001.json")) next(going_round);
        break;
      case going_round:
        // Three presses lead to the view from behind, which is drawn some frames later.
        press_every(since < 4 ? 1 : 700, "m");
        press_every(50, "p");
        if (kept_of_third()) next(from_behind);
        break;
      case from_behind:
        WindowManager(display_).close_button(std::stoul(window));
        next(closing);
        break;
      case closing:
        if (display_.xdotool({"search", "--onlyvisible", "--name", "mirror"}).empty()) next(after);
        break;
      case after:
        done = since > 10;
        return !done;
    }
    return true;
  };
  {
    OnAHead display(*program.device, script);
    Explorer(arguments, program, display, system_.get()).run();
  }
  EXPECT_TRUE(done) << "it stopped at step " << step;
  ASSERT_TRUE(exists("screenshot_001_left.png"));
  const Image8 kept = read_png(folder / "out/screenshot_001_left.png");
  EXPECT_EQ(kept.width, side);
  EXPECT_LT(test::count_colour(kept, 255, 0, 0), 10);
  EXPECT_GT(test::statistics(kept).deviation, 1.0);
  device_ = std::move(program.device);
}

}  // namespace
}  // namespace seascape
