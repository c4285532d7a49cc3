// curves.csv: what is written is read again to the bit, and what is broken is told by line.
#include "app/lab/lab_files.h"

#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/support/expect_error.h"

namespace seascape {
namespace {

LabOrigin origin() {
  LabOrigin o;
  o.machine.cpu = "A \"fast\" one, with commas";
  o.machine.device = "llvmpipe";
  o.machine.driver = "Mesa";
  o.machine.build = "seascape 0.1, release, GCC";
  o.machine.date = "2026-11-22 17:00 UTC";
  o.machine.seed = 7;
  o.quick = true;
  return o;
}

std::vector<LabPoint> points() {
  Summary time;
  time.count = 12, time.median = 1.0 / 3.0, time.p5 = 0.1, time.p95 = 2.5;
  return {{"query", "plain loop, Newton", 3.0, "U10", time, {1e-300, "of Hs, rms"}, "", ""},
          {"frame", "presets", 1.0, "U3, \"calm\"", time, {0.0, "1 - SSIM"}, "low medium", "msaa=4 waves.cascades=3"}};
}

// Control seen: times written with six digits.
TEST(LabFiles, WhatIsWrittenIsReadAgain) {
  const std::string text = curves_csv(points(), origin());
  EXPECT_TRUE(text.starts_with("curve,knob,value,sea,time_us,time_p5_us,time_p95_us,error,error_unit,preset,"));
  const LabRows rows = parse_curves_csv(text, "c");
  ASSERT_EQ(rows.points.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const LabPoint want = points()[i], &got = rows.points[i];
    EXPECT_EQ(got.curve, want.curve);
    EXPECT_EQ(got.knob, want.knob);
    EXPECT_EQ(got.value, want.value);
    EXPECT_EQ(got.sea, want.sea);
    EXPECT_EQ(got.time_us.median, want.time_us.median);
    EXPECT_EQ(got.time_us.p5, want.time_us.p5);
    EXPECT_EQ(got.time_us.p95, want.time_us.p95);
    EXPECT_EQ(got.time_us.count, want.time_us.count);
    EXPECT_EQ(got.error.value, want.error.value);
    EXPECT_EQ(got.error.unit, want.error.unit);
    EXPECT_EQ(got.preset, want.preset);
    EXPECT_EQ(got.settings, want.settings);
  }
  EXPECT_TRUE(same_origin(rows.origin, origin()));
  EXPECT_EQ(rows.origin.machine.cpu, origin().machine.cpu);
  EXPECT_EQ(curves_csv(rows.points, rows.origin), text);
  LabOrigin other = origin();
  other.quick = false;
  EXPECT_FALSE(same_origin(other, origin()));
  other = origin();
  other.machine.build += "2";
  EXPECT_FALSE(same_origin(other, origin()));
}

// Control seen: cells not counted (a crash under the address sanitizer).
TEST(LabFiles, WhatIsBrokenIsToldByLine) {
  const std::string good = curves_csv(points(), origin());
  const auto fault = [&](std::string text) { return test::error_of([&] { parse_curves_csv(text, "c.csv"); }); };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return fault(text);
  };
  EXPECT_NE(fault("").find("empty"), std::string::npos);
  EXPECT_NE(fault("x,z\n1,2\n").find("c.csv:1"), std::string::npos);
  EXPECT_NE(with(",U10,", ",").find("c.csv:2"), std::string::npos);
  EXPECT_NE(with(",2.5,", ",inf,").find("time_p95_us"), std::string::npos);
  EXPECT_NE(with("1e-300", "-1").find("error"), std::string::npos);
  EXPECT_NE(with("1e-300", "one").find("'one'"), std::string::npos);
  EXPECT_NE(with(",quick,", ",slow,").find("slow"), std::string::npos);
  EXPECT_NE(fault(good.substr(0, good.find("commas"))).find("does not end"), std::string::npos);
  EXPECT_TRUE(parse_curves_csv(good.substr(0, good.find('\n') + 1), "c").points.empty());
}

}  // namespace
}  // namespace seascape
