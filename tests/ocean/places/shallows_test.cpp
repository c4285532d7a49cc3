// The sea over a bed: what places make of its waves, the ground above it, and the query that finds both.
#include "ocean/places/shallows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "ocean/sea/place_sea.h"
#include "ocean/waves/gerstner.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/found_surface.h"
#include "tests/support/place_truth.h"

namespace seascape {
namespace {

constexpr double sea_depth_m = 40.0;

SeaState fresh() {
  SeaState sea;
  sea.wind_speed_mps = 9.0;
  sea.depth_m = sea_depth_m;
  sea.chop = 0.7;
  return sea;
}

InputSpec bed(float height_m, double size_m, double feather_m) {
  InputSpec spec;
  spec.to = InputTarget::sea_depth;
  spec.blend = InputBlend::replace;
  spec.value = {height_m, 0.0f, 0.0f, 0.0f};
  spec.feather_m = feather_m;
  spec.shape = AreaInput{.round = true, .at_m = {0.0, 0.0}, .size_m = {size_m, size_m}};
  return spec;
}

InputSpec lake(float height_m) {
  InputSpec spec = bed(height_m, 500.0, 0.0);
  spec.to = InputTarget::level;
  spec.blend = InputBlend::add;
  return spec;
}

// A bank two metres deep, 160 m wide at its top, and an island in its middle that stands four metres high.
std::vector<InputSpec> island() { return {bed(-2.0f, 240.0, 40.0), bed(4.0f, 60.0, 20.0)}; }

PlaceInputs inputs_of(const std::vector<InputSpec>& specs) {
  PlaceInputs result;
  for (const InputTarget kind : {InputTarget::level, InputTarget::sea_depth, InputTarget::flow}) {
    auto inputs = std::make_shared<const Inputs>(kind, specs);
    if (!inputs->empty()) result.kinds.push_back(std::move(inputs));
  }
  return result;
}

class ShallowsTest : public ::testing::Test {
 protected:
  ShallowsTest() : field(fresh(), WaveQuality{.resolution = 64, .cascades = 3}), tiles(true) {
    field.evaluate(ticks_from_seconds(12.5), tiles);
  }
  std::shared_ptr<const Shallows> shallows(const std::vector<InputSpec>& specs) const {
    return make_shallows(field.state(), field.bins(), field.others(), inputs_of(specs));
  }
  test::PlaceTruth sea(const std::vector<InputSpec>& specs) const { return test::PlaceTruth(inputs_of(specs), field); }
  WaveField field;
  WaveTiles tiles;
};

TEST_F(ShallowsTest, WithoutABedThereAreNone) {
  EXPECT_EQ(shallows({}), nullptr);
  EXPECT_FALSE(sea({}).moves());
}

// Far from all inputs nothing is changed; over the bank less of every wave is left, and on the dry island nothing but
// the run-up; of a cascade that this quality has not, as much as of the shortest that it has. Controls seen: the
// shelter left out of the shares (the lee is as rough as the windward side); the run-up everywhere.
TEST_F(ShallowsTest, WavesChangeOverTheBankAndEndAtTheShore) {
  const auto s = shallows(island());
  const glm::dvec2 open(20000.0, 3000.0), bank(-90.0, 20.0), land(2.0, -3.0);
  EXPECT_NEAR(s->bed_m(open, 0.0, 0.0), -sea_depth_m, 1e-4);
  EXPECT_NEAR(s->bed_m(land, 0.0, 0.0), 4.0, 1e-4);
  const PlaceWaves far = s->waves(open, sea_depth_m), over = s->waves(bank, 2.0), dry = s->waves(land, -4.0);
  for (int i = 0; i < gpu::max_cascades; ++i) {
    EXPECT_NEAR(far.share[std::size_t(i)], 1.0f, 2e-3f) << i;
    EXPECT_LT(over.share[std::size_t(i)], 0.9f) << i;
    EXPECT_EQ(dry.share[std::size_t(i)], 0.0f) << i;
  }
  EXPECT_EQ(far.share[4], far.share[2]);
  EXPECT_NEAR(far.swash, 0.0f, 1e-3f);
  EXPECT_GT(dry.swash, 0.05f);
  EXPECT_LT(dry.swash, 0.5f);
  EXPECT_GE(s->most_share(), 1.0);
  EXPECT_LT(s->most_share(), 1.5) << "breaking holds what shoaling raises";
  // Waves break at the shore and on the bank, not in the open, and no more than come there.
  EXPECT_LT(s->surf(open, sea_depth_m), 1e-3);
  EXPECT_EQ(s->surf(land, -4.0), 0.0);
  EXPECT_GT(s->surf({-60.0, 30.0}, 0.5), s->surf({-60.0, 30.0}, 2.0));
  EXPECT_LE(s->surf({-60.0, 30.0}, 1e-6), 1.0);
  // Waves go to +x and -z: what lies beyond the island has less of them.
  const glm::dvec2 down = s->direction(0), lee = 60.0 * down, windward = -60.0 * down;
  EXPECT_LT(s->waves(lee, 2.0).share[0], 0.8f * s->waves(windward, 2.0).share[0]);
}

// Waves that the scene puts along curves break at the height that they and what comes of the sea have together: on the
// windward bank nearly as the sea does, in the lee of the island and without a sea by their own; and the sea's waves
// are as if they were not there. Controls seen: the sea's height everywhere (the lee as the windward side); none of it
// (the same); their height among that of the sea's waves.
TEST_F(ShallowsTest, WavesThatTheScenePutsBreakByWhatComesThere) {
  GerstnerSettings settings;
  settings.set1 = {.height_m = 0.4, .wavelength_m = 14.0, .shore = true};
  const TileSources along{std::make_shared<const Gerstner>(settings, 9.81, sea_depth_m, 0.0, true)};
  const auto made = [&](const WaveField& of) {
    return make_shallows(of.state(), of.bins(), along, inputs_of(island()));
  };
  const auto here = made(field), without = shallows(island());
  SeaState flat = fresh();
  flat.wind_speed_mps = 0.0;
  const auto alone = made(WaveField(flat, WaveQuality{.resolution = 64, .cascades = 3}));
  const glm::dvec2 open(20000.0, 3000.0), lee = 60.0 * here->direction(0), windward = -90.0 * here->direction(0);
  EXPECT_NEAR(here->placed(open, sea_depth_m).share, 1.0, 2e-3);
  EXPECT_LT(here->placed(open, sea_depth_m).surf, 1e-3);
  for (const double depth : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(here->placed(open, depth).share, 0.0);
  EXPECT_EQ(without->placed(open, 2.0).share, 0.0);
  for (const double depth : {0.3, 0.6, 1.2}) {
    const Shallows::Placed own = alone->placed(lee, depth), sheltered = here->placed(lee, depth),
                           struck = here->placed(windward, depth);
    const double most = 0.42 * std::sqrt(2.0) * depth;
    EXPECT_LT(0.4 * own.share, most);
    EXPECT_GT(0.4 * own.share, 0.85 * std::min(most, 0.4)) << depth;
    EXPECT_LT(struck.share, sheltered.share) << depth;
    EXPECT_LE(sheltered.share, own.share);
    EXPECT_LT(sheltered.surf, struck.surf);
    EXPECT_GE(sheltered.surf, own.surf);
    EXPECT_GT(struck.surf, 0.5);
    for (const glm::dvec2 at : {lee, windward})
      for (int i = 0; i < 3; ++i)
        EXPECT_EQ(here->waves(at, depth).share[std::size_t(i)], without->waves(at, depth).share[std::size_t(i)]);
  }
}

// What lies in the lee of land has lost its long waves and not its ripples, which grow again within some hundred
// metres; without wind nothing does. Control seen: all cascades sheltered alike.
TEST_F(ShallowsTest, RipplesGrowAgainInTheLee) {
  const WaveQuality all{.resolution = 64, .cascades = 5};
  const glm::dvec2 lee = 75.0 * shallows(island())->direction(0);
  const auto lost = [&](const SeaState& sea) {
    const WaveField five(sea, all);
    const PlaceWaves waves = make_shallows(sea, five.bins(), {}, inputs_of(island()))->waves(lee, 4.0);
    return std::pair(waves.share[0], waves.share[4]);
  };
  SeaState swell = fresh();
  const auto [long_waves, ripples] = lost(swell);
  EXPECT_GT(ripples, 1.3f * long_waves);
  EXPECT_GT(ripples, 0.85f);
  swell.wind_speed_mps = 0.0;
  swell.swell_height_m = 1.0;
  EXPECT_TRUE(std::isfinite(lost(swell).second));
}

// Stockdon et al. (2006), eq. 12, of this sea's height and mean period. Control seen: 0.06 of H0 alone.
TEST_F(ShallowsTest, RunUpIsThatOfMeasuredBeaches) {
  const auto s = shallows(island());
  double variance = 0.0, frequency = 0.0, of_swash = 0.0;
  for (int i = 0; i < 3; ++i) {
    const MeanWave wave = mean_wave(field.state(), field.bins(), i);
    variance += wave.variance;
    if (i < 2) of_swash += wave.variance;
    frequency += wave.variance * wave.frequency;
  }
  const double period = 2.0 * 3.14159265358979 * variance / frequency,
               length = 9.81 * period * period / (2.0 * 3.14159265358979);
  EXPECT_NEAR(variance, field.statistics().height_variance, 0.02 * variance);
  EXPECT_NEAR(s->swash_m(), 0.06 * std::sqrt(4.0 * std::sqrt(variance) * length), 1e-6);
  EXPECT_NEAR(s->run_up_m() / s->swash_m(), 0.043 / 0.06, 1e-9);
  // The two longest cascades run up by all of it. Control: the share of three (tests/mutants).
  EXPECT_NEAR(double(s->waves({1e6, 0.0}, 1e-4).swash) * 4.0 * std::sqrt(of_swash), s->swash_m(), 1e-3 * s->swash_m());
}

// Hard case 6: where the bed stands at the water or above there is no water wave, no division and nothing that is no
// number. Control seen: shallow water's tables read without their case of no depth (the logarithm of a negative depth).
TEST_F(ShallowsTest, hard_6_dry_places_are_finite) {
  const auto s = shallows(island());
  for (const double depth :
       {0.0, -0.0, -1e-9, -5.0, 1e-9, 1e9, std::numeric_limits<double>::infinity(), std::nan("")}) {
    const PlaceWaves waves = s->waves({3.0, 4.0}, depth);
    for (const float share : waves.share) EXPECT_TRUE(std::isfinite(share) && share >= 0.0f) << depth;
    EXPECT_TRUE(std::isfinite(waves.others) && std::isfinite(waves.swash)) << depth;
  }
  const PlaceWaves nowhere = s->waves({std::nan(""), 0.0}, 3.0);
  for (const float shift : nowhere.shift_m) EXPECT_EQ(shift, 0.0f);
  SeaState none = fresh();
  none.depth_m = -1.0;
  const WaveField land(none, WaveQuality{.resolution = 32, .cascades = 2});
  const auto dry = make_shallows(none, land.bins(), {}, inputs_of(island()));
  EXPECT_TRUE(std::isfinite(dry->swash_m()) && std::isfinite(dry->most_share()));
}

// The ground is what a query finds on land: its height and normal, at rest. Control seen: land that has the velocity of
// the run-up over it.
TEST_F(ShallowsTest, LandIsFoundAsItStands) {
  const test::PlaceTruth place = sea(island());
  for (const glm::dvec2 asked : {glm::dvec2(0.0, 0.0), glm::dvec2(14.0, 3.0), glm::dvec2(-12.0, 12.0)}) {
    QueryAnswer answer;
    place.query(field, tiles, {&asked, 1}, {&answer, 1});
    const auto ground = [&](glm::dvec2 at) { return place.shallows()->bed_m(at, 0.0, 0.0); };
    ASSERT_GT(ground(asked), 0.3);
    EXPECT_TRUE(answer.converged);
    EXPECT_NEAR(answer.height_m, ground(asked), 1e-3);  // between texels of a quarter of a metre
    EXPECT_EQ(answer.orbital_velocity_mps, glm::dvec3(0.0));
    const double e = 0.25;
    const glm::dvec3 normal =
        glm::normalize(glm::dvec3(ground(asked - glm::dvec2(e, 0.0)) - ground(asked + glm::dvec2(e, 0.0)), 2.0 * e,
                                  ground(asked - glm::dvec2(0.0, e)) - ground(asked + glm::dvec2(0.0, e))));
    EXPECT_GT(glm::dot(normal, answer.normal), 0.9999);
  }
}

// The gradients that a sample has are those of the surface, heights a little to either side, over the bank, its slope
// and about the shore as well as in the open: the derivatives' tiles miss what lies between texels of the heights'.
// Controls seen (0.120 with the bed, 0.132 without): the bend of a pattern left out (0.36), the shares' own gradient
// left out (0.144).
TEST_F(ShallowsTest, GradientsAreThoseOfTheSurface) {
  const WaveField fine(fresh(), WaveQuality{.resolution = 256, .cascades = 2});
  WaveTiles waves;
  fine.evaluate(ticks_from_seconds(12.5), waves);
  const auto missed = [&](const test::PlaceTruth& place) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(-130.0, 130.0);
    double off2 = 0.0, all2 = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec2 rest(at(random), at(random));
      const auto height = [&](glm::dvec2 p) { return place.sea(fine, waves, p, 0.0).displacement.y; };
      constexpr double e = 0.25;
      if (std::abs(place.shallows()->bed_m(rest, 0.0, 0.0)) < 0.4)
        continue;  // the surface has an edge where the ground begins
      const glm::dvec2 rise(height(rest + glm::dvec2(e, 0.0)) - height(rest - glm::dvec2(e, 0.0)),
                            height(rest + glm::dvec2(0.0, e)) - height(rest - glm::dvec2(0.0, e)));
      const glm::dvec2 got = place.sea(fine, waves, rest, 0.0).height_gradient, off = got - rise / (2.0 * e);
      off2 += glm::dot(off, off);
      all2 += glm::dot(got, got);
    }
    return std::sqrt(off2 / all2);
  };
  const double open = missed(test::PlaceTruth(inputs_of({bed(-float(sea_depth_m), 100.0, 1.0)}), fine));
  EXPECT_LT(open, 0.15);
  EXPECT_LT(missed(test::PlaceTruth(inputs_of(island()), fine)), 1.05 * open);
}

// Every point that a query finds is one of the surface, over the bank and about its shore.
TEST_F(ShallowsTest, QueriesFindTheSurface) {
  const test::PlaceTruth place = sea(island());
  EXPECT_GT(test::expect_found_on_surface(place, field, tiles, 5, 130.0, [](glm::dvec2, const QueryAnswer&) {}), 190);
}

// A lake's depth is that of its own water: the same bank under a lake two metres higher has the waves of a bank of four
// metres. Control seen: depth from y = 0.
TEST_F(ShallowsTest, DepthIsFromTheStillWater) {
  std::vector<InputSpec> specs = island();
  specs.push_back(lake(2.0f));
  const test::PlaceTruth place = sea(specs);
  const glm::dvec2 bank(-60.0, 30.0);
  EXPECT_NEAR(place.shallows()->still_m(bank, 0.0, 0.0) - place.shallows()->bed_m(bank, 0.0, 0.0), 4.0, 1e-4);
  const test::PlaceTruth deeper = sea({bed(-4.0f, 240.0, 40.0), bed(2.0f, 60.0, 20.0)}), alone = sea(island());
  double off2 = 0.0, other2 = 0.0;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec2 at = bank + glm::dvec2(0.07 * i, -0.05 * i);
    const double here = place.sea(field, tiles, at, 0.0).displacement.y - 2.0;
    const double off = here - deeper.sea(field, tiles, at, 0.0).displacement.y,
                 other = here - alone.sea(field, tiles, at, 0.0).displacement.y;
    off2 += off * off, other2 += other * other;
  }
  EXPECT_LT(off2, 0.02 * other2);
}

