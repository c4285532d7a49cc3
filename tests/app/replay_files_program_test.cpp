// `seascape replay` from outside: names and numbers of its pictures, its record, and that it repeats itself to the bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "engine/image_file.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

namespace fs = std::filesystem;
using test::ProgramResult;
using test::run_program;
using test::TemporaryFolder;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

ProgramResult replay(const fs::path& out, std::vector<std::string> more) {
  std::vector<std::string> words{"replay", "--preset", "low", "--size", "64x36", "--log-level", "error", "--out", out};
  words.insert(words.end(), more.begin(), more.end());
  return run_program(words);
}

// Control: numbers that count from 0 in spite of --start.
TEST(Replay, NumbersAreFramesOfThePathFromStart) {
  const TemporaryFolder folder;
  const ProgramResult part = replay(folder / "part", {"--start", "2", "--frames", "2", "--fps", "4"});
  const ProgramResult whole = replay(folder / "whole", {"--frames", "4", "--fps", "4"});
  ASSERT_EQ(part.exit_code, 0) << part.err;
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(part.out, "");
  EXPECT_EQ(part.err, "");
  EXPECT_THAT(names_in(folder / "part"),
              testing::ElementsAre("frame_0002_left.png", "frame_0002_right.png", "frame_0003_left.png",
                                   "frame_0003_right.png", "replay.json"));
  for (const char* name :
       {"frame_0002_left.png", "frame_0002_right.png", "frame_0003_left.png", "frame_0003_right.png"})
    EXPECT_EQ(text_of(folder / "part" / name), text_of(folder / "whole" / name)) << name;
  EXPECT_NE(text_of(folder / "whole" / "frame_0000_left.png"), text_of(folder / "whole" / "frame_0001_left.png"));
  EXPECT_NE(text_of(folder / "whole" / "frame_0000_left.png"), text_of(folder / "whole" / "frame_0000_right.png"));

  const auto record = nlohmann::json::parse(text_of(folder / "part" / "replay.json"));
  EXPECT_EQ(record.at("scene"), "open_sea");
  EXPECT_EQ(record.at("preset"), "low");
  EXPECT_EQ(record.at("width"), 64);
  ASSERT_EQ(record.at("frames").size(), 2u);
  const auto& frame = record.at("frames")[1];
  EXPECT_EQ(frame.at("frame"), 3);
  EXPECT_EQ(frame.at("time_s"), 0.75);
  EXPECT_EQ(frame.at("files"), (nlohmann::json{"frame_0003_left.png", "frame_0003_right.png"}));
  ASSERT_EQ(frame.at("views").size(), 2u);
  const auto left = frame.at("views")[0].at("position_m"), right = frame.at("views")[1].at("position_m");
  double squared = 0.0;
  for (std::size_t i = 0; i < 3; ++i) squared += std::pow(right[i].get<double>() - left[i].get<double>(), 2.0);
  EXPECT_NEAR(std::sqrt(squared), 0.064, 1e-9);
  EXPECT_GT(frame.at("counts").at("patches"), 4);
  EXPECT_GE(frame.at("counts").at("draws"), 2);
  EXPECT_GT(frame.at("taken").at("cpu_ms"), 0.0);
}

