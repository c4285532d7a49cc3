// The shipped paths fly over the shipped seas, never through them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "app/camera_path.h"
#include "app/input_script_file.h"
#include "app/place_inputs.h"
#include "app/scene.h"
#include "app/sea_remarks.h"
#include "app/sea_spec.h"
#include "app/tile_sources.h"
#include "ocean/sea/query.h"
#include "ocean/sea/sea.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {

// The least height of the path above the water, every quarter of a second; of waves longer than some metres, which
// stand as high as all.
double least_clearance(const std::string& name, double lowered_m) {
  const Scene scene = load_scene(name, "low");
  const CameraPath path = load_camera_path(name);
  const WaveField field(scene.settings.sea, WaveQuality{.resolution = 64, .cascades = 3},
                        tile_sources(scene, limited_sea(scene)));
  const PlaceSea places(place_inputs(scene), field);
  WaveTiles tiles;
  double least = 1e9;
  for (double t = 0.0; t <= path.duration_s(); t += 0.25) {
    const PathSample sample = path.at(t);
    field.evaluate(ticks_from_seconds(sample.scene_time_s), tiles);
    const glm::dvec2 place(sample.pose.position_m.x, sample.pose.position_m.z);
    QueryAnswer answer;
    places.query(field, tiles, {&place, 1}, {&answer, 1});
    least = std::min(least, sample.pose.position_m.y - lowered_m - answer.height_m);
  }
  return least;
}

// Control: the same paths flown 3 m lower dip under the water.
TEST(Content, PathsStayAboveTheirSeas) {
  for (const char* name : {"open_sea", "calm", "storm", "swell", "rain_pool", "gerstner", "baked", "whirlpool",
                           "lagoon", "rivers", "harbour_clip", "harbour", "still_life"}) {
    if (test::sanitized && std::string(name) != "open_sea" && std::string(name) != "lagoon") continue;
    const double least_m = least_clearance(name, 0.0);
    EXPECT_GT(least_m, 0.3) << name;
    RecordProperty(name, std::to_string(least_m));
  }
  EXPECT_LT(least_clearance("open_sea", 3.0), 0.0);
}

// Paths that ride a body are of a scene where something of that name floats. Control seen: another name.
TEST(Content, PathsRideWhatFloats) {
  for (const auto& [path_name, scene_name] :
       {std::pair{"regatta", "regatta"}, std::pair{"open_boat", "open_boat"},
        std::pair{"open_boat_engine", "open_boat"}, std::pair{"flotsam", "flotsam"},
        std::pair{"wake_tank", "wake_tank"}, std::pair{"waterline", "waterline"}}) {
    const CameraPath path = load_camera_path(path_name);
    const Scene scene = load_scene(scene_name, "low");
    EXPECT_FALSE(path.on.empty()) << path_name;
    EXPECT_TRUE(std::ranges::any_of(scene.objects.floating, [&](const FloatingThing& one) {
      return scene.objects.names[one.thing] == path.on;
    })) << path_name;
  }
}

// The scripts that play a person have no fault, find by their name, and do what they are named for. Controls: a yaw of
// 400 degrees, an unknown key; the teleport of teleport_and_turn taken out; the hands held over the pool.
TEST(Content, InputScriptsPlay) {
  std::size_t found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(content_directory() / "inputs")) {
    SCOPED_TRACE(entry.path().string());
    const InputScript script = load_input_script(entry.path().stem().string());
    ++found;
    const InputTimeline timeline(script);
    EXPECT_GT(timeline.end_s(), 4.0);
    EXPECT_LT(timeline.end_s() * script.rate_hz, 900.0);  // tried out within a minute or two without a GPU too
    EXPECT_GE(script.rate_hz, 72.0);
    std::set<Action> pressed;
    for (const ActionPress& press : timeline.presses(-1.0, timeline.end_s())) pressed.insert(press.action);
    int turned = 0, wet = 0;
    for (double t = 0.0; t <= timeline.end_s(); t += 0.1) {
      const auto head = timeline.pose(Tracker::head, t);
      ASSERT_TRUE(head.has_value());
      EXPECT_GT(head->position_m.y, 0.5);
      turned += std::abs(angles_from_orientation(head->orientation).yaw_deg) > 60.0;
      for (const Tracker hand : {Tracker::left, Tracker::right}) {
        const auto at = timeline.pose(hand, t);
        wet += at && at->position_m.y < 0.05;
      }
    }
    if (entry.path().stem() == "look_around") {
      EXPECT_GT(turned, 10);
    }
    if (entry.path().stem() == "hands_in_water") {
      EXPECT_GT(wet, 60);
      EXPECT_TRUE(pressed.contains(Action::grab_right));
    }
    if (entry.path().stem() == "teleport_and_turn") {
      EXPECT_TRUE(pressed.contains(Action::teleport) && pressed.contains(Action::snap_turn));
    }
    for (const ActionRow& row : action_rows())
      EXPECT_EQ(timeline.values(timeline.end_s())[std::size_t(row.action)], 0.0) << row.name;  // nothing stays held
  }
  EXPECT_GE(found, 3u);
}

