// No hole in the sea: from every place, beneath the horizon, there is water in every pixel.
#include <algorithm>

#include "ocean/sea/query.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

namespace {

using test::pose;
using test::SeaShot;

class Holes : public test::GpuTest {};
const test::DrawsMuch draws_much("Holes");

// Places and directions of sight: from 0.2 m (over the water there) to 20 km up, level, grazing, straight down, rolled,
// and far from the origin.
std::vector<Pose> poses() {
  std::vector<Pose> list;
  int i = 0;
  for (const double height : {0.2, 1.0, 3.0, 12.0, 60.0, 400.0, 3000.0, 20000.0}) {
    const double along = 37.3 * i;
    list.push_back(pose({along, height, -0.7 * along}, 47.0 * i, -2.0));
    list.push_back(pose({-along, height, 11.0 * along}, 47.0 * i + 90.0, -35.0, 25.0 * i));
    list.push_back(pose({3.0 * along, height, along}, 47.0 * i + 180.0, -90.0, 10.0));
    list.push_back(pose({1e5 + along, height, -1e6}, 47.0 * i + 270.0, 8.0, -80.0));
    ++i;
  }
  for (int turn = 0; turn < 8; ++turn)
    list.push_back(pose({0.5 * turn, 1.7, 0.3}, 45.0 * turn, 0.0, turn % 2 ? 180.0 : 0.0));
  return list;
}

// Magenta is the one colour that debug.view=holes paints, where beneath the lowest line of water no patch was drawn.
int magenta(const Image8& picture) { return test::count_colour(picture, 255, 0, 255); }

// The pose raised by the crest of the water beneath and about it: an eye under water looks at the sky from below.
Pose above_water(Pose p, const WaveField& field, WaveTiles& tiles, double time_s) {
  field.evaluate(ticks_from_seconds(time_s), tiles);
  std::vector<glm::dvec2> places;
  for (int z = -8; z <= 8; ++z)
    for (int x = -8; x <= 8; ++x) places.push_back({p.position_m.x + 0.25 * x, p.position_m.z + 0.25 * z});
  std::vector<QueryAnswer> answers(places.size());
  query(field, tiles, places, answers);
  double crest = 0.0;
  for (const QueryAnswer& answer : answers) crest = std::max(crest, answer.height_m);
  p.position_m.y += crest;
  return p;
}

void expect_no_holes(const std::string& scene, const std::string& preset, const std::string& join = "masked") {
  SeaShot shot({.scene = scene,
                .preset = preset,
                .width = 160,
                .height = 120,
                .set = {{"debug.view", "holes"},
                        {"waves.resolution", "64"},
                        {"camera.vertical_fov_deg", "80"},
                        {"lod.join", join}}});
  const WaveField field(shot.scene().settings.sea, shot.scene().settings.waves);
  WaveTiles tiles;
  int number = 0;
  for (const Pose& p : poses()) {
    const double time_s = 5.0 + 3.7 * number;
    const Image8 picture = shot.picture(above_water(p, field, tiles, time_s), time_s);
    const int holes = magenta(picture);
    EXPECT_EQ(holes, 0) << scene << " " << preset << ", pose " << number << ": "
                        << test::leave(picture,
                                       "holes_" + scene + "_" + preset + "_" + join + "_" + std::to_string(number));
    ++number;
  }
}

// Controls: APatchLeftOutIsSeen; and culling by a hundredth of the sea's displacement fails in the storm and the open
// sea.
TEST_F(Holes, NoneInCalmWater) { expect_no_holes("calm", "low"); }
TEST_F(Holes, NoneInAStorm) { expect_no_holes("storm", "low"); }
TEST_F(Holes, NoneInTheDesktopFrame) { expect_no_holes("open_sea", "high"); }
TEST_F(Holes, NoneWhereVerticesSlide) {
  expect_no_holes("storm", "low", "morphed");
  expect_no_holes("open_sea", "high", "morphed");
}

// The control: a patch left out is a hole that is seen, in both shapes of the frame.
TEST_F(Holes, APatchLeftOutIsSeen) {
  for (const char* preset : {"low", "high"}) {
    SeaShot shot({.scene = "open_sea",
                  .preset = preset,
                  .width = 160,
                  .height = 120,
                  .set = {{"debug.view", "holes"}, {"waves.resolution", "64"}, {"debug.drop_patch", "0"}}});
    const Pose down = pose({5.0, 10.0, 5.0}, 0.0, -60.0);
    EXPECT_GT(magenta(shot.picture(down, 5.0)), 100) << preset;
    shot.set("debug.drop_patch", "-1");
    EXPECT_EQ(magenta(shot.picture(down, 5.0)), 0) << preset;
  }
}

}  // namespace

}  // namespace seascape
