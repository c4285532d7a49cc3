// What the lab says of its points: plots that hold every point where it belongs, sentences computed from them, settings
// for a budget.
#include "app/lab/lab_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "app/svg.h"
#include "engine/text.h"

namespace seascape {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

LabPoint point(const std::string& knob, double value, const std::string& sea, double us, double error,
               const std::string& preset = "", const std::string& settings = "") {
  LabPoint p;
  p.curve = "frame", p.knob = knob, p.value = value, p.sea = sea, p.error = {error, "of white"}, p.preset = preset,
  p.settings = settings;
  p.time_us.count = 9, p.time_us.median = us, p.time_us.p5 = 0.9 * us, p.time_us.p95 = 1.2 * us;
  return p;
}

const LabCurve curve{"frame", "Whole frames", "one frame", {{"k", false, -1.0, 0.1, 1.0, 8.0, "because"}},
                     true,    true,           {},          {}};

// k: the error falls as 1 / value and time grows with it, half as much at U3; low is 50 % off the front, high is on it,
// and so is medium but for high.
std::vector<LabPoint> points() {
  std::vector<LabPoint> all;
  for (const char* sea : {"U3", "U10", "U25"})
    for (const double v : {1.0, 2.0, 4.0, 8.0})
      all.push_back(point("k", v, sea, (sea[1] == '3' ? 500.0 : 1000.0) * v, 0.08 / v, "", "a.b=" + text_from(v)));
  all.push_back(point("presets", 1.0, "U10", 3000.0, 0.06, "low", "a.b=9"));
  all.push_back(point("presets", 2.0, "U10", 9000.0, 0.005, "high", "a.b=10"));
  all.push_back(point("presets", 3.0, "U10", 9900.0, 0.006, "medium", "a.b=11"));
  return all;
}

// The places of its points are told by the axes' own lines: decades are as far apart everywhere. Controls seen: error
// and time exchanged; a linear scale; seas drawn into one panel.
TEST(LabReport, ThePlotHasEachPointAtItsPlace) {
  const std::string svg = curve_plot(curve, points(), "of white");
  const std::regex circle(
      "<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\" r=\"[35]\" style=\"fill:([^\"]*)\"><title>([^<]*)</title>");
  struct Seen {
    double x, y;
    std::string colour, title;
  };
  std::vector<Seen> seen;
  for (std::sregex_iterator at(svg.begin(), svg.end(), circle), end; at != end; ++at)
    seen.push_back({std::stod((*at)[1]), std::stod((*at)[2]), (*at)[3], (*at)[4]});
  ASSERT_EQ(seen.size(), points().size());
  // Of the first sea: equal steps to the right and down, for time doubles as the error halves.
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_NEAR(seen[i].x - seen[i - 1].x, seen[1].x - seen[0].x, 0.2);
    EXPECT_NEAR(seen[i].y - seen[i - 1].y, seen[1].y - seen[0].y, 0.2);
    EXPECT_GT(seen[i].x, seen[i - 1].x);
    EXPECT_GT(seen[i].y, seen[i - 1].y) << "less is lower";
  }
  // The same times in the next panel, as far from its left edge.
  EXPECT_NEAR(seen[5].x - seen[4].x, seen[1].x - seen[0].x, 0.2);
  EXPECT_GT(seen[4].x, seen[3].x) << "a panel a sea";
  EXPECT_EQ(seen[4].y, seen[0].y);
  EXPECT_THAT(seen[0].title, HasSubstr("k 1: 500 us, 0.08 of white"));
  EXPECT_NE(seen[0].colour, seen[8].colour) << "a colour a knob";
  for (const char* name : {">low<", ">high<", "U10 m/s", "Whole frames"}) EXPECT_THAT(svg, HasSubstr(name));
  // Ringed is the front: all of k, and high.
  std::size_t rings = 0;
  for (std::size_t at = svg.find("r=\"7\""); at != std::string::npos; at = svg.find("r=\"7\"", at + 1)) ++rings;
  EXPECT_EQ(rings, 13u);
  const std::string file = standalone_svg(svg);
  EXPECT_TRUE(file.starts_with("<svg xmlns="));
  EXPECT_THAT(file, HasSubstr("--c0:"));
  // Control seen: the colour after its variable.
  EXPECT_THAT(file, HasSubstr("fill:#fbfcfd;fill:var(--page)"));
  EXPECT_THAT(file, HasSubstr("stroke:#0072b2;stroke:var(--c0)"));
  EXPECT_THAT(file, HasSubstr("svg text{fill:#1b2530;fill:var(--ink);"));
  EXPECT_THAT(file, Not(testing::ContainsRegex("[^;]fill:var"))) << "black where variables are not known";
  EXPECT_THAT(curve_plot(curve, points(), "no such unit"), HasSubstr("Not measured"));
  std::vector<LabPoint> exact = points();
  exact[0].error.value = 0.0;
  EXPECT_THAT(curve_plot(curve, exact, "of white"), Not(HasSubstr("nan"))) << "no logarithm of 0";
}

