// Foam as it is drawn: the images against the processor's foam, and white where inputs foam and nowhere else.
#include <array>
#include <cmath>
#include <cstring>
#include <set>

#include "ocean/waves/half_floats.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using Set = std::vector<std::pair<std::string, std::string>>;

class DrawnFoamWindows : public test::GpuTest {};

// Every texel of every slice, as half floats, after steps, a walk, changes of height by octaves and a jump of the time.
// Controls seen: a slice that is copied once and then never again; a layer filled with the slice of its own number.
TEST_F(DrawnFoamWindows, HoldTheProcessorsFoam) {
  const Set set{{"foam.simulated", "true"}, {"foam.resolution", "64"},  {"foam.levels", "3"},
                {"foam.settle_s", "1"},     {"waves.resolution", "64"}, {"waves.wind_speed_mps", "18"}};
  SeaShot shot({.scene = "open_sea",
                .preset = "medium",
                .width = 48,
                .height = 32,
                .set = set,
                .effects = std::vector<std::string>{"waves", "foam"}});
  std::set<int> octaves;
  struct Moment {
    double time_s;
    glm::dvec3 at;
  };
  for (const Moment& moment : {Moment{5.0, {0.0, 3.0, 0.0}},
                               {5.1, {0.0, 3.0, 0.0}},
                               {5.2, {2.3, 3.0, -1.1}},
                               {5.3, {7.0, 3.0, 4.0}},
                               {5.35, {7.0, 40.0, 4.0}},
                               {5.5, {9.0, 5.0, 4.0}},
                               {90.0, {9.0, 5.0, 4.0}},
                               {90.2, {300.0, 5.0, -80.0}},
                               {90.4, {300.0, 60.0, -80.0}},
                               {90.6, {300.0, 110.0, -80.0}},
                               {90.8, {300.0, 110.0, -80.0}}}) {
    shot.draw(pose(moment.at, 0.0, -20.0), moment.time_s);
    const DrawnFoam* drawn = shot.experience().ocean().foam();
    ASSERT_NE(drawn, nullptr);
    const LodField<float>& field = drawn->sea().foam().field();
    double most = 0.0;
    for (int slice = 0; slice < field.slices(); ++slice) {
      const std::vector<std::uint8_t> got =
          read_image(test::device(), drawn->windows(), std::uint32_t(field.layer(slice)));
      std::vector<std::uint16_t> want(64 * 64);
      halves_from_floats(field.texels(slice), want.data(), want.size());
      ASSERT_EQ(got.size(), want.size() * 2);
      EXPECT_EQ(std::memcmp(got.data(), want.data(), got.size()), 0) << moment.time_s << " s, slice " << slice;
      octaves.insert(field.layer(0));
      for (int i = 0; i < 64 * 64; ++i) most = std::max(most, double(field.texels(slice)[i]));
    }
    EXPECT_GT(most, 0.05) << moment.time_s;
  }
  EXPECT_EQ(octaves.size(), 3u) << "each layer was slice 0's at some height";
}

// A round slick of foam on calm water, from straight above: white within, as without it beyond, where its rest position
// lies, in both frame shapes. Control seen: x and z changed about.
TEST_F(DrawnFoamWindows, AreWhiteWhereAnInputFoams) {
  constexpr int width = 160, height = 120;
  InputSpec input;
  input.to = InputTarget::foam;
  input.value.x = 50.0f;
  input.shape = AreaInput{.round = true, .at_m = {6.0, 0.0}, .size_m = {24.0, 10.0}};
  for (const char* msaa : {"1", "4"}) {
    const Set set{{"msaa", msaa},
                  {"waves.wind_speed_mps", "0"},
                  {"foam.texel_m", "0.25"},
                  {"foam.resolution", "256"},
                  {"sky.sun_elevation_deg", "40"}};
    const auto shot_of = [&](std::vector<std::string> effects) {
      return SeaShot({.scene = "calm",
                      .preset = "high",
                      .width = width,
                      .height = height,
                      .set = set,
                      .effects = std::move(effects),
                      .inputs = {input}});
    };
    SeaShot with = shot_of({"waves", "foam"}), without = shot_of({"waves"});
    const Viewpoint view = with.viewpoint(pose({0.0, 30.0, 0.0}, 0.0, -90.0));
    const Image8 white = with.picture(view, 4.0), plain = without.picture(view, 4.0);
    // Metres a pixel on the level sea, straight down.
    const double metres =
        2.0 * 30.0 * std::tan(glm::radians(0.5 * with.scene().settings.render.vertical_fov_deg)) / height;
    int within = 0, beyond = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const glm::dvec2 place((x + 0.5 - width / 2) * metres, (y + 0.5 - height / 2) * metres),
            off = (place - glm::dvec2(6.0, 0.0)) / glm::dvec2(12.0, 5.0);
        const std::size_t i = std::size_t(y * width + x);
        const glm::dvec3 p = test::light_at(plain, i), w = test::light_at(white, i);
        if (glm::length(off) < 0.85) {
          ++within;
          ASSERT_GT(w.x, 2.0 * p.x) << test::leave(white, "foam") << " at " << x << " " << y;
        } else if (glm::length(off) > 1.6) {
          ++beyond;
          ASSERT_EQ(w, p) << test::leave(white, "foam") << " at " << x << " " << y;
        }
      }
    EXPECT_GT(within, 300);
    EXPECT_GT(beyond, 5000);
  }
}

