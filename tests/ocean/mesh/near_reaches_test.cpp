// How far waves in windows ask for finer vertices.
#include "ocean/mesh/near_reaches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace seascape {
namespace {

NearMeshError window(double from_m, double reach_m, double error_m, int shares = NearMeshError::adds) {
  NearMeshError near;
  near.error.octave_m.fill(error_m);
  near.from_m = from_m, near.reach_m = reach_m, near.shares = shares;
  return near;
}

double reach(std::initializer_list<NearMeshError> near, double error_m, double over_m = 0.0) {
  NearReaches reaches;
  reaches.set({near.begin(), near.size()}, over_m);
  return reaches(1.0, error_m, [](double error) { return 100.0 * error; });
}

// Here an error of e is allowed from 100 e away on. Windows around the viewer count as far as they reach; of those that
// begin farther off nothing is asked where their error is allowed by then, and all of it as far as they go where it is
// not. Of windows that share the water the largest counts, beside
// seven tenths of what the sea is missed by, others add up. Controls seen: where they begin left out;
// those that share added up.
TEST(NearReaches, CountWhereWindowsLie) {
  EXPECT_NEAR(reach({}, 0.1), 10.0, 1e-9);
  EXPECT_NEAR(reach({window(0.0, 100.0, 0.2)}, 0.1), 30.0, 1e-9);
  EXPECT_NEAR(reach({window(0.0, 25.0, 0.2)}, 0.1), 25.0, 1e-9);
  EXPECT_NEAR(reach({window(40.0, 100.0, 0.2)}, 0.1), 10.0, 1e-9) << "allowed before it begins";
  EXPECT_NEAR(reach({window(40.0, 100.0, 0.5)}, 0.1), 60.0, 1e-9);
  EXPECT_NEAR(reach({window(40.0, 100.0, 2.0)}, 0.1), 100.0, 1e-9);
  EXPECT_NEAR(reach({window(0.0, 100.0, 0.2), window(0.0, 100.0, 0.3)}, 0.1), 60.0, 1e-9);
  EXPECT_NEAR(reach({window(0.0, 100.0, 0.2, 1), window(0.0, 100.0, 0.3, 1)}, 0.1), 37.0, 1e-9);
  EXPECT_NEAR(reach({window(0.0, 100.0, 0.2, 0), window(0.0, 100.0, 0.3, 1)}, 0.1), 57.0, 1e-9);
  EXPECT_NEAR(reach({window(0.0, 100.0, 0.02, 0)}, 0.1), 10.0, 1e-9) << "the sea's own largest lies elsewhere";
  EXPECT_NEAR(reach({window(0.0, 20.0, 0.3, 1), window(0.0, 100.0, 0.2, 1)}, 0.1), 27.0, 1e-9)
      << "the near one is over";
  EXPECT_NEAR(reach({window(0.0, 30.0, 0.2)}, 0.5, 40.0), 50.0, 1e-9) << "in space, from 40 m above";
}

// For any windows: beyond the reach every distance is allowed its error, and the reach is none too large. Controls not
// yet planted: an interval's error taken at its other end.
TEST(NearReaches, AreAsFarAsTheyHaveToBe) {
  std::mt19937 random(7);
  const auto share = [&] { return random() / 4294967296.0; };
  for (int n = 0; n < 300; ++n) {
    std::vector<NearMeshError> near;
    for (int k = 0; k < 5; ++k) {
      const double from = share() < 0.4 ? 0.0 : 60.0 * share();
      near.push_back(window(from, from + 1.0 + 80.0 * share(), 0.3 * share(), int(3.0 * share()) - 1));
    }
    const auto error_at = [&](double distance) {
      double sum = 0.05, shared[2] = {0.0, 0.0};
      for (const NearMeshError& one : near) {
        if (distance <= one.from_m || distance > one.reach_m) continue;
        double& of = one.shares < 0 ? sum : shared[one.shares];
        of = one.shares < 0 ? of + one.error.octave_m[0] : std::max(of, one.error.octave_m[0]);
      }
      return std::max(sum, sum - 0.3 * 0.05 + shared[0] + shared[1]);
    };
    NearReaches reaches;
    reaches.set(near, 0.0);
    const double reach_m = reaches(1.0, 0.05, [](double error) { return 100.0 * error; });
    double needed = 0.0;
    for (double distance = 0.005; distance < 150.0; distance += 0.01)
      if (100.0 * error_at(distance) > distance) needed = distance;
    EXPECT_NEAR(reach_m, needed, 0.02) << n;
  }
}

}  // namespace
}  // namespace seascape
