// The command bake, and loops of waves on disk: what is written is what is read, and every fault is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "app/commands.h"
#include "app/loop_file.h"
#include "app/query_command.h"
#include "app/scene.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/image_file.h"
#include "ocean/waves/baked.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

Arguments baking(const std::string& out) {
  Arguments a;
  a.command = Command::bake;
  a.scene = "open_sea";
  a.preset = "low";
  a.frames = 8;
  a.fps = 2.0;
  a.width = 64;
  a.tile_m = 90.0;
  a.out = out;
  return a;
}

// What is read is what was recorded, to a half float's rounding.
TEST(Bake, WritesALoopThatReadsBack) {
  const test::TemporaryFolder folder;
  const std::string out = folder / "loop";
  EXPECT_EQ(run_bake(baking(out)), 0);
  const BakedLoop loop = read_loop(out);
  EXPECT_EQ(loop.frames, 8);
  EXPECT_EQ(loop.samples, 64);
  EXPECT_EQ(loop.fps, 2.0);
  EXPECT_EQ(loop.side_m, 90.0);
  LoopRecorder recorder(load_scene("open_sea", "low").settings.sea, {8, 2.0, 64, 90.0});
  std::vector<float> frame(loop.frame_floats());
  double most = 0.0;
  for (int f = 0; f < 8; ++f) {
    recorder.record(f, frame);
    for (std::size_t i = 0; i < frame.size(); ++i) {
      EXPECT_NEAR(loop.texels[std::size_t(f) * frame.size() + i], frame[i], std::abs(frame[i]) / 2048.0 + 1e-7);
      most = std::max(most, double(std::abs(frame[i])));
    }
  }
  EXPECT_GT(most, 0.3);
  // Only frames and manifest are left, and of a longer loop that was there nothing.
  std::ofstream(out + "/frame_0008.exr") << "old";
  EXPECT_EQ(run_bake(baking(out)), 0);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    ++files;
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos);
  }
  EXPECT_EQ(files, 9u);
}

TEST(Bake, RefusesWhatCannotBe) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  const auto fault = [&](auto change) {
    Arguments a = baking(folder / "loop");
    change(a);
    return test::error_of([&] { run_bake(a); });
  };
  EXPECT_NE(fault([&](Arguments& a) { a.out = folder / "file/loop"; }).find("file"), std::string::npos);
  EXPECT_NE(fault([](Arguments& a) { a.frames = 3; }).find("--frames"), std::string::npos);
  EXPECT_NE(fault([](Arguments& a) {
              a.scene = "gerstner", a.overrides = {{"--set", "waves.wind_speed_mps", "0"}};
            }).find("neither wind waves nor swell"),
            std::string::npos);
  EXPECT_NE(fault([](Arguments& a) { a.scene = "no_such_scene"; }).find("no_such_scene"), std::string::npos);
  EXPECT_NE(fault([](Arguments& a) { a.out = "/dev/full/x"; }), "");
  EXPECT_FALSE(std::filesystem::exists(folder / "loop/loop.json")) << "a fault leaves no manifest";
}

// Each fault of a loop's files is told by the file's name and what is wrong. The control is the same folder before each
// change, which reads.
class LoopFaults : public testing::Test {
 protected:
  LoopFaults() {
    loop_ = folder_ / "loop";
    run_bake(baking(loop_));
    EXPECT_NO_THROW(read_loop(loop_));
  }
  std::string fault() {
    return test::error_of([&] { read_loop(loop_); });
  }
  void manifest(const std::string& from, const std::string& to) {
    std::string text = read_text(loop_ + "/loop.json");
    ASSERT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), from.size(), to);
    std::ofstream(loop_ + "/loop.json", std::ios::binary) << text;
  }
  ImageF frame(int size) { return {size, size, std::vector<float>(std::size_t(size) * std::size_t(size) * 4, 0.5f)}; }
  test::TemporaryFolder folder_;
  std::string loop_;
};

TEST_F(LoopFaults, OfTheManifest) {
  manifest("\"texels\": 64", "\"texels\": 65");
  EXPECT_NE(fault().find("texels: 65 is no power of two"), std::string::npos) << fault();
  manifest("\"texels\": 65", "\"texels\": 64.5");
  EXPECT_NE(fault().find("not a whole number"), std::string::npos) << fault();
  manifest("\"texels\": 64.5", "\"texels\": 1024");
  EXPECT_NE(fault().find("out of range"), std::string::npos) << fault();
  // Told before any memory is taken. Control: the number of frames divided by their size (tests/mutants).
  manifest("\"texels\": 1024", "\"texels\": 512");
  manifest("\"frames\": 8", "\"frames\": 1000");
  EXPECT_NE(fault().find("1000 frames of 512x512 texels take 3000 MiB"), std::string::npos) << fault();
  manifest("\"frames\": 1000", "\"frames\": 8");
  manifest("\"texels\": 512", "\"texels\": 64");
  manifest("\"size_m\": 90.0", "\"size_m\": -1");
  EXPECT_NE(fault().find("size_m"), std::string::npos) << fault();
  manifest("\"size_m\": -1", "\"size\": 90");
  EXPECT_NE(fault().find("loop.json"), std::string::npos) << fault();
  manifest("\"size\": 90", "\"size_m\": 90.0");
  EXPECT_NO_THROW(read_loop(loop_));
  manifest("\"version\": 1", "\"version\": 2");
  EXPECT_NE(fault().find("version: 2 is not known"), std::string::npos) << fault();
  std::filesystem::remove(loop_ + "/loop.json");
  EXPECT_NE(fault().find("loop.json"), std::string::npos) << fault();
}

