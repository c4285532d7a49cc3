// docs/hard-cases.md is made from the tests: every test whose name begins with hard_ and a number, with what the
// comment beside it says is asserted and which planted fault it was seen to catch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

#include "engine/files.h"

namespace seascape {
namespace {

namespace fs = std::filesystem;

// The list that the project set itself. Those that wait for what is not there yet say so.
struct Case {
  const char* what;
  const char* waits = "";
};
const std::map<int, Case> listed{{1, {"wind 0"}},
                                 {2, {"wind 60 m/s"}},
                                 {3, {"NaN, infinite or negative parameters"}},
                                 {4, {"fetch 0"}},
                                 {5, {"fetch 1e9"}},
                                 {6, {"depth 0 or negative"}},
                                 {7, {"depth 1e-6 and 1e6"}},
                                 {8, {"bin k = 0, mean height"}},
                                 {9, {"Nyquist bins"}},
                                 {10, {"dt 0"}},
                                 {11, {"dt 5 s and more"}},
                                 {12, {"time backwards or in jumps"}},
                                 {13, {"t = 1e7 s"}},
                                 {14, {"looping"}},
                                 {15, {"camera at 1e6 m"}},
                                 {16, {"origin shift"}},
                                 {17, {"camera exactly at the surface"}},
                                 {18, {"camera inside a folded crest"}},
                                 {19, {"camera on a quadtree corner"}},
                                 {20, {"jitter of 1e-6 m there"}},
                                 {21, {"ocean size 256 to 8192"}},
                                 {22, {"horizon in view"}},
                                 {23, {"straight down, up, rolled"}},
                                 {24, {"chop 2, folds"}},
                                 {25, {"boat dropped from 100 m"}},
                                 {26, {"density ratio 1e-3 and 1e3"}},
                                 {27, {"capsized"}},
                                 {28, {"100 boats"}},
                                 {29, {"boat at 100 m/s"}},
                                 {30, {"wake over a LOD boundary"}},
                                 {31, {"Courant at twice the limit"}},
                                 {32, {"calm with no input, 1e6 steps"}},
                                 {33, {"denormals"}},
                                 {34, {"cascade bands"}},
                                 {35, {"fp16 at +-65504"}},
                                 {36, {"spline of 0, 1 or coincident points"}},
                                 {37, {"portal edge-on"}},
                                 {38, {"eye half in water"}},
                                 {39, {"eye distance 0"}},
                                 {40, {"asymmetric field of view"}},
                                 {41, {"quality switch in mid-frame"}},
                                 {42, {"window 0x0, headset taken off, device lost"}},
                                 {43, {"full foam for an hour"}},
                                 {44, {"opposed flow, whirlpool centre"}},
                                 {45, {"planet pole and cube corner", "planets"}}};
constexpr int first_of_our_own = 46, least_of_our_own = 20;

struct Found {
  std::vector<int> numbers;
  std::string suite, name, file, asserted, control;
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// "" where a line is no comment.
std::string comment_of(const std::string& line) {
  const std::string text = trimmed(line);
  return text.rfind("//", 0) == 0 ? trimmed(text.substr(2)) : std::string();
}

// What is asserted, up to the word Control; and from it on, without that word.
void split(std::string text, Found& to) {
  static const std::regex number("^Hard( case)? [0-9]+( and [0-9]+)*( [^:.]{0,40})?: ");
  text = std::regex_replace(text, number, "", std::regex_constants::format_first_only);
  static const std::regex word("\\(?Controls?,?( seen| in the test)?[,:] ?|\\(?[Tt]he controls?:? ");
  std::smatch found;
  if (std::regex_search(text, found, word)) {
    to.asserted = trimmed(found.prefix());
    to.control = trimmed(found.suffix());
  } else {
    to.asserted = text;
  }
}

// The comment that stands directly above a test and the one that its body begins with, together.
std::vector<Found> hard_tests() {
  static const std::regex head("^TEST(_F|_P)?\\((\\w+), (hard_[0-9]\\w*)\\).*");
  const fs::path root = fs::path(SEASCAPE_TEST_DIR);
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (entry.path().string().ends_with("_test.cpp")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Found> all;
  for (const fs::path& file : files) {
    std::vector<std::string> lines;
    std::istringstream text(read_text(file));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::smatch match;
      if (!std::regex_match(lines[i], match, head)) continue;
      Found found{{}, match[2], match[3], fs::relative(file, root).string(), "", ""};
      for (std::string rest = found.name.substr(5);
           !rest.empty() && std::isdigit(static_cast<unsigned char>(rest[0]));) {
        std::size_t used = 0;
        found.numbers.push_back(std::stoi(rest, &used));
        rest = rest.substr(used).rfind("_and_", 0) == 0 ? rest.substr(used + 5) : std::string();
      }
      std::string comment;
      std::size_t from = i;
      while (from > 0 && !comment_of(lines[from - 1]).empty()) --from;
      for (; from < i; ++from) comment += (comment.empty() ? "" : " ") + comment_of(lines[from]);
      for (std::size_t n = i + 1; n < lines.size() && !comment_of(lines[n]).empty(); ++n)
        comment += (comment.empty() ? "" : " ") + comment_of(lines[n]);
      split(comment, found);
      all.push_back(std::move(found));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Found& a, const Found& b) { return a.numbers.front() < b.numbers.front(); });
  return all;
}

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.replace(at, 1, "\\|");
  return text;
}

std::string words_of(const Found& test) {
  std::string words = test.name.substr(5);
  words.erase(0, words.find_first_not_of("0123456789_"));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string document() {
  const std::vector<Found> tests = hard_tests();
  std::string text =
      "# Hard cases\n\n"
      "Made from the tests by `SEASCAPE_WRITE_DOCS=1 build/release/tests_unit --gtest_filter='HardCases*'`, and "
      "compared with them by the same. A test's name begins with the number of its case. "
      "Numbers to 45 are the list that the project set itself, and later ones were found by reading the code for "
      "divisions, roots, logarithms, casts, sums and loops without a bound. "
      "`*_hard_test.cpp` is the label hard, `*_gpu_test.cpp` gpu, `*_stereo_test.cpp` stereo, `*_program_test.cpp` "
      "program, others unit.\n\n"
      "| case | | test | what is asserted | planted fault that it was seen to catch |\n| --- | --- | --- | --- | --- "
      "|\n";
  const auto row = [&](int number, const std::string& what, const Found& test) {
    text += "| " + std::to_string(number) + " | " + cell(what) + " | `" + test.suite + "." + test.name + "` (" +
            test.file + ") | " + cell(test.asserted) + " | " + cell(test.control) + " |\n";
  };
  for (const auto& [number, one] : listed) {
    if (*one.waits != '\0')
      text += "| " + std::to_string(number) + " | " + one.what + " | waits for " + one.waits + " | | |\n";
    for (const Found& test : tests)
      if (std::find(test.numbers.begin(), test.numbers.end(), number) != test.numbers.end())
        row(number, one.what, test);
  }
  for (const Found& test : tests)
    if (test.numbers.front() >= first_of_our_own) row(test.numbers.front(), words_of(test), test);
  return text;
}

// Control: any hard test renamed, or its comment changed, without writing the page anew.
TEST(HardCases, ThePageIsWhatTheTestsSay) {
  const fs::path file = fs::path(SEASCAPE_TEST_DIR) / ".." / "docs" / "hard-cases.md";
  if (std::getenv("SEASCAPE_WRITE_DOCS") != nullptr) write_atomically(file, document());
  EXPECT_TRUE(read_text(file) == document())
      << "write docs/hard-cases.md anew: SEASCAPE_WRITE_DOCS=1 build/release/tests_unit --gtest_filter='HardCases*'";
}

// Controls: hard_13_time_1e7 renamed to time_1e7 (13 has no test), and a comment without its control.
TEST(HardCases, EveryNumberHasATestThatSaysWhatItAssertsAndWhatItCatches) {
  std::map<int, int> tests;
  for (const Found& test : hard_tests()) {
    for (const int number : test.numbers) ++tests[number];
    EXPECT_GE(test.asserted.size(), 20u) << test.file << ": " << test.name << ": no comment says what is asserted";
    EXPECT_GE(test.control.size(), 12u) << test.file << ": " << test.name
                                        << ": no comment says which planted fault it was seen to catch";
  }
  for (const auto& [number, one] : listed) {
    if (*one.waits == '\0') {
      EXPECT_GE(tests[number], 1) << "hard case " << number << ", " << one.what << ", has no test";
    } else {
      EXPECT_EQ(tests[number], 0) << "hard case " << number << " does not wait any more";
    }
  }
  const int last = tests.rbegin()->first;
  EXPECT_GE(last, first_of_our_own + least_of_our_own - 1);
  for (int number = first_of_our_own; number <= last; ++number) EXPECT_EQ(tests[number], 1) << "hard case " << number;
}

}  // namespace
}  // namespace seascape
