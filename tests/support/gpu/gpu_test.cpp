#include "tests/support/gpu/gpu_test.h"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <mutex>

namespace seascape::test {

namespace {

// Collects the lines by which a device tells a message of the validation layer (engine/device.cpp).
class MessageSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  std::vector<std::string> take() {
    std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
  }

 protected:
  void sink_it_(const spdlog::details::log_msg& line) override {
    const std::string text(line.payload.data(), line.payload.size());
    if (text.starts_with("validation: ")) messages_.push_back(text);
  }
  void flush_() override {}

 private:
  std::vector<std::string> messages_;
};

struct Shared {
  std::shared_ptr<MessageSink> sink = std::make_shared<MessageSink>();
  std::unique_ptr<Device> device;
  // What shaders are specialised to is kept in the build folder: a process each would do it all anew.
  ShaderLibrary shaders{ShaderLibrary::default_directory(), kept_shaders()};
};

Shared& shared() {
  static Shared all;
  return all;
}

std::vector<std::string>& draw_much() {
  static std::vector<std::string> suites;
  return suites;
}

// Before the driver is loaded: it optimises shaders where any suite that runs draws much.
void choose_compiler() {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    std::string_view name = suite.name();
    name.remove_prefix(name.rfind('/') + 1);  // of an instance with parameters; npos + 1 is 0
    if (suite.should_run() && std::ranges::find(draw_much(), name) != draw_much().end()) unsetenv("GALLIVM_PERF");
  }
}

// The device goes at the end of the program, and its end must be clean too: nothing alive, no message.
class DeviceEnd final : public ::testing::Environment {
 public:
  void SetUp() override {
    choose_compiler();
    // Hazards between submissions too, from frame to frame; an option of the layer that has no flag in Vulkan's own
    // structs.
    setenv("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT", 0);
    spdlog::default_logger()->sinks().push_back(shared().sink);
    spdlog::set_level(spdlog::level::warn);
  }
  void TearDown() override {
    if (shared().device) {
      shared().device->wait_idle();
      EXPECT_TRUE(shared().device->objects().empty())
          << shared().device->objects().size()
          << " objects are alive at the device's end, the first: " << shared().device->objects().front().name;
      shared().device.reset();
    }
    for (const std::string& message : take_validation_messages()) ADD_FAILURE() << message;
  }
};

[[maybe_unused]] const auto* const environment = ::testing::AddGlobalTestEnvironment(new DeviceEnd);

}  // namespace

DrawsMuch::DrawsMuch(const char* suite) { draw_much().emplace_back(suite); }

DiskCache kept_shaders() {
  return DiskCache(std::filesystem::path(SEASCAPE_BUILD_DIR) / "kept_shaders", std::uintmax_t{1} << 30);
}

Device& device() {
  if (!shared().device) {
    DeviceOptions options;
    options.validation = true;
    options.memory_holds = std::uint8_t{0x3c};  // 1.06 as halves, 0.0115 as floats: what is read by mistake is seen
    shared().device = std::make_unique<Device>(options);
  }
  return *shared().device;
}

ShaderLibrary& shaders() { return shared().shaders; }

std::vector<std::string> take_validation_messages() {
  if (shared().device) shared().device->clear_validation_messages();
  return shared().sink->take();
}

void GpuTest::SetUp() { (void)device(); }

void GpuTest::TearDown() {
  device().wait_idle();
  for (const std::string& message : take_validation_messages()) ADD_FAILURE() << message;
}

}  // namespace seascape::test
