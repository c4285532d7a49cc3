// `seascape capture` and `seascape plan` from outside: the files they leave and what stands in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/desktop.h"
#include "tests/support/run_program.h"
#include "tests/support/sampled.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

namespace fs = std::filesystem;
using test::ProgramResult;
using test::run_program;
using test::TemporaryFolder;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

// The patches are coarse: what is tested is what is written, and every preset has to be drawn.
const std::vector<std::string> coarse{"--set", "lod.patch_quads=16", "--set", "lod.threshold=4",
                                      "--set", "waves.resolution=64"};

ProgramResult run(std::vector<std::string> words) {
  words.insert(words.end(), coarse.begin(), coarse.end());
  words.insert(words.end(), {"--log-level", "error"});
  return run_program(words);
}

const char* fixed_columns =
    "scene,preset,frame,time_s,cpu_ms,gpu_ms,draws,triangles,dispatches,missed_72,missed_90,missed_120";

// On a software driver presets take one sample a pixel, unless they are told another number. Controls seen: the user's
// number taken before the device's; a preset that is named left as it is.
TEST(Capture, PresetsTakeOneSampleAPixelInSoftware) {
  const TemporaryFolder folder;
  const auto page = [&](const std::string& preset, std::vector<std::string> more) {
    std::vector<std::string> words{"capture", "--scene",  "swell",   "--preset", preset,
                                   "--size",  "48x27",    "--views", "1",        "--frames",
                                   "1",       "--warmup", "0",       "--out",    folder / "out"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words).exit_code, 0);
    return text_of(fs::path(folder / "out") / "report.html");
  };
  const std::string plain = page("auto", {});
  const bool software = plain.find("draws in software") != std::string::npos;
  EXPECT_THAT(plain, HasSubstr(software ? "1 view, 1 × MSAA" : "1 view, 4 × MSAA"));
  EXPECT_THAT(page("auto", {"--set", "msaa=4"}), HasSubstr("1 view, 4 × MSAA"));
  EXPECT_THAT(page("high", {}), HasSubstr(software ? "1 view, 1 × MSAA" : "1 view, 4 × MSAA"));
}

// A run that holds a frame rate says what it was drawn at and why, in each row and in one sentence; the rate has to be
// known. In the simulated headset too. Controls seen: the columns in every capture; the finest quality written whatever
// was drawn.
TEST(Capture, TellsHowAFrameRateWasHeld) {
  const TemporaryFolder folder;
  const auto capture = [&](const std::string& display, std::vector<std::string> more) {
    std::vector<std::string> words{"capture", "--scene",  "swell",     "--preset", "low",
                                   "--size",  "320x320",  "--display", display,    "--frames",
                                   "40",      "--warmup", "8",         "--out",    folder / display};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  const ProgramResult unknown = capture("headless", {"--set", "adaptive.use=on"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("adaptive.use: a display without a screen has no rate to hold"));
  EXPECT_THAT(unknown.err, HasSubstr("--set adaptive.target_hz=72"));
  for (const std::string display : {"headless", "simulated"}) {
    // A rate that no machine here comes to: all levers go to their last step.
    const ProgramResult held = capture(display, {"--set", "adaptive.use=on", "--set", "adaptive.target_hz=500"});
    EXPECT_EQ(held.exit_code, 0) << held.err;
    EXPECT_THAT(held.out, HasSubstr("held to 2.00 ms a frame: "));
    std::istringstream text(text_of(fs::path(folder / display) / "capture.csv"));
    std::string line;
    std::getline(text, line);
    EXPECT_THAT(line, HasSubstr(",picture_scale,quality,decision"));
    // A machine that stalls may put a frame aside as far off, so that no single line has to say it.
    int lowest = 0, late = 0;
    while (std::getline(text, line)) {
      lowest += line.find(",0.5003,") != std::string::npos;
      late += line.ends_with(",late at every level");
    }
    EXPECT_GT(lowest, 0) << display;
    EXPECT_GT(late, 0) << display;
    EXPECT_THAT(text_of(fs::path(folder / display) / "trace.json"), HasSubstr("\"picture scale\"")) << display;
  }
  const ProgramResult plain = capture("headless", {});
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_THAT(text_of(fs::path(folder / "headless") / "capture.csv"), Not(HasSubstr("picture_scale")));
}

// Control seen: told by make_program() of each preset there are four lines more, and one more of plan.
TEST(Capture, WhatGivesNothingIsToldOnceForAllPresets) {
  const TemporaryFolder folder;
  const std::vector<std::string> scene{"--scene", "calm", "--size", "16x16",
                                       "--views", "1",    "--set",  "level.height_m=2"};
  const auto warnings = [&](std::vector<std::string> words) {
    words.insert(words.end(), scene.begin(), scene.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("warning: --set: level.height_m gives nothing"));
    return std::count(result.err.begin(), result.err.end(), '\n');
  };
  EXPECT_EQ(warnings({"capture", "--preset", "all", "--frames", "1", "--warmup", "0", "--out", folder / "out"}), 1);
  EXPECT_EQ(warnings({"plan", "--preset", "low"}), 1);
  EXPECT_EQ(warnings({"replay", "--preset", "low", "--frames", "1", "--out", folder / "out"}), 1);
}

class CaptureOfAllPresets : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    result_ = new ProgramResult(
        run({"capture", "--scene", "swell", "--preset", "all", "--size", "48x27", "--views", "2", "--frames", "3",
             "--warmup", "1", "--fps", "10", "--set", "waves.where=gpu", "--out", *folder_ / "new" / "out"}));
  }
  static void TearDownTestSuite() {
    delete result_;
    delete folder_;
  }
  static fs::path file(const std::string& name) { return *folder_ / "new" / "out" / name; }
  static inline TemporaryFolder* folder_ = nullptr;
  static inline ProgramResult* result_ = nullptr;
};

