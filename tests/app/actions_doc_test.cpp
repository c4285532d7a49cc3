// docs/actions.md is what the tables say.
#include "app/actions_doc.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "engine/files.h"
#include "platform/bindings.h"

namespace seascape {
namespace {

// Control seen: the sentence of board changed without writing the document anew.
TEST(ActionsDoc, TheDocumentIsUpToDate) {
  const std::filesystem::path file = std::filesystem::path(SEASCAPE_TEST_DIR) / ".." / "docs" / "actions.md";
  if (std::getenv("SEASCAPE_WRITE_DOCS") != nullptr) write_atomically(file, actions_document());
  EXPECT_EQ(read_text(file), actions_document())
      << "write it anew: SEASCAPE_WRITE_DOCS=1 ctest --preset release -R ActionsDoc";
}

// The cells of an action's row of the first table, or of the controllers' with `part` 1; empty where it has none.
std::vector<std::string> cells_of(std::string_view action, std::size_t part = 0) {
  const std::string text = actions_document(), head = "\n| `" + std::string(action) + "` | ";
  const std::size_t controllers = text.find("\n## Controllers");
  const std::size_t at = text.find(head, part == 0 ? 0 : controllers);
  std::vector<std::string> cells;
  if (at == std::string::npos || (part == 0 && at > controllers)) return cells;
  std::string row = text.substr(at + head.size(), text.find('\n', at + 1) - at - head.size());
  for (std::size_t end = row.find(" |"); end != std::string::npos; end = row.find(" |")) {
    cells.push_back(row.substr(0, end));
    row.erase(0, std::min(row.size(), end + 3));
  }
  return cells;
}

// Controls seen: the loop without its last row; keys without what is not printed as its code ("key 265").
TEST(ActionsDoc, EveryActionIsInItWithItsSentenceAndWhatAsksForIt) {
  for (const ActionRow& row : action_rows()) {
    const std::vector<std::string> cells = cells_of(row.name);
    ASSERT_EQ(cells.size(), 4u) << row.name;
    EXPECT_EQ(cells[1], row.sentence);
    EXPECT_EQ(cells[2].find("key "), std::string::npos) << cells[2];
    for (const KeyBinding& binding : key_bindings())
      if (binding.action == row.action) {
        EXPECT_FALSE(cells[2].empty()) << row.name;
      }
  }
  EXPECT_EQ(
      cells_of("throttle"),
      (std::vector<std::string>{"axis", "A boat's throttle: ahead, or astern with a negative value",
                                "W (aboard); S (-1, aboard)", "right trigger (aboard); left trigger (-1, aboard)"}));
  EXPECT_EQ(cells_of("fast")[2], "left Shift; right Shift");
  EXPECT_EQ(cells_of("menu")[2], "F1");
}

// Control seen: profiles that bind alike in columns of their own.
TEST(ActionsDoc, ControllersHaveAColumnEach) {
  EXPECT_NE(actions_document().find("| oculus touch, meta touch plus |"), std::string::npos);
  const std::vector<std::string> cells = cells_of("select_left", 1);
  ASSERT_EQ(cells.size(), 5u);
  EXPECT_EQ(cells[0], "left trigger");
  EXPECT_EQ(cells[4], "left select click");
  EXPECT_TRUE(cells_of("leave", 1).empty());
}

}  // namespace
}  // namespace seascape
