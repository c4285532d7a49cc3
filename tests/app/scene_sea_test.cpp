// The answers of the shipped scenes' seas agree with each other: velocities and normals with differences of heights.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "app/place_inputs.h"
#include "app/scene.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"
#include "tests/support/place_truth.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {

// Linear interpolation bends at texels: there a derivative is any number between the differences to either side.
struct Miss {
  double missed = 0.0, all = 0.0;
  void add(double got, double before, double here, double after, double step) {
    const double first = (here - before) / step, second = (after - here) / step;
    const double want = std::clamp(got, std::min(first, second), std::max(first, second));
    missed += (got - want) * (got - want), all += want * want;
  }
  double share() const { return all > 0.0 ? std::sqrt(missed / all) : 0.0; }
};

const std::vector<std::string> scenes{"open_sea",     "calm",    "storm",     "swell",  "rain_pool",
                                      "gerstner",     "baked",   "whirlpool", "lagoon", "rivers",
                                      "harbour_clip", "harbour", "still_life"};

// In all scenes at all presets 99 of 100 felt heights lie within three times left_out_m of the drawn ones, dynamic
// waves included. Controls seen: seven tenths of left_out_m; felt waves of 20 ms later.
TEST(SceneSea, FeltIsWithinWhatItLeavesOutOfTheDrawn) {
  if (test::sanitized) GTEST_SKIP() << "a minute of numbers of code that other tests run";
  for (const std::string preset : {"low", "medium", "high", "ultra"})
    for (const std::string& name : scenes) {
      const Scene scene = load_scene(name, preset);
      Sea sea(sea_spec(scene));
      const glm::dvec3 start = scene.start.position_m;
      sea.advance(21.3, start);
      sea.advance(21.31, start);
      const SeaView drawn = sea.view_at(21.31, SeaDetail::drawn), felt = sea.view_at(21.31, SeaDetail::felt);
      const double reach = name == "rain_pool" ? 4.0 : 150.0;
      std::mt19937 random(11);
      std::uniform_real_distribution<double> anywhere(-reach, reach);
      const QueryOptions options{.most_iterations = 40, .tolerance_m = 1e-4};
      int asked = 0, within = 0;
      double square = 0.0;
      for (int i = 0; i < 1500; ++i) {
        const double x = anywhere(random);
        const glm::dvec2 at(start.x + x, start.z + anywhere(random));
        const QueryAnswer a = drawn.query(at, options), b = felt.query(at, options);
        if (!a.converged || !b.converged) continue;
        ++asked;
        const double miss = a.height_m - b.height_m;
        within += std::abs(miss) <= 3.0 * b.left_out_m;
        square += miss * miss;
      }
      const double rms = std::sqrt(square / asked);
      RecordProperty(preset + "_" + name, std::to_string(asked) + " points: rms " + std::to_string(rms) +
                                              " m, left out " + std::to_string(felt.left_out_m()) + ", within " +
                                              std::to_string(double(within) / asked));
      EXPECT_GT(asked, 1200) << name;
      EXPECT_GE(within, 0.99 * asked) << name << " at " << preset;
    }
}