// Control: a seed taken from the clock gave two seas.
TEST(Replay, TwiceIsTheSameToTheBit) {
  const TemporaryFolder folder;
  const std::vector<std::string> words{"--scene", "storm", "--frames", "2", "--start", "40", "--seed", "7"};
  for (const char* run : {"first", "second"}) {
    const ProgramResult result = replay(folder / run, words);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  ASSERT_EQ(names_in(folder / "first"), names_in(folder / "second"));
  for (const std::string& name : names_in(folder / "first"))
    if (name != "replay.json") {
      EXPECT_EQ(text_of(folder / "first" / name), text_of(folder / "second" / name)) << name;
    }
  auto first = nlohmann::json::parse(text_of(folder / "first" / "replay.json"));
  auto second = nlohmann::json::parse(text_of(folder / "second" / "replay.json"));
  EXPECT_EQ(first.at("seed"), 7);
  for (auto* record : {&first, &second})
    for (auto& frame : record->at("frames")) frame.erase("taken");
  EXPECT_EQ(first, second);

  const ProgramResult other =
      replay(folder / "other", {"--scene", "storm", "--frames", "1", "--start", "40", "--seed", "8"});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  EXPECT_NE(text_of(folder / "other" / "frame_0040_left.png"), text_of(folder / "first" / "frame_0040_left.png"));
}

std::size_t distinct_greens(const ImageF& image) {
  std::set<float> values;
  for (std::size_t i = 1; i < image.pixels.size(); i += 4) values.insert(image.pixels[i]);
  return values.size();
}

// A frame whose shape is auto keeps its light where an EXR asks for it, and that has more shades than a byte; the tile
// frame keeps none and gives the picture's, which is the control.
TEST(Replay, ExrIsLinearLightThatLoads) {
  const TemporaryFolder folder;
  const ProgramResult result =
      replay(folder / "out", {"--views", "1", "--frames", "1", "--format", "exr", "--set", "frame.shape=auto"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(names_in(folder / "out"), testing::ElementsAre("frame_0000.exr", "replay.json"));
  const ImageF image = read_exr(folder / "out" / "frame_0000.exr");
  ASSERT_EQ(image.width, 64);
  ASSERT_EQ(image.height, 36);
  float least = image.pixels[0], most = image.pixels[0];
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    least = std::min(least, image.pixels[i]);
    most = std::max(most, image.pixels[i]);
  }
  EXPECT_GE(least, 0.0f);
  EXPECT_GT(most, 1.5f * least);
  EXPECT_GT(distinct_greens(image), 256u);
  const ProgramResult tile =
      replay(folder / "tile", {"--views", "1", "--frames", "1", "--format", "exr", "--set", "frame.shape=tile"});
  ASSERT_EQ(tile.exit_code, 0) << tile.err;
  EXPECT_LE(distinct_greens(read_exr(folder / "tile" / "frame_0000.exr")), 256u);
  const auto record = nlohmann::json::parse(text_of(folder / "out" / "replay.json"));
  EXPECT_EQ(record.at("format"), "exr");
  EXPECT_EQ(record.at("frames")[0].at("views").size(), 1u);
}

// Control: columns z,x.
TEST(Query, EndToEndHasItsColumnsAndThePointsInOrder) {
  const TemporaryFolder folder;
  const std::string points = folder / "points.csv", out = folder / "out.csv";
  std::ofstream(points) << "x,z\n0,0\n10.5,-3\n-250,1000\n";
  const ProgramResult result =
      run_program({"query", "--scene", "swell", "--preset", "low", "--time", "12.5", "--points", points, "--out", out},
                  {"VK_DRIVER_FILES=/nonexistent"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream table(text_of(out));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "x,z,height_m,normal_x,normal_y,normal_z,velocity_x,velocity_y,velocity_z,converged");
  const double asked[][2] = {{0, 0}, {10.5, -3}, {-250, 1000}};
  for (const auto& point : asked) {
    ASSERT_TRUE(std::getline(table, line));
    std::vector<double> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    ASSERT_EQ(row.size(), 10u) << line;
    EXPECT_EQ(row[0], point[0]);
    EXPECT_EQ(row[1], point[1]);
    EXPECT_LT(std::abs(row[2]), 20.0);
    EXPECT_NE(row[2], 0.0);
    EXPECT_NEAR(std::hypot(row[3], row[4], row[5]), 1.0, 1e-6);
    EXPECT_GT(row[4], 0.0);
    EXPECT_EQ(row[9], 1.0);
  }
  EXPECT_FALSE(std::getline(table, line));
}

}  // namespace
}  // namespace seascape
