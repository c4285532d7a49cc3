// What belongs to places as it is drawn: levels and currents against the processor's sea, and clipping where the
// inputs lie.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <tuple>

#include "app/place_inputs.h"
#include "app/sea_remarks.h"
#include "app/tile_sources.h"
#include "ocean/mesh/patch_mesh.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/gpu/drawn_mesh.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/place_truth.h"
#include "tests/support/wigley.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using Set = std::vector<std::pair<std::string, std::string>>;

InputSpec area(InputTarget to, glm::vec4 value, glm::dvec2 at, glm::dvec2 size, double feather) {
  InputSpec spec;
  spec.to = to;
  spec.value = value;
  spec.feather_m = feather;
  spec.shape = AreaInput{.round = true, .at_m = at, .size_m = size};
  return spec;
}

std::vector<InputSpec> lake_and_whirlpool() {
  std::vector<InputSpec> inputs{area(InputTarget::level, {4.0f, 0.0f, 0.0f, 0.0f}, {10.0, -60.0}, {60.0, 50.0}, 24.0)};
  InputSpec& whirlpool = inputs.emplace_back();
  whirlpool.to = InputTarget::flow;
  whirlpool.feather_m = 20.0;
  whirlpool.shape = VortexInput{.at_m = {16.0, -52.0}, .core_m = 8.0, .reach_m = 40.0, .swirl_mps = 3.0};
  return inputs;
}

// A bank with an island on it, in a sea of 40 m.
std::vector<InputSpec> bank_and_island() {
  std::vector<InputSpec> inputs;
  for (const auto& [height, size, feather] : {std::tuple{-1.5f, 120.0, 50.0}, std::tuple{3.0f, 36.0, 16.0}}) {
    inputs.push_back(area(InputTarget::sea_depth, {height, 0.0f, 0.0f, 0.0f}, {14.0, -50.0}, {size, size}, feather));
    inputs.back().blend = InputBlend::replace;
  }
  return inputs;
}

class DrawnPlaces : public test::GpuTest {};

struct Worst {
  double error_m = 0.0, hs_m = 0.0;
  int moved = 0;  // points that the effects have moved by more than the tolerance
};

// As of the waves alone (surface_gpu_test.cpp).
double bar(const Worst& worst) { return std::min(1e-3 * worst.hs_m, 5e-3); }

// A thousand vertices near the viewer against PlaceSea.
Worst worst(const std::vector<std::string>& effects, Set set, double time_s,
            const std::vector<InputSpec>& inputs = lake_and_whirlpool()) {
  const Pose head = pose({12.3, 6.0, -45.6}, 30.0, -30.0);
  set.emplace_back("waves.where", "cpu");
  SeaShot shot({.scene = "open_sea",
                .preset = "high",
                .width = 64,
                .height = 36,
                .probe = true,
                .set = set,
                .effects = effects,
                .inputs = inputs});
  for (int i = 0; i < 2; ++i) shot.draw(head, time_s);
  const SurfaceSelection& selection = *shot.experience().ocean().selection();
  const auto bytes = read_buffer(test::device(), shot.experience().surface().probed());
  const auto side = std::size_t(gpu::patch_quads + 1), vertices = side * side;
  const Settings& settings = shot.scene().settings;
  const LimitedSea limited = limited_sea(shot.scene());
  const WaveField field(limited.sea, settings.waves, tile_sources(shot.scene(), limited));
  WaveTiles tiles;
  field.evaluate(ticks_from_seconds(time_s), tiles);
  const PlaceInputs places = place_inputs(shot.scene());
  const test::PlaceTruth place(places, field);
  const LodWindowSettings& windows = places.settings.windows;
  const LodPlacement seen =
      lod_placement(windows, {head.position_m.x, head.position_m.z}, lod_scale(windows, head.position_m.y));
  const glm::dvec2 viewer(head.position_m.x - selection.grid_origin_m.x, head.position_m.z - selection.grid_origin_m.y);
  Worst result;
  double variance = field.statistics().height_variance;
  for (const auto& source : field.others()) variance += source->statistics().height_variance;
  result.hs_m = 4.0 * std::sqrt(variance);
  std::mt19937 random(7);
  for (int i = 0, points = 0; i < 400000 && points < 1000; ++i) {
    const std::size_t at = (random() % selection.patches.size()) * vertices + random() % vertices;
    glm::vec4 rest, drawn;
    std::memcpy(&rest, &bytes[at * 32], 16);
    std::memcpy(&drawn, &bytes[at * 32 + 16], 16);
    const glm::dvec2 from_viewer = glm::dvec2(rest) - viewer;
    if (glm::length(from_viewer) > 100.0) continue;  // three windows
    ++points;
    const glm::dvec2 world = selection.grid_origin_m + glm::dvec2(rest);
    const glm::dvec3 want = place.sea(field, tiles, world, double(rest.z), &seen).displacement;
    const glm::dvec3 got(double(drawn.x) - from_viewer.x, drawn.z, double(drawn.y) - from_viewer.y);
    result.error_m = std::max(result.error_m, glm::length(got - want));
    result.moved += glm::length(field.sea(tiles, world, double(rest.z)).displacement - want) > 0.01 * result.hs_m;
  }
  return result;
}

