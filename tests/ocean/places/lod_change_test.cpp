// What has changed of windows is named texel for texel, and ranges are found as if all were read.
#include "ocean/places/lod_change.h"

#include <gtest/gtest.h>

#include <random>

namespace seascape {
namespace {

constexpr int side = 48;

// How often each stored texel is in the rectangles.
std::vector<int> marked(const LodChange& change) {
  std::vector<int> marks(side * side);
  for (const LodRect& rect : rects(change, side))
    for (int z = rect.z.from; z < rect.z.to; ++z)
      for (int x = rect.x.from; x < rect.x.to; ++x) ++marks[std::size_t(z * side + x)];
  return marks;
}
int stored(std::int64_t texel) { return int(((texel % side) + side) % side); }
bool holds(const LodSpan& span, int at) { return stored(at - span.from) < span.count; }

struct Draws {
  std::mt19937 random{11};
  int next(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random); }
  LodSpan span() {
    LodSpan span;
    span.from = next(0, side - 1);
    span.count = std::max(next(-10, side), 0);
    return span;
  }
  LodChange change() {
    LodChange change;
    change.columns = span();
    change.rows = span();
    return change;
  }
};

// Each texel of its columns and rows once, and no other. Controls seen: no part after the end; columns that have the
// rows' texels too.
TEST(LodChange, RectanglesHaveEachTexelOnce) {
  Draws draws;
  for (int n = 0; n < 500; ++n) {
    const LodChange change = draws.change();
    const std::vector<int> marks = marked(change);
    EXPECT_LE(rects(change, side).size(), 6u);
    for (int z = 0; z < side; ++z)
      for (int x = 0; x < side; ++x)
        ASSERT_EQ(marks[std::size_t(z * side + x)], holds(change.columns, x) || holds(change.rows, z));
  }
}

// What of a window is not in the one before, at places on both sides of 0, steps of all sizes. Control seen: from the
// new window's first texel on, whichever way it went.
TEST(LodChange, IsWhatTheWindowBeforeHadNot) {
  Draws draws;
  for (int n = 0; n < 300; ++n) {
    const int most = n % 3 == 0 ? 2 * side : 4;
    const LodIndex before(draws.next(-100, 100), draws.next(-100, 100)),
        now = before + LodIndex(draws.next(-most, most), draws.next(-most, most));
    const std::vector<int> marks = marked(lod_entered(before, now, side));
    for (std::int64_t z = now.y; z < now.y + side; ++z)
      for (std::int64_t x = now.x; x < now.x + side; ++x) {
        const bool was = x >= before.x && x < before.x + side && z >= before.y && z < before.y + side;
        const bool far = glm::any(glm::greaterThanEqual(glm::abs(now - before), LodIndex(side)));
        ASSERT_EQ(marks[std::size_t(stored(z) * side + stored(x))], far || !was) << n;
      }
  }
}

// Controls seen: no neighbour before the first; none around the end.
TEST(LodChange, NeighboursAreThoseThatTouch) {
  Draws draws;
  for (int n = 0; n < 300; ++n) {
    const LodChange change = draws.change();
    const std::vector<int> marks = marked(change), wider = marked(with_neighbours(change, side));
    const auto at = [&](int x, int z) { return marks[std::size_t(stored(z) * side + stored(x))] != 0; };
    for (int z = 0; z < side; ++z)
      for (int x = 0; x < side; ++x) {
        const bool wanted = at(x, z) || at(x - 1, z) || at(x + 1, z) || at(x, z - 1) || at(x, z + 1);
        ASSERT_EQ(wider[std::size_t(z * side + x)] != 0, wanted) << n << ' ' << x << ' ' << z;
      }
  }
}

// Control seen: the others' alone where both have some.
TEST(LodChange, JoinedHasWhatEitherHas) {
  Draws draws;
  for (int n = 0; n < 300; ++n) {
    LodChanges a{}, b{};
    if (n % 4 != 0) a[1] = draws.change();
    if (n % 5 != 0) b[1] = n % 7 == 0 ? a[1] : draws.change();
    LodChanges both = a;
    join(both, b, side);
    const std::vector<int> of_a = marked(a[1]), of_b = marked(b[1]), of_both = marked(both[1]);
    for (std::size_t i = 0; i < of_a.size(); ++i) ASSERT_TRUE(of_both[i] >= std::max(of_a[i], of_b[i])) << n;
    if (a[1] == b[1] || !b[1].any()) {
      EXPECT_EQ(both[1], a[1]) << "no more than there is";
    }
    EXPECT_EQ(changed_slices(both), a[1].any() || b[1].any() ? 2u : 0u);
  }
}

// Controls seen: squares of the first row alone; a square's old range kept beside the new.
TEST(LodRanges, AreTheLeastAndTheMostOfAll) {
  Draws draws;
  std::vector<float> texels(side * side);
  LodRanges ranges(2, side);
  const auto value = [&](int x, int z) { return texels[std::size_t(z * side + x)]; };
  ranges.take(1, whole_change(side), value);
  for (int n = 0; n < 300; ++n) {
    const LodChange change = draws.change();
    const int least = draws.next(-1000, 0), most = draws.next(0, 1000);
    for (const LodRect& rect : rects(change, side))
      for (int z = rect.z.from; z < rect.z.to; ++z)
        for (int x = rect.x.from; x < rect.x.to; ++x)
          texels[std::size_t(z * side + x)] = float(draws.next(least, most));
    ranges.take(1, change, value);
    EXPECT_EQ(ranges.least(1), *std::min_element(texels.begin(), texels.end()));
    EXPECT_EQ(ranges.most(1), *std::max_element(texels.begin(), texels.end()));
  }
}

}  // namespace
}  // namespace seascape