// The harbour's dry dock is dry up to its walls: from the basin to the land behind it no water stands, nor from side to
// side. Control seen: a clip that ends 3 m before the back wall, where a strip of water lay on the dock's floor.
TEST(Content, TheDryDockIsDry) {
  const Scene scene = load_scene("harbour_clip", "low");
  const WaveField field(scene.settings.sea, WaveQuality{.resolution = 64, .cascades = 3});
  const PlaceSea places(place_inputs(scene), field);
  WaveTiles tiles;
  field.evaluate(0, tiles);
  std::vector<glm::dvec2> asked;
  for (double z = -362.0; z <= -271.0; z += 0.5)  // beside its mouth lies the basin
    for (double x = 20.0; x <= 60.0; x += 2.0) asked.emplace_back(x, z);
  std::vector<QueryAnswer> answers(asked.size());
  places.query(field, tiles, asked, answers);
  for (std::size_t i = 0; i < asked.size(); ++i)
    EXPECT_TRUE(answers[i].clipped || answers[i].depth_m <= 0.05) << asked[i].x << " " << asked[i].y;
}

// What is in the harbour stands where it should: boats hold no water, piers and lighthouse reach down to the bed, and
// cargo lies on the quay or on other cargo. Controls seen: a pier over a bed of 5 m; cargo 0.2 m higher; hulls left
// out.
TEST(Content, TheHarboursThingsStandWhereTheyShould) {
  const Scene scene = load_scene("harbour", "low");
  Sea sea(sea_spec(scene));
  std::vector<SeaView> views;  // a trough may leave a light boat's keel that does not move with it
  for (const double time_s : {20.0, 21.3, 22.6, 23.9, 25.2}) views.push_back(sea.view_at(time_s, SeaDetail::felt));
  std::set<std::size_t> floats;  // which keep their water out themselves
  for (const FloatingThing& one : scene.objects.floating) floats.insert(one.thing);
  EXPECT_EQ(floats.size(), 4u);
  int boats = 0, founded = 0, cargo = 0;
  for (std::size_t i = 0; i < scene.objects.things.size(); ++i) {
    if (floats.contains(i)) continue;
    const SolidThing& thing = scene.objects.things[i];
    const PlacedModel& model = scene.objects.models[thing.model];
    const std::string& name = scene.objects.names[i];
    const glm::dvec3 at = thing.pose.position_m;
    const QueryAnswer water = views.front().query({at.x, at.z});
    const auto is = [&](const char* called) { return name.starts_with(called); };
    if (!model.insides().empty() && at.y < 0.5) {
      EXPECT_TRUE(std::ranges::any_of(views, [&](const SeaView& view) {
        return view.query({at.x, at.z}).clipped;
      })) << name;
      ++boats;
    } else if (is("pier") || is("lighthouse")) {
      EXPECT_LE(water.depth_m, is("pier") ? 4.5 : 5.0) << name;
      EXPECT_GT(water.depth_m, -1.5) << name;
      ++founded;
    } else if (is("crate")) {
      const double foot = at.y - 0.14;
      EXPECT_LT(std::min(std::abs(foot + water.depth_m), std::abs(foot - 0.48 + water.depth_m)), 0.1) << name;
      ++cargo;
    }
  }
  EXPECT_GE(boats, 6);
  EXPECT_EQ(founded, 5);
  EXPECT_GE(cargo, 12);
}

}  // namespace
}  // namespace seascape
