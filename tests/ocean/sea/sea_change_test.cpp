// A sea that grows out of another: its ends, what lies between, and that nobody waits for its making.
#include "ocean/sea/sea_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "engine/error.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {
namespace {

constexpr WaveQuality quality{.resolution = 64, .cascades = 4};

MadeSea made(const SeaState& sea, const Ladder& ladder) {
  MadeSea result{sea, make_wave_bins(sea, quality, ladder), {}};
  result.statistics = sea_statistics(sea, result.bins);
  return result;
}

SeaState breeze() {
  SeaState sea;
  sea.wind_speed_mps = 7;
  sea.chop = 0.8;
  return sea;
}
SeaState gale() {
  SeaState sea;
  sea.wind_speed_mps = 18;
  sea.wind_to_deg = 120;
  sea.swell_height_m = 2;
  sea.chop = 1.1;
  return sea;
}

bool same_waves(const WaveBins& a, const WaveBins& b) {
  return std::equal(a.bins.begin(), a.bins.end(), b.bins.begin(), b.bins.end(),
                    [](const gpu::WaveBin& x, const gpu::WaveBin& y) {
                      return x.amplitude == y.amplitude && x.turns_high == y.turns_high && x.turns_low == y.turns_low;
                    });
}

double variance(const WaveBins& bins) {
  double sum = 0;
  for (const gpu::WaveBin& bin : bins.bins) sum += 0.5 * double(glm::dot(bin.amplitude, bin.amplitude));
  return sum;
}

constexpr std::int64_t begin = 1'000'000, end = 5'000'000;

// Control: weights of the amplitudes swapped; the new sea on its own ladder (its waves run at other frequencies).
TEST(SeaBlend, IsTheOldSeaBeforeItAndTheNewSeaAfterIt) {
  const Ladder l = ladder(breeze());
  for (const bool same_seed : {true, false}) {
    SeaState other = gale();
    if (!same_seed) other.seed = 77;
    const MadeSea from = made(breeze(), l), to = made(other, l);
    const SeaBlend blend(from, to, begin, end, same_seed);
    WaveBins bins = from.bins;
    for (const std::int64_t ticks : {begin - 1000, begin}) {
      blend.amplitudes(ticks, bins);
      EXPECT_TRUE(same_waves(bins, from.bins));
      EXPECT_EQ(blend.chop(ticks), 0.8);
      EXPECT_EQ(blend.statistics(ticks).height_variance, from.statistics.height_variance);
      EXPECT_FALSE(blend.over(ticks));
    }
    for (const std::int64_t ticks : {end, end + 7}) {
      blend.amplitudes(ticks, bins);
      EXPECT_TRUE(same_waves(bins, to.bins));
      EXPECT_EQ(blend.chop(ticks), 1.1);
      EXPECT_EQ(blend.statistics(ticks).largest_height_m, to.statistics.largest_height_m);
      EXPECT_TRUE(blend.over(ticks));
    }
  }
}

// Between the two the sea's energy is between theirs at every time, and the bounds that culling trusts hold. Control:
// amplitudes of two seeds' waves passed over in a straight line lose half of the energy on the way.
TEST(SeaBlend, HasAnEnergyBetweenBothSeas) {
  const Ladder l = ladder(gale());
  for (const bool same_seed : {true, false}) {
    SeaState other = gale();
    other.wind_to_deg = 160;
    if (!same_seed) other.seed = 77;
    const MadeSea from = made(gale(), l), to = made(other, l);
    const SeaBlend blend(from, to, begin, end, same_seed);
    WaveBins bins = from.bins;
    const double a = variance(from.bins), b = variance(to.bins);
    for (int i = 0; i <= 20; ++i) {
      const std::int64_t ticks = begin + (end - begin) * i / 20;
      blend.amplitudes(ticks, bins);
      const double now = variance(bins);
      // Seas of one seed whose directions differ share some waves only: no less than the straight line's half of what
      // they do not share.
      EXPECT_GE(now, (same_seed ? 0.5 : 0.93) * std::min(a, b)) << i;
      EXPECT_LE(now, 1.07 * std::max(a, b)) << i;
      EXPECT_GE(blend.statistics(ticks).largest_height_m, 5.2 * std::sqrt(now)) << i;
    }
  }
}

// From frame to frame, at 90 a second, no place moves faster in a change of two seconds than in the steady gale.
// Control: a change that begins in its middle, and one from the new sea's waves of another seed.
TEST(SeaBlend, NeverJumps) {
  const Ladder l = ladder(breeze());
  const MadeSea from = made(breeze(), l), to = made(gale(), l);
  const std::int64_t start = ticks_from_seconds(20), over = ticks_from_seconds(2);
  const auto largest_step = [&](const SeaBlend& blend, double from_s, double to_s) {
    WaveField field(breeze(), quality, from.bins);
    WaveBins bins = from.bins;
    WaveTiles tiles;
    std::vector<glm::dvec3> before;
    double largest = 0;
    for (int frame = 0; frame <= int((to_s - from_s) * 90); ++frame) {
      const std::int64_t ticks = ticks_from_seconds(from_s + frame / 90.0);
      blend.amplitudes(ticks, bins);
      field.take(bins, blend.chop(ticks), blend.statistics(ticks));
      field.evaluate(ticks, tiles);
      std::vector<glm::dvec3> now;
      for (int i = 0; i < 60; ++i) now.push_back(field.displacement(tiles, {41.3 * i, 17.9 * i - 300}, 0));
      for (std::size_t i = 0; i < before.size(); ++i) largest = std::max(largest, glm::length(now[i] - before[i]));
      before = now;
    }
    return largest;
  };
  const SeaBlend change(from, to, start, start + over, true);
  const double steady = largest_step(change, 24, 25), changing = largest_step(change, 19.9, 22.1);
  EXPECT_LT(changing, 2.0 * steady);
  RecordProperty("of_the_steady_step", std::to_string(changing / steady));
  EXPECT_GT(largest_step(SeaBlend(from, to, start + over, start + over + 1, true), 21.9, 22.1), 4 * steady)
      << "a jump is seen";
}

// After a change the field is the one that is made for the new sea. Control: shifts left with the old chop.
TEST(SeaBlend, LeavesTheFieldOfTheNewSea) {
  const Ladder l = ladder(breeze());
  const MadeSea from = made(breeze(), l), to = made(gale(), l);
  WaveField changed(breeze(), quality, from.bins);
  changed.take(to.bins, to.state.chop, to.statistics);
  const WaveField fresh(gale(), quality, to.bins);
  WaveTiles a, b;
  changed.evaluate(12345678, a);
  fresh.evaluate(12345678, b);
  double worst = 0, largest = 0;
  for (int c = 0; c < quality.cascades; ++c)
    for (const WavePlane plane : {WavePlane::shift, WavePlane::slope})
      for (int z = 0; z < a.samples(c); ++z)
        for (int x = 0; x < a.samples(c); ++x) {
          const std::ptrdiff_t at = std::ptrdiff_t(z) * a.stride(c, 0) + x;
          worst = std::max(worst, double(glm::length(a.texels(c, plane, 0)[at] - b.texels(c, plane, 0)[at])));
          largest = std::max(largest, double(glm::length(b.texels(c, plane, 0)[at])));
        }
  EXPECT_LE(worst, 1e-6 * largest);
}

std::optional<MadeSea> wait_for(SeaMaker& maker) {
  for (int i = 0; i < 2000; ++i) {
    if (std::optional<MadeSea> sea = maker.take()) return sea;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return std::nullopt;
}

// The last of several wishes comes, once, with every wave where the ladder has it; a bad one is refused and nothing
// changes. Control: a maker that keeps the first.
TEST(SeaMaker, MakesTheSeaAskedForLast) {
  const Ladder l = ladder(breeze());
  SeaMaker maker(l, quality);
  EXPECT_FALSE(maker.take());
  for (const double wind : {5.0, 9.0, 21.0}) {
    SeaState sea = gale();
    sea.wind_speed_mps = wind;
    maker.ask(sea, quality);
  }
  SeaState bad = gale();
  bad.wind_speed_mps = -1;
  EXPECT_THROW(maker.ask(bad, quality), Error);
  std::optional<MadeSea> sea = wait_for(maker);
  ASSERT_TRUE(sea);
  SeaState last = gale();
  last.wind_speed_mps = 21;
  EXPECT_EQ(sea->state.wind_speed_mps, 21);
  EXPECT_TRUE(same_waves(sea->bins, make_wave_bins(last, quality, l)));
  EXPECT_EQ(sea->bins.ladder[0].side_m, l[0].side_m);
  EXPECT_FALSE(maker.take());
}

// Control: a depth left out of the comparison.
TEST(SeaMaker, OnlySeasOfOneDispersionGrowOutOfEachOther) {
  EXPECT_TRUE(grows_out_of(breeze(), gale()));
  for (auto change : {+[](SeaState& s) { s.depth_m = 20; }, +[](SeaState& s) { s.gravity_mps2 = 3.7; },
                      +[](SeaState& s) { s.loop_s = 30; }}) {
    SeaState other = gale();
    change(other);
    EXPECT_FALSE(grows_out_of(breeze(), other));
  }
}

}  // namespace
}  // namespace seascape
