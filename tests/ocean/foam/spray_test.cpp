// Spray of a sea: where it begins, how much of it there is, when it ends, and that neither frames, threads, jumps nor
// the viewer change it.
#include "ocean/foam/spray.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/error.h"
#include "tests/support/own_sea.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {

SeaState storm(double wind_mps = 23.0, double chop = 1.15) {
  SeaState sea;
  sea.wind_speed_mps = wind_mps;
  sea.chop = chop;
  return sea;
}
SpraySettings plenty() {
  SpraySettings settings;
  settings.most = 32768;
  settings.range_m = 50.0;
  return settings;
}
const glm::dvec3 head{3.0, 4.0, -2.0};
test::OwnSpray spray_of(const SpraySettings& settings, const SeaState& sea, const std::vector<InputSpec>& inputs = {}) {
  return test::OwnSpray(settings, sea, {.resolution = 64, .cascades = 4}, 3.85, test::places_of(inputs));
}

std::vector<double> numbers(const Spray::Puff& p) {
  std::vector<double> all{p.relaxation_s, p.age_s,      p.life_s, p.diameter_m, p.radius_m,
                          p.above_m,      p.rising_mps, p.drops,  p.shape};
  for (const glm::dvec3& v : {p.place_m, p.velocity_mps, p.eddy_mps, p.air_mps}) all.insert(all.end(), {v.x, v.y, v.z});
  return all;
}
std::vector<std::vector<double>> numbers(const Spray& spray) {
  std::vector<std::vector<double>> all;
  for (const Spray::Puff& p : spray.puffs()) all.push_back(numbers(p));
  return all;
}
// Over moments and places, for a crest of a storm takes seconds to come by.
double mean_aloft(Spray& spray) {
  double sum = 0.0;
  for (int i = 0; i < 12; ++i) {
    spray.update(50.0 + 13.0 * i, head + glm::dvec3(900.0 * i, 0.0, 0.0));
    sum += double(spray.puffs().size());
  }
  return sum / 12.0;
}

// Of puffs that are just beginning, nearly all begin where the surface is squeezed to less than the threshold, as a
// query finds the water there (a folded crest has several places, of which it finds one, and what begins later in the
// step has moved on: a twentieth); of all places a twentieth. Seen: all of 398. Control seen: a breaker() that does not
// ask for the Jacobian (a fifth).
TEST(Spray, BeginsWhereTheJacobianCollapses) {
  test::OwnSpray spray = spray_of(plenty(), storm());
  int born = 0, squeezed = 0, any = 0, any_squeezed = 0;
  for (int i = 0; i < 8; ++i) {
    spray.update(30.0 + 1.5 * i, head);
    const WaveField& field = spray.breaking().field();
    const WaveTiles& tiles = spray.breaking().tiles();
    const auto is_squeezed = [&](glm::dvec2 place) {
      QueryAnswer water;
      query(field, tiles, {&place, 1}, {&water, 1}, {.footprint_m = 0.25, .most_iterations = 30});
      return field.sea(tiles, place - glm::dvec2(water.displacement.x, water.displacement.z), 0.25).jacobian() <
             spray.breaking().threshold() + 0.03;
    };
    for (const Spray::Puff& p : spray.puffs()) {
      if (!(p.age_s < 0.0) || p.age_s < -0.02) continue;  // before the water has moved on
      ++born;
      squeezed += is_squeezed({p.place_m.x, p.place_m.z});
    }
    for (int k = 0; k < 200; ++k, ++any) any_squeezed += is_squeezed({0.37 * k - 40.0, 0.91 * ((k * 37) % 97) - 40.0});
  }
  RecordProperty("born", born);
  RecordProperty("squeezed", squeezed);
  ASSERT_GT(born, 100);
  EXPECT_GT(squeezed, 0.85 * born);
  EXPECT_LT(any_squeezed, 0.1 * any);
}

// Mean numbers aloft of 10, 15 and 23 m/s, and none below 7 m/s, where not even the waves are computed. Seen: 10, 583
// and 8,512. Control seen: a wind factor of 1.
TEST(Spray, GrowsWithTheWind) {
  double before = 0.0;
  for (const double wind : {10.0, 15.0, 23.0}) {
    if (test::sanitized && wind > 15.0) continue;
    SpraySettings wide = plenty();
    wide.range_m = 120.0;
    wide.life_s = 1.0;
    test::OwnSpray spray = spray_of(wide, storm(wind));
    const double aloft = mean_aloft(spray);
    RecordProperty("aloft_" + std::to_string(int(wind)), std::to_string(aloft));
    EXPECT_GT(aloft, 4.0 * before + 0.5) << wind;
    before = aloft;
  }
  for (const double wind : {0.0, 6.9}) {
    test::OwnSpray none = spray_of(plenty(), storm(wind));
    EXPECT_EQ(mean_aloft(none), 0.0);
    EXPECT_EQ(none.own->made(SeaDetail::crests), 0u) << "no wave was computed";
  }
}

