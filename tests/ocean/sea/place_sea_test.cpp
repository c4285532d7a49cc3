// Levels and currents on the processor: the water that a query finds, waves that a current carries and that do not
// pulse.
#include "ocean/sea/place_sea.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ocean/places/flow_phase.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/found_surface.h"
#include "tests/support/place_truth.h"

namespace seascape {
namespace {

SeaState fresh() {
  SeaState sea;
  sea.wind_speed_mps = 9.0;
  sea.chop = 0.7;
  return sea;
}

InputSpec hill(double top_m) {
  InputSpec spec;
  spec.to = InputTarget::level;
  spec.value = {float(top_m), 0.0f, 0.0f, 0.0f};
  spec.feather_m = 40.0;
  spec.shape = AreaInput{.round = true, .at_m = {5.0, -3.0}, .size_m = {100.0, 100.0}};
  return spec;
}

PlaceInputs inputs_of(const std::vector<InputSpec>& specs, const PlaceSettings& settings = {}) {
  PlaceInputs result{settings, {}, {}, nullptr};
  for (const InputTarget kind : {InputTarget::level, InputTarget::flow, InputTarget::clip, InputTarget::sea_depth}) {
    auto inputs = std::make_shared<const Inputs>(kind, specs);
    if (!inputs->empty() || place_outside(settings, kind) != glm::vec4(0.0f)) result.kinds.push_back(std::move(inputs));
  }
  if (std::any_of(specs.begin(), specs.end(), is_volume)) result.volumes = std::make_shared<const ClipVolumes>(specs);
  return result;
}

PlaceSettings current(double to_deg, double speed_mps, double period_s = 2.0) {
  PlaceSettings settings;
  settings.flow_to_deg = to_deg;
  settings.flow_mps = speed_mps;
  settings.flow_period_s = period_s;
  return settings;
}

class PlaceSeaTest : public ::testing::Test {
 protected:
  PlaceSeaTest() : field(fresh(), WaveQuality{.resolution = 64, .cascades = 3}), tiles(true) {
    field.evaluate(ticks_from_seconds(12.5), tiles);
  }
  SeaSample at(const PlaceSea& place, glm::dvec2 rest, double footprint = 0.0) const {
    return place.at(field, tiles, rest, {.footprint_m = footprint}, {});
  }
  WaveField field;
  WaveTiles tiles;
};

// A query finds the point of the surface that stands at the place: where it stands, rest and displacement add up to it,
// level and all; its normal is that of points around it.
TEST_F(PlaceSeaTest, QueriesFindTheSurface) {
  const test::PlaceTruth place(inputs_of({hill(6.0)}, current(70.0, 1.5)), field);
  ASSERT_TRUE(place.moves());
  const int converged =
      test::expect_found_on_surface(place, field, tiles, 3, 60.0, [&](glm::dvec2 asked, const QueryAnswer& answer) {
        const double e = 0.05;
        QueryAnswer east, south;
        const glm::dvec2 to_east = asked + glm::dvec2(e, 0.0), to_south = asked + glm::dvec2(0.0, e);
        place.query(field, tiles, {&to_east, 1}, {&east, 1});
        place.query(field, tiles, {&to_south, 1}, {&south, 1});
        const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(0.0, south.height_m - answer.height_m, e),
                                                            glm::dvec3(e, east.height_m - answer.height_m, 0.0)));
        EXPECT_GT(glm::dot(normal, answer.normal), 0.98);
      });
  EXPECT_GT(converged, 180);
}

// At a rest position, for any footprint, the kernel of queries reads what plain double precision does, and its
// gradients are those of what it reads. Control seen: the footprint left out.
TEST_F(PlaceSeaTest, APointIsThatOfPlainDoublePrecision) {
  const test::PlaceTruth place(inputs_of({hill(6.0)}, current(70.0, 1.5)), field);
  for (const double footprint : {0.0, 0.9, 4.0}) {
    double off2 = 0.0, all2 = 0.0;
    for (int i = 0; i < 300; ++i) {
      const glm::dvec2 rest(60.0 * std::sin(i * 1.7), 60.0 * std::sin(i * 0.61));
      const auto want = [&](double x, double z) {
        return place.sea(field, tiles, rest + glm::dvec2(x, z), footprint).displacement;
      };
      const SeaSample got = at(place, rest, footprint);
      ASSERT_LT(glm::distance(got.displacement, want(0.0, 0.0)), 5e-5);
      constexpr double e = 1e-4;
      const glm::dvec2 rise(want(e, 0.0).y - want(-e, 0.0).y, want(0.0, e).y - want(0.0, -e).y);
      const glm::dvec2 off = got.height_gradient - rise / (2.0 * e);
      off2 += glm::dot(off, off), all2 += glm::dot(got.height_gradient, got.height_gradient);
    }
    EXPECT_LT(std::sqrt(off2 / all2), 0.01) << footprint;
  }
}

