// The dynamic waves as a scene has them: rain that is the same for everybody, steps that do not ask how frames fall,
// time that jumps.
#include "ocean/places/dynamic_sea.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ocean/places/rain.h"
#include "tests/support/expect_error.h"

namespace seascape {
namespace {

RainSettings shower() { return {.drops_per_m2_s = 3.0, .drop_length_m = 0.5, .drop_height_m = 0.02, .seed = 5}; }

DynamicSeaSettings small_sea() {
  DynamicSeaSettings s;
  s.waves.windows.resolution = 64;
  s.waves.windows.slices = 3;
  s.waves.damping_per_s = 1.0;
  s.rain = {.drops_per_m2_s = 0.5, .drop_length_m = 0.8, .drop_height_m = 0.05, .seed = 3};
  s.settle_s = 1.0;
  return s;
}

const glm::dvec3 head{3.0, 1.7, -2.0};

// Heights on a grid around the viewer.
std::vector<double> heights(DynamicSea& sea, glm::dvec2 middle = {3.0, -2.0}, double step = 0.31,
                            double footprint = 0.0) {
  std::vector<double> result;
  for (int j = -8; j <= 8; ++j)
    for (int i = -8; i <= 8; ++i)
      result.push_back(sea.surface().sea(middle + step * glm::dvec2(i, j), footprint).displacement.y);
  return result;
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / double(values.size()));
}

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d;
  for (std::size_t i = 0; i < a.size(); ++i) d.push_back(a[i] - b[i]);
  return rms(d);
}

bool before(const WaveSource& a, const WaveSource& b) {
  return std::pair(a.place_m.x, a.place_m.y) < std::pair(b.place_m.x, b.place_m.y);
}

// As many drops as asked, within four standard errors of a Poisson process, in all quarters of the square and of the
// time alike. Control seen: a cell's drop a tick that does not hang on the tick (the same cell is hit again and again:
// 11 standard errors in a quarter).
TEST(Rain, FallsEvenlyAndAsDenseAsAsked) {
  const double reach = 10.0, rate = 60.0;
  double cells[8] = {};
  for (std::int64_t tick = 0; tick < 1200; ++tick) {
    std::vector<WaveSource> drops;
    add_rain(shower(), tick, 1, rate, {100.0, -40.0}, reach, drops);
    for (const WaveSource& drop : drops) {
      const int quarter = (drop.place_m.x > 100.0) + 2 * (drop.place_m.y > -40.0) + 4 * (tick >= 600);
      cells[quarter] += 1.0;
      EXPECT_LE(std::max(std::abs(drop.place_m.x - 100.0), std::abs(drop.place_m.y + 40.0)), reach);
      EXPECT_NEAR(drop.rise_mps / rate, shower().drop_height_m, 1e-15);
    }
  }
  const double expected = shower().drops_per_m2_s * 4.0 * reach * reach * 20.0 / 8.0;
  for (const double cell : cells) EXPECT_NEAR(cell, expected, 4.0 * std::sqrt(expected));
}

// Which drops fall does not hang on who looks, nor on how ticks are put together. Control seen: cells counted from the
// viewer.
TEST(Rain, IsTheSameForEverybody) {
  std::vector<WaveSource> one, other, together;
  for (std::int64_t tick = 50; tick < 90; ++tick) {
    add_rain(shower(), tick, 1, 60.0, {0.3, 0.2}, 4.0, one);
    add_rain(shower(), tick, 1, 60.0, {2.4, -1.7}, 7.0, other);
  }
  add_rain(shower(), 50, 40, 60.0, {0.3, 0.2}, 4.0, together);
  std::erase_if(other, [](const WaveSource& drop) {
    return std::max(std::abs(drop.place_m.x - 0.3), std::abs(drop.place_m.y - 0.2)) > 4.0;
  });
  std::sort(one.begin(), one.end(), before);
  std::sort(other.begin(), other.end(), before);
  std::sort(together.begin(), together.end(), before);
  ASSERT_GT(one.size(), 50u);
  ASSERT_EQ(one.size(), other.size());
  ASSERT_EQ(one.size(), together.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].place_m, other[i].place_m);
    EXPECT_EQ(one[i].place_m, together[i].place_m);
    EXPECT_NEAR(together[i].rise_mps, one[i].rise_mps / 40.0, 1e-15) << "over forty ticks";
  }
}

