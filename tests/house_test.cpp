// The house's include rule: shaders/shared includes nothing else, engine only shared, platform and ocean only engine
// and shared, app and tests anything; so ocean and platform never meet. Within ocean a room includes only those below
// it. Quoted includes count; system headers do not, except FFTW, whose licence must not reach the program. And no file
// and no function is longer than one reads at a sitting.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;

// Which rooms a file of a room may include from.
const std::map<std::string, std::set<std::string>> kMayInclude = [] {
  std::map<std::string, std::set<std::string>> may = {{"shaders/shared", {"shaders/shared"}},
                                                      {"shaders", {"shaders/shared", "shaders"}},
                                                      {"engine", {"shaders/shared", "engine"}},
                                                      {"platform", {"shaders/shared", "engine", "platform"}}};
  // A floor of the ocean's rooms includes those below it; rooms of one floor do not include each other.
  std::set<std::string> below = may["engine"];
  for (const std::vector<std::string>& floor :
       std::vector<std::vector<std::string>>{{"ocean/waves", "ocean/inputs"},
                                             {"ocean/places"},
                                             {"ocean/sea"},
                                             {"ocean/foam", "ocean/mesh", "ocean/bodies"},
                                             {"ocean/drawn"},
                                             {"ocean/surface"},
                                             {"ocean"}}) {
    for (const std::string& room : floor) {
      may[room] = below;
      may[room].insert(room);
    }
    below.insert(floor.begin(), floor.end());
  }
  may["app"] = below;
  may["app"].insert({"platform", "app"});
  may["tests"] = may["app"];
  may["tests"].insert({"shaders", "tests"});
  return may;
}();

// The room of a path relative to the project; empty for a file that is in none.
std::string room_of(const std::string& path) {
  const std::string first = path.substr(0, path.find('/'));
  const std::size_t second = first == path ? std::string::npos : path.find('/', first.size() + 1);
  if (const std::string room = path.substr(0, second); second != std::string::npos && kMayInclude.contains(room))
    return room;
  return first != path && kMayInclude.contains(first) ? first : "";
}

// The name inside an #include line, with its opening character, `"name` or `<name`; empty for any other line.
std::string included_name(const std::string& line) {
  std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string::npos || line[at] != '#') return "";
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return "";
  at = line.find_first_of("\"<", at + 7);
  if (at == std::string::npos) return "";
  const std::size_t end = line.find(line[at] == '"' ? '"' : '>', at + 1);
  return end == std::string::npos ? "" : line.substr(at, end - at);
}

// An include is looked for as the compilers do: beside the file, from the project's folder, from shaders/ (GLSL).
std::string resolve(const fs::path& root, const fs::path& file, const std::string& name) {
  for (const fs::path& base : {file.parent_path(), root, root / "shaders"}) {
    const fs::path candidate = (base / name).lexically_normal();
    if (fs::is_regular_file(candidate)) return candidate.lexically_relative(root).generic_string();
  }
  return "";
}

struct Survey {
  std::size_t files = 0, includes = 0;
  std::vector<std::string> faults;
};