// The still water is that of the inputs themselves: a lake of 6 m over a bed of -10 m, which the bed's Shallows ask as
// deep as that, and a box of clip about the lake's surface and not the sea's. Without a bed it is as deep as the open
// sea. Controls seen: the level left out; clip left out; clip asked at y = 0; no depth of the open sea.
TEST_F(PlaceSeaTest, StillWaterIsTheInputs) {
  InputSpec bed = hill(-10.0), box;
  bed.to = InputTarget::sea_depth;
  bed.blend = InputBlend::replace;
  bed.feather_m = 0.0;
  box.to = InputTarget::clip;
  box.value.x = 1.0f;
  box.blend = InputBlend::replace;
  box.shape = VolumeInput{.form = VolumeInput::Form::box, .at_m = {5.0, 6.0, -3.0}, .size_m = {4.0, 2.0, 400.0}};
  const PlaceSea lake(inputs_of({hill(6.0), bed, box}), field), open(inputs_of({hill(6.0)}), field);
  const glm::dvec2 middle(5.0, -3.0), beside(9.0, -3.0), sea(5.0, -120.0);
  const StillWater in = lake.still_water(middle, 0.5, 3.0), out = lake.still_water(sea, 0.5, 3.0);
  EXPECT_EQ(in.height_m, 6.0);
  EXPECT_NEAR(in.depth_m, 16.0, 0.1);
  EXPECT_EQ(in.depth_m, 6.0 - lake.shallows()->bed_m(middle, 0.5, 3.0));
  const PlaceWaves waves = lake.shallows()->waves(middle, in.depth_m);
  EXPECT_EQ(in.waves, double(waves.share[0]));
  EXPECT_EQ(in.swash, double(waves.swash));
  EXPECT_EQ(in.surf, lake.shallows()->surf(middle, in.depth_m));
  EXPECT_TRUE(in.clipped);
  EXPECT_FALSE(lake.still_water(beside, 0.5, 3.0).clipped);
  EXPECT_EQ(out.height_m, 0.0);
  EXPECT_EQ(out.depth_m, fresh().depth_m);
  EXPECT_FALSE(out.clipped) << "the box lies above the sea";
  EXPECT_EQ(open.still_water(middle, 0.5, 3.0).height_m, 6.0);
  EXPECT_EQ(open.still_water(middle, 0.5, 3.0).depth_m, fresh().depth_m);
  EXPECT_EQ(open.still_water(middle, 0.5, 3.0).waves, 1.0);
}

// The level is that of the rest place, at the middle of a texel as floats round it and elsewhere straight between them,
// and nothing else of the waves changes but their slopes, by its own. Controls seen: the level where the water stands;
// texels taken at their corners.
TEST_F(PlaceSeaTest, LevelsLiftTheWaterByItsRestPlace) {
  const PlaceSea place(inputs_of({hill(6.0)}), field), open(PlaceInputs{}, field);
  const Inputs alone(InputTarget::level, std::vector<InputSpec>{hill(6.0)});
  for (int i = 0; i < 40; ++i) {
    const glm::dvec2 rest(-44.875 + 2.25 * i, 12.125 - 0.75 * i), between = rest + glm::dvec2(0.1, 0.0625);
    const SeaSample with = at(place, rest), without = at(open, rest);
    const auto level = [&](glm::dvec2 there) { return double(alone.value(there, 0.25, 0.0, glm::vec4(0.0f)).x); };
    EXPECT_NEAR(with.displacement.y - without.displacement.y, level(rest), 1e-6);
    const double north = 0.6 * level(rest) + 0.4 * level(rest + glm::dvec2(0.25, 0.0)),
                 south = 0.6 * level(rest + glm::dvec2(0.0, 0.25)) + 0.4 * level(rest + glm::dvec2(0.25));
    EXPECT_NEAR(place.level_m(between, 0.0, 0.0), 0.75 * north + 0.25 * south, 1e-6);
    EXPECT_EQ(with.displacement.x, without.displacement.x);
    EXPECT_EQ(with.shift_gradient, without.shift_gradient);
  }
}

