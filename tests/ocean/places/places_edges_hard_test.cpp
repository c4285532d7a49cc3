// Hard cases found by reading the local simulations' divisions, casts, accumulations and loops: places and times
// without end, windows' very edges, rain from high up.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ocean/foam/foam.h"
#include "ocean/foam/spray.h"
#include "ocean/foam/spray_flight.h"
#include "ocean/inputs/inputs.h"
#include "ocean/places/dynamic_sea.h"
#include "ocean/places/flow_phase.h"
#include "ocean/places/lod_field.h"
#include "ocean/places/place_fields.h"
#include "ocean/places/place_reader.h"
#include "ocean/places/rain.h"
#include "ocean/places/shallow_water.h"
#include "ocean/places/shore_lines.h"

namespace seascape {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), least_double = 5e-324;

// Hard 67: Rain around a place from 1e14 m out to 1e300 m: drops within reach, or none where doubles are no whole cells
// any more, and in any case an end. Control: the code as it was: at 1e17 m a cell's number plus one is that number, and
// the count never ended.
TEST(RainHard, hard_67_rain_at_the_end_of_the_world) {
  const RainSettings rain{.drops_per_m2_s = 100.0, .drop_length_m = 0.2, .drop_height_m = 0.01};
  for (const double far : {0.0, 1e9, 1e14, 1e16, 1e17, 1e100, 1e300}) {
    std::vector<WaveSource> drops;
    add_rain(rain, 100, 3, 60.0, {far, -far}, 5.0, drops);
    for (const WaveSource& drop : drops) ASSERT_LE(std::abs(drop.place_m.x - far), 5.0 + 1e-15 * far);
    EXPECT_EQ(drops.empty(), far > 1e14) << far;
  }
}

// Hard 68: Heavy rain on wide windows and from 3,000 m up: what falls in a tick stays countable (less than 30 ms'
// worth: fewer than 3,000 drops in 3 ticks), near the water as many drops fall as were asked for (5 %). Control: the
// code as it was: 2.6e7 drops a tick, which take hours.
TEST(RainHard, hard_68_rain_from_high_up_and_on_wide_windows) {
  for (const auto& [texel, height] : {std::pair{0.125, 3000.0}, {10.0, 2.0}, {10.0, 9000.0}}) {
    DynamicSeaSettings s;
    s.waves.windows = {.resolution = 64, .slices = 3, .texel_m = texel};
    s.rain = {.drops_per_m2_s = 100.0, .drop_length_m = 0.2, .drop_height_m = 0.01, .seed = 3};
    s.settle_s = 0.05;
    DynamicSea sea(s);
    EXPECT_TRUE(sea.update(10.0, {3.0, height, 4.0}));
    const DynamicSample there = sea.surface().sea({3.0, 4.0}, 0.0);
    EXPECT_TRUE(std::isfinite(there.displacement.y + there.height_gradient.x));
    EXPECT_FALSE(sea.take_fault());
  }
}

// Hard 69: After 1e16 s to 1e300 s in one advance dynamic waves go on as ever: the next sixtieth of a second is a step.
// Control: the code as it was: what rounding left of the time owed was up to 1e283 s more or less than none, and all
// steps were due at once or none ever again.
TEST(DynamicWavesHard, hard_69_after_1e300_s) {
  for (const double much :
       {1e9, 3.5476060266322664e16, 4.81559331006991e19, 8.757709354995671e49, 6.4020674497133774e299, 1e300}) {
    DynamicWavesSettings s;
    s.windows.resolution = 64;
    s.windows.slices = 2;
    s.idle_m = 0.0;
    DynamicWaves waves(s);
    const LodPlacement placement = lod_placement(s.windows, {0.0, 0.0}, {});
    const std::vector<WaveSource> push{{.head_m = 0.1}};
    ASSERT_EQ(waves.advance(1.5 / s.rate_hz, placement, push), 1);
    ASSERT_GT(waves.advance(much, placement, push), 0);
    for (int i = 0; i < 10; ++i) ASSERT_EQ(waves.advance(1.0 / s.rate_hz, placement, push), 1) << much << " " << i;
    EXPECT_TRUE(std::isfinite(waves.energy_m2()));
  }
}

// Hard 70: Gerstner waves in a film of 1e-30 m to 5e-324 m of water: every factor of shallow water finite and from 0 to
// its bound, at every depth. Control: the code as it was: the logarithm of a wave number of 0 was cast to an int, and
// the table had 2^31 rows (bad_alloc).
TEST(ShallowWaterHard, hard_70_a_film_under_other_waves) {
  for (const double film : {1e-12, 1e-30, 1e-200, 1e-310, least_double}) {
    SeaState sea;
    sea.depth_m = film;
    const ShallowWater water(sea, make_wave_bins(sea, {.resolution = 16, .cascades = 2}), {30.0, 0.2});
    for (const double h : {0.0, least_double, film, 1e-6, 1.0, 1e6, infinity}) {
      for (const float factor : {water.factor(0, h), water.others(h)})
        EXPECT_TRUE(factor >= 0.0f && factor <= float(ShallowWater::most_shoaling)) << film << " " << h;
      EXPECT_TRUE(std::isfinite(water.height_m(h) + water.breaking(h) + water.steepening(0, h)));
    }
  }
}

