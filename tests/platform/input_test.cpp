// How what devices say becomes a frame's actions. Controls are named beside each test; each was seen to fail.
#include "platform/input.h"

#include <gtest/gtest.h>

namespace seascape {
namespace {

// Control: values kept from frame to frame.
TEST(InputGatherer, AddsUpWhatDevicesSay) {
  InputGatherer gatherer;
  gatherer.add(Action::move_x, 1.0);
  gatherer.add(Action::move_x, 0.7);
  gatherer.add(Action::move_z, -1.0);
  gatherer.add(Action::move_z, 0.4);
  gatherer.add(Action::sheet, -0.5);
  const Input input = gatherer.take();
  EXPECT_EQ(input.value(Action::move_x), 1.0);
  EXPECT_NEAR(input.value(Action::move_z), -0.6, 1e-15);
  EXPECT_EQ(input.value(Action::sheet), 0.0);
  EXPECT_EQ(gatherer.take().value(Action::move_x), 0.0);
}

// Control: without the threshold at which it is free again.
TEST(InputGatherer, TellsAPressOnce) {
  InputGatherer gatherer;
  const auto presses = [&](double value) {
    gatherer.add(Action::snap_turn, value);
    const Input input = gatherer.take();
    return input.pressed.empty() ? 0.0 : input.pressed.front().value;
  };
  EXPECT_EQ(presses(0.6), 1.0);
  EXPECT_EQ(presses(0.9), 0.0);
  EXPECT_EQ(presses(0.45), 0.0);
  EXPECT_EQ(presses(0.6), 0.0);  // it never came free
  EXPECT_EQ(presses(0.1), 0.0);
  EXPECT_EQ(presses(0.6), 1.0);
  EXPECT_EQ(presses(-0.8), -1.0);
}

// A key that went down and up between two frames. Control: press() forgotten; told twice where it is held still.
TEST(InputGatherer, MissesNoQuickTouch) {
  InputGatherer gatherer;
  gatherer.press(Action::menu, 1.0);
  EXPECT_EQ(gatherer.take().pressed.size(), 1u);
  gatherer.press(Action::menu, 1.0);
  gatherer.add(Action::menu, 1.0);
  EXPECT_EQ(gatherer.take().pressed.size(), 1u);
  EXPECT_TRUE(gatherer.take().pressed.empty());
}

// Control: reset() without what it remembers as held.
TEST(InputGatherer, ForgetsWhatWasHeldWhenTheFocusWent) {
  InputGatherer gatherer;
  gatherer.add(Action::grab_left, 1.0);
  EXPECT_TRUE(gatherer.take().held(Action::grab_left));
  gatherer.press(Action::board, 1.0);
  gatherer.reset();
  gatherer.add(Action::grab_left, 1.0);
  Input input = gatherer.take();
  EXPECT_FALSE(input.held(Action::grab_left));
  EXPECT_TRUE(input.pressed.empty());
  EXPECT_FALSE(gatherer.take().held(Action::grab_left));  // let go
  gatherer.add(Action::grab_left, 1.0);
  input = gatherer.take();
  EXPECT_TRUE(input.held(Action::grab_left));
  EXPECT_EQ(input.pressed.size(), 1u);
}

// Control: without the question.
TEST(InputGatherer, TakesNoNonsense) {
  InputGatherer gatherer;
  gatherer.add(Action::turn, std::nan(""));
  EXPECT_EQ(gatherer.take().value(Action::turn), 0.0);
}

// A headset's and a desk's. Controls: values of the first alone; presses that are not compared.
TEST(Input, OfTwoAddsUp) {
  Input a, b;
  a.values[std::size_t(Action::move_x)] = 0.7;
  b.values[std::size_t(Action::move_x)] = 0.6;
  b.values[std::size_t(Action::move_z)] = -0.5;
  a.pressed = {{Action::pause, 1.0}, {Action::snap_turn, 1.0}};
  b.pressed = {{Action::snap_turn, -1.0}, {Action::pause, 1.0}, {Action::record, 1.0}};
  a.hands[1] = Hand{};
  b.mouse_pixels = {3.0, 4.0};
  b.wheel = 1.0;
  b.right_button = true;
  const Input both = joined(a, b);
  EXPECT_EQ(both.value(Action::move_x), 1.0);
  EXPECT_EQ(both.value(Action::move_z), -0.5);
  ASSERT_EQ(both.pressed.size(), 4u);
  EXPECT_EQ(both.pressed[2].action, Action::snap_turn);
  EXPECT_EQ(both.pressed[2].value, -1.0);
  EXPECT_EQ(both.pressed[3].action, Action::record);
  EXPECT_TRUE(both.hands[1].has_value());
  EXPECT_FALSE(both.hands[0].has_value());
  EXPECT_EQ(both.mouse_pixels, glm::dvec2(3.0, 4.0));
  EXPECT_EQ(both.wheel, 1.0);
  EXPECT_TRUE(both.right_button);
}

}  // namespace
}  // namespace seascape