// A filled area over a storm takes its foam away, the whitecaps too that are drawn while waves break.
// Control seen: whitecaps that are drawn whatever inputs leave of them.
TEST_F(DrawnFoamWindows, AreDarkWhereAnInputTakesFoamAway) {
  for (const InputBlend blend : {InputBlend::replace, InputBlend::scale}) {
    InputSpec input;
    input.to = InputTarget::foam;
    input.blend = blend;
    input.shape = AreaInput{.size_m = {200.0, 200.0}};
    const auto shot_of = [&](bool taken) {
      InputSpec nothing = input;
      nothing.blend = InputBlend::add;
      return SeaShot({.scene = "storm",
                      .preset = "medium",
                      .width = 160,
                      .height = 120,
                      .set = {{"msaa", "1"}, {"foam.simulated", "false"}, {"water.glitter", "0"}},
                      .effects = {{"waves", "foam"}},
                      .inputs = {taken ? input : nothing}});
    };
    SeaShot with = shot_of(false), without = shot_of(true);
    int foamy = 0, left = 0;
    for (int n = 0; n < 6; ++n) {
      const Viewpoint view = with.viewpoint(pose({0.0, 25.0, 0.0}, 0.0, -90.0));
      const Image8 white = with.picture(view, 3.0 * n), dark = without.picture(view, 3.0 * n);
      for (std::size_t i = 0; i < 160 * 120; ++i) {
        foamy += test::light_at(white, i).x > 0.1;
        left += test::light_at(dark, i).x > 0.1;
      }
    }
    EXPECT_GT(foamy, 40);
    EXPECT_LT(left, foamy / 10);
  }
}

// Steep waves along a curve leave foam where they run and nowhere else; without the effect nothing of it. Control seen:
// a sea of foam that is made without them, as it was once.
TEST_F(DrawnFoamWindows, HoldTheFoamOfWavesAlongACurve) {
  if (!test::device().facts().float32_linear) GTEST_SKIP() << "this device leaves such waves out";
  InputSpec curve;
  curve.to = InputTarget::gerstner;
  curve.value.x = 1.0f;
  curve.feather_m = 4.0;
  SplineInput spline;
  for (const glm::dvec2 at : {glm::dvec2(-90, -20), glm::dvec2(0, -24), glm::dvec2(90, -20)})
    spline.points.push_back({at, 30.0, curve.value});
  curve.shape = spline;
  const Set set{{"foam.simulated", "true"},
                {"foam.resolution", "64"},
                {"foam.levels", "3"},
                {"foam.settle_s", "1"},
                {"waves.resolution", "64"},
                {"waves.wind_speed_mps", "0"},
                {"waves.swell_height_m", "0"},
                {"gerstner.set1_shore", "true"},
                {"gerstner.set1_height_m", "3"},
                {"gerstner.set1_wavelength_m", "14"}};
  for (const bool with : {true, false}) {
    std::vector<std::string> effects{"waves", "foam"};
    if (with) effects.emplace_back("gerstner");
    SeaShot shot({.scene = "open_sea",
                  .preset = "medium",
                  .width = 48,
                  .height = 32,
                  .set = set,
                  .effects = effects,
                  .inputs = {curve}});
    for (int i = 0; i < 24; ++i) shot.draw(pose({0.0, 3.0, 0.0}, 0.0, -20.0), 5.0 + i / 12.0);
    const LodField<float>& field = shot.experience().ocean().foam()->sea().foam().field();
    double within = 0.0, beyond = 0.0;
    field.each(1, [&](LodIndex w) {
      const glm::dvec2 at = field.middle(1, w);
      double& most = std::abs(at.y + 23.0) < 12.0 ? within : beyond;
      if (std::abs(std::abs(at.y + 23.0) - 16.0) > 2.0 || &most == &within)
        most = std::max(most, double(field.texel(1, w)));
    });
    if (with) {
      EXPECT_GT(within, 0.1);
    } else {
      EXPECT_LT(within, 1e-3);
    }
    EXPECT_LT(beyond, 1e-3) << with;
  }
}