TEST(Rain, AnotherSeedIsAnotherRainAndNoneIsNone) {
  RainSettings other = shower(), none = shower(), flat = shower();
  other.seed = 6;
  none.drops_per_m2_s = 0.0;
  flat.drop_height_m = 0.0;
  std::vector<WaveSource> a, b, c;
  add_rain(shower(), 0, 60, 60.0, {0.0, 0.0}, 3.0, a);
  add_rain(other, 0, 60, 60.0, {0.0, 0.0}, 3.0, b);
  add_rain(none, 0, 60, 60.0, {0.0, 0.0}, 3.0, c);
  add_rain(flat, 0, 60, 60.0, {0.0, 0.0}, 3.0, c);
  ASSERT_FALSE(a.empty());
  ASSERT_FALSE(b.empty());
  EXPECT_NE(a.front().place_m, b.front().place_m);
  EXPECT_TRUE(c.empty());
}

// The same waves, to the bit, at every display rate. Control seen: frames' time instead of whole ticks (differences of
// 3 % at 72 Hz).
TEST(DynamicSea, IsTheSameAtEveryFrameRate) {
  DynamicSea reference(small_sea());
  for (int i = 0; i <= 180; ++i) reference.update(i / 60.0, head);
  const std::vector<double> want = heights(reference);
  ASSERT_GT(rms(want), 1e-3);
  for (const double rate : {30.0, 72.0, 90.0, 120.0}) {
    DynamicSea sea(small_sea());
    for (int i = 0; i <= int(3.0 * rate); ++i) sea.update(i / rate, head);
    EXPECT_EQ(heights(sea), want) << rate;
  }
}

// A moment looks alike wherever the frames began: here after 4 s of settling, in which waves fall to exp(-2). Control
// seen: no settling (the whole wave).
TEST(DynamicSea, SettlesBeforeItIsShown) {
  DynamicSeaSettings s = small_sea();
  s.waves.damping_per_s = 2.0;
  s.settle_s = 4.0;
  DynamicSea early(s), late(s);
  for (int i = 0; i <= 14 * 30; ++i) early.update(i / 30.0, head);
  late.update(14.0, head);
  EXPECT_LT(rms_difference(heights(early), heights(late)), 0.03 * rms(heights(early)));
}

// Time that runs backwards, or jumps, begins anew, as a sea would that began then; a long frame takes no more than so
// many steps. Control seen: a time before the last one taken for no time at all.
TEST(DynamicSea, hard_12_time_runs_backwards_or_jumps) {
  DynamicSea sea(small_sea()), fresh(small_sea());
  for (int i = 0; i <= 60; ++i) sea.update(8.0 + i / 60.0, head);
  EXPECT_TRUE(sea.update(2.0, head));
  fresh.update(2.0, head);
  EXPECT_EQ(heights(sea), heights(fresh));
  EXPECT_TRUE(sea.update(40.0, head));
  DynamicSea later(small_sea());
  later.update(40.0, head);
  EXPECT_EQ(heights(sea), heights(later));
  sea.update(44.5, head);  // a frame of 4.5 s, in 8 long steps: the rain of a step falls all of its time
  for (const double h : heights(sea)) EXPECT_LT(std::abs(h), 0.2);
  EXPECT_GT(rms(heights(sea)), 1e-4);
}

TEST(DynamicSea, TakesNoTimeAndNoPlaceThatIsNoNumber) {
  DynamicSea sea(small_sea());
  sea.update(1.0, head);
  const std::vector<double> was = heights(sea);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e300}) {
    EXPECT_FALSE(sea.update(bad, head));
    EXPECT_FALSE(sea.update(1.1, {bad == -1e300 ? std::numeric_limits<double>::quiet_NaN() : bad, 1.0, 0.0}));
    EXPECT_EQ(heights(sea), was);
  }
  EXPECT_FALSE(sea.update(1.0, head)) << "nothing new";
  EXPECT_TRUE(sea.update(1.1, head));
}