// To the bit, whatever the display's rate, and what is drawn of them. Control seen: frames' time instead of whole
// steps.
TEST(Spray, IsTheSameAtEveryFrameRate) {
  test::OwnSpray reference = spray_of(plenty(), storm());
  for (int i = 0; i <= 60; ++i) reference.update(40.0 + i / 60.0, head);
  const auto want = numbers(reference);
  ASSERT_GT(want.size(), 100u);
  std::vector<gpu::SprayPuff> shown(32768), others(32768);
  const std::size_t count = reference.drawn(41.02, head, shown);
  ASSERT_GT(count, 50u);
  for (const double rate : {30.0, 72.0, 90.0, 120.0}) {
    test::OwnSpray spray = spray_of(plenty(), storm());
    for (int i = 0; i <= int(rate); ++i) spray.update(40.0 + i / rate, head);
    EXPECT_EQ(numbers(spray), want) << rate;
    ASSERT_EQ(spray.drawn(41.02, head, others), count);
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_TRUE(others[i].place == shown[i].place && others[i].streak == shown[i].streak &&
                  others[i].look == shown[i].look);
  }
}

// One thread or many; again, and after a jump there, forwards or backwards, to the bit: all that is aloft began within
// a life. Another seed is another spray. Control seen: a jump that keeps what was there; a beginning of half a life
// before.
TEST(Spray, AMomentHasTheVeryPuffsHoweverItWasComeTo) {
  test::OwnSpray runs = spray_of(plenty(), storm()), jumps = spray_of(plenty(), storm());
  for (int i = 0; i <= 40; ++i) runs.update(50.0 + 0.1 * i, head);
  const auto want = numbers(runs);
  ASSERT_GT(want.size(), 50u);
  jumps.update(54.0, head);
  EXPECT_EQ(numbers(jumps), want);
  jumps.update(300.0, head);
  EXPECT_NE(numbers(jumps), want);
  jumps.update(54.0, head);
  EXPECT_EQ(numbers(jumps), want);
  jumps.update(54.0, head);
  EXPECT_EQ(numbers(jumps), want) << "no time at all";
  jumps.update(54.0, head + glm::dvec3(4000.0, 0.0, 0.0));
  jumps.update(54.0, head);
  EXPECT_EQ(numbers(jumps), want) << "a viewer who was elsewhere";
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    test::OwnSpray alone = spray_of(plenty(), storm());
    alone.update(54.0, head);
    EXPECT_EQ(numbers(alone), want);
  }
  SpraySettings other = plenty();
  other.seed = 2;
  test::OwnSpray others = spray_of(other, storm());
  others.update(54.0, head);
  EXPECT_NE(numbers(others), want);
}

// What two viewers both see is the same. Control seen: cells numbered from the viewer.
TEST(Spray, BelongsToTheWorld) {
  SpraySettings settings = plenty();
  settings.range_m = 150.0;
  settings.life_s = 1.5;
  test::OwnSpray here = spray_of(settings, storm()), there = spray_of(settings, storm());
  const glm::dvec3 other = head + glm::dvec3(14.0, 1.0, 9.0);
  here.update(60.0, head);
  there.update(60.0, other);
  const auto all = numbers(there);
  int near = 0;
  for (const Spray::Puff& p : here.puffs()) {
    if (glm::length(p.place_m - head) > 30.0) continue;
    ++near;
    EXPECT_TRUE(std::find(all.begin(), all.end(), numbers(p)) != all.end());
  }
  EXPECT_GT(near, 20);
}

// The wildest sea: never more than the most, all of it finite, and thinned evenly around the viewer, not on one side.
// Control seen: no thinning (the middle of it 37 m to one side).
TEST(Spray, KeepsItsMost) {
  for (const int most : {64, 1000}) {
    SpraySettings settings = plenty();
    settings.amount = 4.0;
    settings.most = most;
    test::OwnSpray spray = spray_of(settings, storm(60.0, 2.0));
    glm::dvec3 sum(0.0);
    int count = 0;
    for (int i = 0; i < 30; ++i) {
      spray.update(20.0 + i / 12.0, head);
      ASSERT_LE(spray.puffs().size(), std::size_t(most));
      for (const Spray::Puff& p : spray.puffs()) {
        for (const double number : numbers(p)) ASSERT_TRUE(std::isfinite(number));
        sum += p.place_m - p.age_s * p.velocity_mps - head;
        ++count;
      }
    }
    EXPECT_GT(count, 20 * most);
    if (most == 1000) {
      EXPECT_LT(glm::length(glm::dvec2(sum.x, sum.z) / double(count)), 0.45 * settings.range_m);
    }
  }
}

