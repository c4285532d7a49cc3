// Windows of waves behind a body under way: how far its wake goes on, and that nothing of it jumps whatever the body
// does. Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "ocean/places/wake_track.h"
#include "ocean/places/wake_windows.h"

namespace seascape {
namespace {

constexpr double dt_s = 1.0 / 60.0;

WakeSettings settings(int resolution = 64) {
  WakeSettings s;
  s.waves.windows = {.resolution = resolution, .slices = 3, .texel_m = 0.25};
  s.waves.damping_per_s = 0.0;
  return s;
}

// A boat of 4 m whose hump of pressure goes along with it.
class Boat {
 public:
  explicit Boat(const WakeSettings& settings) : windows(settings) {}
  void step(const glm::dvec2& velocity, double head_m = 0.05) {
    at += velocity * dt_s;
    const WaveSource hump{.place_m = at, .velocity_mps = velocity, .length_m = 4.0, .head_m = head_m};
    windows.add({.id = 1, .place_m = at, .velocity_mps = velocity, .length_m = 4.0}, {&hump, 1});
    windows.step(dt_s);
  }
  double height(const glm::dvec2& place) {
    const auto surface = windows.shared_surface();
    return surface ? surface->sea(place, 0.0).displacement.y : 0.0;
  }
  int astern() const {
    int count = 0;
    for (int i = 0; i < WakeWindows::most; ++i) count += windows.state(i) == WakeWindows::State::trails;
    return count;
  }
  WakeWindows windows;
  glm::dvec2 at{0.0};
};

// A place behind on the track moves no farther than who leaves it, and lies within the way asked of him.
TEST(WakeTrack, IsFollowedWithoutAJump) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> turns(-0.2, 0.2), gait(0.0, 1.0);
  WakeTrack track;
  glm::dvec2 at(3.0, -2.0);
  track.begin(at);
  double heading = 0.0, farthest = 0.0;
  const std::vector<double> back{0.0, 0.3, 5.0, 17.0};
  std::vector<glm::dvec2> before(back.size(), at);
  for (int i = 0; i < 4000; ++i) {
    heading += turns(random) + (i % 500 == 0 ? 3.0 : 0.0);
    const double way = i % 900 < 100 ? 0.0 : 0.1 * gait(random);
    at += way * glm::dvec2(std::cos(heading), std::sin(heading));
    track.go_to(at, 0.25, 20.0);
    for (std::size_t n = 0; n < back.size(); ++n) {
      const glm::dvec2 now = track.behind(back[n]);
      EXPECT_LE(glm::distance(now, before[n]), way + 1e-9) << back[n] << " at step " << i;
      EXPECT_LE(glm::distance(now, at), back[n] + 1e-9);
      before[n] = now;
      farthest = std::max(farthest, glm::distance(now, at));
    }
  }
  EXPECT_GT(farthest, 4.0);
  EXPECT_LT(track.length_m(), 40.0) << "what nobody asks for is forgotten";
}

// Behind a boat that goes straight ahead the wake is that of windows twice as wide, across the end of its own finest
// window, 17 m behind it, and on in the one astern: within 12 % rms (measured 9.6), most of which is what borders send
// back. Control: no flow_astern() (27 %).
TEST(WakesAstern, AreThoseOfOneWideWindow) {
  Boat narrow(settings(128)), wide(settings(256));
  for (int i = 0; i < 60 * 22; ++i) narrow.step({3.0, 0.0}), wide.step({3.0, 0.0});
  EXPECT_EQ(narrow.astern(), 1);
  double miss = 0.0, size = 0.0, far = 0.0;
  for (double x = 6.0; x < 32.0; x += 0.37)
    for (double y = -4.0; y <= 4.0; y += 0.53) {
      const glm::dvec2 place = narrow.at + glm::dvec2(-x, y);
      const double want = wide.height(place), off = narrow.height(place) - want;
      miss += off * off, size += want * want;
      if (x > 28.0) far = std::max(far, std::abs(want));
    }
  EXPECT_GT(far, 1e-3);
  EXPECT_LT(std::sqrt(miss / size), 0.12);
  RecordProperty("missed", std::to_string(std::sqrt(miss / size)));
}

// Whatever a boat does, the water a step later is what it was carried on by that time, but for what pushes it: within
// 2 % of the highest, away from the hump. She goes straight, turns about in ten metres, backs, stops, goes on; and
// others come, for whom the window astern has to go. Controls: middles straight behind by the boat's velocity in place
// of her track; a window astern that goes at once.
TEST(WakesAstern, NothingJumpsWhateverTheBoatDoes) {
  Boat boat(settings(64));
  const auto turning = [](double t) { return glm::dvec2(std::sin(t), -std::cos(t)); };
  double highest = 0.0, worst = 0.0, worst_s = 0.0;
  int most_astern = 0;
  for (int i = 0; i < 60 * 60; ++i) {
    const double t = i * dt_s;
    glm::dvec2 velocity = 3.0 * turning(0.0);
    if (t > 20.0) velocity = 3.0 * turning(std::min((t - 20.0) * 0.6, M_PI));
    if (t > 36.0) velocity = -2.0 * turning(M_PI);
    if (t > 42.0) velocity = glm::dvec2(0.0);
    if (t > 46.0) velocity = 3.0 * turning(1.0);
    std::vector<glm::dvec2> places;
    for (int p = 0; p < 90; ++p) {
      const double a = p * 2.399, r = 7.0 + 0.45 * p;
      places.push_back(boat.at + r * glm::dvec2(std::cos(a), std::sin(a)));
    }
    boat.windows.look_ahead(dt_s);
    std::vector<double> carried;
    for (const glm::dvec2& place : places) carried.push_back(boat.height(place));
    if (t > 52.0)  // four more come
      for (std::uint64_t id = 2; id < 5; ++id) {
        const glm::dvec2 there = 1000.0 * double(id) + glm::dvec2(2.0 * t, 0.0);
        const WaveSource other{.place_m = there, .velocity_mps = {2.0, 0.0}, .length_m = 4.0, .head_m = 0.05};
        boat.windows.add({.id = id, .place_m = there, .velocity_mps = {2.0, 0.0}, .length_m = 4.0}, {&other, 1});
      }
    boat.step(velocity, t > 42.0 && t <= 46.0 ? 0.0 : 0.05);
    most_astern = std::max(most_astern, boat.astern());
    for (std::size_t p = 0; p < places.size(); ++p) {
      const double now = boat.height(places[p]);
      highest = std::max(highest, std::abs(now));
      if (const double jump = std::abs(now - carried[p]); jump > worst) worst = jump, worst_s = t;
    }
  }
  EXPECT_EQ(most_astern, 1);
  EXPECT_EQ(boat.astern(), 0) << "three others have the windows";
  EXPECT_GT(highest, 5e-3);
  EXPECT_LT(worst, 0.02 * highest) << "at " << worst_s << " s, of " << highest;
  RecordProperty("jump_over_highest", std::to_string(worst / highest));
}

}  // namespace
}  // namespace seascape
