// On which side of the water a point is where levels, land, currents, dynamic waves and clip count: as queries have it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string_view>
#include <utility>

#include "app/scene.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"
#include "tests/support/allocations.h"

namespace seascape {
namespace {

struct Counts {
  int points = 0, apart = 0, water = 0, air = 0, clipped = 0, uncertain = 0, moved = 0;
};

// Points about the surface within a distance of a place, most of them near it, and a few far above and below.
Counts compare(const SeaView& view, const glm::dvec2& about, double radius_m, double time_s) {
  Counts counts;
  std::mt19937 random(18);
  const auto within = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  while (counts.points < 2000) {
    const glm::dvec2 place(about.x + within(-radius_m, radius_m), about.y + within(-radius_m, radius_m));
    const QueryAnswer water = view.query(place, {.most_iterations = 30});
    if (!water.converged) continue;
    ++counts.points;
    const double off = counts.points % 10 == 0
                           ? within(-60.0, 60.0)
                           : std::copysign(std::exp(within(std::log(1e-3), 1.0)), within(-1.0, 1.0));
    const glm::dvec3 at(place.x, water.height_m + off, place.y);
    if (std::abs(at.y - water.height_m) < 1e-3) continue;
    const bool clipped = view.places().clipped(at, time_s, {.texel_m = felt_place_texel_m}),
               in_water = off < 0.0 && !clipped;
    const WaterSide side = view.side(at);
    if (counts.points % 100 == 0) {
      const test::AllocationCounter counter;
      (void)view.side(at);
      EXPECT_EQ(counter.ours(), 0u);
    }
    EXPECT_EQ(side.in_water, at.y < side.height_m);
    counts.apart += side.in_water != in_water;
    counts.water += in_water;
    counts.air += off > 0.0;
    counts.clipped += clipped && off < 0.0;
    counts.uncertain += !side.certain;
    // What the waves alone say is wrong where places move the water.
    counts.moved += water_side(view.field(), view.tiles(), at).in_water != in_water;
  }
  return counts;
}

// In a lake and a river above the sea, on and around an island, in dynamic waves, in a whirlpool, in a dock that is
// clipped, and on a hill. Controls seen: the side of the waves alone (61 to 850 points a scene); clip left out (349);
// the level left out of where the water may stand (43 in the whirlpool), and the ground (733 on the hill); dynamic
// waves left out of the query (61); rest positions looked for too near (71 to 1,230 uncertain).
TEST(PlaceSideHard, IsThatOfTheWholeSurface) {
  struct Where {
    const char* scene;
    double radius_m;
    std::optional<glm::dvec2> about;  // none: the camera
  };
  for (const auto& [name, radius_m, elsewhere] :
       {Where{"rivers", 60.0}, Where{"lagoon", 60.0}, Where{"rain_pool", 2.0}, Where{"whirlpool", 60.0},
        Where{"harbour_clip", 50.0, {{40.0, -306.0}}}, Where{"harbour_clip", 100.0, {{0.0, -620.0}}}}) {
    const Scene scene = load_scene(name, "medium");
    const glm::dvec2 about = elsewhere.value_or(glm::dvec2(scene.start.position_m.x, scene.start.position_m.z));
    Sea sea(sea_spec(scene));
    for (double time_s = 4.0; time_s < 6.0; time_s += 1.0 / 60.0) sea.advance(time_s, scene.start.position_m);
    const SeaView view = sea.view_at(sea.time_s(), SeaDetail::felt);
    const Counts counts = compare(view, about, radius_m, sea.time_s());
    EXPECT_EQ(counts.apart, 0) << name;
    EXPECT_LE(counts.uncertain, 2) << name;
    EXPECT_GT(counts.air, 600) << name;
    EXPECT_GT(counts.water + counts.clipped, 600) << name;
    EXPECT_GT(counts.moved, 10) << name << ": places or dynamic waves move the water";
    RecordProperty(name, std::to_string(counts.moved) + " otherwise than by the waves alone, " +
                             std::to_string(counts.clipped) + " clipped, " + std::to_string(counts.uncertain) +
                             " uncertain");
  }
}

// The crest of too choppy a wave that folds over itself, in a lake that stands 10 m high everywhere: as in the sea, 10
// m higher. Controls seen: sheets that are turned over counted like others (306 points); the height of the query alone
// (306); rest positions displaced without the level (55).
TEST(PlaceSideHard, KnowsTheSheetsOfAFoldThatALevelLifts) {
  SeaState choppy;
  choppy.chop = 2.0;
  const WaveQuality quality{.resolution = 256, .cascades = 1};
  WaveBins bins = make_wave_bins(choppy, quality);
  for (gpu::WaveBin& bin : bins.bins) bin.amplitude = glm::vec2(0);
  const double turn = bins.ladder[0].rotation_rad, k = 2.0 * 3.14159265 * 3.0 / bins.ladder[0].side_m, a_m = 0.8 / k;
  bins.at(0, 3, 0).amplitude = glm::vec2(float(a_m), 0.0f);
  const WaveField field(choppy, quality, bins);
  WaveTiles tiles;
  field.evaluate(0, tiles);
  PlaceInputs inputs;
  inputs.settings.level_m = 10.0;
  inputs.kinds.push_back(std::make_shared<const Inputs>(InputTarget::level, std::vector<InputSpec>{}));
  const PlaceSea lake(inputs, field);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int folded = 0, apart = 0, otherwise = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = choppy.chop * a_m * 0.5 * unit(random), across = 40.0 * unit(random);
    const glm::dvec3 at(x * std::cos(turn) - across * std::sin(turn), a_m * (0.2 + unit(random)),
                        x * std::sin(turn) + across * std::cos(turn));
    const WaterSide alone = water_side(field, tiles, at),
                    side = lake.side(field, tiles, at + glm::dvec3(0.0, 10.0, 0.0), {});
    folded += alone.sheets > 1;
    otherwise += side.sheets != alone.sheets;
    if (std::abs(at.y - alone.height_m) > 0.02 * a_m) apart += side.in_water != alone.in_water;
  }
  RecordProperty("seen", std::to_string(folded) + " folded, " + std::to_string(otherwise) + " with other sheets");
  EXPECT_GE(folded, 300);
  EXPECT_EQ(apart, 0);
  EXPECT_LE(otherwise, folded / 50);
}

// Where no place moves the water it is water_side() to the bit; a point that is no number is in the air, uncertain.
// Control seen: the placed search there too (it takes the query's height).
TEST(PlaceSideHard, IsTheWavesAloneWhereNothingElseMovesThem) {
  const Scene scene = load_scene("open_sea", "medium");
  Sea sea(sea_spec(scene));
  sea.advance(4.2, scene.start.position_m);
  const SeaView view = sea.view_at(4.2, SeaDetail::felt);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 at(40.0 * unit(random), 1.5 * unit(random), 40.0 * unit(random));
    const WaterSide side = view.side(at), alone = water_side(view.field(), view.tiles(), at);
    ASSERT_EQ(side.in_water, alone.in_water);
    ASSERT_EQ(side.height_m, alone.height_m);
    ASSERT_EQ(side.sheets, alone.sheets);
  }
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(view.side({bad, 0.0, 0.0}).in_water);
    EXPECT_FALSE(view.side({0.0, bad, 0.0}).certain);
  }
}

}  // namespace
}  // namespace seascape