// A share of it is of the same puffs: each that is drawn at a smaller share is drawn at a larger one, hides as much or
// more there, and all of it is what is drawn without one. Control seen: ranks by the place in the list.
TEST(Spray, AShareIsOfTheSamePuffs) {
  test::OwnSpray spray = spray_of(plenty(), storm());
  std::vector<gpu::SprayPuff> more(32768), fewer(32768);
  spray.update(70.0, head);
  std::size_t before = spray.drawn(70.01, head, more);
  const std::size_t all = before;
  ASSERT_GT(all, 1000u);
  EXPECT_EQ(spray.drawn(70.01, head, fewer, 1.0), all);
  for (const double share : {0.8, 0.5, 0.2, 0.0}) {
    const std::size_t n = spray.drawn(70.01, head, fewer, share);
    std::size_t at = 0;
    for (std::size_t k = 0; k < n; ++k) {
      while (at < before && more[at].place != fewer[k].place) ++at;
      ASSERT_LT(at, before) << share << ": a puff that was not there before";
      ASSERT_LE(fewer[k].streak.w, more[at].streak.w) << share;
    }
    EXPECT_NEAR(double(n), std::min(1.1 * share, 1.0) * double(all), 0.05 * double(all)) << share;
    std::swap(more, fewer);
    before = n;
  }
}

// Nothing is drawn that lies deep beneath the water, at any moment between steps; and what has lived less than it may
// has ended on the water. Control seen: land() that asks for the age alone (metres beneath).
TEST(Spray, EndsOnTheWater) {
  test::OwnSpray spray = spray_of(plenty(), storm());
  const WaveField field(storm(), {64, 4});
  WaveTiles tiles;
  std::vector<gpu::SprayPuff> shown(32768);
  double lowest = 0.0, sum = 0.0;
  int count = 0;
  for (int i = 0; i < 24; ++i) {
    const double time_s = 70.0 + i / 29.0;
    spray.update(time_s, head);
    field.evaluate(ticks_from_seconds(time_s), tiles);
    const std::size_t n = spray.drawn(time_s, head, shown);
    for (std::size_t k = 0; k < n; ++k) {
      const glm::dvec2 place = glm::dvec2(head.x, head.z) + glm::dvec2(shown[k].place.x, shown[k].place.z);
      QueryAnswer water;
      query(field, tiles, {&place, 1}, {&water, 1}, {.footprint_m = 0.25, .most_iterations = 20});
      if (!water.converged) continue;  // where the surface is folded it has several heights
      const double above = double(shown[k].place.y) - water.height_m;
      lowest = std::min(lowest, above);
      sum += std::min(above, 0.0);
      ++count;
    }
  }
  RecordProperty("lowest", std::to_string(lowest));
  ASSERT_GT(count, 1000);
  EXPECT_GT(lowest, -1.0);
  EXPECT_GT(sum / count, -0.01);
  for (const Spray::Puff& p : spray.puffs()) EXPECT_GE(p.above_m, 0.0);
}

// Half of what a puff takes of the view, with the way that it is drawn out along, in radians or thereabouts.
double half_size(const gpu::SprayPuff& seen) {
  const glm::dvec3 from(seen.place.x, double(seen.place.y) - head.y, seen.place.z), streak(seen.streak);
  const double distance = glm::length(from);
  return (double(seen.place.w) + glm::length(glm::cross(streak, from)) / distance) / distance;
}

// Near the eye spray fades, however large and many the puffs and however hard the wind blows: none that hides anything
// is more than 0.6 radians across, drawn out or not, nor longer than four of its breadths. Controls seen: a fade by
// distance alone (2.5 radians to either side); a way as long as the wind makes it (19 breadths).
TEST(Spray, FadesNearTheEye) {
  for (const auto& [size, wind] : {std::pair{4.0, 23.0}, {1.0, 64.0}, {0.25, 64.0}}) {
    SpraySettings settings = plenty();
    settings.amount = 4.0;
    settings.size = size;
    test::OwnSpray spray = spray_of(settings, storm(wind));
    std::vector<gpu::SprayPuff> shown(32768);
    double largest = 0.0, longest = 0.0;
    for (int i = 0; i < 6; ++i) {
      spray.update(50.0 + 13.0 * i, head);
      const std::size_t n = spray.drawn(spray.step_s(), head, shown);
      for (std::size_t k = 0; k < n; ++k) {
        largest = std::max(largest, half_size(shown[k]));
        longest = std::max(longest, glm::length(glm::dvec3(shown[k].streak)) / double(shown[k].place.w));
      }
    }
    EXPECT_GT(largest, 0.05) << "some are near";
    EXPECT_LT(largest, 0.3);
    EXPECT_LT(longest, 4.001);
  }
}