// A lake higher than the sea, its shore a slope of 24 m; and a whirlpool of 3 m/s that carries the waves round.
// Controls seen: the level read half a texel off; the flow's x and z changed about; one pattern alone; the patterns'
// sum left at its height; the inputs themselves instead of what lies between texels (1 cm).
TEST_F(DrawnPlaces, StandWhereTheProcessorSays) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  const Worst level = worst({"waves", "level"}, {}, 33.3);
  EXPECT_GT(level.moved, 300);
  EXPECT_LE(level.error_m, bar(level)) << level.hs_m;
  for (const double time : {33.3, 34.1, 34.9}) {
    const Worst flow = worst({"waves", "flow"}, {}, time);
    EXPECT_GT(flow.moved, 30);
    EXPECT_LE(flow.error_m, bar(flow)) << time;
  }
}

// Waves over a bank and the land on it, with a bed that falls by a metre in nine, and a dry one by one in one. Controls
// seen: the second layer of a slice read as the first; a shift along the wrong axis; no land; no run-up.
TEST_F(DrawnPlaces, WavesOverABedAreTheProcessors) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  for (const char* depth : {"40", "6"}) {
    const Worst bed = worst({"waves", "sea_depth"}, {{"waves.depth_m", depth}}, 33.3, bank_and_island());
    EXPECT_GT(bed.moved, 300);
    EXPECT_LE(bed.error_m, bar(bed)) << bed.hs_m << ' ' << depth;
  }
  // In a lake that stands higher its banks lie deeper.
  std::vector<InputSpec> lake = bank_and_island();
  lake.push_back(area(InputTarget::level, {1.0f, 0.0f, 0.0f, 0.0f}, {14.0, -50.0}, {400.0, 400.0}, 50.0));
  const Worst dry = worst({"waves", "sea_depth", "clip"}, {{"waves.depth_m", "40"}}, 33.3, [] {
    std::vector<InputSpec> dock = bank_and_island();
    dock.push_back(area(InputTarget::clip, {1.0f, 0.0f, 0.0f, 0.0f}, {14.0, -50.0}, {400.0, 400.0}, 0.0));
    return dock;
  }());
  EXPECT_LE(dry.error_m, bar(dry)) << "where it is clipped the bed lies dry, whose flank falls by one in one";
  const Worst both = worst({"waves", "sea_depth", "level"}, {{"waves.depth_m", "40"}}, 33.3, lake);
  EXPECT_LE(both.error_m, bar(both)) << both.hs_m;
}

// Without inputs the bed lies at waves.depth_m: breakers over a metre of water, and land. Control seen: a bed that is
// left out where nothing gives one.
TEST_F(DrawnPlaces, ABedWithoutInputsIsTheProcessors) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  const Worst bed = worst({"waves", "sea_depth"}, {{"waves.depth_m", "1"}}, 33.3, {});
  EXPECT_GT(bed.moved, 300);
  EXPECT_LE(bed.error_m, bar(bed)) << bed.hs_m;
  const Worst land = worst({"waves", "sea_depth"}, {{"waves.depth_m", "-2"}}, 33.3, {});
  EXPECT_EQ(land.moved, 1000);
  EXPECT_LE(land.error_m, 1e-5);
}

