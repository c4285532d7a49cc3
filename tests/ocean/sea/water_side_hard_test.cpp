// Hard case 18: an eye inside a crest that has folded over itself is on one side of the water, and the flag says what
// the query does.
#include "ocean/sea/water_side.h"

#include <gtest/gtest.h>

#include <random>

#include "ocean/sea/query.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/fold_truth.h"
#include "tests/support/truth.h"

namespace seascape {
namespace {

// One wave along x, 85 texels long, whose crest stands at the origin at time 0.
struct OneWave {
  explicit OneWave(double steepness, double chop) {
    sea.chop = chop;
    WaveBins bins = make_wave_bins(sea, quality);
    for (gpu::WaveBin& bin : bins.bins) bin.amplitude = glm::vec2(0);
    side_m = bins.ladder[0].side_m;
    rotation_rad = bins.ladder[0].rotation_rad;
    k = 2.0 * truth::pi * 3.0 / side_m;
    a = steepness / k;
    bins.at(0, 3, 0).amplitude = glm::vec2(float(a), 0.0f);
    field = std::make_unique<WaveField>(sea, quality, bins);
    field->evaluate(0, tiles);
  }
  // The world place `x` along the wave from its crest and `across`.
  glm::dvec2 place(double x, double across) const {
    return {x * std::cos(rotation_rad) - across * std::sin(rotation_rad),
            x * std::sin(rotation_rad) + across * std::cos(rotation_rad)};
  }
  SeaState sea;
  WaveQuality quality{.resolution = 256, .cascades = 1};
  std::unique_ptr<WaveField> field;
  WaveTiles tiles;
  double side_m = 0.0, rotation_rad = 0.0, k = 0.0, a = 0.0;
};

// A trochoid with 1.2 to 1.9 of the cusp's steepness, against its own formula: above the crest, in its loop, in the
// wedge of air under the overhang and in the water beneath; height_m and the flag say the same; where there is one
// sheet, so does query(). Controls seen: water wherever any sheet is above (35, 243 and 443 points under overhangs
// wrong, and 325 of the next test), sheets that are turned over counted like others (5,245 points, most then
// uncertain); and, counted here, the height of the query alone.
TEST(WaterSideHard, hard_18_in_a_folded_crest_of_one_wave) {
  for (const double fold : {1.2, 1.6, 1.9}) {
    const OneWave wave(fold / 2.0, 2.0);
    const double b = wave.sea.chop * wave.a, over = 0.02 * wave.a;
    int loop = 0, wedge = 0, water = 0, air = 0, wrong = 0, by_query = 0, told_apart = 0, uncertain = 0;
    std::mt19937 random(18);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int n = 0; n < 4000; ++n) {
      // As near the crest as it folds, and beyond.
      const double x = 0.5 * b * unit(random), y = wave.a * (0.2 + 1.0 * unit(random));
      const std::vector<truth::Sheet> sheets = truth::trochoid_sheets(wave.a, b, wave.k, x);
      // Tiles join texels straight: what is nearer to a sheet than that is left out, and where one begins.
      bool near = false;
      for (const truth::Sheet& sheet : sheets) near = near || std::abs(sheet.y - y) < over;
      if (near || sheets.size() != truth::trochoid_sheets(wave.a, b, wave.k, x + over).size() ||
          sheets.size() != truth::trochoid_sheets(wave.a, b, wave.k, x - over).size())
        continue;
      const glm::dvec2 place = wave.place(x, 40.0 * unit(random));
      const WaterSide side = water_side(*wave.field, wave.tiles, {place.x, y, place.y});
      const bool truly = truth::in_water(sheets, y);
      wrong += side.in_water != truly;
      uncertain += !side.certain;
      EXPECT_EQ(side.sheets, int(sheets.size()));
      ASSERT_EQ(side.in_water, y < side.height_m);
      double nearest = 1e9;
      for (const truth::Sheet& sheet : sheets) nearest = std::min(nearest, std::abs(sheet.y - side.height_m));
      EXPECT_LE(nearest, over);
      const bool highest = std::any_of(sheets.begin(), sheets.end(), [&](const truth::Sheet& s) { return s.y > y; });
      int winding = 0;
      for (const truth::Sheet& sheet : sheets) winding += sheet.y > y ? sheet.sign : 0;
      loop += winding == -1, wedge += highest && winding == 0, water += winding == 1, air += !highest;
      QueryAnswer answer;
      query(*wave.field, wave.tiles, {&place, 1}, {&answer, 1});
      by_query += (y < answer.height_m) != truly;
      if (sheets.size() > 1) continue;
      told_apart += (y < answer.height_m) != side.in_water && answer.converged;
      if (answer.converged) {
        EXPECT_NEAR(answer.height_m, side.height_m, over);
      }
    }
    EXPECT_EQ(wrong, 0) << fold;
    EXPECT_EQ(uncertain, 0) << fold;
    EXPECT_EQ(told_apart, 0) << fold;
    EXPECT_GT(by_query, 20) << fold << ": one height a place is not enough";
    EXPECT_GT(std::min({loop, wedge, water, air}), 20) << fold;
    RecordProperty("fold_" + std::to_string(fold), std::to_string(loop) + " in loops, " + std::to_string(wedge) +
                                                       " under overhangs, " + std::to_string(water) +
                                                       " in the water, " + std::to_string(air) + " in the air; " +
                                                       std::to_string(by_query) + " wrong by the query alone");
  }
}

// Six long waves from as many sides, so steep together that crests fold where they meet.
struct Crossing {
  Crossing() {
    sea.chop = 2.0;
    WaveBins bins = make_wave_bins(sea, quality);
    for (gpu::WaveBin& bin : bins.bins) bin.amplitude = glm::vec2(0);
    const double step = 2.0 * truth::pi / bins.ladder[0].side_m;
    std::mt19937 random(12);
    for (const glm::ivec2 m : {glm::ivec2(3, 0), {2, 3}, {4, -1}, {1, 4}, {5, 2}, {-2, 3}}) {
      const double phase = 2.0 * truth::pi * double(random()) / 4294967296.0,
                   size = 0.25 / (step * glm::length(glm::dvec2(m)));
      bins.at(0, m.x, m.y).amplitude = glm::vec2(glm::dvec2(size * std::cos(phase), size * std::sin(phase)));
    }
    field = std::make_unique<WaveField>(sea, quality, bins);
    field->evaluate(ticks_from_seconds(3), tiles);
  }
  truth::Point3 stands(double x, double z) const {
    const glm::dvec3 d = field->displacement(tiles, {x, z}, 0.0);
    return {x + d.x, d.y, z + d.z};
  }
  // Places where the surface folds.
  std::vector<glm::dvec2> folds(std::size_t count) const {
    std::vector<glm::dvec2> places;
    for (int i = 0; places.size() < count && i < 100000; ++i) {
      const glm::dvec2 rest(i * 37 % 631 * 1.3, i * 37 / 631 * 1.3);
      if (field->sea(tiles, rest, 0.0).jacobian() > -0.1) continue;
      const truth::Point3 p = stands(rest.x, rest.y);
      places.push_back({p.x, p.z});
      i += 400;
    }
    return places;
  }
  SeaState sea;
  WaveQuality quality{.resolution = 256, .cascades = 1};
  std::unique_ptr<WaveField> field;
  WaveTiles tiles;
};

// Folds of a sea of more directions, and anywhere of it, against a raster of triangles of all rest positions that the
// place may come from. Control seen: water wherever any sheet is above (325 points wrong).
TEST(WaterSideHard, hard_18_in_folds_where_crests_meet) {
  const Crossing sea;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<glm::dvec2> places = sea.folds(24);
  ASSERT_EQ(places.size(), 24u);
  for (int n = 0; n < 8; ++n) places.push_back({1e5 + 300.0 * unit(random), -2e5 + 300.0 * unit(random)});
  const double reach = sea.field->statistics().largest_shift_m;
  int checked = 0, folded = 0, wrong = 0, by_query = 0;
  for (const glm::dvec2& place : places) {
    const auto sheets = truth::raster_sheets([&](double x, double z) { return sea.stands(x, z); }, place.x, place.y,
                                             reach, reach / 250.0);
    for (int n = 0; n < 40; ++n) {
      const double y = sheets.at(std::size_t(n) % sheets.size()).y + 2.0 * unit(random);
      if (std::any_of(sheets.begin(), sheets.end(), [&](const truth::Sheet& s) { return std::abs(s.y - y) < 0.05; }))
        continue;
      const WaterSide side = water_side(*sea.field, sea.tiles, {place.x, y, place.y});
      const bool truly = truth::in_water(sheets, y);
      EXPECT_TRUE(side.certain);
      EXPECT_EQ(side.sheets, int(sheets.size()));
      EXPECT_EQ(side.in_water, y < side.height_m);
      QueryAnswer answer;
      query(*sea.field, sea.tiles, {&place, 1}, {&answer, 1});
      wrong += side.in_water != truly;
      by_query += (y < answer.height_m) != truly;
      folded += sheets.size() > 1;
      ++checked;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(by_query, 10);
  EXPECT_GT(folded, 300);
  RecordProperty("checked", std::to_string(checked) + ", folded " + std::to_string(folded) +
                                ", wrong by the query alone " + std::to_string(by_query));
}

// A gale with chop 2 and all its short waves, which fold on its crests. Where one sheet stands and the query has
// converged, both say the same. Control seen: squares not grown by what waves shorter than they are may shift, and
// whether the sheets are a whole not asked.
TEST(WaterSideHard, hard_18_in_a_gale_the_flag_equals_the_query) {
  SeaState state;
  state.wind_speed_mps = 25.0;
  state.chop = 2.0;
  const WaveField field(state, {.resolution = 128, .cascades = 5});
  WaveTiles tiles;
  field.evaluate(0, tiles);
  std::vector<glm::dvec2> places;
  for (int i = 0; i < 200000 && places.size() < 30; ++i) {
    const glm::dvec2 rest(i % 547 * 0.9, i / 547 * 0.9);
    const SeaSample sample = field.sea(tiles, rest, 0.0);
    if (sample.jacobian() < -0.1) places.push_back(rest + glm::dvec2(sample.displacement.x, sample.displacement.z));
  }
  ASSERT_EQ(places.size(), 30u);
  for (int i = 0; i < 60; ++i) places.push_back({i * 7.7, i * i * 0.9});
  int folded = 0, plain = 0, apart = 0, uncertain = 0;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const glm::dvec2& place : places) {
    QueryAnswer answer;
    query(field, tiles, {&place, 1}, {&answer, 1}, {.most_iterations = 30});
    for (int n = 0; n < 4; ++n) {
      const double y = answer.height_m + 0.3 * unit(random);
      const WaterSide side = water_side(field, tiles, {place.x, y, place.y});
      ASSERT_EQ(side.in_water, y < side.height_m);
      uncertain += !side.certain;
      folded += side.sheets > 1;
      if (side.sheets > 1 || !answer.converged || std::abs(y - answer.height_m) < 0.01) continue;
      ++plain;
      apart += side.in_water != (y < answer.height_m);
      EXPECT_NEAR(side.height_m, answer.height_m, 0.01);
    }
  }
  EXPECT_EQ(apart, 0);
  EXPECT_EQ(uncertain, 0);
  EXPECT_GT(plain, 150);
  EXPECT_GT(folded, 80);
  RecordProperty("gale", std::to_string(folded) + " folded, " + std::to_string(plain) + " plain, " +
                             std::to_string(uncertain) + " uncertain");
}

// A thousand frames of an eye that trembles by a micrometre in a fold, and of one that stands at the surface to the
// bit: no flicker. Control, in the test: an eye that trembles by 2 m changes sides.
TEST(WaterSideHard, hard_17_and_18_an_eye_keeps_its_side) {
  const Crossing sea;
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int flips = 0, moved = 0;
  for (const glm::dvec2& place : sea.folds(6)) {
    const WaterSide about = water_side(*sea.field, sea.tiles, {place.x, 0.0, place.y});
    for (const double y : {about.height_m - 0.3, about.height_m + 0.3}) {
      const WaterSide first = water_side(*sea.field, sea.tiles, {place.x, y, place.y});
      for (int n = 0; n < 80; ++n) {
        const glm::dvec3 off = 1e-6 * glm::dvec3{unit(random), unit(random), unit(random)};
        flips += water_side(*sea.field, sea.tiles, glm::dvec3(place.x, y, place.y) + off).in_water != first.in_water;
        moved +=
            water_side(*sea.field, sea.tiles, glm::dvec3(place.x, y, place.y) + 2e6 * off).in_water != first.in_water;
      }
    }
    const WaterSide at = water_side(*sea.field, sea.tiles, {place.x, about.height_m, place.y});
    for (int n = 0; n < 170; ++n) {
      const WaterSide again = water_side(*sea.field, sea.tiles, {place.x, about.height_m, place.y});
      ASSERT_EQ(again.in_water, at.in_water);
      ASSERT_EQ(again.height_m, at.height_m);
    }
  }
  EXPECT_EQ(flips, 0);
  EXPECT_GT(moved, 10) << "the control: an eye that trembles by 2 m";
}

// Two eyes 64 mm apart on a rolled head whose middle lies at the water's surface, 2,000 times in a gale: each eye's
// side is what its own query says (where that converges and there is one sheet), and in a quarter of them and more one
// eye is in the water and the other is not. (No picture has a waterline yet: this is what it will be drawn from.)
// Control, in the test: the middle's side for both eyes is wrong as often.
TEST(WaterSideHard, hard_38_an_eye_in_the_water_and_one_in_the_air) {
  SeaState state;
  state.wind_speed_mps = 18.0;
  const WaveField field(state, {.resolution = 64, .cascades = 4});
  WaveTiles tiles;
  field.evaluate(ticks_from_seconds(11.0), tiles);
  std::mt19937 random(38);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int asked = 0, apart = 0, by_the_middle = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec2 place(3000.0 * unit(random), 3000.0 * unit(random));
    QueryAnswer middle;
    query(field, tiles, {&place, 1}, {&middle, 1}, {.most_iterations = 30, .tolerance_m = 1e-5});
    const double roll = truth::pi * unit(random), yaw = truth::pi * unit(random);
    const glm::dvec3 off =
        0.032 * glm::dvec3(std::cos(roll) * std::cos(yaw), std::sin(roll), std::cos(roll) * std::sin(yaw));
    bool in[2] = {};
    for (int eye = 0; eye < 2; ++eye) {
      const glm::dvec3 at = glm::dvec3(place.x, middle.height_m, place.y) + (eye == 0 ? off : -off);
      const glm::dvec2 under(at.x, at.z);
      const WaterSide side = water_side(field, tiles, at);
      QueryAnswer own;
      query(field, tiles, {&under, 1}, {&own, 1}, {.most_iterations = 30, .tolerance_m = 1e-5});
      in[eye] = side.in_water;
      if (side.sheets != 1 || !own.converged || std::abs(at.y - own.height_m) < 2e-3) continue;
      ++asked;
      ASSERT_EQ(side.in_water, at.y < own.height_m) << i;
      by_the_middle += (at.y < own.height_m) != (middle.height_m + 1e-9 * unit(random) < middle.height_m);
    }
    apart += in[0] != in[1];
  }
  EXPECT_GT(asked, 2500);
  EXPECT_GT(apart, 500);
  EXPECT_GT(by_the_middle, 500);
}

TEST(WaterSideHard, EveryPlaceHasASide) {
  const Crossing sea;
  for (const double y : {1e3, 1e300}) {
    EXPECT_FALSE(water_side(*sea.field, sea.tiles, {5.0, y, 7.0}).in_water);
    EXPECT_TRUE(water_side(*sea.field, sea.tiles, {5.0, -y, 7.0}).in_water);
  }
  const WaterSide nowhere = water_side(*sea.field, sea.tiles, {5.0, std::nan(""), 7.0});
  EXPECT_FALSE(nowhere.in_water || nowhere.certain);
  SeaState still;
  still.wind_speed_mps = 0.0;
  const WaveField flat(still, {.resolution = 16, .cascades = 1});
  WaveTiles tiles;
  flat.evaluate(0, tiles);
  EXPECT_TRUE(water_side(flat, tiles, {1.0, -1e-9, 2.0}).in_water);
  EXPECT_FALSE(water_side(flat, tiles, {1.0, 0.0, 2.0}).in_water);
}

}  // namespace
}  // namespace seascape