// Drops hide more than mist; all of it less as eddies draw it apart, and nothing at the end of its life. Control: drops
// that hide less (tests/mutants).
TEST(Spray, HidesLessAsItIsDrawnApartAndGrowsOld) {
  test::OwnSpray spray = spray_of(plenty(), storm());
  std::vector<gpu::SprayPuff> shown(32768);
  std::size_t compared = 0;
  double least_drops = 1.0, most_drops = 0.0;
  for (int i = 0; i < 12; ++i) {
    const glm::dvec3 viewer = head + glm::dvec3(900.0 * i, 0.0, 0.0);
    spray.update(50.0 + 13.0 * i, viewer);
    const std::size_t n = spray.drawn(spray.step_s(), viewer, shown);
    std::size_t next = 0;
    for (const Spray::Puff& p : spray.puffs()) {
      if (next == n || shown[next].look.x != float(p.shape)) continue;  // not to be seen
      const gpu::SprayPuff& seen = shown[next++];
      const double distance = glm::length(p.place_m - viewer), old = p.age_s / p.life_s;
      if (p.age_s < 0.08 || (p.rising_mps < 0.0 && p.above_m < 0.2) || distance > 33.0 || half_size(seen) > 0.1)
        continue;  // comes, goes, or is too near or far
      EXPECT_NEAR(
          double(seen.streak.w),
          (0.4 + 0.4 * p.drops) * std::pow(p.radius_m / double(seen.place.w), 1.5) * std::pow(1.0 - old * old, 2.0),
          1e-5);
      least_drops = std::min(least_drops, p.drops), most_drops = std::max(most_drops, p.drops);
      ++compared;
    }
    EXPECT_EQ(next, n);
  }
  EXPECT_GT(compared, 100u);
  EXPECT_GT(most_drops - least_drops, 0.2);
}

// Spray rises with the level and begins neither on land nor where the water is clipped. Controls seen: the
// level left out; clip left out.
TEST(Spray, KnowsItsPlace) {
  test::OwnSpray far = spray_of(plenty(), storm());
  const glm::dvec3 away{1e6, 4.0, -3e6};
  std::vector<gpu::SprayPuff> shown(32768);
  far.update(54.0, away);
  const std::size_t n = far.drawn(54.02, away, shown);
  ASSERT_GT(n, 20u);
  for (std::size_t i = 0; i < n; ++i) ASSERT_LT(std::abs(shown[i].place.x) + std::abs(shown[i].place.z), 120.0f);

  test::OwnSpray flat = spray_of(plenty(), storm()), none = spray_of(plenty(), storm()),
                 raised = spray_of(plenty(), storm(), {test::flat_input(InputTarget::level, 30.0)}),
                 land = spray_of(plenty(), storm(), {test::flat_input(InputTarget::sea_depth, 1.0)}),
                 dock = spray_of(plenty(), storm(), {test::flat_input(InputTarget::clip, 1.0)});
  flat.update(54.0, head);
  raised.update(54.0, head + glm::dvec3(0.0, 30.0, 0.0));
  land.update(54.0, head);
  dock.update(54.0, head);
  none.update(54.0, head + glm::dvec3(0.0, 400.0, 0.0));
  ASSERT_EQ(raised.puffs().size(), flat.puffs().size());
  for (std::size_t i = 0; i < flat.puffs().size(); ++i)
    EXPECT_NEAR(raised.puffs()[i].place_m.y, flat.puffs()[i].place_m.y + 30.0, 1e-6);
  EXPECT_TRUE(land.puffs().empty());
  EXPECT_TRUE(dock.puffs().empty());
  EXPECT_TRUE(none.puffs().empty());
  EXPECT_EQ(none.own->made(SeaDetail::crests), 0u) << "no wave was computed";

  const auto before = numbers(flat);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -infinite, 1e300}) {
    flat.update(bad, head);
    flat.update(55.0, {bad, 1.0, 0.0});
    EXPECT_EQ(numbers(flat), before);
  }
  SpraySettings wrong;
  wrong.range_m = nan;
  EXPECT_THROW(validate(wrong), Error);
  wrong = {};
  wrong.most = 0;
  EXPECT_THROW(validate(wrong), Error);
}

}  // namespace
}  // namespace seascape