TEST_F(CaptureOfAllPresets, LeavesThreeFilesAndATable) {
  ASSERT_EQ(result_->exit_code, 0) << result_->err;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(file(""))) names.push_back(entry.path().filename());
  EXPECT_THAT(names, testing::UnorderedElementsAre("capture.csv", "trace.json", "report.html"));
  for (const char* word : {"low", "medium", "high", "ultra", "median", "p95", "p99", "max", "72 Hz", "90 Hz", "120 Hz"})
    EXPECT_THAT(result_->out, HasSubstr(word));
}

// Control: a capture that reads the times of a frame where they arrive, and not where they belong, gave nan in gpu_ms
// of frame 1 and passes longer than their frame.
TEST_F(CaptureOfAllPresets, TheTableHasItsColumnsAndARowAFrame) {
  ASSERT_EQ(result_->exit_code, 0) << result_->err;
  const std::vector<std::string> lines = split(text_of(file("capture.csv")), '\n');
  ASSERT_EQ(lines.size(), 1u + 4u * 3u);
  EXPECT_THAT(lines[0], testing::StartsWith(std::string(fixed_columns) + ",gpu_"));
  const std::vector<std::string> columns = split(lines[0], ',');
  for (std::size_t i = 12; i < columns.size(); ++i) {
    EXPECT_THAT(columns[i], testing::MatchesRegex("[gc]pu_.+_ms"));
    EXPECT_EQ(std::count(columns.begin(), columns.end(), columns[i]), 1) << columns[i];
  }
  for (const char* pass :
       {"gpu_wave rows_ms", "gpu_wave columns_ms", "gpu_wave mips_ms", "gpu_surface_ms", "cpu_waiting_ms", "cpu_sea_ms",
        "cpu_waves_ms", "cpu_sky_ms", "cpu_traversal_ms", "cpu_recording_ms", "cpu_submission_ms"})
    EXPECT_THAT(columns, testing::Contains(pass));
  const char* presets[] = {"low", "medium", "high", "ultra"};
  int told = 0;
  for (std::size_t row = 0; row < 12; ++row) {
    const std::vector<std::string> cells = split(lines[row + 1], ',');
    ASSERT_EQ(cells.size(), columns.size()) << lines[row + 1];
    EXPECT_EQ(cells[0], "swell");
    EXPECT_EQ(cells[1], presets[row / 3]);
    EXPECT_EQ(cells[2], std::to_string(row % 3));
    EXPECT_NEAR(std::stod(cells[3]), 0.1 * double(row % 3), 1e-6);
    const double cpu = std::stod(cells[4]), gpu = std::stod(cells[5]), frame = std::max(cpu, gpu);
    EXPECT_GT(cpu, 0.0);
    EXPECT_GT(gpu, 0.0) << lines[row + 1];
    EXPECT_GE(std::stoi(cells[6]), 2);
    EXPECT_GT(std::stoi(cells[7]), 100);
    EXPECT_GE(std::stoi(cells[8]), 3);
    const int rates[] = {72, 90, 120};
    for (std::size_t r = 0; r < 3; ++r)
      if (std::abs(frame - 1000.0 / rates[r]) > 1e-3) {
        EXPECT_EQ(cells[9 + r], frame > 1000.0 / rates[r] ? "1" : "0") << lines[row + 1];
      }
    double passes = 0.0, stages = 0.0;
    for (std::size_t i = 12; i < cells.size(); ++i)
      if (columns[i] != "cpu_waiting_ms") (columns[i].starts_with("gpu") ? passes : stages) += std::stod(cells[i]);
    EXPECT_LE(passes, gpu * 1.01 + 0.1);
    EXPECT_GT(passes, 0.0);
    EXPECT_LE(stages, cpu + 1e-3);
    told += stages > 0.5 * cpu;
  }
  EXPECT_GE(told, 6) << "stages tell most of a frame's time but where something else ran between them";
}

