// Events of eyes that go in and out of the water. Controls are named beside each test; each
// was seen to fail.
#include "app/eye_crossings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace seascape {
namespace {

using Depth = std::function<double(double time_s)>;

std::vector<EyeEvent> events_of(const Depth& left, const Depth& right, double rate_hz, double lasts_s) {
  EyeCrossings eyes;
  std::vector<EyeEvent> all;
  for (int frame = 0; frame <= int(lasts_s * rate_hz); ++frame) {
    const double time_s = frame / rate_hz;
    const std::optional<double> depths[] = {left(time_s), right(time_s)};
    eyes.step(time_s, depths);
    for (const EyeEvent& event : eyes.take_events()) all.push_back(event);
  }
  return all;
}

// Eyes that bob by 10 cm, the right one 3 cm higher, over 10 s of waves of 4 s: in and out once a wave each, at the
// same times at any rate of frames, where they are 2 cm beyond the surface. Controls: the frame's time in place of the
// one between two frames; the depth's sign; no past_m.
TEST(EyeCrossings, AreTheSameAtAnyRate) {
  const auto bob = [](double up_m) {
    return [up_m](double t) { return 0.1 * std::sin(2.0 * 3.14159265358979 * (t - 0.5) / 4.0) - up_m; };
  };
  // sin(x) = 0.2 of the left eye on the way in, -0.2 on the way out; 0.5 and 0.1 of the right one.
  const double turn = 4.0 / (2.0 * 3.14159265358979);
  const double wanted[][3] = {{0, 1, 0.5 + turn * std::asin(0.2)}, {1, 1, 0.5 + turn * std::asin(0.5)},
                              {1, 0, 2.5 - turn * std::asin(0.1)}, {0, 0, 2.5 + turn * std::asin(0.2)},
                              {0, 1, 4.5 + turn * std::asin(0.2)}, {1, 1, 4.5 + turn * std::asin(0.5)},
                              {1, 0, 6.5 - turn * std::asin(0.1)}, {0, 0, 6.5 + turn * std::asin(0.2)}};
  for (const double rate_hz : {15.0, 30.0, 72.0, 90.0, 144.0, 1000.0}) {
    const auto found = events_of(bob(0.0), bob(0.03), rate_hz, 8.2);
    ASSERT_EQ(found.size(), std::size(wanted)) << rate_hz;
    for (std::size_t n = 0; n < found.size(); ++n) {
      EXPECT_EQ(double(found[n].eye), wanted[n][0]) << rate_hz << " " << n;
      EXPECT_EQ(double(found[n].in), wanted[n][1]) << rate_hz << " " << n;
      EXPECT_NEAR(found[n].time_s, wanted[n][2], 3.0 / (rate_hz * rate_hz) + 1e-6) << rate_hz << " " << n;
    }
  }
}

// What stays within 2 cm of the surface, or passes it for less than a tenth of a second, is no event. Controls: no
// past_m; no hold_s.
TEST(EyeCrossings, DoNotChatter) {
  const Depth trembles = [](double t) { return 0.018 * std::sin(40.0 * t); };
  const Depth splashes = [](double t) { return std::fmod(t, 1.0) < 0.06 && t > 0.5 ? 0.2 : -0.3; };
  for (const double rate_hz : {30.0, 90.0, 1000.0})
    EXPECT_TRUE(events_of(trembles, splashes, rate_hz, 5.0).empty()) << rate_hz;
}

// Where an eye begins is no event, far above the water it is known to be in the air, and a clock that stands or runs
// back changes nothing. Controls: an event for the first frame; the clock not looked at.
TEST(EyeCrossings, BeginWithoutOneAndNeedTimeToPass) {
  EyeCrossings eyes;
  const std::optional<double> deep[] = {3.0}, far[] = {std::nullopt};
  eyes.step(0.0, deep);
  EXPECT_TRUE(eyes.in_water(0));
  eyes.step(1.0, far);
  EXPECT_TRUE(eyes.in_water(0) || !eyes.take_events().empty());
  for (const double time_s : {0.2, 0.9, 1.0}) eyes.step(time_s, deep);  // no time has passed
  eyes.step(1.2, far);
  EXPECT_FALSE(eyes.in_water(0));
  const auto events = eyes.take_events();
  EXPECT_LE(events.size(), 1u);
  for (const EyeEvent& event : events) EXPECT_FALSE(event.in);
}

}  // namespace
}  // namespace seascape
