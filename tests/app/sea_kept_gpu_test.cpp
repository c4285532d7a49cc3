// The sea outlives what draws it: a change of the waves, a rebuild of the drawing and a device that is lost in
// mid-frame leave it as it was.
#include <chrono>
#include <cstring>
#include <thread>

#include "app/frame.h"
#include "app/sea_spec.h"
#include "platform/headless.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {
namespace {

using test::pose;

class SeaKept : public test::GpuTest {};

// Drifts with the water that it feels and presses it.
class Drifter : public SeaActor {
 public:
  void step(SeaStep& step) override {
    const QueryAnswer water = step.felt().query(at_m_, {.footprint_m = 1.0});
    at_m_ += step.dt_s * (glm::dvec2(0.6, -0.4) + glm::dvec2(water.normal.x, water.normal.z));
    step.press({.place_m = at_m_, .velocity_mps = {0.6, -0.4}, .length_m = 2.0, .head_m = 0.1 + 0.1 * water.height_m});
  }
  std::uint64_t hash() const override {
    std::uint64_t x, z;
    std::memcpy(&x, &at_m_.x, 8), std::memcpy(&z, &at_m_.y, 8);
    return x * 31u + z;
  }

 private:
  glm::dvec2 at_m_{1.0, -2.0};
};

Scene pressed_scene() {
  Scene scene = load_scene("open_sea", "low");
  scene.effects = {"waves", "dynamic_waves", "foam", "spray"};
  for (const auto& [key, value] : {std::pair("dynamic_waves.resolution", "64"), std::pair("dynamic_waves.levels", "3"),
                                   std::pair("dynamic_waves.rain_per_m2_s", "0.05"),
                                   std::pair("dynamic_waves.settle_s", "0"), std::pair("waves.resolution", "64")})
    set_from_text(scene.settings, key, value, "test");
  return scene;
}

struct Felt {
  std::uint64_t hash;
  double height_m, slope;
  bool operator==(const Felt&) const = default;
};
Felt felt(Sea& sea) {
  const QueryAnswer answer = sea.view_at(sea.time_s(), SeaDetail::felt).query({3.0, 7.0});
  return {sea.hash(), answer.height_m, answer.normal.x};
}

// Asks for another sea and waits until its waves are made, beside the frames.
void change(Sea& sea, const SeaState& state, const glm::dvec3& at_m) {
  const std::uint64_t before = sea.waves_version();
  sea.change(state, 0.4);
  for (int i = 0; i < 4000 && sea.waves_version() == before; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    sea.advance(sea.time_s(), at_m);
  }
  ASSERT_GT(sea.waves_version(), before);
}

// Drawn on two devices, the first of which goes in mid-frame while a view is held, with a rebuild and a change of the
// sea between, against a sea that nobody draws: state and felt water equal to the bit. Controls seen: a sea made anew
// with the drawing; a change that another quality of the picture ends at once.
TEST_F(SeaKept, ThroughAChangeARebuildAndADeviceThatIsLost) {
  const Scene scene = pressed_scene();
  const Pose head = pose({0.0, 2.0, 5.0}, 10.0, -15.0);
  const auto drawn = std::make_shared<Sea>(sea_spec(scene)), alone = std::make_shared<Sea>(sea_spec(scene));
  for (const auto& sea : {drawn, alone}) sea->add(std::make_shared<Drifter>());
  SeaState windier = scene.settings.sea;
  windier.wind_speed_mps += 4.0;
  const auto moment = [](int i) { return 5.0 + i / 36.0; };
  const ExperienceOptions options{.width = 64, .height = 36, .views = 1};
  const auto frame = [&](Experience& experience, int i, bool submits) {
    HeadlessOptions display;
    display.width = 64, display.height = 36, display.views = 1;
    experience.frame().begin();
    (void)water_at_camera(experience, head.position_m, moment(i));
    draw_frame(experience, experience.frame(), Headless(display).viewpoint(head), moment(i));
    if (submits) experience.frame().submit(), experience.frame().finish();
    alone->advance(moment(i), head.position_m);
    EXPECT_EQ(felt(*drawn), felt(*alone)) << "frame " << i;
  };
  SeaView held;
  double held_m = 0.0;
  {
    Device device{DeviceOptions{}};
    ShaderLibrary shaders;
    Experience experience(device, shaders, scene, options, drawn);
    EXPECT_EQ(experience.sea(), drawn);
    for (int i = 0; i < 20; ++i) frame(experience, i, true);
    Settings other = scene.settings;
    other.waves.cascades = 3;  // the picture's alone
    other.water.anisotropy = 2;
    experience.apply(other);
    EXPECT_EQ(experience.builds(), 2u);
    EXPECT_EQ(experience.sea(), drawn);
    for (int i = 20; i < 30; ++i) frame(experience, i, true);
    for (Sea* sea : {drawn.get(), alone.get()}) change(*sea, windier, head.position_m);
    for (int i = 30; i < 36; ++i) frame(experience, i, true);
    held = drawn->view_at(drawn->time_s(), SeaDetail::felt);
    held_m = held.query({3.0, 7.0}).height_m;
    frame(experience, 36, false);  // recorded, and then the device is gone
  }
  Device device{DeviceOptions{}};
  ShaderLibrary shaders;
  Experience experience(device, shaders, scene, options, drawn);
  EXPECT_EQ(experience.sea(), drawn);
  EXPECT_EQ(felt(*drawn), felt(*alone)) << "as it was";
  for (int i = 37; i < 60; ++i) frame(experience, i, true);
  EXPECT_EQ(held.query({3.0, 7.0}).height_m, held_m);
  EXPECT_FALSE(drawn->changing());
}

}  // namespace
}  // namespace seascape