// Gerstner waves along a bay. Controls seen: right taken for left; the pattern laid backwards along the curve.
TEST_F(DrawnPlaces, WavesAlongACurveAreTheProcessors) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  InputSpec bay;
  bay.to = InputTarget::gerstner;
  bay.value = glm::vec4(1.0f, 0.0f, 0.0f, 0.0f);
  bay.feather_m = 12.0;
  SplineInput spline;
  for (const glm::dvec2 at : {glm::dvec2(-90, -20), glm::dvec2(-40, -24), glm::dvec2(0, -44), glm::dvec2(40, -62),
                              glm::dvec2(80, -40), glm::dvec2(120, -10)})
    spline.points.push_back({at, 70.0, bay.value});
  bay.shape = spline;
  const Set set{{"gerstner.set1_shore", "true"}, {"gerstner.set1_height_m", "1"}, {"gerstner.set1_wavelength_m", "22"},
                {"gerstner.set1_octaves", "2"},  {"gerstner.set1_waves", "6"},    {"gerstner.set1_spread_deg", "40"},
                {"gerstner.chop", "0.7"}};
  for (const double time : {33.3, 61.7}) {
    const Worst alone = worst({"waves", "gerstner"}, set, time, {bay});
    EXPECT_GT(alone.moved, 300);
    EXPECT_LE(alone.error_m, bar(alone)) << alone.hs_m << ' ' << time;
  }
  // Beside the set everywhere, over a bank and in a current.
  Set both = set;
  both.insert(both.end(), {{"gerstner.set2_height_m", "0.5"},
                           {"gerstner.set2_to_deg", "120"},
                           {"waves.depth_m", "40"},
                           {"flow.speed_mps", "0.7"}});
  std::vector<InputSpec> inputs = bank_and_island();
  inputs.push_back(bay);
  const Worst all = worst({"waves", "gerstner", "sea_depth", "flow"}, both, 33.3, inputs);
  EXPECT_GT(all.moved, 300);
  EXPECT_LE(all.error_m, bar(all)) << all.hs_m;
}

// Pixels whose water stands where it is clipped show the sky that is beneath them, and no others do; in both frame
// shapes. Control seen: clipped by the rest position (waves of the storm stand metres beside it).
TEST_F(DrawnPlaces, ClipWhatStandsWithinTheInput) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  constexpr int width = 160, height = 120;
  const std::vector<InputSpec> inputs{
      area(InputTarget::clip, {1.0f, 0.0f, 0.0f, 0.0f}, {3.0, -5.0}, {24.0, 18.0}, 0.0)};
  for (const char* msaa : {"1", "4"}) {
    const Set set{{"msaa", msaa}, {"debug.view", "holes"}};
    const auto shot_of = [&](std::vector<std::string> effects) {
      return SeaShot({.scene = "storm",
                      .preset = "high",
                      .width = width,
                      .height = height,
                      .probe = true,
                      .set = set,
                      .effects = std::move(effects),
                      .inputs = inputs});
    };
    SeaShot with = shot_of({"waves", "clip"}), without = shot_of({"waves"});
    const Viewpoint view = with.viewpoint(pose({3.0, 25.0, 5.0}, 0.0, -70.0));
    const Image8 clipped = with.picture(view, 4.0);
    without.draw(view, 4.0);
    const auto shown = test::DrawnMesh(without, view).shown(width, height);
    const WaveField field(with.scene().settings.sea, WaveQuality{.resolution = 16, .cascades = 1});
    const test::PlaceTruth place(place_inputs(with.scene()), field);
    int wrong = 0, holes = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      if (!shown[i].any) continue;
      const glm::dvec3 light = test::light_at(clipped, i);
      const bool want = place.clipped(shown[i].point.at, 4.0);
      holes += want;
      wrong += want ? light.x - light.y < 0.3 : light.x - light.y > 0.7;  // holes are magenta, edges by their samples
    }
    EXPECT_GT(holes, 1000) << test::leave(clipped, "clipped");
    EXPECT_LE(wrong, 250) << "along the edge, a texel wide; msaa " << msaa;
  }
}