Survey survey(const fs::path& root) {
  const std::set<std::string> kinds = {".h", ".cpp", ".glsl", ".vert", ".frag", ".comp"};
  Survey result;
  for (const char* top : {"shaders", "engine", "platform", "ocean", "app", "tests"}) {
    if (!fs::is_directory(root / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (!entry.is_regular_file() || !kinds.contains(entry.path().extension().string())) continue;
      const std::string path = entry.path().lexically_relative(root).generic_string();
      const std::string room = room_of(path);
      ++result.files;
      std::ifstream text(entry.path());
      std::string line;
      for (int number = 1; std::getline(text, line); ++number) {
        const std::string name = included_name(line);
        if (name.empty()) continue;
        const std::string place = path + ":" + std::to_string(number) + ": ";
        if (name.find("fftw") != std::string::npos && room != "tests")
          result.faults.push_back(place + "FFTW outside tests");
        if (name[0] != '"') continue;
        ++result.includes;
        const std::string target = resolve(root, entry.path(), name.substr(1));
        const std::string target_room = room_of(target);
        // A quoted name that is no file of ours is a library's or a generated header.
        if (!target.empty() && !kMayInclude.at(room).contains(target_room))
          result.faults.push_back(place + room + " may not include " + target);
      }
    }
  }
  return result;
}

constexpr int kMostFileLines = 450, kMostFunctionLines = 100;
const std::set<std::string> kMayBeLong = {"app/settings_table.cpp"};  // a table of all settings

std::size_t indent_of(const std::string& line) { return std::min(line.find_first_not_of(' '), line.size()); }

// Blocks of formatted code that are longer than a function may be: from a line that ends in a brace to that which
// closes it, at the same indentation, or at a lesser one where parameters or a constructor's initialisers are wrapped.
// Rooms of names and types are no functions.
std::vector<std::string> long_functions(const std::string& path, const std::vector<std::string>& lines) {
  std::vector<std::string> faults;
  std::vector<std::pair<std::size_t, std::size_t>> open;  // indentation, line
  const auto is_room = [&](const auto& block) {
    const std::string first = lines[block.second].substr(block.first);
    bool room = first.ends_with("= {");  // a table
    for (const char* word : {"namespace", "class ", "struct ", "enum ", "union ", "extern "})
      room = room || first.rfind(word, 0) == 0;
    return room;
  };
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const std::string& line = lines[n];
    const std::size_t indent = indent_of(line);
    if (indent == line.size() || line.compare(indent, 2, "//") == 0) continue;
    if (line[indent] == '}') {
      std::size_t ends = open.size();
      while (ends > 0 && open[ends - 1].first > indent) --ends;
      const bool equal = ends > 0 && open[ends - 1].first == indent;
      if (equal && (ends == open.size() || !is_room(open[ends - 1]))) --ends;
      if (ends < open.size() && !is_room(open[ends]) && n - open[ends].second + 1 > kMostFunctionLines)
        faults.push_back(path + ":" + std::to_string(open[ends].second + 1) + ": " +
                         std::to_string(n - open[ends].second + 1) + " lines in one function");
      open.resize(ends);
    }
    if (line.back() == '{') open.emplace_back(indent, n);
  }
  return faults;
}

std::vector<std::string> long_ones(const fs::path& root, std::size_t* files) {
  const std::set<std::string> kinds = {".h", ".cpp", ".glsl", ".vert", ".frag", ".comp", ".sh", ".awk"};
  std::vector<std::string> faults;
  for (const char* top : {"shaders", "engine", "platform", "ocean", "app", "tests", "scripts"}) {
    if (!fs::is_directory(root / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string kind = entry.path().extension().string();
      if (!entry.is_regular_file() || !kinds.contains(kind)) continue;
      const std::string path = entry.path().lexically_relative(root).generic_string();
      if (kMayBeLong.contains(path)) continue;
      ++*files;
      std::vector<std::string> lines;
      std::ifstream text(entry.path());
      for (std::string line; std::getline(text, line);) lines.push_back(line);
      if (lines.size() > std::size_t(kMostFileLines))
        faults.push_back(path + ": " + std::to_string(lines.size()) + " lines");
      if (kind == ".sh" || kind == ".awk") continue;
      for (const std::string& fault : long_functions(path, lines)) faults.push_back(fault);
    }
  }
  return faults;
}

// A tree of its own for the planted faults, removed at the end.
class PlantedTree : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("seascape_house_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    for (const char* file :
         {"shaders/shared/types.h", "shaders/lib/noise.glsl", "engine/device.h", "platform/window.h",
          "ocean/waves/sea.h", "ocean/inputs/a.h", "ocean/places/a.h", "ocean/sea/a.h", "ocean/foam/a.h",
          "ocean/mesh/a.h", "ocean/drawn/a.h", "ocean/surface/a.h", "ocean/ocean.h", "app/scene.h"})
      write(file, "");
  }
  void TearDown() override { fs::remove_all(root_); }
  void write(const std::string& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  fs::path root_;
};

TEST(House, NobodyIncludesWhatTheRuleForbids) {
  const Survey result = survey(fs::path(SEASCAPE_TEST_DIR).parent_path());
  EXPECT_GT(result.files, 20u);
  EXPECT_GT(result.includes, 20u);
  for (const std::string& fault : result.faults) ADD_FAILURE() << fault;
}

TEST(House, NothingIsTooLongToRead) {
  std::size_t files = 0;
  for (const std::string& fault : long_ones(fs::path(SEASCAPE_TEST_DIR).parent_path(), &files)) ADD_FAILURE() << fault;
  EXPECT_GT(files, 500u);
}

