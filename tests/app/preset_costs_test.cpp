// The presets' table: kept, read back, printed, and the shipped one is what docs/presets.md says.
#include "app/preset_costs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "app/quality.h"
#include "app/settings.h"
#include "engine/error.h"
#include "engine/files.h"

namespace seascape {
namespace {

using testing::HasSubstr;

PresetCosts sample(const std::string& scene) {
  return {
      scene,        "a, \"device\"",
      "2026-11-28", 480,
      504,          2,
      24,           {{"GPU: surface", "ms", {1.0, 2.5, 1234.56, 0.01234}}, {"draws", "", {41.0, 42.0, 43.0, 44.0}}}};
}

// Control: writing names without csv_cell fails here.
TEST(PresetCosts, AreReadAsTheyWereWritten) {
  const std::vector<PresetCosts> all{sample("open_sea"), sample("storm")};
  const std::string text = preset_costs_csv(all);
  const std::vector<PresetCosts> read = parse_preset_costs(text, "presets.csv");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[1].scene, "storm");
  EXPECT_EQ(read[0].device, "a, \"device\"");
  EXPECT_EQ(read[0].height, 504);
  ASSERT_EQ(read[0].rows.size(), 2u);
  EXPECT_DOUBLE_EQ(read[0].rows[0].of[2], 1234.56);
  EXPECT_EQ(preset_costs_csv(read), text);
}

// Control: a scene always put after the others fails here, and the file is refused the next time.
TEST(PresetCosts, ASceneMeasuredAgainTakesItsPlace) {
  std::vector<PresetCosts> all{sample("open_sea"), sample("storm")};
  PresetCosts again = sample("open_sea");
  again.frames = 7;
  put(all, again);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(costs_of(all, "open_sea")->frames, 7);
  put(all, sample("calm"));
  EXPECT_EQ(all.back().scene, "calm");
  EXPECT_EQ(costs_of(all, "lagoon"), nullptr);
}

// Control: parse_preset_costs without its checks of cells takes these.
TEST(PresetCosts, AFileThatIsNoneIsRefusedWithItsLine) {
  const std::string good = preset_costs_csv(std::vector{sample("open_sea")});
  const auto refused = [](const std::string& text, const char* place) {
    try {
      (void)parse_preset_costs(text, "presets.csv");
      ADD_FAILURE() << "taken: " << text;
    } catch (const Error& fault) {
      EXPECT_THAT(fault.where(), HasSubstr(place));
      EXPECT_FALSE(fault.remedy().empty());
    }
  };
  refused("frame,ms\n", "presets.csv:1");
  refused(good + "open_sea,x\n", "presets.csv:4");
  refused(good + "storm,d,2026,480,504,2,24,draws,,1,2,3,many\n", "presets.csv:4");
  refused(good + "storm,d,2026,480,504,2,24,draws,,1,2,3,-4\n", "presets.csv:4");
  refused(good + "storm,d,2026,480,504,3,24,draws,,1,2,3,4\n", "presets.csv:4");
  refused(good + preset_costs_csv(std::vector{sample("storm")}).substr(good.find('\n') + 1) +
              good.substr(good.find('\n') + 1),
          "presets.csv:6");
}

// Control: a row of app/quality.cpp that setting_lines() leaves out fails here.
TEST(PresetCosts, TheTableHasEverySettingAndEveryCost) {
  const PresetCosts costs = sample("open_sea");
  const std::string text = preset_table(&costs, "open_sea");
  std::size_t quality_settings = 0;
  for (const Setting& setting : settings_table()) {
    if (!setting.quality) continue;
    ++quality_settings;
    EXPECT_THAT(text, HasSubstr("\n" + std::string(setting.key) + " "));
  }
  EXPECT_EQ(setting_lines().size(), quality_settings);
  EXPECT_THAT(text, HasSubstr("GPU: surface, ms"));
  EXPECT_THAT(text, HasSubstr("0.0123"));
  EXPECT_THAT(preset_table(nullptr, "lagoon"), HasSubstr("no costs are known of lagoon"));
}

// Control: another figure in content/presets.csv, or another value in app/quality.cpp, fails here.
TEST(PresetCosts, TheDocumentIsUpToDate) {
  const std::filesystem::path file = std::filesystem::path(SEASCAPE_TEST_DIR) / ".." / "docs" / "presets.md";
  const std::string text = presets_document(shipped_preset_costs());
  if (std::getenv("SEASCAPE_WRITE_DOCS") != nullptr) write_atomically(file, text);
  EXPECT_EQ(read_text(file), text) << "write it anew: SEASCAPE_WRITE_DOCS=1 ctest --preset release -R PresetCosts";
}

}  // namespace
}  // namespace seascape