// Without anything of places it is the query of the waves, to the bit.
TEST_F(PlaceSeaTest, WithoutPlacesItIsTheWavesQuery) {
  const PlaceSea place(PlaceInputs{}, field);
  EXPECT_FALSE(place.moves());
  const glm::dvec2 asked(3.0, 7.0);
  QueryAnswer ours, theirs;
  place.query(field, tiles, {&asked, 1}, {&ours, 1});
  query(field, tiles, {&asked, 1}, {&theirs, 1});
  EXPECT_EQ(ours.height_m, theirs.height_m);
  EXPECT_EQ(ours.orbital_velocity_mps, theirs.orbital_velocity_mps);
}

// Water is taken away where it stands within a volume, whatever lies above or below; flat inputs take it at any height.
// Control seen: the height left out.
TEST_F(PlaceSeaTest, VolumesTakeWaterByItsHeight) {
  InputSpec ball;
  ball.to = InputTarget::clip;
  ball.blend = InputBlend::replace;
  ball.value.x = 1.0f;
  ball.shape = VolumeInput{.form = VolumeInput::Form::sphere, .at_m = {4.0, 1.0, -7.0}, .radius_m = 2.0};
  InputSpec flat = hill(1.0);
  flat.to = InputTarget::clip;
  flat.shape = AreaInput{.round = true, .at_m = {30.0, 0.0}, .size_m = {6.0, 6.0}};
  flat.feather_m = 0.0;
  const PlaceSea place(inputs_of({ball, flat}), field), alone(inputs_of({ball}), field);
  for (const PlaceSea* sea : {&place, &alone}) {
    EXPECT_TRUE(sea->clipped({4.0, -0.9, -7.0}, 0.0));
    EXPECT_TRUE(sea->clipped({5.9, 1.0, -7.0}, 0.0));
    EXPECT_FALSE(sea->clipped({5.9, 0.0, -7.0}, 0.0));
    EXPECT_FALSE(sea->clipped({4.0, 3.1, -7.0}, 0.0));
    EXPECT_FALSE(sea->clipped({4.0, -1.1, -7.0}, 0.0));
  }
  EXPECT_TRUE(place.clipped({30.0, 9.0, 0.0}, 0.0));
  EXPECT_FALSE(alone.clipped({30.0, 9.0, 0.0}, 0.0));
}

// A tide lifts all water by its height, and nothing else.
TEST_F(PlaceSeaTest, ATideLiftsEverything) {
  PlaceSettings tide;
  tide.level_m = 2.5;
  const PlaceSea place(inputs_of({}, tide), field), open(PlaceInputs{}, field);
  for (const glm::dvec2 rest : {glm::dvec2(0.0), glm::dvec2(1e5, -3e4)}) {
    const SeaSample with = at(place, rest, 0.5), without = at(open, rest, 0.5);
    EXPECT_NEAR(with.displacement.y - without.displacement.y, 2.5, 1e-6);
    EXPECT_EQ(with.height_gradient, without.height_gradient);
  }
}

// What floats goes with the current. Control seen: the flow's x and z changed about.
TEST_F(PlaceSeaTest, ACurrentCarriesWhatFloats) {
  const PlaceSea place(inputs_of({}, current(90.0, 2.0)), field);  // to +x
  std::vector<glm::dvec2> asked;
  for (int i = 0; i < 400; ++i) asked.emplace_back(7.3 * (i % 20), 9.1 * (i / 20));
  std::vector<QueryAnswer> answers(asked.size());
  place.query(field, tiles, asked, answers);
  glm::dvec3 mean(0.0);
  for (const QueryAnswer& answer : answers) mean += answer.orbital_velocity_mps / double(answers.size());
  EXPECT_NEAR(mean.x, 2.0, 0.15);
  EXPECT_NEAR(mean.z, 0.0, 0.15);
}