// Control: with waves.where=gpu, or lit forward, the columns are others.
TEST(Capture, LightIsAPassOfItsOwnWhereItIsDeferred) {
  const TemporaryFolder folder;
  const ProgramResult result = run({"capture",
                                    "--scene",
                                    "swell",
                                    "--preset",
                                    "low",
                                    "--size",
                                    "48x27",
                                    "--views",
                                    "1",
                                    "--frames",
                                    "2",
                                    "--warmup",
                                    "1",
                                    "--set",
                                    "msaa=1",
                                    "--set",
                                    "frame.lighting=deferred",
                                    "--set",
                                    "waves.where=cpu",
                                    "--out",
                                    folder / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> lines = split(text_of(folder / "out" / "capture.csv"), '\n');
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[0], testing::StartsWith(std::string(fixed_columns) + ",gpu_surface_ms,gpu_light_ms,cpu_"))
      << "the processor writes the waves' images: no copies";
  EXPECT_GT(std::stod(split(lines[1], ',')[12]), 0.0);
}

// Control: a trace of the first run alone had one process.
TEST_F(CaptureOfAllPresets, TheTraceIsJsonWithEveryFrameOfEveryRun) {
  ASSERT_EQ(result_->exit_code, 0) << result_->err;
  const nlohmann::json trace = nlohmann::json::parse(text_of(file("trace.json")));
  std::size_t slices = 0, processes = 0;
  for (const auto& event : trace.at("traceEvents")) {
    if (event.at("ph") == "X") ++slices;
    if (event.at("ph") == "M" && event.at("name") == "process_name") ++processes;
  }
  EXPECT_EQ(processes, 4u);
  EXPECT_GE(slices, 4u * 3u * 6u);  // CPU, GPU and at least four passes a frame
}

// Control: a page with a link to a style sheet elsewhere was caught by its "https://".
TEST_F(CaptureOfAllPresets, TheReportLoadsNothingAndNamesTheMachine) {
  ASSERT_EQ(result_->exit_code, 0) << result_->err;
  const std::string page = text_of(file("report.html"));
  for (const char* load : {"http://", "https://", "<script", "src=", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(load)));
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("waves"));
  for (const char* preset : {"low", "medium", "high", "ultra"}) EXPECT_THAT(page, HasSubstr(preset));
  EXPECT_THAT(page, HasSubstr("seascape 0.1"));
}