// Hard 71: Places, times and rates without end: what belongs to places is taken at a finite time for any rate above 0,
// a flow's two patterns count 1 together and stay within half a period for any, and a reader gives what is outside at
// 1e39 m and beyond. Control: the code as it was: a rate of 1e308 made the time infinite, and moving inputs were gone.
TEST(PlaceHard, hard_71_rates_periods_and_places_without_end) {
  PlaceSettings s;
  for (const double rate : {least_double, 1e-300, 30.0, 1e300, 1.7e308})
    for (const double time : {-1e9, 0.0, 0.4, 1e9, 1e300}) {
      s.rate_hz = rate;
      const double taken = place_time_s(s, false, time);
      EXPECT_TRUE(std::isfinite(taken)) << rate << " " << time;
      EXPECT_LE(taken, time + 1e-6 * std::max(1.0, 1.0 / rate) + 1e-9 * std::abs(time)) << rate << " " << time;
      if (rate >= 30.0) {
        EXPECT_NEAR(taken, time, 0.04 + 1e-9 * std::abs(time)) << rate;
      }
      const FlowPhase phase = flow_phase(time, rate);
      EXPECT_TRUE(phase.first >= 0.0 && phase.first <= 1.0) << rate << " " << time;
      EXPECT_LE(std::max(std::abs(phase.first_s), std::abs(phase.second_s)), 0.5 * rate);
    }
  s = {};
  const PlaceValues<glm::vec4> values{
      glm::vec4(7.0f), [](glm::dvec2, double, double) { return glm::vec4(1.0f); }, true, {}};
  PlaceReader<glm::vec4> reader(values, s, 0.0);
  const LodPlacement seen = lod_placement(s.windows, {0.0, 0.0}, {});
  for (const double far : {1e12, 1e39, 1e300, infinity})
    for (const LodPlacement* placement : {&seen, static_cast<const LodPlacement*>(nullptr)})
      EXPECT_EQ(reader(place_reading(s.windows, {far, 0.0}, 0.0, placement), {far, 0.0}).x,
                far > 1e13 || placement != nullptr ? 7.0f : 1.0f)
          << far;
}

// Hard 72: A viewer exactly on a texel's corner, middle and edge, and places exactly at each window's edge, at the
// reach and a float's last place to either side: a constant field comes back to the bit, and a slope of 1 per metre
// within a texel. Control: windows three texels beyond their middle (two are to spare).
TEST(LodFieldHard, hard_72_exactly_at_a_windows_edge) {
  const LodWindowSettings s{.resolution = 32, .slices = 4, .texel_m = 0.5};
  for (const double x : {0.0, 0.25, 0.5, -0.25, 1e6, 1e6 + 0.25})
    for (const double blend : {0.0, 1e-7, 0.999999}) {
      const LodPlacement placement = lod_placement(s, {x, -x}, {1, blend});
      LodField<glm::vec2> field(s, glm::vec2(3.0f, 0.0f), placement);
      for (int i = 0; i < field.slices(); ++i)
        field.each(i, [&](LodIndex w) { field.texel(i, w) = {3.0f, float(field.middle(i, w).x - x)}; });
      const double reach = double(field.windows().reach.x), all = double(field.windows().reach.y);
      for (int slice = 0; slice < s.slices; ++slice)
        for (const double edge : {reach * (1 << slice), 0.75 * reach * (1 << slice), 0.98 * reach * (1 << slice),
                                  0.75 * all, std::min(all, reach * (1 << slice))})
          for (const double off : {-1e-6, 0.0, 1e-6})
            for (const glm::dvec2 way : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0.3, 1), glm::dvec2(-1, -1)}) {
              if (edge > all) continue;
              const glm::vec2 read = field.sample(glm::dvec2(x, -x) + edge * (1.0 + off) * way, 0.0);
              ASSERT_EQ(read.x, 3.0f) << x << " " << edge;
              ASSERT_TRUE(std::isfinite(read.y));
              if (edge * (1.0 + off) <= 0.75 * all * (1.0 - 1e-6)) {
                ASSERT_NEAR(read.y, edge * (1.0 + off) * way.x, 1e-3 * edge + 1e-6 * std::abs(x)) << x << " " << edge;
              }
            }
    }
}

