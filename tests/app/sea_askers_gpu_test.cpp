// Who asks the sea in a frame: camera, picture, foam, spray and culling share its tiles.
#include <map>
#include <mutex>

#include "app/camera_path.h"
#include "app/frame.h"
#include "tests/support/gpu/drawn_tiles.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

using test::SeaShot;

class SeaAskers : public test::GpuTest, public ::testing::WithParamInterface<WavePlace> {};
INSTANTIATE_TEST_SUITE_P(Places, SeaAskers, ::testing::Values(WavePlace::gpu, WavePlace::cpu), test::place_name);

// How a program comes by its frames: explore moves the camera by the water that it feels, replay and capture have a
// path's poses at times of their own.
struct Program {
  const char* name;
  bool feels;
  double fps;
  int frames;
};

// In every scene, in explore, replay and capture, tiles of a time and a detail are computed once, whoever asks; those
// of the picture once a frame where the processor makes them, and never where the GPU does. Control seen: foam stepped
// before spray (storm).
TEST_P(SeaAskers, HaveTilesOfATimeAndADetailMadeOnce) {
  const bool every = test::long_run();
  const Program programs[] = {{"explore", true, 72.0, every ? 12 : 4},
                              {"replay", false, 30.0, every ? 6 : 3},
                              {"capture", false, 90.0, every ? 6 : 3}};
  std::size_t number = GetParam() == WavePlace::cpu ? 0 : 1;  // others each
  for (const std::string scene : {"open_sea", "calm", "storm", "swell", "rain_pool", "gerstner", "baked", "whirlpool",
                                  "lagoon", "rivers", "harbour_clip", "harbour", "still_life"}) {
    if (!test::sampled(number++, 4)) continue;
    SeaShot shot({.scene = scene,
                  .preset = "low",
                  .width = 48,
                  .height = 32,
                  .views = 2,
                  .set = {{"waves.where", test::place_value(GetParam())}}});
    Experience& experience = shot.experience();
    const CameraPath path = load_camera_path(scene);
    std::mutex together;
    std::map<std::pair<std::int64_t, SeaDetail>, int> made;
    experience.sea()->report_tiles_to([&](std::int64_t ticks, SeaDetail detail) {
      const std::scoped_lock lock(together);
      ++made[{ticks, detail}];
    });
    double begin_s = 10.0;
    for (const Program& program : programs) {
      made.clear();
      int drawn = 0;
      for (int i = 0; i < program.frames; ++i) {
        const double time_s = begin_s + i / program.fps;
        const Pose pose = path.at(i / program.fps).pose;
        experience.frame().begin();
        if (program.feels) (void)water_at_camera(experience, pose.position_m, time_s);
        draw_frame(experience, experience.frame(), shot.viewpoint(pose), time_s);
        experience.frame().submit();
        experience.frame().finish();
      }
      for (const auto& [of, times] : made) {
        EXPECT_EQ(times, 1) << scene << ", " << program.name << ": detail " << int(of.second) << " at tick "
                            << of.first;
        drawn += of.second == SeaDetail::drawn;
      }
      EXPECT_EQ(drawn, GetParam() == WavePlace::cpu ? program.frames : 0) << scene << ", " << program.name;
      begin_s += 10.0;
    }
    experience.sea()->report_tiles_to(nullptr);
  }
}

}  // namespace
}  // namespace seascape
