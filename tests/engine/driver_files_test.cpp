// What is wrong with the driver's files that the environment names.
#include "engine/driver_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "tests/support/temporary_folder.h"
#include "tests/support/variable.h"

namespace seascape {
namespace {

using test::TemporaryFolder;
using test::Variable;
using testing::StartsWith;

// Controls seen: an empty variable taken for one that is unset, and a folder without files passed over; without the
// look at is_discarded() what is not JSON is told as no driver's.
TEST(DriverFiles, TheVariableAndTheFileAreNamed) {
  const TemporaryFolder folder;
  const auto file = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  };
  const std::string text = file("text.so", "no library"),
                    good = file("good.json", R"({"ICD": {"library_path": "libc.so.6"}})"),
                    broken = file("broken.json", "{ broken"), other = file("other.json", R"({"layer": {}})"),
                    list = file("list.json", "[1]"),
                    beside = file("beside.json", R"({"ICD": {"library_path": "./text.so"}})");
  const Variable none("VK_DRIVER_FILES", nullptr), older("VK_ICD_FILENAMES", nullptr),
      added("VK_ADD_DRIVER_FILES", nullptr);
  EXPECT_EQ(driver_files_fault(), "");
  const std::pair<std::string, std::string> told[] = {
      {good, ""},
      {broken, broken + ", which is not JSON"},
      {good + ":" + broken, broken + ", which is not JSON"},
      {other, other + ", which is no driver's: it has no ICD.library_path"},
      {list, list + ", which is no driver's: it has no ICD.library_path"},
      {folder / "none.json", (folder / "none.json").string() + ", of which reading says: there is no such file"},
      {beside, beside + ", whose library cannot be loaded: " + folder.path().string()},
  };
  for (const auto& [value, fault] : told) {
    const Variable set("VK_DRIVER_FILES", value.c_str());
    if (fault.empty()) {
      EXPECT_EQ(driver_files_fault(), "") << value;
    } else {
      EXPECT_THAT(driver_files_fault(), StartsWith("VK_DRIVER_FILES names " + fault)) << value;
    }
  }
  {
    const Variable set("VK_ICD_FILENAMES", broken.c_str());
    EXPECT_THAT(driver_files_fault(), StartsWith("VK_ICD_FILENAMES names " + broken));
    const Variable newer("VK_DRIVER_FILES", good.c_str());
    EXPECT_EQ(driver_files_fault(), "") << "the loader does not read the old name where the new one is set";
  }
  std::filesystem::create_directory(folder / "empty");
  const std::string empty = folder / "empty";
  for (const auto& [value, fault] : {std::pair<std::string, std::string>{"", "it is empty"},
                                     {":", "':' holds none"},
                                     {empty, "'" + empty.substr(0, 20)}}) {
    const Variable set("VK_DRIVER_FILES", value.c_str());
    const Variable unread("VK_ICD_FILENAMES", good.c_str());
    EXPECT_THAT(driver_files_fault(), StartsWith("VK_DRIVER_FILES names no driver's file: " + fault)) << value;
  }
  const Variable set("VK_ADD_DRIVER_FILES", folder.path().c_str());
  EXPECT_THAT(driver_files_fault(), StartsWith("VK_ADD_DRIVER_FILES names " + beside));
}

}  // namespace
}  // namespace seascape
