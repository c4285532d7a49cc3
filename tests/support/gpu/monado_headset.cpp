#include "tests/support/gpu/monado_headset.h"

#include <filesystem>
#include <fstream>

#include "tests/support/gpu/gpu_test.h"

namespace seascape::test {

MonadoHeadset::MonadoHeadset() : calls(loader.get()), record(calls), system(calls.get()) {
  DeviceOptions options;
  options.validation = true;
  system.make_device(options);
  device = std::make_unique<Device>(options);
  headset = std::make_unique<Headset>(system, *device, HeadsetOptions{});
}

MonadoHeadset::~MonadoHeadset() {
  headset.reset();
  if (device) device->wait_for_gpu();
}

std::string MonadoTest::take_core_validation() {
  const std::filesystem::path file = folder_ / "core_validation.txt";
  std::ifstream text(file);
  std::string said;
  for (std::string line; std::getline(text, line);) {
    layer_was_there_ = layer_was_there_ || line.find("Core Validation Layer is initialized") != std::string::npos;
    if (line.find("[VALID_DEBUG ") == std::string::npos) said += line + "\n";  // its coming and going
  }
  std::filesystem::remove(file);
  return said;
}

void MonadoTest::TearDown() {
  EXPECT_EQ(take_core_validation(), "");
  EXPECT_TRUE(layer_was_there_) << "OpenXR's core validation layer was not loaded";
  for (const std::string& message : take_validation_messages()) ADD_FAILURE() << message;
}

}  // namespace seascape::test
