// What presets cost, measured on a device; and what a device's presets are measured for.
#include "app/measured_presets.h"

#include <gtest/gtest.h>

#include "app/calibrate.h"
#include "app/quality.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/variable.h"

namespace seascape {
namespace {

class MeasuredPresets : public test::GpuTest {};

// Control: low's scene at all presets.
TEST_F(MeasuredPresets, FinerPresetsCostMoreAndErrLess) {
  std::array<Scene, 4> scenes;
  for (std::size_t p = 0; p < scenes.size(); ++p) {
    scenes[p] = load_scene("open_sea", preset_names()[p]);
    suit_device(scenes[p].settings, preset_names()[p], DeviceClass::software);
  }
  ShaderLibrary& shaders = test::shaders();
  std::size_t steps = 0, all = 0;
  const PresetCosts costs = measure_presets(test::device(), shaders, scenes, {96, 96, 2}, nullptr, 3,
                                            [&](std::size_t done, std::size_t of) { steps = done, all = of; });
  EXPECT_EQ(steps, all);
  EXPECT_EQ(costs.scene, "open_sea");
  const auto row = [&](std::string_view what) {
    const PresetCost* found = row_of(costs, what);
    EXPECT_NE(found, nullptr) << what;
    return found != nullptr ? found->of : std::array<double, 4>{};
  };
  const auto error = row(error_row), triangles = row("triangles"), memory = row("device memory"),
             moved = row("moved by attachments and copies"), frame = row(frame_row), draws = row("draws");
  EXPECT_LT(error[3], error[0]);
  EXPECT_GT(error[3], 0.0);
  EXPECT_GT(triangles[3], triangles[0]);
  EXPECT_GT(memory[3], memory[0]);
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_GT(moved[p], 0.0);
    EXPECT_GT(frame[p], 0.0);
    EXPECT_GT(draws[p], 0.0);
  }
  EXPECT_EQ(preset_costs_csv(parse_preset_costs(preset_costs_csv(std::vector{costs}), "again")),
            preset_costs_csv(std::vector{costs}));
}

// The first time a device is measured, the second time it is known; a goal that it cannot reach takes low. Controls:
// remember() left out measures twice; a rate in place of its period takes ultra.
TEST_F(MeasuredPresets, ADeviceIsMeasuredOnceAndRemembered) {
  const test::TemporaryFolder folder;
  const test::Variable cache("XDG_CACHE_HOME", folder.path().c_str());
  ShaderLibrary& shaders = test::shaders();
  const DisplayGoal slow{48, 40, 1, 0.01};
  EXPECT_EQ(calibrated_preset(test::device(), shaders, slow), "ultra") << "100 s a frame";
  const CalibratedDevice name = calibrated_device(test::device().facts());
  const Calibration known = remembered(DiskCache::of_user(), name);
  ASSERT_TRUE(known.presets[3]);
  EXPECT_GT(known.presets[3]->at(1e-6 * 48 * 40), 0.0);
  const std::uint64_t objects = test::device().objects_made();
  EXPECT_EQ(calibrated_preset(test::device(), shaders, slow), "ultra");
  EXPECT_EQ(calibrated_preset(test::device(), shaders, {48, 40, 1, 1e6}), "low") << "1 microsecond a frame";
  EXPECT_EQ(test::device().objects_made(), objects) << "nothing was drawn";
}

}  // namespace
}  // namespace seascape
