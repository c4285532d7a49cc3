// The built program whose headset's runtime dies, with a desktop beside it. Controls are named beside the test; each
// was seen to fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/desktop.h"
#include "tests/support/gpu/monado_headset.h"
#include "tests/support/run_program.h"

#include "tests/support/x11.h"  // last: X11's macros take common names

namespace seascape {
namespace {

using test::Background;
using test::MonadoTest;
using test::VirtualDisplay;
using test::wait_until;

// The window that is no mirror; "" where there is none.
std::string window_of(const VirtualDisplay& display) {
  std::istringstream found(display.xdotool({"search", "--onlyvisible", "--name", "^Seascape: "}));
  for (std::string window; found >> window;) {
    const std::string name = display.xdotool({"getwindowname", window});  // none where it has gone meanwhile
    if (name.starts_with("Seascape: ") && name.find("mirror") == std::string::npos) return window;
  }
  return "";
}

// What the program says, but for what the runtime's library and the validation layer say in it.
std::vector<std::string> own_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream all(text);
  for (std::string line; std::getline(all, line);)
    if (!line.starts_with("ERROR [") && !line.starts_with("Core Validation")) lines.push_back(line);
  return lines;
}

// One line says that the headset is lost; a window opens whose pictures go on; closed, it ends the program well.
// Controls seen: an explore that ends there, as before (exit 1); a second line; an Error after the window was closed.
TEST_F(MonadoTest, WhereTheRuntimeDiesTheWindowGoesOn) {
  const VirtualDisplay display;
  Background program({test::program_file(), "explore", "--display", "headset", "--scene", "calm", "--preset", "low",
                      "--set", "msaa=1", "--set", "waves.cascades=3"},
                     {display.variable(), "WAYLAND_DISPLAY=", "SEASCAPE_VALIDATION=1"});
  const auto explores = [&] {
    const auto client = monado.client(program.id());
    return (client && client->focused && !display.xdotool({"search", "--onlyvisible", "--name", "mirror"}).empty()) ||
           !program.running();
  };
  ASSERT_TRUE(wait_until(explores, 120.0));
  ASSERT_TRUE(program.running()) << program.err();
  const std::size_t before = own_lines(program.err()).size();
  monado.kill();
  std::string window;
  ASSERT_TRUE(wait_until([&] { return !(window = window_of(display)).empty() || !program.running(); }, 120.0));
  ASSERT_NE(window, "") << "exit " << program.exit_code() << ": " << program.err();
  const test::X11Reader reader(display, std::stoul(window));
  const Image8 first = reader.read();
  EXPECT_TRUE(wait_until([&] { return reader.read().pixels != first.pixels; })) << program.err();
  test::WindowManager(display).close_button(std::stoul(window));
  EXPECT_EQ(program.exit_code(60.0), 0) << program.err();
  std::vector<std::string> said = own_lines(program.err());
  said.erase(said.begin(), said.begin() + std::ptrdiff_t(std::min(before, said.size())));
  EXPECT_THAT(said, testing::ElementsAre(testing::AllOf(testing::StartsWith("warn"), testing::HasSubstr("headset"),
                                                        testing::HasSubstr("lost"))));
}

}  // namespace
}  // namespace seascape