// Where a pattern's turn begins its share is 0 and grows: velocities have that growth then as they do a moment later.
// Control seen: such a pattern taken for one that is not there (velocities off by twice its height a period).
TEST_F(PlaceSeaTest, VelocitiesHaveAPatternWhoseTurnBegins) {
  const PlaceSea place(inputs_of({}, current(70.0, 1.5, 0.5)), field);
  std::vector<glm::dvec2> asked;
  for (int i = 0; i < 100; ++i) asked.emplace_back(7.3 * (i % 10), 9.1 * (i / 10));
  for (const double time_s : {0.0, 12.0, 12.25}) {  // of the first pattern, again, and of the second
    std::vector<QueryAnswer> begin(asked.size()), later(asked.size());
    field.evaluate(ticks_from_seconds(time_s), tiles);
    place.query(field, tiles, asked, begin);
    field.evaluate(ticks_from_seconds(time_s) + 4, tiles);  // 4 microseconds
    place.query(field, tiles, asked, later);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      EXPECT_LT(glm::distance(begin[i].orbital_velocity_mps, later[i].orbital_velocity_mps), 0.01) << time_s;
      EXPECT_LT(glm::distance(begin[i].eulerian_velocity_mps, later[i].eulerian_velocity_mps), 0.02) << time_s;
    }
  }
}

// The waves stand as high at every moment of the two patterns' turn: their variance does not pulse. Controls seen: a
// sum left at its height (in a fast current it swings by 1.7), and one raised as if the patterns had nothing in common
// (slow water, 2.0).
TEST_F(PlaceSeaTest, CarriedWavesDoNotPulse) {
  for (const double speed : {0.2, 1.0, 6.0, 80.0}) {
    const PlaceSea place(inputs_of({}, current(30.0, speed)), field);
    std::vector<double> variances;
    for (int moment = 0; moment < 8; ++moment) {
      field.evaluate(ticks_from_seconds(100.0 + 0.25 * moment), tiles);
      double sum = 0.0;
      for (int j = 0; j < 60; ++j)
        for (int i = 0; i < 60; ++i) {
          const double h = at(place, {3.7 * i, 4.3 * j}).displacement.y;
          sum += h * h;
        }
      variances.push_back(sum / field.statistics().height_variance / 3600.0);
    }
    const auto [least, most] = std::minmax_element(variances.begin(), variances.end());
    EXPECT_LT(*most / *least, 1.3) << speed;
    EXPECT_NEAR(*most, 1.1, 0.35) << speed;
  }
}

// Waves go with the water: a moment after a pattern was where it belongs, it stands so far on. By the correlation with
// the waves alone, that far behind. Control seen: the patterns carried the other way.
TEST_F(PlaceSeaTest, WavesGoWithTheWater) {
  const double speed = 15.0, later = 0.8;
  const PlaceSea place(inputs_of({}, current(90.0, speed, 8.0)), field);  // to +x
  field.evaluate(ticks_from_seconds(52.0 + later), tiles);  // at 52 s the first pattern is in its place, and alone
  const auto alike = [&](double behind_m) {
    double xy = 0.0, xx = 0.0, yy = 0.0;
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) {
        const glm::dvec2 rest(5.1 * i, 4.7 * j);
        const double carried = at(place, rest).displacement.y,
                     wave = field.sea(tiles, rest - glm::dvec2(behind_m, 0.0), 0.0).displacement.y;
        xy += carried * wave, xx += carried * carried, yy += wave * wave;
      }
    return xy / std::sqrt(xx * yy);
  };
  EXPECT_GT(alike(speed * later), 0.9);
  EXPECT_LT(alike(-speed * later), 0.7);
}

