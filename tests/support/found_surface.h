// That what queries find is a point of the surface.
#pragma once
#include <gtest/gtest.h>

#include <random>

#include "ocean/sea/place_sea.h"
#include "tests/support/place_truth.h"

namespace seascape::test {

// Asks at 200 places within `reach_m` and expects of each answer that converged that the surface at its rest position
// stands there, to 2 mm; then each(place, answer). Gives how many did.
template <class Each>
int expect_found_on_surface(const test::PlaceTruth& sea, const WaveField& field, const WaveTiles& tiles, unsigned seed,
                            double reach_m, const Each& each) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(-reach_m, reach_m);
  int converged = 0;
  for (int i = 0; i < 200; ++i) {
    const double x = at(random);
    const glm::dvec2 asked(x, at(random));
    QueryAnswer answer;
    sea.query(field, tiles, {&asked, 1}, {&answer, 1});
    if (!answer.converged) continue;
    ++converged;
    const glm::dvec2 rest = asked - glm::dvec2(answer.displacement.x, answer.displacement.z);
    EXPECT_NEAR(sea.sea(field, tiles, rest, 0.0).displacement.y, answer.height_m, 2e-3);
    each(asked, answer);
  }
  return converged;
}

}  // namespace seascape::test
