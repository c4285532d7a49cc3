// The foam of waves along curves: as that of the same waves everywhere, only along the curve, by the share of them that
// a bed breaks, and where the water goes.
#include "ocean/foam/foam_shore.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "ocean/foam/foam_sea.h"
#include "ocean/sea/place_sea.h"
#include "ocean/waves/gerstner.h"
#include "ocean/waves/wave_tiles.h"

#include "tests/support/own_sea.h"
#include "tests/support/place_truth.h"

namespace seascape {
namespace {

SeaState calm() {
  SeaState sea;
  sea.wind_speed_mps = 0.0;
  return sea;
}
WaveQuality coarse() { return {64, 4}; }

FoamSpec small_spec() {
  FoamSpec spec;
  spec.settings.simulated = true;
  spec.settings.windows = {.resolution = 64, .slices = 3, .texel_m = 0.5};
  spec.settings.settle_s = 0.0;
  return spec;
}

std::vector<InputSpec> spline(const std::vector<glm::dvec2>& points, double width, double feather) {
  InputSpec spec;
  spec.to = InputTarget::gerstner;
  spec.feather_m = feather;
  SplineInput shape;
  for (const glm::dvec2 at : points) shape.points.push_back({at, width, glm::vec4(1.0f, 0.0f, 0.0f, 0.0f)});
  spec.shape = shape;
  return {spec};
}
std::vector<InputSpec> straight() { return spline({{0, 0}, {60, 0}, {400, 0}}, 40.0, 5.0); }
std::vector<InputSpec> bay() {
  return spline({{-120, 30}, {-60, 0}, {-10, -34}, {50, -30}, {90, 10}, {150, 24}}, 60.0, 10.0);
}
constexpr glm::dvec3 head{100.0, 1.7, 0.0};

GerstnerSettings one_wave(double height_m, bool shore) {
  GerstnerSettings s;
  s.set1 = {.height_m = height_m, .wavelength_m = 24.0, .shore = shore};
  return s;
}
GerstnerSettings many(double height_m) {
  GerstnerSettings s;
  s.set1 = {.height_m = height_m, .wavelength_m = 16.0, .spread_deg = 30.0, .octaves = 1, .waves = 6, .shore = true};
  return s;
}

struct Along {
  Along(const GerstnerSettings& settings, const std::vector<InputSpec>& curves)
      : tile(std::make_shared<const Gerstner>(settings, 9.81, 1e6, 0.0, true)),
        lines(std::make_shared<const ShoreLines>(curves, tile->side_m())) {}
  test::OwnFoam foam(const FoamSpec& spec, const SeaState& sea = calm(), PlaceInputs place = {}) const {
    return test::OwnFoam(spec, sea, coarse(), {tile}, lines, std::move(place));
  }
  test::OwnFoam foam_over(double bed_m, const FoamSpec& spec, const SeaState& sea = calm()) const {
    return foam(spec, sea, test::places_of({test::flat_input(InputTarget::sea_depth, bed_m)}));
  }
  std::shared_ptr<const Gerstner> tile;
  std::shared_ptr<const ShoreLines> lines;
};

void run(FoamSea& foam, int steps, double rate = 12.0) {
  for (int i = 0; i <= steps; ++i) foam.update(9.0 + i / rate, head);
}

// Along a straight curve steep waves foam as the same set does everywhere, and nowhere else; gentle ones do not. Seen:
// 0.05 apart at most where up to 0.7 is covered, for one reads the nearer mip level and the other between two. Controls
// seen: what they squeeze left out (0.73); the threshold of the sea's own waves (0.48).
TEST(FoamShore, SteepWavesFoamAsTheSameSetEverywhereDoes) {
  Along along(one_wave(5.4, true), straight());
  test::OwnFoam there = along.foam(small_spec()),
                everywhere(small_spec(), calm(), coarse(), {std::make_shared<const Gerstner>(one_wave(5.4, false))});
  run(there, 36), run(everywhere, 36);
  double most = 0.0, apart = 0.0;
  for (double x = 80.0; x <= 120.0; x += 0.7)
    for (double z = -40.0; z <= 40.0; z += 0.3) {
      const double got = there.foam().covered({x, z}, 0.0), want = everywhere.foam().covered({x, z}, 0.0);
      if (std::abs(z) < 14.0) most = std::max(most, want), apart = std::max(apart, std::abs(got - want));
      if (std::abs(z) > 22.0) {
        ASSERT_EQ(got, 0.0) << x << ' ' << z;
      }
    }
  RecordProperty("apart", std::to_string(apart));
  EXPECT_GT(most, 0.4);
  EXPECT_LT(apart, 0.08);
  Along gentle(one_wave(0.5, true), straight());
  test::OwnFoam none = gentle.foam(small_spec());
  run(none, 36);
  EXPECT_FALSE(none.foam().any());
}

double mean_within(const FoamSea& foam, double least_z, double most_z) {
  double sum = 0.0;
  int count = 0;
  for (double x = 85.0; x <= 115.0; x += 0.5)
    for (double z = least_z; z <= most_z; z += 0.25) sum += double(foam.foam().covered({x, z}, 0.0)), ++count;
  return sum / count;
}

// Where the bed breaks them their crests foam, in the lee too where the sea has no waves, whether or not the sea's own
// foam is simulated; as much as breaks, and as much as the bed leaves of them. Seen: 0.51 where nearly all
// breaks, and 0.33 among the sea's waves. Controls seen: surf of these waves alone among those of the sea (0.52); foam
// in troughs as on crests (0.87); their heights left out (none).
TEST(FoamShore, FoamsWhereABedBreaksThem) {
  Along along(many(0.5), straight());
  FoamSpec spec = small_spec();
  spec.settings.simulated = false;
  spec.settings.shore_per_s = 0.0;
  const auto foam_of = [&](double depth_m) {
    test::OwnFoam foam = along.foam_over(-depth_m, spec);
    run(foam, 36);
    EXPECT_EQ(mean_within(foam, 22.0, 40.0), 0.0) << "beyond the curve";
    return mean_within(foam, -14.0, 14.0);
  };
  EXPECT_EQ(foam_of(20.0), 0.0);
  EXPECT_EQ(foam_of(-1.0), 0.0) << "land";
  const double some = foam_of(0.7), all = foam_of(0.3);
  EXPECT_GT(some, 0.15);
  EXPECT_GT(all, some);
  RecordProperty("all", std::to_string(all));
  EXPECT_LT(all, 0.75) << "troughs do not break";
  spec.settings.breaking = 0.0;
  EXPECT_EQ(foam_of(0.5), 0.0);
  // Among waves of the sea, of which little breaks there, what breaks is these waves' part of the energy.
  spec.settings.breaking = 1.0;
  SeaState sea;
  sea.wind_speed_mps = 4.0;
  test::OwnFoam among = along.foam_over(-0.7, spec, sea);
  run(among, 36);
  RecordProperty("among", std::to_string(mean_within(among, -14.0, 14.0)));
  EXPECT_GT(mean_within(among, -14.0, 14.0), 0.02);
  EXPECT_LT(mean_within(among, -14.0, 14.0), 0.4);
}

// The edge of the water's foam runs up and down with them: farther out than without them. Control seen: their heights
// left out there.
TEST(FoamShore, TheWatersEdgeGoesUpAndDownWithThem) {
  const auto covered = [](double height_m) {
    Along along(many(height_m), straight());
    FoamSpec spec = small_spec();
    spec.settings.breaking = 0.0;
    test::OwnFoam foam = along.foam(spec, calm(), test::places_of({test::beach({100.0, -12.0}, {0.0, 1.0})}));
    run(foam, 48);
    return mean_within(foam, -5.0, -4.0);  // deeper than shore_m
  };
  EXPECT_LT(covered(0.01), 0.005);
  EXPECT_GT(covered(0.5), 0.02);
}

// Each texel is moved as the sea is that queries see (PlaceSea), around a bend, where the waves fade, and in a current;
// the same after a walk and of each instruction set. What differs is what lies between the texels that the sea's places
// are read from. Seen: less than a micrometre, 0.0024 of their derivatives. Controls seen: right for left (1.1 m); a
// current left out (0.09 m); texels that come in as the next coarser ones are; the curve's turning left out (0.0057 of
// the derivatives).
TEST(FoamShore, MovesTheWaterAsTheSeaIs) {
  const Along along(many(0.9), bay());
  const WaveField field(calm(), WaveQuality{.resolution = 16, .cascades = 1}, {along.tile});
  const FoamSpec spec = small_spec();
  for (const double speed : {0.0, 4.0}) {
    PlaceInputs inputs;
    inputs.shore = along.lines;
    inputs.settings.flow_to_deg = 60.0;
    inputs.settings.flow_mps = speed;
    if (speed > 0.0)
      inputs.kinds.push_back(std::make_shared<const Inputs>(InputTarget::flow, std::vector<InputSpec>{}));
    const test::PlaceTruth place(inputs, field);
    WaveTiles tiles;
    field.evaluate(ticks_from_seconds(31.7), tiles);
    const glm::vec2 velocity = speed > 0.0 ? glm::vec2(place.flow_mps({0.0, 0.0}, 0.0, 31.7)) : glm::vec2(0.0f);
    const FlowPhase phase = flow_phase(31.7, inputs.settings.flow_period_s);
    const LodPlacement here = lod_placement(spec.settings.windows, {18.0, -20.0}, {}),
                       far = lod_placement(spec.settings.windows, {-70.0, 40.0}, {});
    FoamShore fresh(along.lines, spec.settings.windows, field), walked(along.lines, spec.settings.windows, field);
    const LodField<glm::vec2> flow(spec.settings.windows, velocity, here);
    fresh.follow(here, nullptr);
    walked.follow(far, nullptr);
    for (int i = 1; i <= 10; ++i)
      walked.follow(lod_placement(spec.settings.windows, glm::mix(far.viewer, here.viewer, 0.1 * i), {}), nullptr);
    const LodField<float> windows(spec.settings.windows, 0.0f, here);
    std::vector<FoamShore::Moved> moved(64), after(64);
    double worst = 0.0, worst_gradient = 0.0, highest = 0.0;
    int seen = 0;
    for (int slice = 0; slice < 2; ++slice)
      for (int z = 0; z < 64; ++z) {
        const double texel = windows.texel_m(slice);
        const FoamRow row{slice, texel, windows.middle(slice, windows.first(slice) + LodIndex(0, z))};
        const bool any = fresh.row(row, field, tiles, speed > 0.0 ? &flow : nullptr, phase, moved);
        std::int64_t sets = z % 16 == 0 ? hwy::SupportedTargets() : 0;
        do {
          hwy::SetSupportedTargetsForTest(sets & -sets);
          hwy::GetChosenTarget().DeInit();
          ASSERT_EQ(walked.row(row, field, tiles, speed > 0.0 ? &flow : nullptr, phase, after), any);
          for (int i = 0; any && i < 64; ++i) {
            const FoamShore::Moved &got = after[std::size_t(i)], &want = moved[std::size_t(i)];
            ASSERT_EQ(got.displacement, want.displacement);
            ASSERT_EQ(got.shift_gradient, want.shift_gradient);
            ASSERT_EQ(got.variance, want.variance);
          }
          sets &= sets - 1;
        } while (sets != 0);
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().DeInit();
        for (int i = 0; i < 64; ++i) {
          const SeaSample want = place.sea(field, tiles, row.first_m + glm::dvec2(i * texel, 0.0), texel);
          const FoamShore::Moved got = any ? moved[std::size_t(i)] : FoamShore::Moved{};
          worst = std::max(worst, glm::distance(want.displacement, got.displacement));
          if (got.height_variance > 0.999 * along.tile->statistics().height_variance)
            worst_gradient = std::max(worst_gradient, glm::distance(want.shift_gradient, got.shift_gradient)), ++seen;
          highest = std::max(highest, std::abs(got.displacement.y));
        }
      }
    RecordProperty("worst_m", std::to_string(worst));
    RecordProperty("worst_gradient", std::to_string(worst_gradient));
    EXPECT_GT(seen, 1000);
    EXPECT_GT(highest, 0.4);
    EXPECT_LT(worst, 1e-4) << speed;
    EXPECT_LT(worst_gradient, 0.004) << speed;
  }
}

// To the bit whatever the display's rate, and after a change of the sea as new foam in that sea. Controls seen: other
// water that reaches the sea's own waves alone; a change of the sea that foam does not notice.
TEST(FoamShore, IsTheSameAtEveryFrameRateAndTakesOtherWater) {
  Along along(many(0.5), straight());
  const auto texels = [](const FoamSea& foam) {
    std::vector<float> all;
    const LodField<float>& field = foam.foam().field();
    for (int i = 0; i < field.slices(); ++i) field.each(i, [&](LodIndex w) { all.push_back(field.texel(i, w)); });
    return all;
  };
  SeaState sea;
  sea.wind_speed_mps = 4.0;
  test::OwnFoam slow = along.foam_over(-0.7, small_spec(), sea), fast = along.foam_over(-0.7, small_spec(), sea);
  run(slow, 24, 12.0), run(fast, 180, 90.0);
  EXPECT_GT(mean_within(slow, -14.0, 14.0), 0.1);
  EXPECT_EQ(texels(slow), texels(fast));
  // The sea changes: rougher waves break these earlier.
  Sea& changed = *slow.own;
  SeaState rough = sea;
  rough.wind_speed_mps = 8.0;
  changed.advance(11.0, head);
  changed.change(rough, 0.5);
  double time_s = 11.0;
  for (int i = 0; i < 6000 && changed.changing(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    changed.advance(time_s += 0.02, head);
  }
  ASSERT_FALSE(changed.changing());
  for (int i = 0; i < 30; ++i) slow.update(1.0, head);
  FoamSea fresh(small_spec(), changed, along.lines);
  const std::vector<float> before = texels(slow);
  run(slow, 24, 12.0), run(fresh, 24, 12.0);  // both begin anew
  EXPECT_NE(texels(slow), before);
  EXPECT_EQ(texels(slow), texels(fresh));
}

}  // namespace
}  // namespace seascape
