// The built program in a headset on a real runtime, Monado's, with its mirror on a virtual display. Controls are named
// beside each test; each was seen to fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/desktop.h"
#include "tests/support/gpu/monado_headset.h"
#include "tests/support/run_program.h"

namespace seascape {
namespace {

using test::Background;
using test::Monado;
using test::MonadoTest;
using test::VirtualDisplay;
using test::wait_until;
using testing::HasSubstr;
using testing::Not;

// It comes to have the focus, its mirror to a window, and after its frames it ends well: under validation it would not
// where either layer had said anything. Controls seen: a mirror that is off; presets measured while the display's
// session lives, where the runtime has one at a time.
TEST_F(MonadoTest, TheProgramExplores) {
  const VirtualDisplay display;
  Background program({test::program_file(), "explore", "--display", "headset", "--scene", "calm", "--preset", "auto",
                      "--set", "waves.cascades=3", "--frames", "80"},
                     {display.variable(), "WAYLAND_DISPLAY=", "SEASCAPE_VALIDATION=1"});
  bool focused = false, mirrored = false;
  wait_until(
      [&] {
        const auto client = monado.client(program.id());
        focused = focused || (client && client->shown && client->focused);
        mirrored = mirrored || !display.xdotool({"search", "--onlyvisible", "--name", "mirror"}).empty();
        return !program.running();
      },
      120.0);
  EXPECT_TRUE(focused);
  EXPECT_TRUE(mirrored);
  EXPECT_EQ(program.exit_code(), 0) << program.err();
  EXPECT_THAT(program.err(), HasSubstr("headset: Monado: Simulated HMD on Monado"));
  EXPECT_THAT(program.err(), Not(HasSubstr("seascape: ")));
  EXPECT_THAT(program.err(), Not(HasSubstr("warn")));
}

}  // namespace
}  // namespace seascape
