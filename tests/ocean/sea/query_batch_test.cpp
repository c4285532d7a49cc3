// Batches of queries: the answers of single calls to the bit, on any thread, from any start, with no allocation.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <thread>
#include <tuple>
#include <vector>

#include "ocean/sea/query_simd.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/allocations.h"

namespace seascape {
namespace {

auto all_of(const QueryAnswer& a) {
  return std::tuple(a.height_m, a.displacement.x, a.displacement.y, a.displacement.z, a.normal.x, a.normal.y,
                    a.normal.z, a.orbital_velocity_mps.x, a.orbital_velocity_mps.y, a.orbital_velocity_mps.z,
                    a.eulerian_velocity_mps.x, a.eulerian_velocity_mps.y, a.eulerian_velocity_mps.z, a.residual_m,
                    a.contraction, a.iterations, a.converged);
}

int different(std::span<const QueryAnswer> a, std::span<const QueryAnswer> b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += all_of(a[i]) != all_of(b[i]);
  return count;
}

// A steep sea: points end after different numbers of steps, some in folds.
struct Sea {
  Sea() {
    SeaState state;
    state.wind_speed_mps = 14;
    state.chop = 1.6;
    field.emplace(state, WaveQuality{.resolution = 64, .cascades = 4});
    field->evaluate(ticks_from_seconds(1e3), tiles);
  }
  std::optional<WaveField> field;
  WaveTiles tiles{true};
};

std::vector<glm::dvec2> some_places(std::size_t count) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> near(-300, 300), far(-1e6, 1e6);
  std::vector<glm::dvec2> places;
  for (std::size_t i = 0; i < count; ++i)
    places.push_back(i % 3 ? glm::dvec2(near(random), near(random)) : glm::dvec2(far(random), far(random)));
  return places;
}

TEST(QueryBatch, answers_do_not_depend_on_what_stands_beside_them) {
  // Single calls, batches of every small length, a long one and the same reversed, at footprints on one mip level and
  // between two. Control: the sum over layers begun with the last layer for batches of more than four points fails.
  const Sea sea;
  const std::vector<glm::dvec2> places = some_places(5000);
  for (const double footprint : {0.0, 1.7, 40.0}) {
    const QueryOptions options{.footprint_m = footprint};
    std::vector<QueryAnswer> single(places.size()), batch(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      query(*sea.field, sea.tiles, {&places[i], 1}, {&single[i], 1}, options);
    std::size_t first = 0;
    for (std::size_t length = 1; first + length <= places.size(); first += length++)
      query(*sea.field, sea.tiles, {&places[first], length}, {&batch[first], length}, options);
    EXPECT_EQ(different({single.data(), first}, {batch.data(), first}), 0) << footprint;
    query(*sea.field, sea.tiles, places, batch, options);
    EXPECT_EQ(different(single, batch), 0) << footprint;
    std::vector<glm::dvec2> reversed(places.rbegin(), places.rend());
    query(*sea.field, sea.tiles, reversed, batch, options);
    std::reverse(batch.begin(), batch.end());
    EXPECT_EQ(different(single, batch), 0) << footprint;
  }
  query(*sea.field, sea.tiles, {}, {});
}

TEST(QueryBatch, displaces_rest_positions_as_the_field_does_one_by_one) {
  // Control: every group begun at the first place fails from 33 places on (2.9 m).
  const Sea sea;
  const std::vector<glm::dvec2> places = some_places(1000);
  for (const std::size_t count : {std::size_t{1}, std::size_t{7}, std::size_t{32}, std::size_t{33}, places.size()}) {
    std::vector<glm::vec3> moved(count);
    displace_points(plan_queries(*sea.field, sea.tiles, {}), places.data(), moved.data(), count);
    double off = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      off = std::max(off, glm::length(glm::dvec3(moved[i]) - sea.field->displacement(sea.tiles, places[i], 0.0)));
    EXPECT_LE(off, 1e-4) << count;
  }
}

TEST(QueryBatch, ThreadsMakeNoDifference) {
  // Tiles evaluated and asked by one, two and three threads of TBB; and four threads that ask of one sea at once.
  // Control: a share scaled by 1 + 1e-6 (threads - 1) fails.
  const std::vector<glm::dvec2> places = some_places(6000);
  std::vector<QueryAnswer> first(places.size());
  for (const std::size_t threads : {1, 2, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Sea sea;
    std::vector<QueryAnswer> answers(places.size());
    query(*sea.field, sea.tiles, places, answers);
    if (threads == 1) first = answers;
    EXPECT_EQ(different(first, answers), 0) << threads;
  }
  const Sea sea;
  std::vector<std::vector<QueryAnswer>> answers(4, std::vector<QueryAnswer>(places.size()));
  std::vector<std::thread> threads;
  for (auto& own : answers) threads.emplace_back([&] { query(*sea.field, sea.tiles, places, own); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& own : answers) EXPECT_EQ(different(first, own), 0);
}

TEST(QueryBatch, starts_from_answers_of_a_moment_ago) {
  // The same surface within the tolerance in fewer steps, also where the new answers replace the old in place.
  // Control: without `previous` the steps are not fewer; starting at +displacement takes more.
  SeaState state;
  state.wind_speed_mps = 10;
  const WaveField field(state, {.resolution = 128, .cascades = 4});
  WaveTiles tiles;
  const std::vector<glm::dvec2> places = some_places(500);
  std::vector<QueryAnswer> before(places.size()), plain(places.size()), started(places.size());
  field.evaluate(ticks_from_seconds(5), tiles);
  query(field, tiles, places, before);
  field.evaluate(ticks_from_seconds(5 + 1.0 / 90), tiles);
  query(field, tiles, places, plain);
  query(field, tiles, places, started, {.previous = before});
  query(field, tiles, places, before, {.previous = before});
  EXPECT_EQ(different(started, before), 0);
  int steps = 0, plain_steps = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    steps += started[i].iterations, plain_steps += plain[i].iterations;
    EXPECT_TRUE(started[i].converged);
    EXPECT_LE(started[i].residual_m, 1e-3);
    EXPECT_NEAR(started[i].height_m, plain[i].height_m, 1e-3);
  }
  EXPECT_LE(steps, 0.7 * plain_steps);
  RecordProperty("steps", std::to_string(steps) + " instead of " + std::to_string(plain_steps));
}

TEST(QueryBatch, a_start_that_is_no_number_is_not_taken) {
  // Control: without the bound on the start these do not converge.
  const Sea sea;
  const std::vector<glm::dvec2> places = some_places(9);
  std::vector<QueryAnswer> before(9), plain(9), answers(9);
  for (std::size_t i = 0; i < 9; ++i)
    before[i].displacement.x = i % 2 ? std::nan("") : std::numeric_limits<double>::infinity();
  query(*sea.field, sea.tiles, places, plain);
  query(*sea.field, sea.tiles, places, answers, {.previous = before});
  EXPECT_EQ(different(plain, answers), 0);
}

TEST(QueryBatch, a_place_that_is_no_number_converges_nowhere) {
  // And leaves its neighbours alone. Control: `converged` made of !(residual > tolerance) fails.
  const Sea sea;
  std::vector<glm::dvec2> places = some_places(20);
  std::vector<QueryAnswer> plain(20), answers(20);
  query(*sea.field, sea.tiles, places, plain);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  places[3].x = std::nan("");
  places[7].y = infinity;
  places[19] = {-infinity, 1e300};
  query(*sea.field, sea.tiles, places, answers);
  for (const std::size_t i : {3, 7, 19}) {
    EXPECT_FALSE(answers[i].converged);
    answers[i] = plain[i];
  }
  EXPECT_EQ(different(plain, answers), 0);
}

TEST(QueryBatch, allocates_nothing) {
  // Control: a std::vector of one float in query() is counted.
  if (!test::AllocationCounter::counts) GTEST_SKIP() << "the sanitizer has its own operator new";
  const Sea sea;
  const std::vector<glm::dvec2> places = some_places(10000);
  std::vector<QueryAnswer> answers(places.size());
  query(*sea.field, sea.tiles, places, answers);
  const test::AllocationCounter counter;
  query(*sea.field, sea.tiles, places, answers);
  query(*sea.field, sea.tiles, {places.data(), 700}, {answers.data(), 700},
        {.footprint_m = 3, .previous = {answers.data(), 700}});
  for (std::size_t i = 0; i < 100; ++i) query(*sea.field, sea.tiles, {&places[i], 1}, {&answers[i], 1});
  EXPECT_EQ(counter.ours(), 0u);
  EXPECT_EQ(counter.others(), 0u);
}

}  // namespace
}  // namespace seascape
