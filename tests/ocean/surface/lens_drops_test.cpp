// Drops on a lens: a function of time and seed, for some seconds. Controls are named beside each test; each was seen to
// fail.
#include "ocean/surface/lens_drops.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seascape {
namespace {

// Under water until 1 s, then out of it.
std::vector<gpu::LensDrop> drops_at(double time_s, double from_s = 0.0, double rate_hz = 90.0, int eye = 0,
                                    std::uint32_t seed = 3, glm::dvec2 down = {0.0, -1.0}) {
  LensDrops lens;
  const int first = int(std::lround(from_s * rate_hz)), last = int(std::lround(time_s * rate_hz));
  for (int n = first; n <= last; ++n)
    lens.step({.time_s = n / rate_hz, .wet = n / rate_hz < 1.0, .down = down}, seed, eye);
  std::vector<gpu::LensDrop> drops;
  lens.list(drops);
  return drops;
}

bool same(const std::vector<gpu::LensDrop>& a, const std::vector<gpu::LensDrop>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
           return x.place == y.place && x.shape == y.shape;
         });
}

// None before it was in the water, nor in it; a few right after, within what the eye sees, each of a few millimetres;
// none after their life. Control: wet_ left out of what makes them.
TEST(LensDrops, AreThereForSomeSecondsAfterTheLensCameOut) {
  LensDrops never;
  for (int n = 0; n < 300; ++n) never.step({.time_s = n / 90.0, .down = {0.0, -1.0}}, 3, 0);
  EXPECT_FALSE(never.any());
  EXPECT_TRUE(drops_at(0.9).empty());
  const std::vector<gpu::LensDrop> first = drops_at(1.0);
  EXPECT_EQ(first.size(), std::size_t(LensDrops::most));
  for (const gpu::LensDrop& drop : first) {
    EXPECT_LE(std::max(std::abs(drop.place.x), std::abs(drop.place.y)), 1.0f);
    EXPECT_GE(drop.place.z, 0.005f);
    EXPECT_LE(drop.place.z, 0.024f);
    EXPECT_EQ(drop.shape.z, 1.0f);
  }
  EXPECT_GT(drops_at(2.5).size(), 6u);
  EXPECT_LT(drops_at(5.0).size(), drops_at(2.5).size());
  EXPECT_TRUE(drops_at(1.0 + LensDrops::life_s).empty());
}

// Whoever begins to look later sees the same to the bit, as long as he has seen the lens in the water; another seed or
// eye has others; and how often one looks hardly matters. Control: the time of coming out taken from where one began.
TEST(LensDrops, FollowFromTimeAndSeed) {
  EXPECT_TRUE(same(drops_at(2.0), drops_at(2.0)));
  EXPECT_TRUE(same(drops_at(2.0), drops_at(2.0, 0.7)));
  EXPECT_FALSE(same(drops_at(2.0), drops_at(2.0, 0.0, 90.0, 1)));
  EXPECT_FALSE(same(drops_at(2.0), drops_at(2.0, 0.0, 90.0, 0, 4)));
  const auto fine = drops_at(2.0), coarse = drops_at(2.0, 0.0, 30.0);
  ASSERT_EQ(fine.size(), coarse.size());
  for (std::size_t n = 0; n < fine.size(); ++n) EXPECT_LT(glm::distance(fine[n].place, coarse[n].place), 1e-5f);
}

// They run downwards only, whichever way that is, the large ones far. Control: the sine's share above 1, with which
// they turn back.
TEST(LensDrops, RunDownwards) {
  for (const glm::dvec2 down : {glm::dvec2(0.0, -1.0), glm::dvec2(0.6, -0.8), glm::dvec2(0.0, 0.0)}) {
    double farthest = 0.0;
    auto before = drops_at(1.0, 0.0, 90.0, 0, 3, down);
    const auto first = before;
    for (int n = 1; n < 80; ++n) {  // until the first dries
      const auto now = drops_at(1.0 + n / 90.0, 0.0, 90.0, 0, 3, down);
      ASSERT_EQ(now.size(), before.size());
      for (std::size_t i = 0; i < now.size(); ++i) {
        const glm::dvec2 way(now[i].place.x - before[i].place.x, now[i].place.y - before[i].place.y);
        EXPECT_GE(glm::dot(way, down), -1e-7);
        EXPECT_NEAR(way.x * down.y - way.y * down.x, 0.0, 1e-6);
        farthest = std::max(farthest, glm::distance(glm::dvec2(now[i].place), glm::dvec2(first[i].place)));
      }
      before = now;
    }
    if (glm::length(down) > 0.0) {
      EXPECT_GT(farthest, 0.05);
    } else {
      EXPECT_EQ(farthest, 0.0);
    }
  }
}

// The next wave washes them off, and a jump of time leaves a dry lens. Control: the limit of a step left out.
TEST(LensDrops, AreWashedOff) {
  const auto after = [](std::initializer_list<std::pair<double, bool>> moments) {
    LensDrops lens;
    for (const auto& [time_s, wet] : moments) lens.step({.time_s = time_s, .wet = wet, .down = {0.0, -1.0}}, 3, 0);
    std::vector<gpu::LensDrop> drops;
    lens.list(drops);
    return drops.size();
  };
  EXPECT_GT(after({{0.0, true}, {0.1, false}}), 0u);
  EXPECT_EQ(after({{0.0, true}, {0.1, false}, {0.2, true}}), 0u);
  EXPECT_EQ(after({{0.0, true}, {0.1, false}, {9.0, false}}), 0u);
  EXPECT_EQ(after({{5.0, true}, {5.1, false}, {5.0, false}}), 0u);
  EXPECT_EQ(after({{0.0, true}, {9.0, false}}), 0u);
}

}  // namespace
}  // namespace seascape
