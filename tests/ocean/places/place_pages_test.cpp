#include "ocean/places/place_pages.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace seascape {
namespace {

float value_at(glm::dvec2 middle, double texel, double time) {
  return float(3.0 * middle.x - 7.0 * middle.y + 11.0 * texel + time);
}

PlacePages pages() {
  return PlacePages(2, [](glm::dvec2 middle, double texel, double time, float* to) {
    for (int i = 0; i < 8; ++i) to[i] = value_at(middle, texel, time) + float(i);
  });
}

// Whichever texels are asked for, by page or beside all pages: those of the place, of the size and of the time.
// Controls seen: a page found by its place alone; the texels beside all pages begun at the next.
void expect_cell(const PlacePages& pages, std::int64_t x, std::int64_t z, double texel, double time,
                 std::uint32_t& slot) {
  PlacePages::Own own;
  const PlacePages::Cell cell = pages.cell(x, z, texel, time, slot, own);
  for (int i = 0; i < 4; ++i) {
    const float* const at = cell.first + (i & 1) * cell.right + (i >> 1) * cell.below;
    const glm::dvec2 middle = (glm::dvec2(double(x + (i & 1)), double(z + (i >> 1))) + 0.5) * texel;
    ASSERT_EQ(at[0], value_at(middle, texel, time)) << x << " " << z << " " << i;
    ASSERT_EQ(at[7], value_at(middle, texel, time) + 7.0f);
  }
}

TEST(PlacePages, HaveTheTexelsOfAPlaceASizeAndATime) {
  const PlacePages some = pages();
  std::uint32_t slot = 0;
  for (int round = 0; round < 2; ++round)
    for (std::int64_t z = -20; z < 20; ++z)
      for (std::int64_t x = -20; x < 20; ++x) {
        expect_cell(some, x, z, 0.5, 0.0, slot);
        expect_cell(some, x, z, 1.0, 0.0, slot);
        expect_cell(some, x, z, 0.5, 0.1, slot);
      }
  EXPECT_FALSE(some.worn());
}

TEST(PlacePages, AnswerWhenTheyAreFull) {
  const PlacePages some = pages();
  std::uint32_t slot = 0;
  for (std::int64_t i = 0; i < 12000; ++i) expect_cell(some, 8 * i, -24 * i, 0.5, 0.0, slot);
  EXPECT_TRUE(some.worn());
  for (std::int64_t i = 11999; i >= 0; --i) expect_cell(some, 8 * i + 7, -24 * i, 0.5, 0.0, slot);
}

TEST(PlacePages, AnswerSeveralThreadsAtOnce) {
  const PlacePages some = pages();
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      std::uint32_t slot = 0;
      for (std::int64_t i = 0; i < 3000; ++i) expect_cell(some, (i * 7 + t) % 900, i % 5, 0.25, 0.0, slot);
    });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace seascape