TEST(FlowPhase, PatternsComeAndGoUnseen) {
  for (double t = -5.0; t < 5.0; t += 0.01) {
    const FlowPhase p = flow_phase(t, 2.0);
    EXPECT_GE(p.first, 0.0);
    EXPECT_LE(p.first, 1.0);
    EXPECT_LE(std::abs(p.first_s), 1.0);
    EXPECT_LE(std::abs(p.second_s), 1.0);
    EXPECT_LE(p.first, 1.01 - std::abs(p.first_s)) << "at the end of its way it is gone";
    EXPECT_LE(1.0 - p.first, 1.01 - std::abs(p.second_s));
  }
  EXPECT_EQ(flow_phase(std::nan(""), 2.0).first, flow_phase(0.0, 2.0).first);
}

TEST_F(PlaceSeaTest, NoNumberIsNoAnswer) {
  const PlaceSea place(inputs_of({hill(6.0)}), field);
  const glm::dvec2 asked(std::nan(""), 1.0);
  QueryAnswer answer;
  place.query(field, tiles, {&asked, 1}, {&answer, 1});
  EXPECT_FALSE(answer.converged);
  EXPECT_EQ(answer.height_m, 0.0);
}

// Windows hold what the inputs give at their texels' middles, and follow the viewer: the same as if made anew, and so
// are the least and the most of each. Controls seen: texels that come in left as they were; ranges left as they were.
TEST(PlaceField, FollowsTheViewer) {
  PlaceSettings settings;
  settings.windows = {.resolution = 64, .slices = 4, .texel_m = 0.5};
  const auto inputs = std::make_shared<const Inputs>(InputTarget::level, std::vector<InputSpec>{hill(6.0)});
  const auto placed = [&](glm::dvec2 at, double height) {
    return lod_placement(settings.windows, at, lod_scale(settings.windows, height));
  };
  PlaceField follows(place_values(inputs, settings), settings, placed({0.0, 0.0}, 2.0), 0.0);
  for (int i = 1; i <= 30; ++i) {
    const LodPlacement next = placed({1.3 * i, -0.7 * i}, 2.0 + i);
    follows.follow(next, 0.0);
    const PlaceField anew(place_values(inputs, settings), settings, next, 0.0);
    for (int slice = 0; slice < 4; ++slice) {
      double worst = 0.0;
      follows.field().each(slice, [&](LodIndex w) {
        worst = std::max(worst, double(std::abs(follows.field().texel(slice, w).x - anew.field().texel(slice, w).x)));
      });
      // A slice that came by a change of the octave holds means of finer texels until it moves.
      EXPECT_LE(worst, next.scale.octave > 0 ? 0.06 : 0.0) << i << ' ' << slice;
      EXPECT_NEAR(follows.least(slice), anew.least(slice), worst) << i << ' ' << slice;
      EXPECT_NEAR(follows.most(slice), anew.most(slice), worst) << i << ' ' << slice;
    }
  }
  EXPECT_NEAR(follows.most(), 6.0, 1e-5);
  EXPECT_EQ(changed_slices(follows.follow(follows.field().placement(), 5.0)), 0u) << "nothing has changed";
}

// What changes with time is taken ten times a second, and only where it lies.
TEST(PlaceField, TakesWhatChangesWithTime) {
  InputSpec trail;
  trail.to = InputTarget::level;
  trail.value = {1.0f, 0.0f, 0.0f, 0.0f};
  trail.shape = TrailInput{.keys = {{0.0, {-10.0, 0.0}}, {10.0, {10.0, 0.0}}}, .radius_m = 3.0, .life_s = 2.0};
  PlaceSettings settings;
  settings.windows = {.resolution = 64, .slices = 2, .texel_m = 0.5};
  const auto inputs = std::make_shared<const Inputs>(InputTarget::level, std::vector<InputSpec>{trail});
  ASSERT_FALSE(inputs->still());
  const LodPlacement here = lod_placement(settings.windows, {0.0, 0.0}, {});
  PlaceField field(place_values(inputs, settings), settings, here, 0.0);
  EXPECT_NE(changed_slices(field.follow(here, 5.0)), 0u);
  EXPECT_GT(field.field().sample({0.0, 0.0}, 0.0).x, 0.5f);
  EXPECT_EQ(changed_slices(field.follow(here, 5.05)), 0u) << "within a tenth of a second";
  EXPECT_NE(changed_slices(field.follow(here, 20.0)), 0u);
  EXPECT_EQ(field.field().sample({0.0, 0.0}, 0.0).x, 0.0f);
}

}  // namespace
}  // namespace seascape