// Nothing is above what extent() says, and slopes come to its moments. Control seen: the extent of the level before the
// last step.
TEST(DynamicSea, ExtentsBoundTheWaves) {
  DynamicSea sea(small_sea());
  sea.update(2.0, head);
  double height = 0.0, shift = 0.0;
  for (int i = 0; i < sea.surface().levels(); ++i)
    height += sea.surface().extent(i).height_m, shift += sea.surface().extent(i).shift_m;
  double most_height = 0.0, most_shift = 0.0;
  for (int j = -60; j <= 60; ++j)
    for (int i = -60; i <= 60; ++i) {
      const glm::dvec3 d = sea.surface().sea(glm::dvec2(3.0, -2.0) + 0.1 * glm::dvec2(i, j), 0.0).displacement;
      most_height = std::max(most_height, std::abs(d.y));
      most_shift = std::max(most_shift, std::hypot(d.x, d.z));
    }
  EXPECT_LE(most_height, height);
  EXPECT_LE(most_shift, shift);
  EXPECT_GT(most_height, 0.3 * height);
  EXPECT_GT(most_shift, 0.3 * shift);
  EXPECT_GT(sea.surface().extent(0).slope_moments.x, 0.0);
}

// A straight line between places of the surface misses what lies between by no more than its bend says, and by no less
// than a seventh of it. Controls seen: the bend of the slopes along x alone, by half a texel, and by two.
TEST(DynamicSea, ExtentsBoundTheBend) {
  DynamicSea sea(small_sea());
  sea.update(2.0, head);
  const DynamicSurface& surface = sea.surface();
  const double half_m = 2.0 * surface.texel_m(0);
  double bound = 0.0, most = 0.0;
  for (int i = 0; i < surface.levels(); ++i) bound += 0.5 * 1.1 * surface.extent(i).bent_per_m * half_m * half_m;
  const auto height = [&](glm::dvec2 at) { return surface.sea(at, 0.0).displacement.y; };
  for (int j = -60; j <= 60; ++j)
    for (int i = -60; i <= 60; ++i) {
      const glm::dvec2 at = glm::dvec2(3.0, -2.0) + 0.1 * glm::dvec2(i, j);
      for (const glm::dvec2 way : {glm::dvec2(1.0, 0.0), glm::dvec2(0.0, 1.0), glm::dvec2(0.7071, 0.7071)})
        most = std::max(most, std::abs(height(at) - 0.5 * (height(at + half_m * way) + height(at - half_m * way))));
    }
  RecordProperty("of_bound", std::to_string(most / bound));
  EXPECT_LE(most, bound);
  EXPECT_GT(most, bound / 7.0);
}

TEST(DynamicSea, KnowsWhatCanNeverMove) {
  DynamicSeaSettings s = small_sea();
  EXPECT_FALSE(still(s));
  s.rain.drops_per_m2_s = 0.0;
  EXPECT_TRUE(still(s));
  s = small_sea();
  s.waves.depth_m = 0.0;
  EXPECT_TRUE(still(s)) << "dry";
}

TEST(DynamicSea, RefusesWhatIsOutOfRangeByName) {
  const auto refused = [](auto change, const char* name) {
    DynamicSeaSettings s = small_sea();
    change(s);
    EXPECT_NE(test::error_of([&] { DynamicSea sea(s); }).find(name), std::string::npos) << name;
  };
  refused([](auto& s) { s.settle_s = -1.0; }, "settle_s");
  refused([](auto& s) { s.settle_s = std::nan(""); }, "settle_s");
  refused([](auto& s) { s.rain.drops_per_m2_s = 101.0; }, "drops_per_m2_s");
  refused([](auto& s) { s.rain.drop_length_m = 0.0; }, "drop_length_m");
  refused([](auto& s) { s.rain.drop_height_m = INFINITY; }, "drop_height_m");
  refused([](auto& s) { s.waves.rate_hz = 5.0; }, "rate_hz");
}

}  // namespace
}  // namespace seascape
