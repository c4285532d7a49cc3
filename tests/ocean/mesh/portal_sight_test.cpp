// What may be seen through portals, against lines of sight.
#include "ocean/mesh/portal_sight.h"

#include <gtest/gtest.h>

#include <random>

namespace seascape {
namespace {

// A ball that some line from an eye through a portal's ball meets is never left out, and of those that are kept only
// few are met by none: some that touch the cone between two lines. Controls seen: cones of half the angle; all balls
// kept.
TEST(PortalSight, KeepsWhatALineThroughAPortalMeets) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto direction = [&] {
    glm::dvec3 d;
    do d = {unit(random), unit(random), unit(random)};
    while (glm::dot(d, d) > 1.0 || glm::dot(d, d) < 1e-3);
    return glm::normalize(d);
  };
  int met = 0, kept = 0, kept_in_vain = 0, asked = 0;
  for (int scene = 0; scene < 400; ++scene) {
    const glm::dvec3 eye = 0.03 * direction(), portal = (1.5 + unit(random)) * 2.0 * direction();
    const double radius = 0.3 + 0.2 * unit(random);
    PortalSight sight;
    EXPECT_FALSE(sight.any());
    sight.add(eye, portal, radius);
    EXPECT_TRUE(sight.any());
    for (int i = 0; i < 50; ++i, ++asked) {
      const glm::dvec3 ball = 20.0 * direction();
      const double size = 1.0 + 0.9 * unit(random);
      bool meets = false;
      for (int line = 0; line < 300 && !meets; ++line) {
        const glm::dvec3 way = glm::normalize(portal + radius * direction() - eye), off = ball - eye;
        const double along = glm::dot(off, way);
        meets = along > 0.0 && glm::dot(off, off) - along * along < size * size;
      }
      met += meets;
      const bool shown = sight.may_show(ball, size);
      kept += shown;
      kept_in_vain += shown && !meets;
      EXPECT_TRUE(shown || !meets);
    }
  }
  EXPECT_GT(met, 100);
  EXPECT_LT(kept_in_vain, kept / 3);
  EXPECT_LT(kept, asked / 10);
}

// An eye in a portal's ball sees everything. Control seen: such a portal left out.
TEST(PortalSight, WithinAPortalAllIsSeen) {
  PortalSight sight;
  sight.add(glm::dvec3(0.0), {0.0, 0.0, -0.5}, 1.0);
  EXPECT_TRUE(sight.any());
  EXPECT_TRUE(sight.may_show({0.0, 0.0, 50.0}, 0.1));
}

}  // namespace
}  // namespace seascape