// The control of the test above.
TEST_F(PlantedTree, LongFilesAndFunctionsAreFound) {
  const auto body = [](int lines) {
    std::string text;
    for (int i = 0; i < lines; ++i) text += "  if (x) {\n    y();\n  }\n";
    return text;
  };
  const auto found = [&] {
    std::size_t files = 0;
    return long_ones(root_, &files);
  };
  // 3 * 33 + 2 is 101, one line too many; namespaces and classes may be longer.
  write("ocean/sea/planted.cpp", "namespace seascape {\nvoid f() {\n" + body(33) + "}\n}  // namespace seascape\n");
  EXPECT_EQ(found(), std::vector<std::string>{"ocean/sea/planted.cpp:2: 101 lines in one function"});
  write("ocean/sea/planted.cpp", "namespace seascape {\nclass A {\n  void f() {\n" + body(32) + "  }\n  void g() {\n" +
                                     body(32) + "  }\n};\n}  // namespace seascape\n");
  EXPECT_EQ(found(), std::vector<std::string>{});
  const std::string constructor = "A::A()\n    : a_(1) {\n" + body(32) + "}\n";
  write("ocean/sea/planted.cpp", constructor + "void f() {\n  if (x)\n    for (;;) {\n    }\n}\n");
  EXPECT_EQ(found(), std::vector<std::string>{});
  write("ocean/sea/planted.cpp", "A::A()\n    : a_(1) {\n" + body(33) + "}\n");
  EXPECT_EQ(found(), std::vector<std::string>{"ocean/sea/planted.cpp:2: 101 lines in one function"});
  write("ocean/sea/planted.cpp", std::string(450, '\n'));
  EXPECT_EQ(found(), std::vector<std::string>{});
  write("ocean/sea/planted.cpp", std::string(451, '\n'));
  EXPECT_EQ(found(), std::vector<std::string>{"ocean/sea/planted.cpp: 451 lines"});
}

// The control of the test above: every forbidden pair, planted, is found, with its place; the allowed ones are not.
TEST_F(PlantedTree, EveryForbiddenIncludeIsFound) {
  const std::map<std::string, std::string> files = {{"shaders/shared", "shaders/shared/types.h"},
                                                    {"shaders", "shaders/lib/noise.glsl"},
                                                    {"engine", "engine/device.h"},
                                                    {"platform", "platform/window.h"},
                                                    {"ocean/waves", "ocean/waves/sea.h"},
                                                    {"ocean/inputs", "ocean/inputs/a.h"},
                                                    {"ocean/places", "ocean/places/a.h"},
                                                    {"ocean/sea", "ocean/sea/a.h"},
                                                    {"ocean/foam", "ocean/foam/a.h"},
                                                    {"ocean/mesh", "ocean/mesh/a.h"},
                                                    {"ocean/drawn", "ocean/drawn/a.h"},
                                                    {"ocean/surface", "ocean/surface/a.h"},
                                                    {"ocean", "ocean/ocean.h"},
                                                    {"app", "app/scene.h"}};
  int forbidden = 0;
  for (const auto& [from, path] : files) {
    for (const auto& [to, target] : files) {
      const std::string planted = from + "/planted.h";
      write(planted, "// a comment\n#include \"" + target + "\"\n");
      const Survey result = survey(root_);
      fs::remove(root_ / planted);
      if (kMayInclude.at(from).contains(to)) {
        EXPECT_TRUE(result.faults.empty()) << from << " to " << to << ": " << result.faults.front();
      } else {
        ++forbidden;
        ASSERT_EQ(result.faults.size(), 1u) << from << " to " << to;
        EXPECT_EQ(result.faults[0], planted + ":2: " + from + " may not include " + target);
      }
    }
  }
  EXPECT_EQ(forbidden,
            14 * 14 - 82);  // rooms may include 1, 2, 2, 3, 3, 3, 5, 6, 7, 7, 9, 10, 11 and 13, themselves among them
}

// Other ways to write the same include are found too: relative, from shaders/, indented, after other text.
TEST_F(PlantedTree, RelativeAndIndentedIncludesAreFound) {
  write("ocean/waves/planted.cpp", "  #  include \"../../platform/window.h\"\n");
  write("engine/planted.cpp", "#include \"lib/noise.glsl\"\n");
  write("engine/other.cpp", "#include <fftw3.h>\n");
  write("tests/bench/planted.cpp", "#include <fftw3.h>\n#include \"app/scene.h\"\n");
  const Survey result = survey(root_);
  const std::set<std::string> faults(result.faults.begin(), result.faults.end());
  const std::set<std::string> expected = {"ocean/waves/planted.cpp:1: ocean/waves may not include platform/window.h",
                                          "engine/planted.cpp:1: engine may not include shaders/lib/noise.glsl",
                                          "engine/other.cpp:1: FFTW outside tests"};
  EXPECT_EQ(faults, expected);
}

}  // namespace
