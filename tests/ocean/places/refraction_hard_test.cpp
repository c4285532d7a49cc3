// Hard cases of bending and shelter: beds of land, of no land, of numbers that are none, a flat sea, and places that
// are no places.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <limits>
#include <random>

#include "ocean/places/refraction.h"
#include "tests/support/expect_error.h"

namespace seascape {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
const InputBounds field{{-400.0, -300.0}, {500.0, 200.0}};

struct Sea {
  explicit Sea(double wind = 10.0, double depth = deep_water_m) {
    sea.wind_speed_mps = wind, sea.depth_m = depth;
    bins = make_wave_bins(sea, {.resolution = 64, .cascades = 5});
  }
  Refraction over(const DepthOfPlace& depth, const InputBounds& bounds = field,
                  RefractionSettings settings = {.cells = 64}) const {
    return Refraction(sea, bins, ShallowWater(sea, bins), bounds, depth, settings);
  }
  SeaState sea;
  WaveBins bins;
};

// Every value finite and in its range, within the grid, beyond it and far away.
void expect_sound(const Refraction& r) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> near(-1500.0, 1500.0);
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec2 p = glm::dvec2(near(random), near(random)) * (i % 10 == 0 ? 1e5 : 1.0);
    for (int c = 0; c < 5; ++c) {
      ASSERT_TRUE(std::isfinite(r.shift(c, p)) && std::abs(r.shift(c, p)) <= r.most_shift_m(c) * 1.000001);
      ASSERT_TRUE(r.shelter(c, p) >= 0.0f && r.shelter(c, p) <= 1.0f) << r.shelter(c, p);
    }
    ASSERT_TRUE(r.shelter(p) >= 0.0f && r.shelter(p) <= 1.0f);
  }
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_EQ(r.shift(0, {bad, 0.0}), 0.0);
    EXPECT_EQ(r.shelter(0, {0.0, bad}), 1.0f);
  }
  EXPECT_EQ(r.shift(0, {1e7, 1e7}), 0.0);
  EXPECT_EQ(r.shelter({1e7, 1e7}), 1.0f);
}

TEST(RefractionHard, AnyBedGivesFiniteFields) {
  // Control, seen: land left with the infinity that the fronts have there.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> height(-30.0, 30.0);
  std::vector<double> noise(64);
  for (double& h : noise) h = height(random);
  const auto archipelago = [&](glm::dvec2 p, double) {
    return noise[std::size_t((int(std::floor(p.x / 40.0)) * 7 + int(std::floor(p.y / 40.0)) * 3) & 63)];
  };
  const std::vector<std::pair<const char*, DepthOfPlace>> beds{
      {"land alone", [](glm::dvec2, double) { return -3.0; }},
      {"no land", [](glm::dvec2, double) { return 8.0; }},
      {"the shore at 0", [](glm::dvec2 p, double) { return std::max(-p.x, 0.0); }},
      {"land to the west and north edge",
       [](glm::dvec2 p, double) { return p.x < -100.0 || p.y < -100.0 ? -1.0 : 12.0; }},
      {"land to the east and south edge",
       [](glm::dvec2 p, double) { return p.x > 100.0 || p.y > 100.0 ? -1.0 : 12.0; }},
      {"a lake in land", [](glm::dvec2 p, double) { return glm::length(p) < 80.0 ? 5.0 : -1.0; }},
      {"a film of water", [](glm::dvec2, double) { return 1e-6; }},
      {"an ocean under a cliff", [](glm::dvec2 p, double) { return p.x > 0.0 ? 1e6 : -1e6; }},
      {"an archipelago at random", archipelago},
  };
  for (const auto& [name, bed] : beds) {
    SCOPED_TRACE(name);
    for (const double wind : {0.0, 3.0, 25.0}) {
      const Refraction r = Sea(wind).over(bed);
      expect_sound(r);
      if (wind == 0.0) {
        EXPECT_EQ(r.shift(0, {0.0, 0.0}), 0.0);
      }
    }
  }
  expect_sound(Sea(10.0, 6.0).over(beds[8].second));
  expect_sound(Sea(10.0, 0.0).over(beds[8].second));
  const Refraction lake = Sea().over(beds[5].second);
  EXPECT_EQ(lake.shelter({0.0, 0.0}), 0.0f);  // nothing comes to it
}