// A boat, a ball, a heeled drum and a box in a storm, some of them lifted out of it or under it: pixels whose water
// stands within one of them show the sky beneath, by its height too, and no others; in both frame shapes. What is drawn
// and what a query says differ along the edges alone, by parts of a pixel: in two thousandths of them at most (seen 29
// of 19,200). Controls seen: heights left out (257 wrong); a volume's own axes taken for the world's (998); hulls' maps
// read two texels off (71); a tree that forgets halves (965).
TEST_F(DrawnPlaces, VolumesClipWhatStandsWithinThem) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  constexpr int width = 160, height = 120;
  using Form = VolumeInput::Form;
  std::vector<InputSpec> inputs;
  const auto add = [&](auto shape) {
    InputSpec& spec = inputs.emplace_back();
    spec.to = InputTarget::clip;
    spec.blend = InputBlend::replace;
    spec.value.x = 1.0f;
    spec.shape = shape;
  };
  ShapeInput boat;
  boat.model = test::wigley_model({}), boat.from = ShapeInput::From::hull, boat.at_m = {3.0, -9.0},
  boat.turn_deg = 70.0, boat.roll_deg = 20.0, boat.scale = 1.5;
  add(boat);
  add(VolumeInput{.form = Form::sphere, .at_m = {-7.0, 0.5, -3.0}, .radius_m = 3.5});
  add(VolumeInput{.form = Form::cylinder,
                  .at_m = {9.0, -0.5, 1.0},
                  .radius_m = 3.0,
                  .length_m = 3.0,
                  .turn_deg = 30.0,
                  .roll_deg = 40.0});
  add(VolumeInput{
      .form = Form::box, .at_m = {2.0, 0.0, 0.0}, .size_m = {6.0, 1.6, 4.0}, .turn_deg = 20.0, .pitch_deg = 15.0});
  add(VolumeInput{.form = Form::capsule,
                  .at_m = {-4.0, 1.0, -14.0},
                  .radius_m = 1.5,
                  .length_m = 9.0,
                  .turn_deg = 50.0,
                  .pitch_deg = 80.0});
  add(VolumeInput{.form = Form::box, .at_m = {-6.0, 30.0, 2.0}, .size_m = {20.0, 6.0, 20.0}});
  inputs.push_back(area(InputTarget::clip, {1.0f, 0.0f, 0.0f, 0.0f}, {-14.0, -10.0}, {6.0, 6.0}, 0.0));
  for (const char* msaa : {"1", "4"}) {
    const auto shot_of = [&](std::vector<std::string> effects) {
      return SeaShot({.scene = "storm",
                      .preset = "high",
                      .width = width,
                      .height = height,
                      .probe = true,
                      .set = {{"msaa", msaa}, {"debug.view", "holes"}},
                      .effects = std::move(effects),
                      .inputs = inputs});
    };
    SeaShot with = shot_of({"waves", "clip"}), without = shot_of({"waves"});
    const Viewpoint view = with.viewpoint(pose({0.0, 25.0, 5.0}, 0.0, -65.0));
    const Image8 clipped = with.picture(view, 4.0);
    without.draw(view, 4.0);
    const auto shown = test::DrawnMesh(without, view).shown(width, height);
    const WaveField field(with.scene().settings.sea, WaveQuality{.resolution = 16, .cascades = 1});
    const test::PlaceTruth place(place_inputs(with.scene()), field);
    int wrong = 0, holes = 0, by_height = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const glm::dvec3 at = shown[i].point.at;
      if (!shown[i].any || glm::length(glm::dvec2(at.x, at.z) - glm::dvec2(-14.0, -10.0)) < 4.0) continue;
      const glm::dvec3 light = test::light_at(clipped, i);
      const bool want = place.clipped(at, 4.0);
      holes += want;
      by_height += want != place.clipped({at.x, 0.0, at.z}, 4.0);
      wrong += want ? light.x - light.y < 0.3 : light.x - light.y > 0.7;  // holes are magenta, edges by their samples
    }
    EXPECT_GT(holes, 1000) << test::leave(clipped, "volumes");
    EXPECT_GT(by_height, 200);
    EXPECT_LE(wrong, 40) << "of " << shown.size() << "; msaa " << msaa << ' ' << test::leave(clipped, "volumes");
  }
}

// With four samples a pixel the edges of what is clipped are four samples fine: a pixel's share of hole is that of
// sixteen pixels in its place, to a tenth (a fifth with one sample). Control seen: a pixel's samples left out together.
TEST_F(DrawnPlaces, EdgesOfWhatIsClippedAreAsFineAsSamples) {
  if (!test::device().facts().sample_shading)
    GTEST_SKIP() << "this device's pixels cannot ask for what lies at their samples";
  constexpr int width = 96, height = 72, finer = 4;
  InputSpec box;
  box.to = InputTarget::clip;
  box.blend = InputBlend::replace;
  box.value.x = 1.0f;
  box.shape = VolumeInput{
      .form = VolumeInput::Form::box, .at_m = {1.0, 0.0, -6.0}, .size_m = {14.0, 9.0, 10.0}, .turn_deg = 23.0};
  const std::vector<InputSpec> inputs{
      box, area(InputTarget::clip, {1.0f, 0.0f, 0.0f, 0.0f}, {-14.0, -10.0}, {9.0, 9.0}, 0.0)};
  // Of each pixel: holes are magenta, and water is as green as red.
  const auto holes = [&](const char* msaa, int times) {
    SeaShot shot({.scene = "calm",
                  .preset = "high",
                  .width = std::uint32_t(times * width),
                  .height = std::uint32_t(times * height),
                  .set = {{"msaa", msaa}, {"debug.view", "holes"}},
                  .effects = std::vector<std::string>{"waves", "clip"},
                  .inputs = inputs});
    const Image8 picture = shot.picture(pose({0.0, 25.0, 5.0}, 0.0, -65.0), 4.0);
    std::vector<double> shares(std::size_t(width * height), 0.0);
    for (int y = 0; y < times * height; ++y)
      for (int x = 0; x < times * width; ++x) {
        const glm::dvec3 light = test::light_at(picture, std::size_t(y) * std::size_t(times * width) + std::size_t(x));
        shares[std::size_t(y / times) * width + std::size_t(x / times)] +=
            std::clamp(light.x - light.y, 0.0, 1.0) / (times * times);
      }
    return shares;
  };
  const std::vector<double> truth = holes("1", finer), coarse = holes("1", 1), fine = holes("4", 1);
  double of_coarse = 0.0, of_fine = 0.0;
  int edge = 0, within = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    within += truth[i] > 0.99;
    if (truth[i] < 0.01 || truth[i] > 0.99) {
      EXPECT_LT(std::abs(fine[i] - truth[i]), 0.3) << i;
      continue;
    }
    ++edge;
    of_coarse += std::abs(coarse[i] - truth[i]);
    of_fine += std::abs(fine[i] - truth[i]);
  }
  RecordProperty("coarse_thousandths", int(1e3 * of_coarse / edge));
  RecordProperty("fine_thousandths", int(1e3 * of_fine / edge));
  ASSERT_GT(edge, 100);
  ASSERT_GT(within, 300);
  EXPECT_LT(of_fine, 0.5 * of_coarse) << of_fine / edge << " and " << of_coarse / edge << " of a pixel, of " << edge;
}

