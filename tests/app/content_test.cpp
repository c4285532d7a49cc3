// The shipped paths fly over the shipped seas, never through them.
#include <gtest/gtest.h>

#include "app/camera_path.h"
#include "app/place_inputs.h"
#include "app/scene.h"
#include "app/sea_remarks.h"
#include "app/tile_sources.h"
#include "ocean/sea/query.h"
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
                           "lagoon", "rivers", "harbour_clip"}) {
    if (test::sanitized && std::string(name) != "open_sea" && std::string(name) != "lagoon") continue;
    const double least_m = least_clearance(name, 0.0);
    EXPECT_GT(least_m, 0.3) << name;
    RecordProperty(name, std::to_string(least_m));
  }
  EXPECT_LT(least_clearance("open_sea", 3.0), 0.0);
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

}  // namespace
}  // namespace seascape
