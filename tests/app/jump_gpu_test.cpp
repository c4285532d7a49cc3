// Where somebody watches, no frame waits for what is simulated: after a jump of the time, a toggle of an effect and a
// change of settings each frame takes about as many steps as those before.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

namespace {

class Jump : public test::GpuTest {};

// What has been done in all: slices of foam stepped, steps of spray, tiles of crests evaluated.
struct Work {
  std::uint64_t foam = 0, spray = 0, crests = 0;
};

class Watched {
 public:
  explicit Watched(const char* scene, bool goes_on = true)
      : shot_({.scene = scene,
               .preset = "low",
               .width = 64,
               .height = 48,
               .set = {{"waves.resolution", "32"}, {"waves.cascades", "3"}, {"msaa", "1"}, {"foam.settle_s", "8"}}}) {
    frame();
    if (goes_on) shot_.experience().go_on();
    for (int n = 0; n < 90; ++n) {
      const Work done = frame();
      most_.foam = std::max(most_.foam, done.foam);
      most_.spray = std::max(most_.spray, done.spray);
      most_.crests = std::max(most_.crests, done.crests);
    }
  }
  // No frame of the next half second does more than twice what those before did.
  void expect_no_more(const char* after) {
    // Backwards a step of foam is not spread over frames.
    const std::uint64_t foam = backwards ? 4 : 2 * most_.foam;
    for (int n = 0; n < 36; ++n) {
      const Work done = frame();
      EXPECT_LE(done.foam, foam) << after << ", frame " << n;
      EXPECT_LE(done.spray, 2 * most_.spray) << after << ", frame " << n;
      EXPECT_LE(done.crests, 2 * most_.crests) << after << ", frame " << n;
    }
  }
  Work frame() {
    time_s += backwards ? -1.0 / 72.0 : 1.0 / 72.0;
    const Work before = work();
    const auto began = std::chrono::steady_clock::now();
    shot_.draw(shot_.scene().start, time_s);
    longest_ms =
        std::max(longest_ms, 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
    const Work now = work();
    return {now.foam < before.foam ? now.foam : now.foam - before.foam,
            now.spray < before.spray ? now.spray : now.spray - before.spray, now.crests - before.crests};
  }
  Work work() {
    Experience& e = shot_.experience();
    return {e.ocean().foam() ? e.ocean().foam()->sea().slices_stepped() : 0,
            e.ocean().spray() ? e.ocean().spray()->steps() : 0, e.sea()->made(SeaDetail::crests)};
  }
  test::SeaShot& shot() { return shot_; }
  const Work& most() const { return most_; }
  double time_s = 5.0, longest_ms = 0.0;
  bool backwards = false;

 private:
  test::SeaShot shot_;
  Work most_;
};

// Control seen: without Experience::go_on each of the jumps, and the toggles of foam and spray, fail.
TEST_F(Jump, NoFrameWaitsForFoamAndSpray) {
  for (const char* scene : {"storm", "whirlpool"}) {
    SCOPED_TRACE(scene);
    Watched sea(scene);
    ASSERT_GT(sea.most().foam, 0u);
    const std::vector<std::string> with = sea.shot().scene().effects;
    const auto without = [&](const char* effect) {
      std::vector<std::string> rest = with;
      std::erase(rest, effect);
      return rest;
    };
    sea.longest_ms = 0.0;
    sea.time_s += 1000.0;
    sea.expect_no_more("a jump forwards");
    sea.time_s -= 700.0;
    sea.expect_no_more("a jump back");
    sea.backwards = true;
    sea.expect_no_more("time that runs backwards");
    sea.backwards = false;
    for (const char* effect : {"foam", "spray"}) {
      sea.shot().experience().apply_effects(without(effect));
      sea.expect_no_more("an effect less");
      sea.shot().experience().apply_effects(with);
      sea.expect_no_more("an effect more");
    }
    sea.shot().set("foam.life_s", "3");
    sea.expect_no_more("another life");
    sea.shot().set("foam.texel_m", "0.7");
    sea.expect_no_more("other windows");
    sea.shot().set("waves.wind_speed_mps", "15");
    sea.expect_no_more("another wind");
    RecordProperty(std::string("longest_ms_") + scene, std::to_string(sea.longest_ms));
  }
}

// Foam that goes on is there at once, and comes to what it would be: as much is covered as where it began anew.
// Control seen: without Experience::go_on the first frame after the jump has other foam.
TEST_F(Jump, FoamGoesOnAndComesToWhatItWouldBe) {
  const auto covered = [](test::SeaShot& shot) {
    const Foam& foam = shot.experience().ocean().foam()->sea().foam();
    double sum = 0.0;
    for (int i = 0; i < 4096; ++i) sum += double(foam.covered({-64.0 + 2.0 * (i % 64), -64.0 + 2.0 * (i / 64)}, 0.0));
    return sum / 4096.0;
  };
  Watched sea("storm"), settled("storm", false);
  const double before = covered(sea.shot());
  sea.time_s += 1000.0;
  sea.frame();
  EXPECT_NEAR(covered(sea.shot()), before, 0.1 * before);
  for (int n = 0; n < 8 * 72; ++n) sea.frame();
  settled.time_s = sea.time_s;
  settled.frame();
  const double now = covered(sea.shot()), anew = covered(settled.shot());
  EXPECT_GT(anew, 0.01);
  EXPECT_NEAR(now, anew, 0.1 * anew);
}

}  // namespace

}  // namespace seascape
