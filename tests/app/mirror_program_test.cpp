// The desktop's mirror of a headset, on a virtual display: what its window shows is read as a screen reads it. Controls
// are named beside each test; each was seen to fail.
#include "app/mirror.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/frame.h"
#include "app/mirror_layout.h"
#include "platform/headless.h"
#include "tests/support/gpu/blockade.h"
#include "tests/support/gpu/desk.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/x11.h"  // last: X11's macros take common names

namespace seascape {
namespace {

using test::wait_until;
using test::WindowManager;
using test::X11Reader;

constexpr int side = 320;  // of an eye's picture, pixels

Image8 cut(const Image8& image, const PixelBox& box) {
  Image8 part{box.most.x - box.least.x, box.most.y - box.least.y, 3, {}};
  for (int y = box.least.y; y < box.most.y; ++y)
    for (int x = box.least.x; x < box.most.x; ++x) {
      const std::uint8_t* pixel = &image.pixels[std::size_t((y * image.width + x) * image.channels)];
      part.pixels.insert(part.pixels.end(), pixel, pixel + 3);
    }
  return part;
}

Scene small_scene() {
  Scene scene = load_scene("calm", "low");
  for (const auto& [key, value] :
       std::initializer_list<std::pair<const char*, const char*>>{{"msaa", "1"},
                                                                  {"waves.cascades", "3"},
                                                                  {"stereo.eye_distance_m", "0.2"},
                                                                  {"mirror.overlay", "false"},
                                                                  {"time.scale", "0"}})
    set_from_text(scene.settings, key, value, "test");
  return scene;
}

// A sea for two eyes on a desktop of its own, and its mirror.
class MirrorOnADesktop : public test::DeskTest {
 protected:
  void TearDown() override {
    mirror_.reset();
    experience_.reset();
    copy_.reset();
    DeskTest::TearDown();
  }
  void make(MirrorView view) {
    Scene scene = small_scene();
    scene.settings.mirror.view = view;
    ExperienceOptions options{side, side, 2};
    options.seen_elsewhere = true;
    experience_ = std::make_unique<Experience>(*device_, shaders_, scene, options);
    experience_->before_build([this] {
      if (mirror_) mirror_->let_go();
    });
    copy_ = std::make_unique<PictureCopy>(*device_);
    WindowOptions window;
    window.width = side;
    window.height = 200;
    mirror_ = std::make_unique<Mirror>(*system_, *device_, shaders_, window);
    mirror_->set_title("A head");
    window_ = display_.xdotool({"search", "--name", "A head"});
    window_ = window_.substr(0, window_.find('\n'));
    ASSERT_FALSE(window_.empty());
  }
  ::Window window() const { return std::stoul(window_); }
  void look(MirrorView view) {
    Settings settings = experience_->scene().settings;
    settings.mirror.view = view;
    experience_->apply(settings);
  }
  Viewpoint seen() const {
    HeadlessOptions eyes;
    eyes.width = eyes.height = side;
    eyes.eye_distance_m = 0.2;
    return Headless(eyes).viewpoint(head_);
  }
  // A frame of the headset as explore draws it, `later_s` after the last; what the mirror says of it.
  struct Done {
    bool due, copied;
    std::uint64_t commands;
  };
  Done frame(double later_s = 1.0) {
    now_s_ += later_s;
    input_ = mirror_->begin(now_s_, experience_->scene().settings.mirror);
    Frame& frame = experience_->frame();
    frame.begin();
    draw_frame(*experience_, frame, seen(), 3.0);
    Done done{mirror_->due(), mirror_->wants_copy(), 0};
    if (done.copied) copy_->record(frame, experience_->picture());
    frame.submit();
    done.commands = frame.counts().commands;
    mirror_->follow(head_, later_s);
    const PanelFacts facts;
    if (mirror_->due()) mirror_->show({*copy_, *experience_, 3.0, experience_->scene().settings, facts, ""});
    frame.finish();
    return done;
  }
  // Frames until the window shows a picture.
  bool shows(const Image8& wanted) {
    const X11Reader reader(display_, window());
    Image8 seen;
    const bool there = wait_until([&] {
      frame();
      const Image8 all = reader.read();
      if (all.width != wanted.width || all.height != wanted.height) return false;
      seen = cut(all, {{0, 0}, {all.width, all.height}});
      return test::differing_pixels(seen, wanted) == 0;
    });
    if (!there && !seen.pixels.empty()) test::leave(seen, "mirror_seen"), test::leave(wanted, "mirror_wanted");
    return there;
  }
  Image8 eye(int which) const {
    experience_->frame().finish();
    return read_picture(*device_, experience_->picture().colour(), {side, side}, which);
  }
  Image8 middle_of_eye(int which) const { return cut(eye(which), {{0, 60}, {side, 260}}); }