// How many patches are drawn, and how many pixels show water.
std::pair<std::size_t, int> patches_and_water(const std::string& scene, const Set& set, const InputSpec& input,
                                              const Pose& head, std::vector<std::string> effects) {
  SeaShot shot({.scene = scene,
                .preset = "high",
                .width = 160,
                .height = 120,
                .set = set,
                .effects = std::move(effects),
                .inputs = {input}});
  const Image8 picture = shot.picture(shot.viewpoint(head), 4.0);
  int water = 0;
  for (std::size_t i = 0; i < picture.pixels.size() / 4; ++i) {
    const glm::dvec3 light = test::light_at(picture, i);
    water += light.y > 0.1 * light.x;  // not a hole
  }
  return {shot.experience().ocean().selection()->patches.size(), water};
}

// Patches that lie within a volume as a whole are left out, and none that a wave over it shows: the storm's crests over
// a low one are there.
TEST_F(DrawnPlaces, PatchesWithinAVolumeAreNotDrawn) {
  InputSpec raft;
  raft.to = InputTarget::clip;
  raft.blend = InputBlend::replace;
  raft.value.x = 1.0f;
  for (const bool high : {true, false}) {
    raft.shape = VolumeInput{
        .form = VolumeInput::Form::box, .at_m = {0.0, 0.0, -150.0}, .size_m = {400.0, high ? 200.0 : 3.0, 300.0}};
    const auto drawn = [&](std::vector<std::string> effects) {
      return patches_and_water("storm", {{"debug.view", "holes"}}, raft, pose({0.0, 30.0, 0.0}, 0.0, -45.0),
                               std::move(effects));
    };
    const auto [left, water] = drawn({"waves", "clip"});
    const auto [all, everywhere] = drawn({"waves"});
    if (high) {
      EXPECT_LT(left, all * 3 / 4);
      EXPECT_LT(water, everywhere / 2);
    } else {
      EXPECT_EQ(left, all) << "a wave may stand over it anywhere";
      EXPECT_GT(water, everywhere / 4) << "crests over the raft";
      EXPECT_LT(water, everywhere * 9 / 10);
    }
  }
}

// Patches that are clipped as a whole are not drawn at all: of a pond in dry land few are left, and the picture shows
// its water. Control seen: none left out.
TEST_F(DrawnPlaces, PatchesWithoutWaterAreNotDrawn) {
  InputSpec pond = area(InputTarget::clip, {0.0f, 0.0f, 0.0f, 0.0f}, {0.0, -30.0}, {30.0, 20.0}, 0.0);
  pond.blend = InputBlend::replace;
  const auto drawn = [&](std::vector<std::string> effects) {
    return patches_and_water("calm", {{"clip.by_default", "true"}, {"debug.view", "holes"}}, pond,
                             pose({0.0, 12.0, 0.0}, 0.0, -20.0), std::move(effects));
  };
  const auto [left, water] = drawn({"waves", "clip"});
  const auto [all, everywhere] = drawn({"waves"});
  EXPECT_LT(left, all / 2);
  EXPECT_GT(water, everywhere / 50) << "the pond is there";
  EXPECT_LT(water, everywhere * 3 / 4);
}

}  // namespace
}  // namespace seascape
