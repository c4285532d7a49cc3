// docs/settings.md is what the tables say.
#include "app/settings_doc.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "app/settings.h"
#include "engine/files.h"

namespace seascape {
namespace {

// Control: changing one sentence of the table without writing the document anew fails here.
TEST(SettingsDoc, TheDocumentIsUpToDate) {
  const std::filesystem::path file = std::filesystem::path(SEASCAPE_TEST_DIR) / ".." / "docs" / "settings.md";
  if (std::getenv("SEASCAPE_WRITE_DOCS") != nullptr) write_atomically(file, settings_document());
  EXPECT_EQ(read_text(file), settings_document())
      << "write it anew: SEASCAPE_WRITE_DOCS=1 ctest --preset release -R SettingsDoc";
}

TEST(SettingsDoc, EverySettingIsInIt) {
  const std::string text = settings_document();
  for (const Setting& setting : settings_table())
    EXPECT_NE(text.find("| `" + std::string(setting.key) + "` | "), std::string::npos) << setting.key;
}

}  // namespace
}  // namespace seascape