TEST(RefractionHard, WithoutABedNothingBendsAndNothingIsSheltered) {
  // Control, seen: a grid laid over no bounds asks the bed.
  const auto never_asked = [](glm::dvec2, double) -> double { throw std::logic_error("asked"); };
  const Refraction none = Sea().over(never_asked, InputBounds{});
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.shift(0, {3.0, 4.0}), 0.0);
  EXPECT_EQ(none.shelter(1, {3.0, 4.0}), 1.0f);
  EXPECT_EQ(none.shelter({3.0, 4.0}), 1.0f);
  const Refraction point =
      Sea().over([](glm::dvec2, double) { return 2.0; }, InputBounds{{5.0, 5.0}, {5.0, 5.0}});  // of no width
  expect_sound(point);
  // As deep as the sea itself: nothing bends, to a thousandth of a cell.
  const Refraction deep = Sea().over([](glm::dvec2, double) { return deep_water_m; });
  for (int c = 0; c < 3; ++c) EXPECT_LE(deep.most_shift_m(c), 1e-3 * deep.grid().cell_m) << c;
  for (const glm::dvec2 p : {glm::dvec2(0.0), glm::dvec2(300.0, 100.0)}) EXPECT_NEAR(deep.shelter(p), 1.0f, 1e-6f);
}

TEST(RefractionHard, hard_3_a_bed_that_is_no_number_is_refused_by_its_place) {
  // A bed that is NaN or infinite somewhere is refused with the place where it is. Control, seen: the depths not looked
  // at, and nothing is thrown.
  for (const double bad : {nan, infinity, -infinity}) {
    const std::string said = test::error_of(
        [&] { Sea().over([&](glm::dvec2 p, double) { return p.x > 100.0 && p.y > 50.0 ? bad : 9.0; }); });
    EXPECT_EQ(said.rfind("sea_depth: the depth at x 1", 0), 0u) << said;
  }
  const auto deep = [](glm::dvec2, double) { return 9.0; };
  for (const int cells : {-1, 0, 15, 2049})
    EXPECT_NE(
        test::error_of([&] { Sea().over(deep, field, {.cells = cells}); }).find("cells: " + std::to_string(cells)),
        std::string::npos);
  for (const double margin : {nan, infinity, -1.0})
    EXPECT_NE(test::error_of([&] { Sea().over(deep, field, {.margin_waves = margin}); }).find("margin_waves: "),
              std::string::npos);
}

TEST(RefractionHard, TheSameBedGivesTheSameBitsOnAnyThreads) {
  // Made on one thread and three times on four. Control: the lines' rows shared between threads, a race that one run
  // of three saw.
  const auto bed = [](glm::dvec2 p, double) { return 6.0 + 8.0 * std::sin(p.x / 60.0) * std::cos(p.y / 45.0); };
  const Sea sea;
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena one(1), four(4);
  const RefractionSettings fine{.cells = 256};  // long enough for other threads to come in
  const Refraction a = one.execute([&] { return sea.over(bed, field, fine); });
  for (int time = 0; time < 3; ++time) {
    const Refraction b = four.execute([&] { return sea.over(bed, field, fine); });
    for (double x = -700.0; x < 800.0; x += 37.0)
      for (double z = -600.0; z < 500.0; z += 41.0)
        for (int c = 0; c < 5; ++c) {
          ASSERT_EQ(a.shift(c, {x, z}), b.shift(c, {x, z}));
          ASSERT_EQ(a.shelter(c, {x, z}), b.shelter(c, {x, z}));
        }
  }
}

}  // namespace
}  // namespace seascape