// Names of presets whose points are close stand above each other. Control seen: each beside its point.
TEST(LabReport, NamesOfPresetsDoNotCoverEachOther) {
  std::vector<LabPoint> close = points();
  close.back().error.value = 0.0052;
  const std::string svg = curve_plot(curve, close, "of white");
  const auto y_of = [&](const std::string& name) {
    std::smatch found;
    EXPECT_TRUE(std::regex_search(svg, found, std::regex("y=\"([0-9.]+)\" text-anchor=\"[a-z]+\">" + name + "<")));
    return std::stod(found[1]);
  };
  EXPECT_GE(std::abs(y_of("high") - y_of("medium")), 13.9);
}

// Controls seen: the front of all seas together; presets among those that judge them; rivals of all knobs; the law's
// power with its sign lost.
TEST(LabReport, SentencesAreComputedFromThePoints) {
  const std::string said = conclusion(curve, points());
  EXPECT_THAT(said, HasSubstr("at U10 m/s: k 1 takes 1 ms for one frame and misses 0.08 of white; presets 2 (high) "
                              "takes 9 times as long and misses 0.005, 16 times less."));
  EXPECT_THAT(said, HasSubstr("the error goes with the power -1 of it (theory -1: because)"));
  EXPECT_THAT(said, HasSubstr("Take 50 % more time than what errs no more: low."));
  EXPECT_THAT(said, HasSubstr("On the front: medium, high."));
  EXPECT_THAT(conclusion(curve, {}), HasSubstr("was not measured"));
  const auto off = presets_off_front(curve, points());
  ASSERT_EQ(off.size(), 3u);
  EXPECT_NEAR(off.at("low"), 1.5, 1e-12);
  EXPECT_EQ(off.at("high"), 1.0);
  EXPECT_EQ(off.at("medium"), 1.0) << "presets do not judge each other";
  // What is no rival beats nobody.
  LabCurve among = curve;
  among.rivals = "k", among.why_rivals = "Others jump.";
  std::vector<LabPoint> with_others = points();
  with_others.push_back(point("jumping", 1.0, "U10", 10.0, 1e-3));
  EXPECT_EQ(presets_off_front(among, with_others), off);
  EXPECT_GT(presets_off_front(curve, with_others).at("high"), 100.0);
  EXPECT_THAT(conclusion(among, with_others), HasSubstr("On the front: medium, high. Others jump."));
  const std::string table = lab_table({curve}, points());
  EXPECT_THAT(table, HasSubstr("low 50 %"));
  EXPECT_THAT(table, HasSubstr("frame      U10         1 ms        0.08       9 ms       0.005"));
  const std::string page = lab_html({curve}, points(), {});
  for (const char* part : {"<!doctype html>", "Whole frames", "</html>", "<svg "}) EXPECT_THAT(page, HasSubstr(part));
  for (const char* network : {"http:", "https:", "src=", "@import", "<script"})
    EXPECT_THAT(page, Not(HasSubstr(network)));
}

// Controls seen: the budget passed by the first that does not fit; settings of another sea.
TEST(LabReport, SettingsForABudgetAreThoseOfTheFront) {
  const auto fit = [&](double us) {
    std::vector<std::string> settings;
    for (const LabPoint& p : recommended(points(), us, "U10")) settings.push_back(p.settings);
    return settings;
  };
  EXPECT_THAT(fit(4500.0), ElementsAre("a.b=4", "a.b=2", "a.b=1"));
  EXPECT_THAT(fit(4000.0), ElementsAre("a.b=4", "a.b=2", "a.b=1"));
  EXPECT_THAT(fit(1e9), ElementsAre("a.b=10", "a.b=8", "a.b=4", "a.b=2", "a.b=1"));
  EXPECT_TRUE(fit(900.0).empty());
  EXPECT_TRUE(recommended(points(), 1e9, "U7").empty());
}

}  // namespace
}  // namespace seascape
