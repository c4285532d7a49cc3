// A virtual display of its own, and a device that shows windows there, under validation.
#pragma once
#include <gtest/gtest.h>

#include <memory>

#include "platform/window.h"
#include "tests/support/desktop.h"
#include "tests/support/variable.h"

namespace seascape::test {

// After every test the validation layer has said nothing.
class DeskTest : public testing::Test {
 protected:
  DeskTest() {
    system_ = std::make_unique<WindowSystem>();
    DeviceOptions options;
    options.validation = options.present = true;
    options.instance_extensions = system_->instance_extensions();
    device_ = std::make_unique<Device>(options);
  }
  void TearDown() override {
    device_->wait_idle();
    EXPECT_TRUE(device_->validation_messages().empty()) << device_->validation_messages().front();
  }

  VirtualDisplay display_;
  Variable x11_{"DISPLAY", display_.name().c_str()}, wayland_{"WAYLAND_DISPLAY", nullptr};
  std::unique_ptr<WindowSystem> system_;
  std::unique_ptr<Device> device_;
};

}  // namespace seascape::test
