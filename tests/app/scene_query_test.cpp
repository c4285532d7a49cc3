// Batches of queries in scenes with places: the answers of single calls to the bit, on any number of threads, with no
// allocation.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "app/scene.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"
#include "tests/support/allocations.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {

constexpr double time_s = 7.3;
constexpr const char* scenes[] = {"lagoon", "rivers", "rain_pool", "whirlpool", "harbour_clip", "harbour", "storm"};

auto all_of(const QueryAnswer& a) {
  return std::tuple(a.height_m, a.displacement.x, a.displacement.y, a.displacement.z, a.normal.x, a.normal.y,
                    a.normal.z, a.orbital_velocity_mps.x, a.orbital_velocity_mps.y, a.orbital_velocity_mps.z,
                    a.eulerian_velocity_mps.x, a.eulerian_velocity_mps.y, a.eulerian_velocity_mps.z, a.flow_mps.x,
                    a.flow_mps.y, a.still_m, a.depth_m, a.clipped, a.left_out_m, a.residual_m, a.contraction,
                    a.iterations, a.converged);
}

struct SceneSea {
  explicit SceneSea(const char* name) {
    const Scene scene = load_scene(name, "medium");
    SeaSpec spec = sea_spec(scene);
    spec.drawn_velocity = spec.felt_velocity = true;
    start = scene.start.position_m;
    sea = std::make_unique<Sea>(std::move(spec));
    sea->advance(time_s, start);
  }
  std::vector<glm::dvec2> places(std::size_t count) const {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> within(-150.0, 150.0);
    std::vector<glm::dvec2> result;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = within(random);
      result.push_back({start.x + x, start.z + within(random)});
    }
    return result;
  }
  glm::dvec3 start;
  std::unique_ptr<Sea> sea;
};

// Pages of places are made anew for each of the seas, and in another order. Control seen: texels of pages made by
// their neighbour's number (lagoon, rivers, whirlpool, harbour_clip).
TEST(SceneQuery, AnswersDoNotDependOnBatchesOrThreads) {
  const std::size_t count = test::sanitized ? 200 : 1500;  // from 1,024 on several threads take part
  for (const char* name : scenes) {
    if (test::sanitized && name != std::string_view("lagoon")) continue;
    for (const SeaDetail detail : {SeaDetail::drawn, SeaDetail::felt}) {
      const SceneSea one(name), two(name), three(name);
      const std::vector<glm::dvec2> places = one.places(count);
      std::vector<QueryAnswer> single(count), batch(count), reversed(count);
      for (const double footprint : {0.0, 1.3}) {
        const QueryOptions options{.footprint_m = footprint};
        for (std::size_t i = 0; i < count; ++i) single[i] = one.sea->view_at(time_s, detail).query(places[i], options);
        {
          const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
          two.sea->view_at(time_s, detail).query(places, batch, options);
        }
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 3);
        three.sea->view_at(time_s, detail).query(std::vector(places.rbegin(), places.rend()), reversed, options);
        std::reverse(reversed.begin(), reversed.end());
        int different = 0;
        for (std::size_t i = 0; i < count; ++i)
          different += all_of(single[i]) != all_of(batch[i]) || all_of(single[i]) != all_of(reversed[i]);
        EXPECT_EQ(different, 0) << name << " at " << footprint << " m";
      }
    }
  }
}