// Hard 73: A closed curve of 1.6e10 m under a pattern of one metre has 1.6e10 waves along it and not a remainder of
// 2^31: its stretch stays within 40 %. Control: the code as it was: the number of periods was cut to an int.
TEST(ShoreLinesHard, hard_73_more_periods_than_an_int_holds) {
  SplineInput spline;
  spline.closed = true;
  for (int i = 0; i < 800; ++i) spline.points.push_back({{i % 2 == 0 ? -1e7 : 1e7, 1e4 * i}, 1000.0, glm::vec4(1.0f)});
  InputSpec spec;
  spec.to = InputTarget::gerstner;
  spec.value = glm::vec4(1.0f);
  spec.shape = spline;
  const ShoreLines lines(std::vector{spec}, 1.0);
  int found = 0;
  for (int i = 1; i < 800; ++i) {
    const ShorePlace there = lines.at({0.0, 1e4 * (i - 0.5)}, 0.0);
    ASSERT_TRUE(std::isfinite(there.bent_m.x + there.bent_m.y));
    if (there.share == 0.0f) continue;
    ++found;
    ASSERT_GT(double(there.stretch), 0.7);
    ASSERT_LT(double(there.stretch), 1.5);
  }
  EXPECT_GT(found, 400);
}

// Hard 74: Foam after steps of 1e-12 s to 1e12 s, in a flow of 10 km/s that shears: each share from 0 to 1 and no
// number that is none; a long step leaves what the gain leaves for ever. Controls: the exponential taken as 1 - rate
// dt; and the code as it was: a place 1e27 texels away cast to a whole number (told by the undefined-behaviour
// sanitizer).
TEST(FoamHard, hard_74_steps_of_any_length) {
  FoamSettings s;
  s.windows = {.resolution = 32, .slices = 2, .texel_m = 0.5};
  for (const bool flows : {false, true})
    for (const double dt : {1e-12, 1e-3, 1.0, 1e6, 1e12}) {
      Foam foam(s);
      if (flows)
        foam.set_flow([](glm::dvec2 at, double) { return glm::vec2(9.9e3f * float(std::sin(at.y)), 3.0f); }, true);
      foam.follow(lod_placement(s.windows, {1.0, 2.0}, {}), 0.0f);
      foam.fill(0.7f);
      const auto gain = [](const FoamRow&, std::span<float> per_s) { std::fill(per_s.begin(), per_s.end(), 0.5f); };
      for (int i = 0; i < 3; ++i) foam.step(dt, gain);
      const double rest = 0.5 / (0.5 + 1.0 / s.life_s);
      for (int slice = 0; slice < 2; ++slice)
        foam.field().each(slice, [&](LodIndex w) {
          const float f = foam.field().texel(slice, w);
          ASSERT_TRUE(f >= 0.0f && f <= 1.0f) << dt;
          if (dt >= 1e6) {
            ASSERT_NEAR(f, rest, 1e-5) << dt;
          }
        });
      EXPECT_FALSE(foam.take_fault());
    }
}

// Hard 75: Droplets of a nanometre to a metre, in air from rest to 1e6 m/s, over times from 0 to 1e9 s: flights finite,
// none faster than it began or the air goes but for its fall, and exact to 1e-9 at a time of 0. Control: exp(-q) taken
// as 1 - q (infinitely fast droplets).
TEST(SprayFlightHard, hard_75_droplets_of_any_size) {
  for (const double diameter : {1e-9, 1e-6, 1e-3, 1.0})
    for (const double wind : {0.0, 1e-300, 20.0, 1e6})
      for (const double t : {0.0, 5e-324, 1e-15, 1e-6, 1.0, 1e9}) {
        const glm::dvec3 v(3.0, 5.0, -1.0), air(wind, 0.0, 0.0);
        const double relaxation = relaxation_s(diameter, glm::length(v - air));
        ASSERT_GT(relaxation, 0.0);
        const Flight flight = fly(v, air, relaxation, 9.81, t);
        const double speed = glm::length(flight.velocity), fall = 9.81 * std::min(t, relaxation);
        ASSERT_TRUE(std::isfinite(speed + glm::length(flight.way))) << diameter << " " << wind << " " << t;
        ASSERT_LE(speed, glm::length(v) + wind + fall + 1e-9 * (wind + fall));
        if (t <= 1e-15 * relaxation) {
          ASSERT_NEAR(glm::length(flight.velocity - v), 0.0, 1e-9 * (1.0 + wind));
        }
        if (t > 0.0 && t < 1e-3 * relaxation) {
          ASSERT_NEAR(flight.way.z / (v.z * t), 1.0, 1e-3 + std::abs(t / relaxation));
        }
      }
  for (const double wind : {0.0, 5e-324, 1e-3, 100.0})
    for (const double height : {0.0, 5e-324, 1.0, 1e300})
      EXPECT_TRUE(std::isfinite(WindProfile(wind, 9.81).at(height)));
}

}  // namespace
}  // namespace seascape
