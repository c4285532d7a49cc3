// A new wind while the sea runs: nothing is built, no frame waits, and what has come is what a fresh start draws.
#include <chrono>
#include <thread>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

namespace {

class SeaChanges : public test::GpuTest {};

// Draws frames of time `time_s` until a sea asked for has begun to come: its amplitudes leave the old ones a moment later.
void draw_until_it_begins(test::SeaShot& shot, const Pose& head, double& time_s) {
  const WaveBins before = shot.experience().ocean().bins();
  for (int i = 0; i < 400; ++i) {
    shot.draw(head, time_s);
    const WaveBins& now = shot.experience().ocean().bins();
    for (std::size_t k = 0; k < now.bins.size(); k += 7)
      if (now.bins[k].amplitude != before.bins[k].amplitude) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    time_s += 1e-3;
  }
  FAIL() << "the new sea never came";
}

// Controls: Ocean::update without follow_change never changes the picture; a change that rebuilds makes pipelines.
TEST_F(SeaChanges, GrowIntoWhatAFreshStartDraws) {
  for (const char* place : {"gpu", "cpu"}) {
    SCOPED_TRACE(place);
    const test::ShotOptions common{.scene = "open_sea", .preset = "medium", .width = 96, .height = 54,
                                   .set = {{"waves.where", place}, {"waves.resolution", "64"}, {"waves.change_s", "1.5"}, {"msaa", "1"}}};
    const Pose head = test::pose({0.0, 6.0, 0.0}, 10.0, -10.0);
    test::SeaShot live(common);
    double time_s = 10.0;
    const Image8 before = live.picture(head, time_s);
    const std::uint64_t pipelines = live.device().pipelines_made(), builds = live.experience().builds();
    live.set("waves.wind_speed_mps", "10.5");
    live.set("waves.chop", "0.7");
    EXPECT_TRUE(live.experience().ocean().changing());
    draw_until_it_begins(live, head, time_s);
    const Image8 midway = live.picture(head, time_s + 0.7);
    EXPECT_TRUE(live.experience().ocean().changing());
    const Image8 changed = live.picture(head, time_s + 2.0);
    EXPECT_FALSE(live.experience().ocean().changing());
    EXPECT_EQ(live.device().pipelines_made(), pipelines);
    EXPECT_EQ(live.experience().builds(), builds);
    test::ShotOptions options = common;
    options.set.emplace_back("waves.wind_speed_mps", "10.5");
    options.set.emplace_back("waves.chop", "0.7");
    test::SeaShot fresh(options);
    EXPECT_LE(test::difference(changed, fresh.picture(head, time_s + 2.0)).p99, 4e-3);
    EXPECT_GT(test::difference(changed, before).p99, 4e-3);
    EXPECT_GT(test::differing_pixels(midway, fresh.picture(head, time_s + 0.7)), 0);
    // Back, and to another depth, which is made anew.
    live.set("waves.depth_m", "12");
    EXPECT_FALSE(live.experience().ocean().changing());
    EXPECT_EQ(live.experience().builds(), builds + 1);
  }
}

// Midway both ways of filling the tiles draw one sea. Control: chop left out of WaveCompute::take.
TEST_F(SeaChanges, AreTheSameInBothPlaces) {
  std::vector<Image8> pictures;
  for (const char* place : {"gpu", "cpu"}) {
    test::SeaShot live({.scene = "open_sea", .preset = "high", .width = 96, .height = 54,
                        .set = {{"waves.where", place}, {"waves.resolution", "64"}, {"waves.change_s", "2"}, {"msaa", "1"}}});
    Ocean& ocean = live.experience().ocean();
    const Pose head = test::pose({0.0, 6.0, 0.0}, 10.0, -10.0);
    live.draw(head, 10.0);
    live.set("waves.wind_speed_mps", "16");
    live.set("waves.chop", "0.4");
    std::this_thread::sleep_for(std::chrono::seconds(2));  // made by then, so that both begin at once; draw_until_it_begins would not
    live.draw(head, 20.0);
    ASSERT_TRUE(ocean.changing());
    pictures.push_back(live.picture(head, 21.0));
    ASSERT_TRUE(ocean.changing()) << "midway";
  }
  const auto same = test::difference(pictures[0], pictures[1]);
  EXPECT_LE(same.mean, 4e-4);
  EXPECT_LE(same.p99, 8e-3);
}

}  // namespace

}  // namespace seascape