// What is left out of the fields is as of calm water; the rest is as without a mask, to the bit, but for heights, which
// are those of the points found. Control seen: velocities found all the same.
TEST(SceneQuery, FindsTheFieldsThatAreAskedFor) {
  for (const char* name : {"storm", "lagoon", "whirlpool", "harbour_clip"}) {
    const SceneSea one(name);
    std::vector<glm::dvec2> places = one.places(300);
    if (std::string(name) == "harbour_clip")
      for (glm::dvec2& place : places) place.y -= 190.0;  // around the dock
    const SeaView view = one.sea->view_at(time_s, SeaDetail::felt);
    const auto ask = [&](unsigned fields) {
      std::vector<QueryAnswer> answers(places.size());
      view.query(places, answers, {.fields = fields});
      return answers;
    };
    const auto all = ask(query_all), none = ask(0), slopes = ask(query_slopes), moving = ask(query_velocity),
               clip = ask(query_clip);
    int clipped = 0, level = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_EQ(all[i].displacement, none[i].displacement);
      EXPECT_NEAR(all[i].height_m, none[i].height_m, 2e-3);
      EXPECT_EQ(none[i].height_m, none[i].displacement.y);
      EXPECT_EQ(none[i].normal, glm::dvec3(0.0, 1.0, 0.0));
      EXPECT_EQ(none[i].contraction, 0.0);
      for (const auto* still : {&none[i], &slopes[i], &clip[i]}) {
        EXPECT_EQ(still->orbital_velocity_mps, glm::dvec3(0.0));
        EXPECT_EQ(still->eulerian_velocity_mps, glm::dvec3(0.0));
      }
      EXPECT_EQ(slopes[i].normal, all[i].normal);
      EXPECT_EQ(slopes[i].height_m, all[i].height_m);
      EXPECT_EQ(moving[i].orbital_velocity_mps, all[i].orbital_velocity_mps);
      EXPECT_EQ(moving[i].eulerian_velocity_mps, all[i].eulerian_velocity_mps);
      EXPECT_EQ(clip[i].clipped, all[i].clipped);
      EXPECT_FALSE(none[i].clipped || moving[i].clipped);
      EXPECT_EQ(none[i].flow_mps, all[i].flow_mps);
      EXPECT_EQ(none[i].depth_m, all[i].depth_m);
      clipped += all[i].clipped;
      level += all[i].normal.y > 0.999999;
    }
    EXPECT_LT(level, 200) << name;
    EXPECT_TRUE(std::string(name) != "harbour_clip" || clipped > 5) << clipped;
  }
}

// A normal and the velocity of the surface at a fixed place are what heights around the place and around the time say,
// of nine tenths of the points: edges of texels bend the rest, and more where dynamic waves have small ones. Controls
// seen: layers whose share is the same everywhere; patterns that lie beside the points everywhere alike; patterns that
// a current lets lie.
TEST(SceneQuery, SlopesAndVelocitiesAreThoseOfTheHeights) {
  for (const auto& [name, most_slope] : {std::pair("lagoon", 2e-4), std::pair("rivers", 2e-4),
                                         std::pair("whirlpool", 2e-4), std::pair("rain_pool", 6e-3)}) {
    const SceneSea one(name);
    const std::vector<glm::dvec2> places = one.places(400);
    const QueryOptions options{.most_iterations = 30, .tolerance_m = 2e-6};
    const auto heights = [&](double later_s, glm::dvec2 beside) {
      std::vector<glm::dvec2> moved(places);
      for (glm::dvec2& place : moved) place += beside;
      std::vector<QueryAnswer> answers(places.size());
      one.sea->view_at(time_s + later_s, SeaDetail::felt).query(moved, answers, options);
      return answers;
    };
    const double e = 1.0 / 512.0, e_s = 1.0 / 256.0;
    const auto here = heights(0.0, {0.0, 0.0}), east = heights(0.0, {e, 0.0}), west = heights(0.0, {-e, 0.0}),
               south = heights(0.0, {0.0, e}), north = heights(0.0, {0.0, -e}), then = heights(e_s, {0.0, 0.0}),
               before = heights(-e_s, {0.0, 0.0});
    std::vector<double> slopes, speeds;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const glm::dvec3& n = here[i].normal;
      const glm::dvec2 slope =
          glm::dvec2(east[i].height_m - west[i].height_m, south[i].height_m - north[i].height_m) / (2.0 * e);
      slopes.push_back(glm::length(slope + glm::dvec2(n.x, n.z) / n.y));
      speeds.push_back(
          std::abs((then[i].height_m - before[i].height_m) / (2.0 * e_s) - here[i].eulerian_velocity_mps.y));
    }
    const auto most = [](std::vector<double>& of) {
      std::sort(of.begin(), of.end());
      return of[of.size() * 9 / 10];
    };
    const double slope = most(slopes), speed = most(speeds);
    EXPECT_LT(slope, most_slope) << name;
    EXPECT_LT(speed, 1e-4) << name;
  }
}

// Once the tiles are there, also where the points come to places that nobody has asked for. Control seen: pages that
// are allocated when they are first needed.
TEST(SceneQuery, AllocatesNothing) {
  if (!test::AllocationCounter::counts) GTEST_SKIP() << "the sanitizers have an operator new of their own";
  for (const char* name : scenes) {
    const SceneSea one(name);
    const std::vector<glm::dvec2> places = one.places(200);
    std::vector<QueryAnswer> answers(places.size());
    const SeaView view = one.sea->view_at(time_s, SeaDetail::felt);
    (void)view.tiles();
    const test::AllocationCounter counter;
    view.query(places, answers);
    (void)view.at(places.front(), 0.5);
    EXPECT_EQ(counter.ours(), 0u) << name;
  }
}

}  // namespace
}  // namespace seascape
