// Where the surface is drawn: the positions that the drawing vertex shader puts out, against the wave field on the CPU
// and what belongs to places; with tiles that the GPU computed, and with tiles that were uploaded.
#include <cmath>
#include <cstring>
#include <random>

#include "app/camera_path.h"
#include "app/place_inputs.h"
#include "app/sea_remarks.h"
#include "app/tile_sources.h"
#include "ocean/mesh/patch_mesh.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/gpu/drawn_tiles.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/place_truth.h"
#include "tests/support/sampled.h"

namespace seascape {

namespace {

using test::pose;
using test::SeaShot;

class DrawnSurface : public test::GpuTest, public ::testing::WithParamInterface<WavePlace> {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  }
};

INSTANTIATE_TEST_SUITE_P(Places, DrawnSurface, ::testing::Values(WavePlace::gpu, WavePlace::cpu), test::place_name);

struct Errors {
  double worst_m = 0.0, hs_m = 0.0;
  int points = 0, resolved = 0;  // resolved: whose displacement passes the tolerance's own size
  std::string where;
};

// Draws `scene` and compares `count` random vertices; `late_s` shifts the field's time (a control).
Errors errors(WavePlace place, const std::string& scene, const std::string& preset,
              std::vector<std::pair<std::string, std::string>> set, const Pose& head, double time_s, int count,
              double late_s = 0.0) {
  set.emplace_back("waves.where", test::place_value(place));
  SeaShot shot({.scene = scene, .preset = preset, .width = 64, .height = 36, .probe = true, .set = std::move(set)});
  shot.draw(head, time_s);
  const Settings& settings = shot.scene().settings;
  const SurfaceSelection& selection = shot.experience().ocean().select(shot.viewpoint(head));
  const auto bytes = read_buffer(test::device(), shot.experience().surface().probed());
  const auto side = std::size_t(gpu::patch_quads + 1), vertices = side * side;
  Errors result;
  if (selection.patches.size() > Surface::probe_patches || selection.patches.empty()) {
    ADD_FAILURE() << selection.patches.size() << " patches for a probe of " << Surface::probe_patches;
    return result;
  }
  const LimitedSea limited = limited_sea(shot.scene());
  const WaveField field(limited.sea, settings.waves, tile_sources(shot.scene(), limited));
  WaveTiles tiles;
  field.evaluate(ticks_from_seconds(time_s + late_s), tiles);
  const PlaceInputs inputs = place_inputs(shot.scene());
  const test::PlaceTruth sea(inputs, field);
  const LodWindowSettings& windows = inputs.settings.windows;
  const LodPlacement seen =
      lod_placement(windows, {head.position_m.x, head.position_m.z}, lod_scale(windows, head.position_m.y));
  double variance = field.statistics().height_variance;
  for (const auto& source : field.others()) variance += source->statistics().height_variance;
  result.hs_m = 4.0 * std::sqrt(variance);
  const glm::dvec2 viewer(head.position_m.x - selection.grid_origin_m.x, head.position_m.z - selection.grid_origin_m.y);
  std::mt19937 random(7);
  for (int i = 0; i < count; ++i) {
    const std::size_t at = (random() % selection.patches.size()) * vertices + random() % vertices;
    glm::vec4 rest, drawn;
    std::memcpy(&rest, &bytes[at * 32], 16);
    std::memcpy(&drawn, &bytes[at * 32 + 16], 16);
    const glm::dvec3 want =
        sea.sea(field, tiles, selection.grid_origin_m + glm::dvec2(rest), double(rest.z), &seen).displacement;
    const glm::dvec2 from_viewer = glm::dvec2(rest) - viewer;
    const glm::dvec3 got(double(drawn.x) - from_viewer.x, drawn.z, double(drawn.y) - from_viewer.y);
    // What two roundings of a float come to beyond the patches, 2 mm at 20 km, is no error of the sea.
    const glm::dvec2 spacing = 0x1p-23 * glm::abs(from_viewer);
    const double error = glm::length(glm::max(glm::abs(got - want) - glm::dvec3(spacing.x, 0.0, spacing.y), 0.0));
    ++result.points;
    result.resolved += glm::length(want) > 0.05 * result.hs_m;
    if (error > result.worst_m || std::isnan(error)) {
      result.worst_m = std::isnan(error) ? 1e9 : error;
      result.where = scene + " " + preset + ": rest " + std::to_string(rest.x) + ", " + std::to_string(rest.y) +
                     " m, footprint " + std::to_string(rest.z) + " m, " + std::to_string(glm::length(from_viewer)) +
                     " m away";
    }
  }
  return result;
}

// A loop's fading is the picture's alone: queries have its waves at every distance, as the setting says. Nor do they
// know what is simulated.
const std::vector<std::pair<std::string, std::string>> unfaded{{"baked.fade_m", "0"},
                                                               {"dynamic_waves.rain_per_m2_s", "0"}};

const Pose near_water = pose({12.3, 2.0, -45.6}, 30.0, -12.0);

const std::vector<std::string> scenes{"open_sea", "calm",      "storm",  "swell",  "rain_pool",    "gerstner",
                                      "baked",    "whirlpool", "lagoon", "rivers", "harbour_clip", "harbour"};
// With SEASCAPE_LONG=1 all scenes in both places of the waves, else each in one of them.
std::vector<std::string> scenes_in(WavePlace place) {
  std::vector<std::string> chosen;
  for (std::size_t n = 0; n < scenes.size(); ++n)
    if (test::sampled(n + std::size_t(place == WavePlace::gpu), 2)) chosen.push_back(scenes[n]);
  return chosen;
}
// What there is of places is where a scene's own path goes.
Pose head_of(const std::string& scene) {
  if (scene == "lagoon")
    return load_camera_path(scene).at(13.0).pose;  // before the beach, where waves run along a curve
  return scene == "whirlpool" || scene == "rivers" || scene == "harbour_clip" ? load_camera_path(scene).at(2.0).pose
                                                                              : near_water;
}

// A thousand points a scene where the tiles are 32-bit floats: within 1/1000 of the significant height, and 5 mm.
// Control seen: a laying of wave particles displaced as if it were the whole tile (40 times the bar); shifts of the bed
// that went over into the ground pattern's origin at the edge of all windows (16 times, 2 km away).
TEST_P(DrawnSurface, StandsWhereTheWaveFieldSays) {
  for (const std::string preset : {"high", "ultra"})
    for (const std::string& scene : scenes_in(GetParam())) {
      if (preset == "ultra" && !test::long_run()) continue;
      const Errors e = errors(GetParam(), scene, preset, unfaded, head_of(scene), 33.3, 1000);
      EXPECT_EQ(e.points, 1000);
      EXPECT_GT(e.resolved, scene == "rain_pool" ? 50 : 300) << "too few of the points are moved by waves";
      EXPECT_LE(e.worst_m, 1e-3 * e.hs_m) << e.where;
      EXPECT_LE(e.worst_m, 5e-3) << e.where;
      RecordProperty(preset + "_" + scene, std::to_string(e.worst_m) + " m of Hs " + std::to_string(e.hs_m));
    }
}

// The presets of standalone headsets keep their tiles in half floats, each of which is off by up to 1/2048 of a crest,
// in five numbers added: within 1/200 of the significant height. DrawnQuery has them with 32-bit tiles.
TEST_P(DrawnSurface, StandsThereInHalfFloatsTooWithinTheirOwnError) {
  for (const char* preset : {"low", "medium"})
    for (const std::string& scene : scenes_in(GetParam())) {
      const Errors half = errors(GetParam(), scene, preset, unfaded, head_of(scene), 33.3, 1000);
      EXPECT_LE(half.worst_m, 5e-3 * half.hs_m) << half.where;
    }
}

// A light sea, whose longest tile is warped, at the world's origin and a thousand kilometres out, and in a current
// and over a bed. Controls seen: the warp's phases taken at the world's origin and not the grid's; the warp left out of
// the shaders (0.1 to 1 m).
TEST_P(DrawnSurface, StandsThereInLightSeas) {
  for (const char* wind : {"3", "7"}) {
    const std::vector<std::pair<std::string, std::string>> set{{"waves.wind_speed_mps", wind},
                                                               {"waves.swell_height_m", "0"}};
    for (const Pose& head : {near_water, pose({1e6 + 0.37, 2.0, -1e6 - 0.81}, 200.0, -10.0)}) {
      const Errors e = errors(GetParam(), "open_sea", "high", set, head, 33.3, 500);
      EXPECT_GT(e.resolved, 100);
      EXPECT_LE(e.worst_m, std::min(1e-3 * e.hs_m, 5e-3)) << wind << ' ' << e.where;
      RecordProperty(std::string(wind) + (head.position_m.x > 1e5 ? "_far" : "_near"), std::to_string(e.worst_m));
    }
  }
  for (const char* scene : {"rivers", "whirlpool", "harbour_clip"}) {
    const Errors e = errors(GetParam(), scene, "high", unfaded, head_of(scene), 33.3, 500);
    EXPECT_LE(e.worst_m, std::min(1e-3 * e.hs_m, 5e-3)) << e.where;
  }
}

// The control: a field that is a twentieth of a second late does not agree.
TEST_P(DrawnSurface, AFieldAtAnotherTimeDoesNotAgree) {
  const Errors e = errors(GetParam(), "open_sea", "high", {}, near_water, 33.3, 1000, 0.05);
  EXPECT_GT(e.worst_m, 1e-3 * e.hs_m);
  EXPECT_GT(e.worst_m, 5e-3);
}

// A thousand kilometres from the world's origin, from high above, and late in a long run: as exact.
TEST_P(DrawnSurface, StandsThereFarFromTheOriginAndLate) {
  const Errors far =
      errors(GetParam(), "open_sea", "high", {}, pose({1e6 + 0.37, 2.0, -1e6 - 0.81}, 200.0, -10.0), 33.3, 500);
  EXPECT_LE(far.worst_m, std::min(1e-3 * far.hs_m, 5e-3)) << far.where;
  const Errors late = errors(GetParam(), "storm", "high", {}, pose({-700.0, 60.0, 300.0}, 100.0, -30.0), 1e7, 500);
  EXPECT_LE(late.worst_m, std::min(1e-3 * late.hs_m, 5e-3)) << late.where;
}

}  // namespace

}  // namespace seascape
