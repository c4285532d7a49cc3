// Rows of foam against the same formulas texel by texel in double.
#include "ocean/foam/foam_simd.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <random>
#include <vector>

namespace seascape {
namespace {

template <class Work>
void with_each_instruction_set(const Work& work) {
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    hwy::GetChosenTarget().DeInit();
    work(hwy::TargetName(left & -left));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

constexpr int side = 64;
constexpr double dt = 1.0 / 12.0, texel_m = 0.5;

struct Slice {
  std::vector<float> before;
  std::vector<glm::vec2> speed;  // with a texel more on either side
  explicit Slice(std::mt19937& random) {
    std::uniform_real_distribution<float> unit;
    std::normal_distribution<float> normal;
    for (int i = 0; i < side * side; ++i) before.push_back(unit(random));
    for (int i = 0; i < side * (side + 2); ++i) {
      const bool rests = i % 3 == 0 || (i % (side + 2)) / 16 == 2;
      speed.push_back(rests ? glm::vec2(0.0f) : 8.0f * glm::vec2{normal(random), normal(random)});
    }
  }
  const glm::vec2* row(int z) const { return speed.data() + glm::clamp(z, 0, side - 1) * (side + 2) + 1; }
  float at(int x, int z) const { return before[std::size_t(z * side + x)]; }
};

struct Carried {
  std::vector<float> values{std::vector<float>(side)}, grow{values}, covered{values};
  std::vector<int> beyond{std::vector<int>(side)};
  std::vector<glm::vec2> ways{std::vector<glm::vec2>(side)};
  glm::dvec2 sums{0.0};
  Carried(const Slice& slice, int z) {
    const int count = carry_row(
        {slice.before.data(), slice.row(z - 1), slice.row(z), slice.row(z + 1), side, z, float(dt), float(texel_m)},
        values, grow, beyond, ways);
    beyond.resize(std::size_t(count)), ways.resize(std::size_t(count));
    for (const int x : beyond) values[std::size_t(x)] = 0.125f;
    sums = settle_row(values, grow, covered);
  }
  friend bool operator==(const Carried&, const Carried&) = default;
};

double cubic(double f, int i) {
  const double w[] = {f * (f * (2.0 - f) - 1.0), f * f * (3.0 * f - 5.0) + 2.0, f * (f * (4.0 - 3.0 * f) + 1.0),
                      f * f * (f - 1.0)};
  return 0.5 * w[i];
}

// Of all rows; of each instruction set the same to the bit. Controls seen: the slopes of the flow along x for those
// along z; a texel's weights along x for those across; a border's slopes that are not left out; a texel of the last two
// columns taken for one within.
TEST(FoamRows, AreCarriedAsTexelByTexel) {
  std::mt19937 random(3);
  const Slice slice(random);
  double worst = 0.0;
  int carried = 0, beyond = 0;
  for (int z = 0; z < side; ++z) {
    const Carried best(slice, z);
    glm::dvec2 sums(0.0);
    std::size_t next = 0;
    for (int x = 0; x < side; ++x) {
      const glm::dvec2 speed(slice.row(z)[x]);
      glm::dvec2 midway = speed, along_x(0.0), along_z(0.0);
      if (x > 0 && z > 0 && x + 1 < side && z + 1 < side) {
        along_x = glm::dvec2(slice.row(z)[x + 1]) - glm::dvec2(slice.row(z)[x - 1]);
        along_z = glm::dvec2(slice.row(z + 1)[x]) - glm::dvec2(slice.row(z - 1)[x]);
        const glm::dvec2 back = -0.5 * dt / (2.0 * texel_m) * speed;
        midway += back.x * along_x + back.y * along_z;
      }
      const glm::dvec2 way = -dt / texel_m * midway, at = glm::dvec2(x, z) + way, cell = glm::floor(at);
      double value = 0.0;
      if (midway == glm::dvec2(0.0)) {
        value = double(slice.at(x, z));
      } else if (cell.x >= 1.0 && cell.y >= 1.0 && cell.x < side - 2 && cell.y < side - 2) {
        for (int j = 0; j < 4; ++j)
          for (int i = 0; i < 4; ++i)
            value += cubic(at.x - cell.x, i) * cubic(at.y - cell.y, j) *
                     double(slice.at(int(cell.x) - 1 + i, int(cell.y) - 1 + j));
        ++carried;
      } else {
        ASSERT_LT(next, best.beyond.size());
        ASSERT_EQ(best.beyond[next], x);
        EXPECT_LT(glm::distance(glm::dvec2(best.ways[next]), way), 1e-5);
        value = 0.125, ++next, ++beyond;
      }
      value *= std::exp(std::clamp(-(along_x.x + along_z.y) / (2.0 * texel_m) * dt, -4.0, 4.0));
      (value < 0.0 ? sums.x : sums.y) += value;
      worst = std::max(worst, std::abs(double(best.covered[std::size_t(x)]) - std::clamp(value, 0.0, 1.0)));
    }
    EXPECT_EQ(next, best.beyond.size());
    EXPECT_LT(glm::distance(best.sums, sums), 1e-4 * sums.y);
    with_each_instruction_set([&](const char* name) { EXPECT_EQ(Carried(slice, z), best) << name << ' ' << z; });
  }
  EXPECT_GT(carried, 1500);
  EXPECT_GT(beyond, 100);
  RecordProperty("worst", std::to_string(worst * 1e6) + "e-6");
  EXPECT_LT(worst, 2e-5);
}

// Gains from none to more than any, foam from none to all, and what is neither. Controls seen: the step without the
// loss; foam that is no share left as it is.
TEST(FoamRows, AreSpentAsTexelByTexel) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const double loss = 1.0 / 3.85;
  std::vector<float> gains, covered;
  for (const float g : {0.0f, 1e-6f, 0.02f, 0.5f, 2.0f, 100.0f, 9e5f, 2e6f, -1.0f, nan})
    for (const float f :
         {0.0f, 5e-5f, 1e-3f, 0.2f, 0.7f, 1.0f, 1.5f, -0.1f, nan, 0.4f, 0.05f, 0.9f, 0.3f, 0.6f, 0.8f, 0.1f})
      gains.push_back(g), covered.push_back(f);
  const auto spent = [&](std::size_t first, SpentRow& told) {
    std::vector<float> row(covered.begin() + std::ptrdiff_t(first), covered.begin() + std::ptrdiff_t(first) + 16);
    told = spend_row(float(loss), float(dt), float(std::exp(-dt * loss)), std::span(gains).subspan(first, 16), row);
    return row;
  };
  double worst = 0.0;
  for (std::size_t first = 0; first < gains.size(); first += 16) {
    SpentRow told;
    const std::vector<float> got = spent(first, told);
    EXPECT_TRUE(told.holds && told.wrong);
    for (std::size_t i = 0; i < 16; ++i) {
      const double g = gains[first + i] >= 0.0f ? std::min(double(gains[first + i]), 1e6) : 0.0,
                   f = covered[first + i] >= 0.0f ? std::min(double(covered[first + i]), 1.0) : 0.0;
      const double rest = g / (g + loss), next = rest + (f - rest) * std::exp(-(g + loss) * dt);
      if (next < double(least_foam)) {
        EXPECT_EQ(got[i], 0.0f);
      } else {
        worst = std::max(worst, std::abs(double(got[i]) - next));
      }
    }
    with_each_instruction_set([&](const char* name) { EXPECT_EQ(spent(first, told), got) << name; });
  }
  EXPECT_LT(worst, 1e-6);
  std::vector<float> row(16, 0.0f);
  const std::vector<float> none(16, 0.0f);
  const SpentRow told = spend_row(float(loss), float(dt), 0.9f, none, row);
  EXPECT_FALSE(told.holds || told.wrong);
}

}  // namespace
}  // namespace seascape