// Control: frames_of without its last frame gave five lines.
TEST(Capture, WalksTheWholePathUnlessTold) {
  const TemporaryFolder folder;
  const std::string path = folder / "short.json";
  std::ofstream(path)
      << R"({"version": 1, "keys": [{"time_s": 0, "position_m": [0, 3, 0]}, {"time_s": 2, "position_m": [0, 3, -4]}]})";
  const ProgramResult result = run({"capture", "--preset", "low", "--path", path, "--size", "32x18", "--views", "1",
                                    "--fps", "2", "--warmup", "0", "--out", folder / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> lines = split(text_of(folder / "out" / "capture.csv"), '\n');
  ASSERT_EQ(lines.size(), 6u);  // 0 s to 2 s at 2 a second, both ends
  EXPECT_THAT(lines[5], testing::StartsWith("open_sea,low,4,2.0"));
}

// Control: a capture that takes every display for headless ends with 0 where no desktop answers.
TEST(Capture, InAWindowNeedsADesktopAndMeasuresThere) {
  const TemporaryFolder folder;
  const std::vector<std::string> words{"capture",     "--display", "window",  "--preset",    "low",
                                       "--size",      "96x64",     "--views", "1",           "--frames",
                                       "2",           "--warmup",  "1",       "--set",       "waves.resolution=64",
                                       "--log-level", "error",     "--out",   folder / "out"};
  const ProgramResult without = run_program(words, {"DISPLAY=", "WAYLAND_DISPLAY="});
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_THAT(without.err, testing::StartsWith("seascape: display: "));
  EXPECT_FALSE(fs::exists(folder / "out"));

  const test::VirtualDisplay display;
  const ProgramResult result = run_program(words, {display.variable(), "WAYLAND_DISPLAY=", "SEASCAPE_VALIDATION=1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> lines = split(text_of(folder / "out" / "capture.csv"), '\n');
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[0], HasSubstr("gpu_surface_ms"));
  EXPECT_THAT(text_of(folder / "out" / "report.html"), HasSubstr("96 × 64"));
}

// Controls: a plan whose passes are the sum of its effects' counted one too many; one without add_foam had no module of
// foam.
TEST(Plan, AsJsonNamesEveryEffectItsReasonAndItsObjects) {
  // Four samples, so that the sea is lit where its triangles are drawn on every device.
  const ProgramResult result = run({"plan", "--scene", "storm", "--preset", "low", "--size", "32x18", "--json", "--set",
                                    "waves.where=gpu", "--set", "foam.simulated=false", "--set", "msaa=4"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json plan = nlohmann::json::parse(result.out);
  std::uint64_t bytes = 0, draws = 0, passes = 0;
  std::map<std::string, nlohmann::json> effects;
  for (const auto& effect : plan.at("effects")) {
    effects[effect.at("name")] = effect;
    for (const char* key : {"because", "passes", "pipelines", "modules", "bytes"})
      EXPECT_TRUE(effect.contains(key)) << key;
    EXPECT_FALSE(effect.at("because").get<std::string>().empty());
    bytes += effect.at("bytes").get<std::uint64_t>();
    for (const auto& pass : effect.at("passes"))
      if (pass.at("when") == "every frame") {
        draws += pass.at("draws").get<std::uint64_t>();
        passes += pass.at("times").get<std::uint64_t>();
      }
  }
  EXPECT_EQ(plan.at("totals").at("bytes"), bytes);
  EXPECT_EQ(plan.at("totals").at("draws"), draws);
  EXPECT_EQ(plan.at("totals").at("passes"), passes - 2) << "sky and spray are drawn in the surface's pass";
  ASSERT_THAT(effects, testing::SizeIs(7));
  EXPECT_EQ(effects.at("waves").at("because"), "the scene names it");
  EXPECT_GT(effects.at("waves").at("bytes"), 1000);
  EXPECT_GE(effects.at("waves").at("pipelines").size(), 3u);
  EXPECT_TRUE(
      effects.at("foam").at("passes").empty());  // it is code in the surface's shader and has no pass of its own
  ASSERT_EQ(effects.at("foam").at("modules").size(), 1u);
  EXPECT_EQ(effects.at("foam").at("modules")[0].at("name"), "surface.frag");
  EXPECT_EQ(effects.at("foam").at("modules")[0].at("part_of"), "surface");
  EXPECT_GT(effects.at("foam").at("modules")[0].at("words"), 100);
  EXPECT_GT(effects.at("surface").at("modules").size(), 1u);
}

// Control: a plan that always names foam.
TEST(Plan, OfASceneWithoutFoamHasNone) {
  const ProgramResult result = run({"plan", "--scene", "calm", "--preset", "low", "--size", "32x18"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::size_t presets = result.out.find("\npresets ");  // their table has a setting of foam
  ASSERT_NE(presets, std::string::npos);
  EXPECT_THAT(result.out.substr(0, presets), Not(HasSubstr("foam")));
  EXPECT_THAT(result.out, HasSubstr("waves: the scene names it"));
}

// And one table of what each effect adds, with SEASCAPE_LONG=1: two minutes. Control: a matrix that leaves low out.
TEST(Plan, MatrixHasATableOfEachPreset) {
  if (!test::long_run()) GTEST_SKIP() << "SEASCAPE_LONG=1 asks for it";
  const TemporaryFolder folder;
  std::ofstream(folder / "calm.json") << R"({"version": 1, "effects": ["waves"]})";  // few effects take little time
  const ProgramResult result = run({"plan", "--scene", folder / "calm.json", "--preset", "low", "--size", "32x18",
                                    "--matrix", folder / "m", "--frames", "1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* preset : {"low", "medium", "high", "ultra"}) {
    const auto lines = split(text_of(folder / "m" / ("plan_calm_" + std::string(preset) + ".csv")), '\n');
    ASSERT_EQ(lines.size(), 5u) << preset;
    EXPECT_EQ(lines[0],
              "scene,preset,effect,because,passes,draws,triangles,dispatches,pipelines,modules,words,resources,bytes");
    EXPECT_THAT(lines[1], testing::StartsWith("calm," + std::string(preset) + ",waves,the scene names it,"));
  }
  const auto costs = split(text_of(folder / "m" / "matrix_calm_low.csv"), '\n');
  ASSERT_GT(costs.size(), 4u);
  EXPECT_EQ(costs[0], "scene,preset,effect,beside,ms,ms_low,ms_high,bytes,passes,draws,dispatches,pipelines,words");
  EXPECT_THAT(costs[1], testing::StartsWith("calm,low,waves,nothing,"));
  EXPECT_THAT(text_of(folder / "m" / "matrix_calm_low.svg"), testing::StartsWith("<svg "));
}

}  // namespace
}  // namespace seascape
