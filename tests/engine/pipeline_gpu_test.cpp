// What pipelines ask of the device.
#include "engine/pipeline.h"

#include <gtest/gtest.h>

namespace seascape {
namespace {

// Drivers test a draw that discards before it is shaded only where it writes no stencil: otherwise things half in the
// water take seven times as long (lavapipe). Control seen: all bits written by every draw.
TEST(Pipeline, DrawsThatOnlyTestTheStencilWriteNone) {
  for (const bool front : {true, false}) {
    for (const Stencil tests : {Stencil::in_air, Stencil::in_water}) {
      EXPECT_EQ(stencil_state(tests, front).writeMask, 0u);
      EXPECT_EQ(stencil_state(tests, front).compareMask, 0xffu);
    }
    for (const Stencil writes : {Stencil::begin_in_water, Stencil::count})
      EXPECT_EQ(stencil_state(writes, front).writeMask, 0xffu);
  }
}

}  // namespace
}  // namespace seascape
