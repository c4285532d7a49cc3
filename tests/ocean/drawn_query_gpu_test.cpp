// The drawn surface against the answers of the one sea: each vertex stands at the height that a query of the `drawn`
// detail says for its place, with levels, beds, currents, dynamic waves and clip in both.
#include <cmath>
#include <cstring>
#include <random>

#include "app/camera_path.h"
#include "ocean/mesh/patch_mesh.h"
#include "tests/support/gpu/drawn_tiles.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using Set = std::vector<std::pair<std::string, std::string>>;

class DrawnQuery : public test::GpuTest, public ::testing::WithParamInterface<WavePlace> {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  }
};

INSTANTIATE_TEST_SUITE_P(Places, DrawnQuery, ::testing::Values(WavePlace::gpu, WavePlace::cpu), test::place_name);

struct Misses {
  double worst_m = 0.0, hs_m = 0.0;
  int points = 0, unconverged = 0;
  std::string where;
};

// Compares `count` random vertices of a shot's last frame, drawn for `head` at `time_s`, with queries of `late_s`
// later, without dynamic waves where there is no `history`, and in the finest texels where not `as_seen` (controls).
// Vertices whose query did not converge are counted and left out.
struct Asked {
  double late_s = 0.0;
  bool history = true, as_seen = true;
};
Misses misses(SeaShot& shot, const Pose& head, double time_s, int count, const Asked& asked = {}) {
  Experience& experience = shot.experience();
  const SurfaceSelection& selection = *experience.ocean().selection();
  const auto bytes = read_buffer(test::device(), experience.surface().probed());
  const auto side = std::size_t(gpu::patch_quads + 1), vertices = side * side;
  Misses result;
  if (selection.patches.size() > Surface::probe_patches || selection.patches.empty()) {
    ADD_FAILURE() << selection.patches.size() << " patches for a probe of " << Surface::probe_patches;
    return result;
  }
  Sea& sea = *experience.sea();
  double variance = sea.statistics().height_variance;
  for (const auto& source : sea.spec().sources) variance += source->statistics().height_variance;
  result.hs_m = 4.0 * std::sqrt(variance);
  const SeaView view = sea.view_at(time_s + asked.late_s, SeaDetail::drawn);
  const glm::dvec2 head_m(head.position_m.x, head.position_m.z);
  const LodWindowSettings& windows = sea.spec().place.settings.windows;
  const LodPlacement seen = lod_placement(windows, head_m, lod_scale(windows, head.position_m.y));
  std::mt19937 random(7);
  for (int i = 0; i < count; ++i) {
    const std::size_t at = (random() % selection.patches.size()) * vertices + random() % vertices;
    glm::vec4 rest, drawn;
    std::memcpy(&rest, &bytes[at * 32], 16);
    std::memcpy(&drawn, &bytes[at * 32 + 16], 16);
    const glm::dvec2 place = head_m + glm::dvec2(drawn.x, drawn.y);
    const QueryAnswer answer = view.query(place, {.footprint_m = double(rest.z),
                                                  .most_iterations = 60,
                                                  .tolerance_m = 1e-5,
                                                  .history = asked.history,
                                                  .seen = asked.as_seen ? &seen : nullptr});
    ++result.points;
    if (!answer.converged || answer.contraction > 0.9) {
      ++result.unconverged;
      continue;
    }
    const double error = std::abs(answer.height_m - double(drawn.z));
    if (!(error <= result.worst_m)) {
      result.worst_m = std::isnan(error) ? 1e9 : error;
      result.where = shot.scene().name + ": " + std::to_string(place.x) + ", " + std::to_string(place.y) +
                     " m, footprint " + std::to_string(rest.z) + " m, " + std::to_string(glm::length(place - head_m)) +
                     " m away";
    }
  }
  return result;
}

const Pose near_water = pose({12.3, 2.0, -45.6}, 30.0, -12.0);
Pose head_of(const std::string& scene) {
  if (scene == "rain_pool") return pose({0.3, 1.7, -0.6}, 10.0, -20.0);
  if (scene == "lagoon") return load_camera_path(scene).at(13.0).pose;
  return scene == "whirlpool" || scene == "rivers" || scene == "harbour_clip" ? load_camera_path(scene).at(2.0).pose
                                                                              : near_water;
}

const std::vector<std::string> scenes{"open_sea", "calm",      "storm",  "swell",  "rain_pool",    "gerstner",
                                      "baked",    "whirlpool", "lagoon", "rivers", "harbour_clip", "harbour"};

double bar_m(const Misses& m) { return std::min(1e-3 * m.hs_m, 5e-3); }