  ShaderLibrary shaders_{ShaderLibrary::default_directory()};
  std::unique_ptr<Experience> experience_;
  std::unique_ptr<PictureCopy> copy_;
  std::unique_ptr<Mirror> mirror_;
  Pose head_{{0.0, 1.7, 0.0}, orientation_from_angles({20.0, -5.0, 0.0})};
  std::string window_;
  Input input_;
  double now_s_ = 0.0;
};

// The window has the size of the middle of an eye's picture, and later of both, so that every pixel is one of theirs.
// Controls seen: the right eye shown for the left; a part from the picture's upper edge; halves exchanged.
TEST_F(MirrorOnADesktop, ShowsEitherEyeAndBoth) {
  make(MirrorView::left);
  frame();
  const Image8 left = middle_of_eye(0), right = middle_of_eye(1);
  EXPECT_GT(test::difference(left, right).mean, 1e-3) << "the control: eyes that see alike";
  EXPECT_TRUE(shows(left));
  look(MirrorView::right);
  EXPECT_TRUE(shows(right));
  look(MirrorView::both);
  display_.xdotool({"windowsize", window_, "640", "200"});
  Image8 both{640, 200, 3, {}};
  for (int y = 0; y < 200; ++y)
    for (const Image8* one : {&left, &right})
      both.pixels.insert(both.pixels.end(), one->pixels.begin() + y * side * 3,
                         one->pixels.begin() + (y + 1) * side * 3);
  EXPECT_TRUE(shows(both));
}

// Between two of its pictures, while it is minimised, closed or off, the mirror costs the headset's frame no command.
// Controls seen: due_ without the rate; without Window::shows(); a copy in every frame.
TEST_F(MirrorOnADesktop, CopiesOnlyWhatItIsAboutToShow) {
  make(MirrorView::left);
  const auto first_due = [&] {
    Done done{};
    EXPECT_TRUE(wait_until([&] {
      done = frame();
      return done.due;
    }));
    return done;
  };
  const Done shown = first_due();
  EXPECT_TRUE(shown.copied);
  Done between{};
  for (int i = 0; i < 40; ++i) {  // in which its window is free again
    between = frame(0.0);
    EXPECT_FALSE(between.due || between.copied);
  }
  EXPECT_LT(between.commands, shown.commands);

  WindowManager manager(display_);
  const auto idle = [&](const char* why) {
    frame();  // takes in the event
    for (int i = 0; i < 20; ++i) {
      const Done done = frame();
      EXPECT_FALSE(done.due || done.copied) << why;
      EXPECT_EQ(done.commands, between.commands) << why;
    }
  };
  manager.set_iconic(window(), true);
  idle("minimised");
  manager.set_iconic(window(), false);
  EXPECT_TRUE(first_due().copied);
  look(MirrorView::off);
  idle("off");
  look(MirrorView::right);
  EXPECT_TRUE(first_due().copied);
}

// Controls seen: a mirror that goes on drawing; closed() that another view does not end.
TEST_F(MirrorOnADesktop, ClosesAloneAndComesBack) {
  make(MirrorView::left);
  frame();
  const Image8 left = middle_of_eye(0);
  EXPECT_TRUE(shows(left));
  WindowManager(display_).close_button(window());
  EXPECT_TRUE(wait_until([&] {
    frame();
    return mirror_->take_closed();
  }));
  EXPECT_TRUE(mirror_->closed());
  frame();
  EXPECT_FALSE(mirror_->take_closed());
  EXPECT_FALSE(frame().due);
  EXPECT_EQ(display_.xdotool({"search", "--onlyvisible", "--name", "A head"}), "");
  mirror_->open();
  EXPECT_TRUE(shows(left));
  WindowManager(display_).close_button(window());
  EXPECT_TRUE(wait_until([&] {
    frame();
    return mirror_->take_closed();
  }));
  look(MirrorView::right);
  EXPECT_TRUE(shows(middle_of_eye(1)));
}

// While its picture is on the GPU and cannot go on, the headset's frames do: the mirror is not due, and nothing of it
// is waited for. Controls seen: ready() of frames that are on the GPU; begin() that waits for its last picture.
TEST_F(MirrorOnADesktop, HoldsNobodyUpThatItsPictureTakesLong) {
  make(MirrorView::left);
  frame();
  const Image8 left = middle_of_eye(0);
  ASSERT_TRUE(shows(left));
  ASSERT_TRUE(wait_until([&] {
    input_ = mirror_->begin(now_s_ += 1.0, experience_->scene().settings.mirror);
    return mirror_->due();
  }));
  test::Blockade blockade(*device_);  // what is submitted from now waits
  const PanelFacts facts;
  mirror_->show({*copy_, *experience_, 3.0, experience_->scene().settings, facts, ""});
  for (int i = 0; i < 10; ++i) {
    mirror_->begin(now_s_ += 1.0, experience_->scene().settings.mirror);
    EXPECT_FALSE(mirror_->due());
    if (mirror_->due()) mirror_->show({*copy_, *experience_, 3.0, experience_->scene().settings, facts, ""});
  }
  EXPECT_TRUE(blockade.lift()) << "something waited for it";
  look(MirrorView::right);
  EXPECT_TRUE(shows(middle_of_eye(1)));
}

// While the view from behind is on the GPU, the headset's next frames do not write the waves that it reads. Control
// seen: wave images without a copy for it.
TEST_F(MirrorOnADesktop, SeesTheWavesOfItsOwnFrame) {
  make(MirrorView::third);
  std::optional<Image8> before;
  ASSERT_TRUE(wait_until([&] {
    frame();
    before = mirror_->third();
    return before.has_value();
  }));
  ASSERT_TRUE(wait_until([&] {
    mirror_->begin(now_s_ += 1.0, experience_->scene().settings.mirror);
    return mirror_->due();
  }));
  test::Blockade blockade(*device_);
  const PanelFacts facts;
  mirror_->show({*copy_, *experience_, 3.0, experience_->scene().settings, facts, ""});
  for (const double time_s : {3.5, 4.0}) {
    experience_->frame().begin();
    draw_frame(*experience_, experience_->frame(), seen(), time_s);
    experience_->frame().submit();
  }
  EXPECT_TRUE(blockade.lift());
  EXPECT_EQ(test::differing_pixels(*mirror_->third(), *before), 0);
}

// What is asked for at the desk comes as input; the panel's key is the desk's own. Controls seen: begin() that returns
// no input; one that leaves the panel's key in it.
TEST_F(MirrorOnADesktop, TakesKeys) {
  make(MirrorView::left);
  frame();
  display_.xdotool({"windowfocus", "--sync", window_});
  std::vector<Action> pressed;
  const auto press = [&](const char* key, Action wanted) {
    display_.xdotool({"key", key});
    return wait_until(
        [&] {
          frame();
          for (const Press& one : input_.pressed) pressed.push_back(one.action);
          return std::count(pressed.begin(), pressed.end(), wanted) > 0;
        },
        5.0);
  };
  EXPECT_TRUE(press("p", Action::screenshot));
  display_.xdotool({"key", "F1"});
  EXPECT_TRUE(press("r", Action::record));
  EXPECT_EQ(std::count(pressed.begin(), pressed.end(), Action::menu), 0);
  const Image8 left = middle_of_eye(0);
  const X11Reader reader(display_, window());
  EXPECT_TRUE(wait_until([&] {
    frame();
    return test::differing_pixels(cut(reader.read(), {{0, 0}, {side, 200}}), left) > 5000;
  })) << "the panel lies over the picture";
}

// The view from behind is the sea of the headset's frame, as another viewer of the same sea draws it from there; and
// the headset's pictures are the same to the bit with it. It goes and comes back when the experience is built anew.
// Controls seen: a camera half a metre beside; before_build() not asked.
TEST_F(MirrorOnADesktop, LooksFromBehind) {
  make(MirrorView::left);
  frame();
  const Image8 before[2] = {eye(0), eye(1)};
  look(MirrorView::third);
  std::optional<Image8> third;
  const auto comes = [&] {
    return wait_until([&] {
      frame();
      third = mirror_->third();
      return third.has_value();
    });
  };
  ASSERT_TRUE(comes());
  EXPECT_EQ(third->width, side / 2);
  EXPECT_EQ(third->height, 100);
  for (int i = 0; i < 6; ++i) {
    const Done done = frame();
    EXPECT_FALSE(done.copied);
    for (int which = 0; which < 2; ++which)
      EXPECT_EQ(test::differing_pixels(eye(which), before[which]), 0) << "frame " << i;
  }
  third = mirror_->third();

  test::ShotOptions alone{.scene = "calm", .preset = "low", .width = side / 2, .height = 100};
  alone.set = {{"msaa", "1"}, {"waves.cascades", "3"}};
  test::SeaShot shot(*device_, alone);
  OutsideCamera camera;
  camera.step(head_, {}, 0.0);
  const double water_m = experience_->sea()
                             ->view_at(3.0, SeaDetail::felt)
                             .query({camera.pose(-1e9).position_m.x, camera.pose(-1e9).position_m.z})
                             .height_m;
  Pose at = camera.pose(water_m);
  const double off = test::difference(*third, shot.picture(at, 3.0)).mean;
  at.position_m.x += 0.5;
  EXPECT_LT(off, 0.3 * test::difference(*third, shot.picture(at, 3.0)).mean);

  Settings other = experience_->scene().settings;
  other.render.shape = FrameShape::desktop;  // builds the experience anew
  experience_->apply(other);
  EXPECT_FALSE(mirror_->third());
  EXPECT_TRUE(comes());
}

}  // namespace
}  // namespace seascape