// A storm draws the lace out along the wind, and it stays where it lies on the water when the grid origin moves on with
// the viewer, 400 km from the world's; below Beaufort 6 it is as it was laid. Controls seen: an origin that is not
// drawn out; the wide laying's origin drawn out as the others.
TEST_F(DrawnFoamWindows, LaceIsDrawnOutByTheWindAndStaysWhereItLies) {
  for (const double wind_mps : {8.0, 24.0}) {
    const Set set{{"foam.simulated", "true"},
                  {"foam.resolution", "64"},
                  {"waves.resolution", "64"},
                  {"waves.wind_speed_mps", std::to_string(wind_mps)},
                  {"waves.wind_to_deg", "70"}};
    SeaShot shot({.scene = "open_sea",
                  .preset = "medium",
                  .width = 48,
                  .height = 32,
                  .set = set,
                  .effects = std::vector<std::string>{"waves", "foam"}});
    const glm::dvec2 place(4e5, -3e5), blown(std::sin(glm::radians(70.0)), -std::cos(glm::radians(70.0)));
    // Where in its tile each laying has a place, as shaders/lib/foam.glsl finds it.
    const auto layings = [&](const glm::dvec2& at, const glm::dvec2& origin) {
      gpu::FrameData frame{};
      shot.experience().ocean().foam()->describe(frame, origin);
      const gpu::FoamData& data = frame.foam;
      const glm::dvec2 rest = at - origin, along(data.wind.x, data.wind.y);
      const auto drawn_out = [&](double taken) { return rest - taken * glm::dot(rest, along) * along; };
      const glm::dvec2 lace = drawn_out(data.wind.z), wide = drawn_out(data.wind.w);
      const double c = double(gpu::foam_turn_cos), s = double(gpu::foam_turn_sin);
      return std::array{lace / double(gpu::foam_side_m) + glm::dvec2(data.origin.x, data.origin.y),
                        glm::dvec2(c * lace.x + s * lace.y, c * lace.y - s * lace.x) / double(gpu::foam_fine_side_m) +
                            glm::dvec2(data.origin.z, data.origin.w),
                        glm::dvec2(c * wide.x - s * wide.y, c * wide.y + s * wide.x) / double(gpu::foam_wide_side_m) +
                            glm::dvec2(data.look.x, data.look.y)};
    };
    const auto before = layings(place, place + glm::dvec2(7.0, -13.0)),
               after = layings(place, place + glm::dvec2(-21.0, 40.0));
    const auto along = layings(place + 1.0 * blown, place),
               across = layings(place + glm::dvec2(-blown.y, blown.x), place), there = layings(place, place);
    for (std::size_t laying = 0; laying < 3; ++laying) {
      const glm::dvec2 off = before[laying] - after[laying];
      EXPECT_LT(glm::length(off - glm::round(off)), 1e-4) << laying << ", " << wind_mps << " m/s";
      const double drawn = glm::length(across[laying] - there[laying]) / glm::length(along[laying] - there[laying]),
                   want = wind_mps < 9.0 ? 1.0
                          : laying == 2  ? 5.5
                                         : 2.3;
      EXPECT_NEAR(drawn, want, 0.1 * want * double(want > 1.0) + 1e-5) << laying << ", " << wind_mps << " m/s";
    }
  }
}

// Where the sea is still and nobody foams it, the effect costs no pass after its first frame. Control seen: a copy in
// every frame.
TEST_F(DrawnFoamWindows, RestWhereNothingFoams) {
  const Set set{{"foam.simulated", "true"},
                {"foam.resolution", "64"},
                {"waves.wind_speed_mps", "0"},
                {"waves.swell_height_m", "0"}};
  SeaShot shot({.scene = "open_sea",
                .preset = "medium",
                .width = 48,
                .height = 32,
                .set = set,
                .effects = std::vector<std::string>{"waves", "foam"}});
  shot.draw(pose({0.0, 3.0, 0.0}, 0.0, -10.0), 1.0);
  for (int i = 1; i < 6; ++i) {
    shot.draw(pose({0.3 * i, 3.0, 0.0}, 0.0, -10.0), 1.0 + 0.1 * i);
    for (const PipelineWork& work : shot.experience().frame().work()) EXPECT_STRNE(work.pass, "foam");
  }
}

}  // namespace
}  // namespace seascape