TEST_F(LoopFaults, OfAFrame) {
  const std::string third = loop_ + "/frame_0003.exr";
  const std::vector<std::uint8_t> good = read_bytes(third);
  const auto expect = [&](const std::string& what) {
    EXPECT_NE(fault().find("frame_0003.exr"), std::string::npos) << fault();
    EXPECT_NE(fault().find(what), std::string::npos) << fault();
    write_atomically(third, good);
    EXPECT_NO_THROW(read_loop(loop_));
  };
  std::filesystem::remove(third);
  expect("is missing");
  write_atomically(third, std::span(good).first(good.size() / 2));
  expect("broken");
  write_atomically(third, std::string_view("not an EXR at all"));
  expect("");
  write_exr(third, frame(32));
  expect("is 32x32 texels where the manifest says 64x64");
  ImageF nan = frame(64);
  nan.pixels[4 * (64 * 5 + 7) + 1] = std::nanf("");
  write_exr(third, nan);
  expect("NaN");
  ImageF far = frame(64);
  far.pixels[4 * 9] = 91.0f;
  write_exr(third, far);
  expect("more than the loop's side");
  // Channels of other names: those of one more byte in the header, as other programs write them ("X" for "R").
  std::string renamed(good.begin(), good.end());
  const std::size_t at = renamed.find(std::string("R\0\1\0\0\0", 6));
  ASSERT_NE(at, std::string::npos);
  renamed[at] = 'X';
  write_atomically(third, renamed);
  expect("lacks the channel R");
}

// The name of a loop is looked up in content/loops, a folder beside the scene and from the working directory.
TEST(Loops, AreFoundByNameAndByFolder) {
  EXPECT_EQ(loop_folder("fresh_sea", ""), content_directory() / "loops" / "fresh_sea");
  const std::string message = test::error_of([] { loop_folder("fresh_see", ""); });
  EXPECT_NE(message.find("no loop is called 'fresh_see' (did you mean 'fresh_sea'?)"), std::string::npos) << message;
  EXPECT_NE(test::error_of([] { loop_folder("", ""); }).find("no loop is named"), std::string::npos);
  EXPECT_NE(test::error_of([] { loop_folder("./nowhere", ""); }).find("is no folder"), std::string::npos);
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "loops/mine");
  EXPECT_EQ(loop_folder("loops/mine", folder / "scene.json"), folder.path() / "loops/mine");
  EXPECT_EQ(loop_folder(folder / "loops/mine", ""), folder.path() / "loops/mine");
}

// The shipped loop is what its manifest says; the scene that plays it has it in its queries. Control: without the
// effect heights are those of the wind alone.
TEST(Loops, TheShippedOneIsInTheScenesAnswers) {
  const BakedLoop loop = read_loop(content_directory() / "loops" / "fresh_sea");
  double variance = 0.0;
  for (int f = 0; f < loop.frames; ++f)
    for (int i = 0; i < 64 * 64; ++i)
      variance += std::pow(loop.texels[std::size_t(f) * loop.frame_floats() + std::size_t(4096 + i)], 2) /
                  (4096.0 * loop.frames);
  EXPECT_NEAR(4.0 * std::sqrt(variance), 1.3, 0.3);
  Scene scene = load_scene("baked", "low");
  std::vector<glm::dvec2> points;
  for (int i = 0; i < 400; ++i) points.emplace_back(3.7 * i, -1.3 * i);
  const auto heights = [&](double time_s) {
    std::vector<double> list;
    const std::string text = query_csv(scene, {.times_s = {time_s}}, points);
    std::size_t line = text.find('\n') + 1;
    while (line < text.size()) {
      std::size_t comma = text.find(',', text.find(',', line) + 1) + 1;
      list.push_back(std::stod(text.substr(comma)));
      line = text.find('\n', line) + 1;
    }
    return list;
  };
  const auto deviation = [](const std::vector<double>& list) {
    double sum = 0.0;
    for (const double h : list) sum += h * h / double(list.size());
    return std::sqrt(sum);
  };
  const double with = deviation(heights(3.0));
  scene.settings.sea.wind_speed_mps = 0.0;
  const std::vector<double> now = heights(3.0), later = heights(3.0 + 20.0), between = heights(3.0 + 7.0);
  ASSERT_EQ(now.size(), points.size());
  double worst = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i)
    worst = std::max(worst, std::abs(now[i] - later[i])), moved = std::max(moved, std::abs(now[i] - between[i]));
  EXPECT_LE(worst, 1e-6) << "20 s are the loop";
  EXPECT_GT(moved, 0.3);
  scene = load_scene("baked", "low");
  scene.effects = {"waves"};
  EXPECT_GT(with, 3.0 * deviation(heights(3.0)));
}

// A scene that names a loop which is not there is refused where it is read.
TEST(Loops, ASceneWithoutItsLoopIsAFault) {
  const std::string message = test::error_of([] {
    parse_scene(R"({"version": 1, "effects": ["waves", "baked"], "baked": {"loop": "nothing"}})", "s.json", "low");
  });
  EXPECT_EQ(message.find("s.json: baked.loop: no loop is called 'nothing'"), 0u) << message;
  EXPECT_NO_THROW(
      parse_scene(R"({"version": 1, "effects": ["waves"], "baked": {"loop": "nothing"}})", "s.json", "low"));
}

}  // namespace
}  // namespace seascape
