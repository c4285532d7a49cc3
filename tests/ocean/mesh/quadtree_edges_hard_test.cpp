// Hard cases of the mesh found by reading its roots, logarithms and casts: eyes as high and as low as doubles go.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/error.h"
#include "ocean/mesh/horizon.h"
#include "ocean/mesh/quadtree.h"

namespace seascape {
namespace {

// Hard 76: An eye from the least double to 1e12 m above or below the sea selects a whole mesh with finite numbers; one
// at 1e160 m, whose height squared is more than any double, is refused by name. Control: the code as it was: an
// infinite horizon, whose logarithm was cast to an int.
TEST(QuadtreeHard, hard_76_eyes_of_any_height) {
  for (const LodJoin join : {LodJoin::morphed, LodJoin::masked}) {
    LodSettings settings;
    settings.join = join;
    Quadtree tree(settings);
    for (const double y : {0.0, 5e-324, 1e-300, 1e-9, 1.0, 1e4, 1e8, 1e12, -1e-300, -1e4, -1e12}) {
      Viewpoint viewpoint;
      viewpoint.viewer.position_m = {1e6, y, -1e6};
      const SurfaceSelection& selection = tree.select(viewpoint, {20.0, 10.0});
      EXPECT_FALSE(selection.patches.empty()) << y;
      EXPECT_TRUE(std::isfinite(selection.horizon_m) && std::isfinite(selection.mesh.skirt_to_horizon) &&
                  selection.mesh.skirt_to_horizon >= selection.mesh.skirt_to_multiplier)
          << y;
      EXPECT_GT(selection.mesh.skirt_rows, 0);
    }
    for (const double y : {1e160, -1e160, 1e308}) {
      Viewpoint viewpoint;
      viewpoint.viewer.position_m = {0.0, y, 0.0};
      try {
        tree.select(viewpoint, {20.0, 10.0});
        ADD_FAILURE() << y;
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("viewer"), std::string::npos);
      }
    }
  }
}

}  // namespace
}  // namespace seascape
