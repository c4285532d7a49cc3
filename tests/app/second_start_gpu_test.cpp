// What a start keeps on disk, and what the next one saves by it.
#include <fstream>
#include <vector>

#include "app/frame.h"
#include "app/program.h"
#include "engine/files.h"
#include "platform/headless.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape {
namespace {

namespace fs = std::filesystem;

class SecondStart : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    folder_ = fs::path(::testing::TempDir()) / "second_start";
    fs::remove_all(folder_);
  }
  void TearDown() override {
    fs::remove_all(folder_);
    GpuTest::TearDown();
  }
  struct Start {
    int specialised = 0;
    std::uint64_t pipelines = 0, given_kept = 0;
    std::vector<std::uint8_t> picture;
  };
  Start start() const {
    Start result;
    Device device({.validation = true, .cache = DiskCache(folder_)});
    ShaderLibrary shaders(ShaderLibrary::default_directory(), DiskCache(folder_));
    Scene scene = load_scene("storm", "low");
    for (const auto& [key, value] : {std::pair("waves.resolution", "64"), std::pair("foam.settle_s", "0")})
      set_from_text(scene.settings, key, value, "test");
    const HeadlessOptions options{.width = 48, .height = 32, .views = 2};
    Experience experience(device, shaders, scene, {.width = 48, .height = 32, .views = 2});
    Headless display(options);
    Frame& frame = experience.frame();
    display.begin();
    frame.begin();
    draw_frame(experience, frame, display.viewpoint(scene.start), scene.settings.time_start_s);
    display.end(frame, &experience.picture());
    frame.finish();
    device.wait_idle();
    result.picture = picture_of(device, experience, 0).pixels;
    result.specialised = shaders.specialised();
    result.pipelines = device.pipelines_made();
    result.given_kept = device.pipelines_given_kept();
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
    return result;
  }
  fs::path folder_;
};

// Controls seen: a pipeline made without the cache; the optimiser run in spite of what is kept.
TEST_F(SecondStart, RunsNoOptimiserAndGivesEveryPipelineAKeptCache) {
  const Start first = start();
  ASSERT_GT(first.specialised, 4);
  ASSERT_GT(first.pipelines, 3u);
  EXPECT_EQ(first.given_kept, 0u);
  const Start second = start();
  EXPECT_EQ(second.specialised, 0);
  EXPECT_EQ(second.pipelines, first.pipelines);
  EXPECT_EQ(second.given_kept, second.pipelines);
  EXPECT_EQ(second.picture, first.picture);
}

// Damaged files, and the pipelines of another driver under this one's name, are as if they were not there; and they are
// replaced. Control seen: the header of a driver's cache not compared.
TEST_F(SecondStart, WhatIsDamagedOrForeignIsMadeAnew) {
  const Start first = start();
  for (const auto& file : fs::directory_iterator(folder_)) {
    std::vector<std::uint8_t> bytes = read_bytes(file.path());
    bytes[bytes.size() / 2] ^= 0xff;
    write_atomically(file.path(), std::span<const std::uint8_t>(bytes));
  }
  const auto expect_first = [&](const Start& another) {
    EXPECT_EQ(another.specialised, first.specialised);
    EXPECT_EQ(another.given_kept, 0u);
    EXPECT_EQ(another.picture, first.picture);
  };
  expect_first(start());
  EXPECT_EQ(start().specialised, 0);
  const DiskCache cache(folder_);
  for (const auto& file : fs::directory_iterator(folder_)) {
    const std::string name = file.path().filename().string();
    if (!name.starts_with("pipelines-")) continue;
    auto bytes = cache.read(name);
    ASSERT_TRUE(bytes);
    (*bytes)[16] ^= 0xff;  // of the driver's UUID
    cache.write(name, *bytes);
  }
  const Start foreign = start();
  EXPECT_EQ(foreign.given_kept, 0u);
  EXPECT_EQ(foreign.specialised, 0);
  EXPECT_EQ(start().given_kept, first.pipelines);
}

}  // namespace
}  // namespace seascape