// In a current the two patterns of every cascade are carried, over a bed as over none, and the sea stays as high.
TEST_F(ShallowsTest, ACurrentCarriesWavesOverABed) {
  PlaceInputs inputs = inputs_of(island());
  inputs.settings.flow_mps = 12.0;
  inputs.settings.flow_to_deg = 90.0;
  inputs.kinds.push_back(std::make_shared<const Inputs>(InputTarget::flow, std::vector<InputSpec>{}));
  const test::PlaceTruth with(inputs, field), without = sea(island());
  field.evaluate(ticks_from_seconds(12.2), tiles);
  double carried = 0.0, still = 0.0, together = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec2 at(-100.0 + 0.35 * (i % 50), -60.0 + 3.1 * (i / 50));
    const double a = with.sea(field, tiles, at, 0.0).displacement.y,
                 b = without.sea(field, tiles, at, 0.0).displacement.y;
    carried += a * a, still += b * b, together += a * b;
  }
  EXPECT_NEAR(carried / still, 1.0, 0.35);
  EXPECT_LT(together / std::sqrt(carried * still), 0.98) << "nothing is carried";
}

// Hard case 35 of the bed: heights at the ends of what an input takes are kept, and the waves there are finite.
TEST_F(ShallowsTest, ExtremeBedsAreFinite) {
  for (const float height : {-12000.0f, 12000.0f, 0.0f}) {
    const test::PlaceTruth place = sea({bed(height, 240.0, 40.0)});
    for (double x = -140.0; x <= 140.0; x += 7.0) {
      const SeaSample s = place.sea(field, tiles, {x, 1.0}, 0.5);
      EXPECT_TRUE(std::isfinite(s.displacement.x + s.displacement.y + s.displacement.z + s.height_gradient.x +
                                s.height_gradient.y))
          << height << ' ' << x;
    }
  }
}

}  // namespace
}  // namespace seascape
