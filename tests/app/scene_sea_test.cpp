// The answers of the shipped scenes' seas agree with each other: velocities and normals with differences of heights.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "app/scene.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {

struct Miss {
  double missed = 0.0, all = 0.0;
  void add(double got, double want) { missed += (got - want) * (got - want), all += want * want; }
  double share() const { return all > 0.0 ? std::sqrt(missed / all) : 0.0; }
};

// Where queries converge on water: the height's rate of change by differences in time, the one that the README's formula
// makes of normal and velocity, and slopes by differences in space. Linear interpolation bends at texels, where the
// waves' own slopes, which answers have, do not: differences of heights miss these by a tenth, and the rate of change,
// which has a slope in it, by 0.7 to 3 hundredths, with a current as without. Controls seen: what the current does to the
// patterns left out of the rate (whirlpool, rivers).
TEST(SceneSea, HeightsVelocitiesAndNormalsAgree) {
  if (test::sanitized) GTEST_SKIP() << "a minute of numbers of code that other tests run";
  for (const char* name : {"open_sea", "calm", "storm", "swell", "rain_pool", "gerstner", "baked", "whirlpool", "lagoon",
                           "rivers", "harbour_clip"}) {
    const Scene scene = load_scene(name, "high");
    SeaSpec spec = sea_spec(scene);
    spec.drawn_velocity = true;
    Sea sea(std::move(spec));
    const QueryOptions options{.most_iterations = 40, .tolerance_m = 1e-5, .history = false};
    constexpr double time_s = 21.3, dt = 4e-3, dx = 0.01;
    std::mt19937 random(4);
    std::uniform_real_distribution<double> anywhere(-120.0, 120.0);
    const glm::dvec3 start = scene.start.position_m;
    std::vector<glm::dvec2> at;
    for (int i = 0; i < 400; ++i) {
      const double x = anywhere(random);
      at.push_back({start.x + x, start.z + anywhere(random)});
    }
    const auto ask = [&](double t, glm::dvec2 by) {
      std::vector<glm::dvec2> places = at;
      for (glm::dvec2& place : places) place += by;
      std::vector<QueryAnswer> answers(at.size());
      sea.view_at(t, SeaDetail::drawn).query(places, answers, options);
      return answers;
    };
    const auto now = ask(time_s, {}), before = ask(time_s - dt, {}), after = ask(time_s + dt, {});
    const auto east = ask(time_s, {dx, 0.0}), west = ask(time_s, {-dx, 0.0}), south = ask(time_s, {0.0, dx}),
               north = ask(time_s, {0.0, -dx});
    Miss rates, formula, slopes;
    int used = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      bool converged = now[i].contraction < 0.9;
      for (const auto* each : {&now, &before, &after, &east, &west, &south, &north})
        converged = converged && (*each)[i].converged;
      // Land, and the water's edge, where the ground takes over within the differences.
      if (!converged || now[i].orbital_velocity_mps == glm::dvec3(0.0) ||
          (now[i].depth_m < 100.0 && now[i].height_m < now[i].still_m - now[i].depth_m + 0.05))
        continue;
      ++used;
      const glm::dvec3 &n = now[i].normal, &v = now[i].orbital_velocity_mps;
      rates.add(now[i].eulerian_velocity_mps, (after[i].height_m - before[i].height_m) / (2.0 * dt));
      formula.add(v.y + (n.x * v.x + n.z * v.z) / n.y, (after[i].height_m - before[i].height_m) / (2.0 * dt));
      slopes.add(-n.x / n.y, (east[i].height_m - west[i].height_m) / (2.0 * dx));
      slopes.add(-n.z / n.y, (south[i].height_m - north[i].height_m) / (2.0 * dx));
    }
    RecordProperty(std::string(name), std::to_string(used) + " points: " + std::to_string(rates.share()) + ", " +
                                          std::to_string(formula.share()) + ", " + std::to_string(slopes.share()));
    EXPECT_GT(used, 250) << name;
    EXPECT_LE(rates.share(), 0.03) << name;
    EXPECT_LE(formula.share(), 0.03) << name;
    EXPECT_LE(slopes.share(), 0.12) << name;
  }
}

}  // namespace
}  // namespace seascape
