// The front of time and error against looking at every pair, and how far a point is off it.
#include "app/lab/pareto.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace seascape {
namespace {

using ::testing::ElementsAre;

bool beats(const Tradeoff& a, const Tradeoff& b) {
  return a.time <= b.time && a.error <= b.error && (a.time < b.time || a.error < b.error);
}

// Every pair of 200 random points, ties among them. Control seen: `<=` for the error of the next on the front (equal
// points doubled).
TEST(Pareto, TheFrontIsWhatNoOtherBeats) {
  std::mt19937 random(3);
  for (int draw = 0; draw < 20; ++draw) {
    std::vector<Tradeoff> points;
    for (int i = 0; i < 200; ++i) points.push_back({double(random() % 40), double(random() % 40)});
    std::vector<bool> on(points.size(), false);
    double before = -1.0;
    for (const std::size_t i : pareto_front(points)) {
      on[i] = true;
      EXPECT_GT(points[i].time, before) << "ascending in time";
      before = points[i].time;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool beaten = false, earlier = false;
      for (std::size_t j = 0; j < points.size(); ++j) {
        beaten = beaten || beats(points[j], points[i]);
        earlier = earlier || (j < i && points[j].time == points[i].time && points[j].error == points[i].error);
      }
      EXPECT_EQ(on[i], !beaten && !earlier) << i;
    }
  }
  EXPECT_TRUE(pareto_front({}).empty());
}

// Controls seen: settings that err more taken for rivals; the slowest rival for the quickest.
TEST(Pareto, OffTheFrontIsTheTimeThatTheQuickestAsExactTakes) {
  const std::vector<Tradeoff> others{{1.0, 8.0}, {2.0, 4.0}, {4.0, 1.0}};
  EXPECT_EQ(off_front({0.5, 100.0}, others), 1.0) << "the quickest";
  EXPECT_EQ(off_front({2.0, 4.0}, others), 1.0) << "equal to one";
  EXPECT_NEAR(off_front({2.2, 4.1}, others), 1.1, 1e-12);
  EXPECT_NEAR(off_front({6.0, 4.0}, others), 3.0, 1e-12) << "three times the second, which errs as much";
  EXPECT_NEAR(off_front({6.0, 3.9}, others), 1.5, 1e-12);
  EXPECT_EQ(off_front({9.0, 0.5}, others), 1.0) << "more exact than any";
  EXPECT_TRUE(std::isinf(off_front({1.0, 1.0}, std::vector<Tradeoff>{{0.0, 0.0}})));
}

// Controls seen: what errs more taken for near; all near but the front.
TEST(Pareto, NearTheFrontIsWhatTakesLittleMore) {
  const std::vector<Tradeoff> points{{2.0, 4.0}, {1.0, 8.0}, {2.4, 3.9}, {2.6, 4.0}, {1.2, 9.0}, {9.0, 7.0}};
  EXPECT_THAT(near_front(points, 1.0), ElementsAre(0u, 1u, 2u)) << "the front";
  EXPECT_THAT(near_front(points, 1.25), ElementsAre(0u, 1u, 2u, 4u));
  EXPECT_THAT(near_front(points, 1.35), ElementsAre(0u, 1u, 2u, 3u, 4u));
  EXPECT_EQ(near_front(points, 100.0).size(), points.size());
  EXPECT_TRUE(near_front({}, 2.0).empty());
}

}  // namespace
}  // namespace seascape
