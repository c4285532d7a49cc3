// Both eyes in one pass draw what each eye draws alone, bit for bit; and what they draw is a sea.
#include <gtest/gtest.h>

#include "engine/multiview_check.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"

namespace seascape {

namespace {

using test::differing_pixels;
using test::pose;
using test::SeaShot;
using test::ShotOptions;

class Stereo : public test::GpuTest {};
const test::DrawsMuch draws_much("Stereo");

// Five seas with SEASCAPE_LONG=1, else the three that differ most: the storm has foam, and is hazy; the pool has wave
// particles. Scenes with solid things and shores have tests of their own.
std::vector<std::string> scenes() {
  if (test::long_run()) return {"open_sea", "calm", "storm", "swell", "rain_pool"};
  return {"open_sea", "storm", "rain_pool"};
}

// Where an eye cannot see both sides of a patch's edge alike: near the water, rolled, and looking down.
std::vector<Pose> poses() {
  std::vector<Pose> list{pose({3.0, 9.0, -7.0}, 20.0, -8.0)};
  if (test::long_run()) {
    list.push_back(pose({-1e5, 12.0, 3e5}, 200.0, -30.0, 40.0));
    list.push_back(pose({0.0, 300.0, 0.0}, 90.0, -90.0));
  }
  return list;
}

ShotOptions small(const std::string& scene, const std::string& preset) {
  // Both ways to the waves of a picture, in turn.
  return {.scene = scene,
          .preset = preset,
          .width = 160,
          .height = 120,
          .set = {{"waves.where", scene == "open_sea" || scene == "calm" ? "cpu" : "gpu"}}};
}

// Straight down from high up, beside the sun's reflection, the sea is an even blue: 2 to 23 bytes of deviation by
// scene; a fill has none.
void expect_a_sea(const Image8& picture, const std::string& what, bool from_above = false) {
  const test::PictureStatistics s = test::statistics(picture);
  EXPECT_GT(s.mean, 25.0) << what << " is black";
  EXPECT_LT(s.mean, 245.0) << what << " is white";
  EXPECT_GT(s.deviation, from_above ? 1.0 : 6.0) << what << " is flat";
}

void expect_one_pass_equals_each_eye(const std::string& preset) {
  for (const std::string& scene : scenes()) {
    int number = 0;
    for (const Pose& head : poses()) {
      const double time_s = 12.5 + 100.0 * number;
      const std::string what = scene + "_" + preset + "_" + std::to_string(number++);
      ShotOptions options = small(scene, preset);
      options.views = 2;
      std::vector<Image8> together, by_eye, alone;
      if (multiview_works(test::device(), test::shaders())) together = SeaShot(options).pictures(head, time_s);
      options.per_eye = true;
      by_eye = SeaShot(options).pictures(head, time_s);
      options.per_eye = false;
      options.views = 1;
      for (const int eye : {-1, 1}) {
        options.eye = eye;
        alone.push_back(SeaShot(options).picture(head, time_s));
      }
      for (std::size_t eye = 0; eye < 2; ++eye) {
        const std::string which = what + (eye == 0 ? "_left" : "_right");
        expect_a_sea(alone[eye], which, number == 3);
        if (!together.empty()) {
          EXPECT_EQ(differing_pixels(together[eye], alone[eye]), 0)
              << test::leave(together[eye], which + "_together") << " " << test::leave(alone[eye], which + "_alone");
        }
        EXPECT_EQ(differing_pixels(by_eye[eye], alone[eye]), 0)
            << test::leave(by_eye[eye], which + "_by_eye") << " " << test::leave(alone[eye], which + "_alone");
      }
      EXPECT_GT(differing_pixels(alone[0], alone[1]), 100) << what << ": the eyes see the same";
    }
  }
}

// Controls: a second eye moved by a hundredth of a unit in views of two fails all of these; an eye distance that
// differs by a millimetre is seen (AnotherEyeDistanceIsSeen).
TEST_F(Stereo, OnePassEqualsEachEyeAtLow) { expect_one_pass_equals_each_eye("low"); }
TEST_F(Stereo, OnePassEqualsEachEyeAtMedium) { expect_one_pass_equals_each_eye("medium"); }
TEST_F(Stereo, OnePassEqualsEachEyeAtHigh) { expect_one_pass_equals_each_eye("high"); }
TEST_F(Stereo, OnePassEqualsEachEyeAtUltra) { expect_one_pass_equals_each_eye("ultra"); }

TEST_F(Stereo, AnotherEyeDistanceIsSeen) {
  const Pose head = poses().front();
  ShotOptions options = small("open_sea", "low");
  options.views = 2;
  options.per_eye = !multiview_works(test::device(), test::shaders());
  const auto usual = SeaShot(options).pictures(head, 12.5);
  options.set = {{"stereo.eye_distance_m", "0.065"}};
  const auto wider = SeaShot(options).pictures(head, 12.5);
  for (std::size_t eye = 0; eye < 2; ++eye) EXPECT_GT(differing_pixels(usual[eye], wider[eye]), 50);
}

// Two eyes at no distance with equal fields of view draw the same picture to the bit, which is also that of the one in
// the middle. Control: AnotherEyeDistanceIsSeen, above.
TEST_F(Stereo, hard_39_eyes_at_no_distance_see_the_same) {
  for (const char* preset : {"low", "high"}) {
    ShotOptions options = small("storm", preset);
    options.views = 2;
    options.per_eye = !multiview_works(test::device(), test::shaders());
    options.set = {{"stereo.eye_distance_m", "0"}};
    const auto eyes = SeaShot(options).pictures(poses().front(), 12.5);
    expect_a_sea(eyes[0], preset);
    EXPECT_EQ(differing_pixels(eyes[0], eyes[1]), 0) << preset;
    options.views = 1;
    options.eye = 0;
    EXPECT_EQ(differing_pixels(SeaShot(options).picture(poses().front(), 12.5), eyes[0]), 0)
        << preset << ": the centre";
  }
}

// A frame is a function of its place and time: what was drawn before it leaves no trace, in another order or at all.
// The control: another time is seen.
TEST_F(Stereo, TwoRunsAreIdenticalWhateverCameBefore) {
  for (const char* preset : {"medium", "high"}) {
    ShotOptions options = small("open_sea", preset);
    options.views = 2;
    options.per_eye = !multiview_works(test::device(), test::shaders());
    const Pose here = poses().front(), there = pose({-500.0, 80.0, 900.0}, 130.0, -40.0);
    SeaShot first(options);
    const auto once = first.pictures(here, 12.5);
    (void)first.pictures(there, 400.0);
    (void)first.pictures(here, 3.0);
    const auto again = first.pictures(here, 12.5);
    const auto fresh = SeaShot(options).pictures(here, 12.5);
    const auto later = first.pictures(here, 12.6);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      EXPECT_EQ(differing_pixels(once[eye], again[eye]), 0) << preset;
      EXPECT_EQ(differing_pixels(once[eye], fresh[eye]), 0) << preset;
      EXPECT_GT(differing_pixels(once[eye], later[eye]), 100) << preset;
    }
  }
}

}  // namespace

}  // namespace seascape
