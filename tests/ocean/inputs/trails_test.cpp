// Trails: what is left behind fades with its age alone, at any frame rate, and runs backwards as it ran forwards.
#include <gtest/gtest.h>

#include "ocean/inputs/inputs.h"
#include "tests/support/input_truth.h"

namespace seascape {
namespace {

InputSpec trail(std::vector<TrailKey> keys, double radius, double life, bool loop = false) {
  InputSpec spec;
  spec.to = InputTarget::foam;
  spec.where = "here";
  spec.value = {2.0f, 0.0f, 0.0f, 0.0f};
  TrailInput input;
  input.keys = std::move(keys);
  input.radius_m = radius, input.life_s = life, input.loop = loop;
  spec.shape = input;
  return spec;
}
float at(const Inputs& inputs, double x, double z, double time) {
  return inputs.value({x, z}, 0.0, time, glm::vec4(0.0f)).x;
}

// Against twenty thousand discs, one after the other, along a straight way at one speed, of any softness, spreading or
// not. Control: the disc that was left nearest, for the one that shows most, is off by 0.29; ages counted from the
// first key, by 2.
TEST(InputTrails, AreTheLargestShareOfAllDiscs) {
  for (const double feather : {0.0, 2.0, 6.0})
    for (const double spread : {0.0, 0.4, 5.0, 9.0}) {
      InputSpec spec = trail({{100.0, {0.0, 0.0}}, {110.0, {50.0, 0.0}}, {120.0, {100.0, 0.0}}}, 3.0, 8.0);
      spec.feather_m = feather;
      std::get<TrailInput>(spec.shape).spread_mps = spread;
      const Inputs inputs(InputTarget::foam, std::vector{spec});
      EXPECT_FALSE(inputs.still());
      double worst = 0.0, most = 0.0;
      for (const double time : {99.0, 103.3, 110.0, 114.9, 121.0, 126.0, 129.0})
        for (double x = -2.0; x < 104.0; x += 3.7)
          for (const double z : {0.0, -1.3, 2.9, 7.0}) {
            double truth = 0.0;
            for (int i = 0; i <= 20000; ++i) {
              const double left = 100.0 + i / 1000.0, age = time - left;
              if (age < 0.0 || age > 8.0) continue;
              const double inside = 3.0 + spread * age - std::hypot(x - 5.0 * (left - 100.0), z);
              truth = std::max(truth, 2.0 *
                                          (feather > 0.0   ? test::smooth(inside / feather)
                                           : inside >= 0.0 ? 1.0
                                                           : 0.0) *
                                          (1.0 - age / 8.0));
            }
            worst = std::max(worst, std::abs(at(inputs, x, z, time) - truth));
            most = std::max(most, truth);
          }
      EXPECT_LT(worst, 1e-3) << feather << " " << spread;
      EXPECT_GT(most, 0.9);
    }
}

// A question is answered from its time alone: asked in steps of any frame rate, forwards or backwards, it is the same
// to the bit; and from frame to frame it fades by what the time between them says. Control: times rounded down to a
// sixtieth of a second fade in steps 6 times too large.
TEST(InputTrails, AreTheSameAtAnyFrameRateAndBackwards) {
  const std::vector<TrailKey> keys{{0.0, {0.0, 0.0}}, {4.0, {30.0, 10.0}}, {9.0, {20.0, 50.0}}, {15.0, {-30.0, 20.0}}};
  const Inputs inputs(InputTarget::foam, std::vector{trail(keys, 4.0, 6.0)});
  std::vector<float> forwards;
  for (int frame = 0; frame <= 20 * 360; ++frame) forwards.push_back(at(inputs, 30.0, 11.0, frame / 360.0));
  for (const int rate : {30, 60, 72, 90, 120})
    for (int frame = 20 * rate; frame >= 0; --frame)
      EXPECT_EQ(at(inputs, 30.0, 11.0, double(frame * (360 / rate)) / 360.0),
                forwards[std::size_t(frame * (360 / rate))]);
  const auto most = std::max_element(forwards.begin(), forwards.end());
  EXPECT_GT(*most, 1.9f);
  for (auto frame = most; frame + 1 != forwards.end(); ++frame) {
    EXPECT_LE(frame[1], frame[0]);
    EXPECT_LE(frame[0] - frame[1], 2.0 / 6.0 / 360.0 + 1e-5);
  }
}

// Control: without the search for the newest pass, the second lap is empty.
TEST(InputTrails, ALoopGoesOnForEver) {
  const std::vector<TrailKey> keys{
      {0.0, {50.0, 0.0}}, {5.0, {0.0, 50.0}}, {10.0, {-50.0, 0.0}}, {15.0, {0.0, -50.0}}, {20.0, {50.0, 0.0}}};
  const Inputs inputs(InputTarget::foam, std::vector{trail(keys, 5.0, 12.0, true)});
  float most = 0.0f;
  for (double time = 0.0; time < 20.0; time += 0.5)
    for (const double lap : {-3.0, 1.0, 1000.0}) {
      const float here = at(inputs, 0.0, 50.0, time + 20.0), there = at(inputs, 0.0, 50.0, time + 20.0 * lap);
      EXPECT_NEAR(here, there, 1e-5) << time << " " << lap;
      most = std::max(most, here);
    }
  EXPECT_GT(most, 1.9f);
  EXPECT_NEAR(at(inputs, 50.0, 0.0, 40.0), 2.0f, 1e-5) << "where it begins again";
  EXPECT_NEAR(at(inputs, 0.0, 50.0, 40.0 + 5.0 + 6.0), 1.0f, 0.1) << "half its life ago";
  EXPECT_EQ(at(inputs, 0.0, 50.0, 40.0 + 4.0 - 1.0), 0.0f) << "older than its life";
}

// Control: a tree of boxes that do not grow cuts the spread trail at its first width.
TEST(InputTrails, SpreadAsTheyAge) {
  InputSpec spec = trail({{0.0, {0.0, 0.0}}, {100.0, {1000.0, 0.0}}}, 2.0, 50.0);
  std::get<TrailInput>(spec.shape).spread_mps = 0.5;
  const Inputs inputs(InputTarget::foam, std::vector{spec});
  for (const double age : {5.0, 20.0, 40.0}) {
    const double x = 10.0 * (60.0 - age), half = 2.0 + 0.5 * age;
    EXPECT_NEAR(at(inputs, x, half - 0.05, 60.0), 2.0 * (1.0 - age / 50.0), 5e-3);
    EXPECT_EQ(at(inputs, x, half + 0.05, 60.0), 0.0f);
  }
}

// A thing at rest: its newest disc is whole for as long as it is there. Control: without the test of the distance of
// what does not move, the disc is as wide as the box that it is looked for in.
TEST(InputTrails, AThingAtRestLeavesItsNewestDisc) {
  const Inputs inputs(InputTarget::foam,
                      std::vector{trail({{0.0, {0.0, 0.0}}, {10.0, {0.0, 0.0}}, {20.0, {0.0, 0.0}}}, 2.0, 4.0)});
  for (double time = 0.0; time <= 20.0; time += 0.25) {
    EXPECT_EQ(at(inputs, 1.0, 0.0, time), 2.0f);
    EXPECT_EQ(at(inputs, 1.5, 1.5, time), 0.0f);
  }
  EXPECT_NEAR(at(inputs, 1.0, 0.0, 22.0), 1.0f, 1e-6);
  EXPECT_EQ(at(inputs, 1.0, 0.0, 24.0), 0.0f);
}

}  // namespace
}  // namespace seascape
