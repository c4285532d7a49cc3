// Headsets on a real runtime (tests/support/monado.h), under OpenXR's and Vulkan's validation.
#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "platform/headset.h"
#include "tests/support/gpu/headset_record.h"
#include "tests/support/monado.h"

namespace seascape::test {

inline bool has_focus(const DisplayFrame& shown) { return shown.focused && shown.should_render; }

// A headset as `explore` makes it, whose calls are noted down.
struct MonadoHeadset {
  MonadoHeadset();
  ~MonadoHeadset();

  XrLoader loader;
  HostileRuntime calls;
  HeadsetRecord record;
  HeadsetSystem system;
  std::unique_ptr<Device> device;
  std::unique_ptr<Headset> headset;
};

// After every test neither OpenXR's core validation layer nor Vulkan's has said anything of this process or of a
// program that it started. The control: MonadoStates.CoreValidationSpeaks.
class MonadoTest : public testing::Test {
 protected:
  void TearDown() override;
  // What the core validation layer has found since the last call.
  std::string take_core_validation();

  Monado monado;

 private:
  TemporaryFolder folder_;
  bool layer_was_there_ = false;
  Variable layer_{"XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation"};
  Variable kind_{"XR_CORE_VALIDATION_EXPORT_TYPE", "text"};
  Variable file_{"XR_CORE_VALIDATION_FILE_NAME", (folder_ / "core_validation.txt").c_str()};
};

}  // namespace seascape::test
