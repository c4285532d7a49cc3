#include "app/report_replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/files.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using nlohmann::json;

ReplayRecord record() {
  ReplayRecord made;
  made.scene = "open \"sea\"";
  made.path = "storm";
  made.preset = "high";
  made.seed = 18446744073709551615ull;
  made.width = 1280;
  made.height = 720;
  made.fps = 30.0;
  made.stereo = "single";
  made.format = "png";
  made.driver = "lavapipe \xff";  // not UTF-8
  for (int i = 5; i < 8; ++i) {
    ReplayFrame frame;
    frame.frame = i;
    frame.time_s = i / 30.0;
    frame.scene_time_s = 1e7 + i / 30.0;
    frame.views.viewer.position_m = {0.1, 1.7, -1e6 - 1.0 / 3.0};
    frame.views.viewer.orientation = {0.5, 0.1, 0.2, 0.3};
    frame.views.eyes = stereo_views(frame.views.viewer, symmetric_fov(60.0, 16.0 / 9.0), 0.064);
    frame.files = {"frame_0005_left.png", "frame_0005_right.png"};
    frame.cpu_ms = 1.25;
    frame.gpu_ms = std::nan("");
    frame.draws = 4;
    frame.triangles = 5000000000ull;
    frame.dispatches = 12;
    frame.patches = 300;
    if (i == 6) frame.eye_events = {{6 / 30.0 - 0.01, 0, true}, {6 / 30.0, 1, false}};
    made.frames.push_back(frame);
  }
  return made;
}

// Controls: the eyes' names swapped; orientation given as w, x, y, z, or numbers rounded to six
// digits, read back different.
TEST(ReplayRecord, ReadsBackTheSame) {
  const ReplayRecord made = record();
  const json parsed = json::parse(replay_json(made));
  EXPECT_EQ(parsed.at("version"), 1);
  EXPECT_EQ(parsed.at("scene"), made.scene);
  EXPECT_EQ(parsed.at("seed").get<std::uint64_t>(), made.seed);
  EXPECT_EQ(parsed.at("width"), 1280);
  ASSERT_EQ(parsed.at("frames").size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const json& frame = parsed.at("frames").at(i);
    const ReplayFrame& source = made.frames[i];
    EXPECT_EQ(frame.at("frame"), source.frame);
    EXPECT_EQ(frame.at("time_s").get<double>(), source.time_s);
    EXPECT_EQ(frame.at("scene_time_s").get<double>(), source.scene_time_s);
    EXPECT_EQ(frame.at("viewer").at("position_m").at(2).get<double>(), source.views.viewer.position_m.z);
    EXPECT_EQ(frame.at("viewer").at("orientation_xyzw").get<std::vector<double>>(),
              (std::vector<double>{0.1, 0.2, 0.3, 0.5}));
    ASSERT_EQ(frame.at("views").size(), 2u);
    EXPECT_EQ(frame.at("views").at(1).at("position_m").at(0).get<double>(), source.views.eyes[1].pose.position_m.x);
    EXPECT_EQ(frame.at("views").at(0).at("fov_tangents").at("down").get<double>(), source.views.eyes[0].fov.down);
    EXPECT_EQ(frame.at("files").at(1), "frame_0005_right.png");
    EXPECT_EQ(frame.at("counts").at("triangles").get<std::uint64_t>(), 5000000000ull);
    EXPECT_EQ(frame.at("counts").at("patches"), 300);
    EXPECT_EQ(frame.at("taken").at("cpu_ms"), 1.25);
    EXPECT_TRUE(frame.at("taken").at("gpu_ms").is_null());
    ASSERT_EQ(frame.at("events").size(), source.eye_events.size());
    for (std::size_t n = 0; n < source.eye_events.size(); ++n) {
      EXPECT_EQ(frame.at("events").at(n).at("time_s").get<double>(), source.eye_events[n].time_s);
      EXPECT_EQ(frame.at("events").at(n).at("eye"), n == 0 ? "left" : "right");
      EXPECT_EQ(frame.at("events").at(n).at("event"), n == 0 ? "in" : "out");
    }
  }
}

// Control: times taken outside `taken` make the rest of two replays differ.
TEST(ReplayRecord, OnlyWhatWasTakenDiffers) {
  ReplayRecord a = record(), b = record();
  b.frames[1].cpu_ms = 99.0;
  json first = json::parse(replay_json(a)), second = json::parse(replay_json(b));
  EXPECT_NE(first, second);
  for (json* parsed : {&first, &second})
    for (json& frame : parsed->at("frames")) frame.erase("taken");
  EXPECT_EQ(first, second);
}

// Control: the frames of a record without any would leave "[" open.
TEST(ReplayRecord, NoFramesAndOneLineEach) {
  ReplayRecord made = record();
  EXPECT_EQ(std::ranges::count(replay_json(made), '\n'), 17 + 3 + 2);
  made.frames.clear();
  EXPECT_TRUE(json::parse(replay_json(made)).at("frames").empty());
  const test::TemporaryFolder folder;
  write_replay_record(folder / "replay.json", made);
  EXPECT_EQ(read_text(folder / "replay.json"), replay_json(made));
}

}  // namespace
}  // namespace seascape