// Where queries converge on water: the height's rate of change, as answers have it and as the README's formula makes it
// of normal and velocity, and the slopes that normals have, against differences of heights in time and in space,
// dynamic waves and currents included; and the displacements against plain double precision. Controls seen: velocities
// without what a current does to the patterns (whirlpool 0.20, rivers); dynamic waves without velocity (rain_pool
// 0.95); slopes without what shares grow by (rain_pool, whirlpool, rivers); a tile's axis turned the wrong way (all);
// heights on shore without the run-up (lagoon, harbour_clip).
TEST(SceneSea, HeightsVelocitiesAndNormalsAgree) {
  if (test::sanitized) GTEST_SKIP() << "a minute of numbers of code that other tests run";
  for (const std::string& name : scenes) {
    const Scene scene = load_scene(name, "high");
    SeaSpec spec = sea_spec(scene);
    spec.drawn_velocity = spec.felt_velocity = true;
    Sea sea(std::move(spec));
    const QueryOptions options{.most_iterations = 40, .tolerance_m = 1e-5};
    constexpr double time_s = 21.31, dt = 5e-4, dx = 5e-4;  // within a step of dynamic waves
    std::mt19937 random(4);
    const double reach = name == "rain_pool" ? 3.0 : 120.0;
    std::uniform_real_distribution<double> anywhere(-reach, reach);
    const glm::dvec3 start = scene.start.position_m;
    std::vector<glm::dvec2> at;
    for (int i = 0; i < 400; ++i) {
      const double x = anywhere(random);
      at.push_back({start.x + x, start.z + anywhere(random)});
    }
    for (const SeaDetail detail : {SeaDetail::drawn, SeaDetail::felt}) {
      const auto ask = [&](double t, glm::dvec2 by) {
        sea.advance(t, start);
        std::vector<glm::dvec2> places = at;
        for (glm::dvec2& place : places) place += by;
        std::vector<QueryAnswer> answers(at.size());
        sea.view_at(t, detail).query(places, answers, options);
        return answers;
      };
      const auto before = ask(time_s - dt, {}), now = ask(time_s, {});
      const auto east = ask(time_s, {dx, 0.0}), west = ask(time_s, {-dx, 0.0}), south = ask(time_s, {0.0, dx}),
                 north = ask(time_s, {0.0, -dx}), after = ask(time_s + dt, {});
      Miss rates, formula, slopes, sideways;
      int used = 0;
      double apart = 0.0;
      sea.advance(time_s, start);
      const SeaView view = sea.view_at(time_s, detail);
      const test::PlaceTruth plain(place_inputs(scene), view.field(), sea.shallows());
      for (std::size_t i = 0; i < at.size(); ++i) {
        bool converged = now[i].contraction < 0.9;
        for (const auto* each : {&now, &before, &after, &east, &west, &south, &north})
          converged = converged && (*each)[i].converged;
        // Land, and the water's edge, where the ground takes over within the differences.
        if (!converged || now[i].orbital_velocity_mps == glm::dvec3(0.0) ||
            (now[i].depth_m < 100.0 && now[i].height_m < now[i].still_m - now[i].depth_m + 0.05))
          continue;
        ++used;
        // The same surface in plain double precision.
        if (detail == SeaDetail::drawn) {
          const glm::dvec3& moved = now[i].displacement;
          const glm::dvec2 rest = at[i] - glm::dvec2(moved.x, moved.z);
          const SeaSample want =
              plain.sea(view.field(), view.tiles(), rest, 0.0, nullptr, view.dynamic(), view.volumes());
          for (const glm::dvec3& got : {moved, view.at(rest, 0.0).displacement})
            apart = std::max(apart, glm::length(want.displacement - got));
        }
        const glm::dvec3 &n = now[i].normal, &v = now[i].orbital_velocity_mps;
        const double here = now[i].height_m;
        rates.add(now[i].eulerian_velocity_mps.y, before[i].height_m, here, after[i].height_m, dt);
        formula.add(v.y + (n.x * v.x + n.z * v.z) / n.y, before[i].height_m, here, after[i].height_m, dt);
        for (const int axis : {0, 2})
          sideways.add(now[i].eulerian_velocity_mps[axis], before[i].displacement[axis], now[i].displacement[axis],
                       after[i].displacement[axis], dt);
        slopes.add(-n.x / n.y, west[i].height_m, here, east[i].height_m, dx);
        slopes.add(-n.z / n.y, north[i].height_m, here, south[i].height_m, dx);
      }
      RecordProperty(name + (detail == SeaDetail::felt ? "_felt" : ""),
                     std::to_string(used) + " points: " + std::to_string(rates.share()) + ", " +
                         std::to_string(formula.share()) + ", " + std::to_string(slopes.share()) + ", " +
                         std::to_string(apart));
      EXPECT_GT(used, name == "harbour" ? 150 : 250) << name << ", where much is land";
      EXPECT_LE(apart, 5e-5) << name;
      EXPECT_LE(rates.share(), 0.01) << name;
      EXPECT_LE(formula.share(), 0.01) << name;
      EXPECT_LE(sideways.share(), 0.01) << name;
      EXPECT_LE(slopes.share(), 0.01) << name;
    }
  }
}

}  // namespace
}  // namespace seascape