// Draws some frames, so that the mesh has followed the waves, up to `time_s`. A loop's fading is the picture's alone.
SeaShot shot_of(const std::string& scene, const std::string& preset, WavePlace where, const Pose& head, double time_s,
                Set set = {}) {
  set.insert(set.end(), {{"waves.where", test::place_value(where)}, {"baked.fade_m", "0"}});
  SeaShot shot({.scene = scene, .preset = preset, .width = 64, .height = 36, .probe = true, .set = std::move(set)});
  for (int i = 2; i >= 0; --i) shot.draw(head, time_s - i / 72.0);
  return shot;
}

// Every scene at every preset, places as the picture's windows have them: within a thousandth of the significant wave
// height and 5 mm where tiles are 32-bit floats. Controls within: a twentieth of a second late; dynamic waves left out;
// texels of places as if there were no viewer. Control seen: land that does not give way to the open sea at the edge of
// all windows (rivers, lagoon, harbour_clip).
TEST_P(DrawnQuery, AnswersAreWhereTheSurfaceIsDrawn) {
  constexpr double time_s = 33.3;
  std::size_t number = 0;
  for (const std::string preset : {"low", "medium", "high", "ultra"})
    for (const std::string& scene : scenes) {
      const std::size_t here = number++;
      if (preset == "high") {
        if (!test::sampled(here + std::size_t(GetParam() == WavePlace::gpu), 2)) continue;  // the others there
      } else if (!test::sampled(here, 9) || (GetParam() == WavePlace::gpu && !test::long_run())) {
        continue;
      }
      const Pose head = head_of(scene);
      SeaShot shot = shot_of(scene, preset, GetParam(), head, time_s, {{"waves.half_storage", "false"}});
      const Misses m = misses(shot, head, time_s, 1000);
      EXPECT_EQ(m.points, 1000);
      EXPECT_LE(m.unconverged, 20);
      EXPECT_LE(m.worst_m, bar_m(m)) << preset << ", " << m.where;
      RecordProperty(preset + "_" + scene, std::to_string(m.worst_m) + " m of Hs " + std::to_string(m.hs_m));
      if (preset != "high") continue;
      EXPECT_GT(misses(shot, head, time_s, 300, {.late_s = 0.05}).worst_m, bar_m(m)) << scene;
      if (scene == "rain_pool") {
        EXPECT_GT(misses(shot, head, time_s, 1000, {.history = false}).worst_m, bar_m(m));
      }
      if (scene == "rivers" || scene == "harbour_clip") {
        EXPECT_GT(misses(shot, head, time_s, 1000, {.as_seen = false}).worst_m, bar_m(m)) << scene;
      }
    }
}

// Goes by the viewer and presses the water.
class Presser : public SeaActor {
 public:
  void step(SeaStep& step) override {
    at_m_ += step.dt_s * glm::dvec2(speed_mps, 0.0);
    step.press({.place_m = at_m_, .velocity_mps = {speed_mps, 0.0}, .length_m = 3.0, .head_m = 0.25});
  }
  static constexpr double speed_mps = 4.0;
  glm::dvec2 at_m_{-11.5, -48.0};
};

// A pressed and rained-on sea, while the press goes over the border between two windows of dynamic waves, and on.
// Control within: dynamic waves left out. Control seen: the press laid half a texel off in the picture's windows.
TEST_P(DrawnQuery, APressedAndRainedOnSeaIsTheDrawnOne) {
  const Pose head = pose({12.3, 2.5, -45.6}, -80.0, -15.0);
  SeaShot shot({.scene = "open_sea",
                .preset = "high",
                .width = 64,
                .height = 36,
                .probe = true,
                .set = {{"waves.where", test::place_value(GetParam())},
                        {"dynamic_waves.resolution", "128"},
                        {"dynamic_waves.levels", "4"},
                        {"dynamic_waves.rain_per_m2_s", "0.02"},
                        {"dynamic_waves.drop_length_m", "1.5"},
                        {"dynamic_waves.drop_height_m", "0.2"},
                        {"dynamic_waves.settle_s", "1"}},
                .effects = std::vector<std::string>{"waves", "dynamic_waves"}});
  const auto presser = std::make_shared<Presser>();
  shot.experience().sea()->add(presser);
  double without_m = 0.0;
  for (int frame = 0; frame <= 12 * 36; ++frame) {
    const double time_s = 3.0 + frame / 36.0;
    if (frame % 54 > 51 || frame % 54 == 0) shot.draw(head, time_s);
    if (frame == 0 || frame % 54 != 0) continue;
    const Misses m = misses(shot, head, time_s, 1000);
    EXPECT_LE(m.unconverged, 20);
    EXPECT_LE(m.worst_m, bar_m(m)) << presser->at_m_.x << " m: " << m.where;
    without_m = std::max(without_m, misses(shot, head, time_s, 1000, {.history = false}).worst_m);
  }
  EXPECT_GT(presser->at_m_.x, 30.0);
  EXPECT_GT(without_m, 0.05);
}

}  // namespace
}  // namespace seascape
