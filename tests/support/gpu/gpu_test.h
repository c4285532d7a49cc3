// The harness of every test that draws: one device under validation a process, and a fixture that fails on any message.
#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/device.h"
#include "engine/disk_cache.h"
#include "engine/shader.h"

namespace seascape::test {

// The process's device, with validation and synchronization validation, made at the first call; and the shaders beside
// the executable. Making a device takes a third of a second, so tests share it.
Device& device();
ShaderLibrary& shaders();
DiskCache kept_shaders();  // where they are kept from one process to the next: by their words and what specialises them

// Marks a suite whose tests draw more than they compile: a software driver optimises their shaders, which it does not
// for others (tests/CMakeLists.txt). Stands beside the tests, at the level of the namespace.
struct DrawsMuch {
  explicit DrawsMuch(const char* suite);
};

// Messages of the validation layer that any device of this process has given since the last call, oldest first. They
// are taken from the log, so that those of a second device, and of a device's end, count as well.
std::vector<std::string> take_validation_messages();

// After every test the device is idle and the validation layer has said nothing. A test that plants a fault takes its
// messages away by take_validation_messages(). The control: engine/validation_gpu_test.cpp plants an error and a
// hazard.
class GpuTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;
};

}  // namespace seascape::test
