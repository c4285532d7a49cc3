// Gerstner waves along curves on the processor: as the waves everywhere where the curve is straight, and crests along
// it that come in as fast as they must.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <random>

#include "ocean/places/place_reader.h"
#include "ocean/sea/place_sea.h"
#include "ocean/waves/gerstner.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/place_truth.h"

namespace seascape {
namespace {

SeaState flat() {
  SeaState sea;
  sea.wind_speed_mps = 0.0;
  return sea;
}

InputSpec spline(const std::vector<glm::dvec2>& points, double width, double feather, bool closed = false) {
  InputSpec spec;
  spec.to = InputTarget::gerstner;
  spec.feather_m = feather;
  SplineInput shape;
  shape.closed = closed;
  for (const glm::dvec2 at : points) shape.points.push_back({at, width, glm::vec4(1.0f, 0.0f, 0.0f, 0.0f)});
  spec.shape = shape;
  return spec;
}

std::vector<glm::dvec2> bay() { return {{-120, 30}, {-60, 0}, {-10, -34}, {50, -30}, {90, 10}, {150, 24}}; }

GerstnerSettings one_wave(double to_deg) {
  GerstnerSettings s;
  s.set1 = {.height_m = 1.0, .wavelength_m = 24.0, .to_deg = to_deg};
  return s;
}
GerstnerSettings many() {
  GerstnerSettings s;
  s.set1 = {.height_m = 0.9, .wavelength_m = 26.0, .spread_deg = 40.0, .octaves = 2, .waves = 6};
  s.chop = 0.7;
  return s;
}

// Waves along curves, and the sea around them; nothing else but `inputs`.
struct Shore {
  Shore(GerstnerSettings settings, const std::vector<InputSpec>& specs, double time_s, const PlaceInputs& others = {})
      : tiles(true) {
    settings.set1.shore = true;
    tile = std::make_shared<const Gerstner>(settings, 9.81, 1e6, 0.0, true);
    field = std::make_unique<WaveField>(flat(), WaveQuality{.resolution = 16, .cascades = 1}, TileSources{tile});
    PlaceInputs inputs = others;
    inputs.shore = std::make_shared<const ShoreLines>(specs, tile->side_m());
    place = std::make_unique<test::PlaceTruth>(inputs, *field);
    at(time_s);
  }
  void at(double time_s) { field->evaluate(ticks_from_seconds(time_s), tiles); }
  SeaSample sea(glm::dvec2 rest, double footprint = 0.0) const { return place->sea(*field, tiles, rest, footprint); }
  QueryAnswer query(glm::dvec2 at) const {
    QueryAnswer answer;
    place->query(*field, tiles, {&at, 1}, {&answer, 1});
    return answer;
  }
  std::shared_ptr<const Gerstner> tile;
  std::unique_ptr<WaveField> field;
  std::unique_ptr<test::PlaceTruth> place;
  WaveTiles tiles;
};

// Along a straight curve of any direction the set is the set everywhere that goes to its left, to 1e-5 m; displacement,
// derivatives and velocity. Controls seen: the shore on the right; a displacement that is not turned; the shift's
// derivatives along and across changed about.
TEST(ShoreSea, AlongAStraightCurveItIsTheSetEverywhere) {
  for (const double heading_deg : {90.0, 0.0, 37.0, 215.0}) {  // of the curve
    const double heading = heading_deg * std::numbers::pi / 180.0;
    const glm::dvec2 along(std::sin(heading), -std::cos(heading));
    const Shore shore(one_wave(0.0), {spline({glm::dvec2(0.0), 60.0 * along, 400.0 * along}, 100.0, 5.0)}, 17.3);
    const double to_deg = heading_deg - 90.0 < 0.0 ? heading_deg + 270.0 : heading_deg - 90.0;
    const WaveField everywhere(flat(), WaveQuality{.resolution = 16, .cascades = 1},
                               TileSources{std::make_shared<const Gerstner>(one_wave(to_deg))});
    WaveTiles tiles(true);
    everywhere.evaluate(ticks_from_seconds(17.3), tiles);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> s(10.0, 380.0), z(-40.0, 40.0);
    for (int i = 0; i < 300; ++i) {
      const glm::dvec2 rest = s(random) * along + z(random) * glm::dvec2(-along.y, along.x);
      const SeaSample a = shore.sea(rest), b = everywhere.sea(tiles, rest, 0.0);
      ASSERT_LT(glm::distance(a.displacement, b.displacement), 1e-5) << heading_deg;
      ASSERT_LT(glm::distance(a.height_gradient, b.height_gradient), 1e-5);
      ASSERT_LT(glm::distance(a.shift_gradient, b.shift_gradient), 1e-5);
      const QueryAnswer q = shore.query(rest);
      QueryAnswer of_all;
      query(everywhere, tiles, {&rest, 1}, {&of_all, 1});
      ASSERT_NEAR(q.height_m, of_all.height_m, 1e-3);
      ASSERT_LT(glm::distance(q.orbital_velocity_mps, of_all.orbital_velocity_mps), 1e-3);
    }
  }
}

// Crests are parallel to the curve, and come in to its left at the speed of deep water, sqrt(g / k). The phase across
// the curve is that of the best fitting wave. Controls seen: the pattern's z the other way about; the way along the
// curve taken for the distance.
TEST(ShoreSea, CrestsFollowTheCurveAndComeIn) {
  GerstnerSettings settings = one_wave(0.0);
  settings.chop = 0.0;
  Shore shore(settings, {spline(bay(), 80.0, 8.0)}, 0.0);
  const ShoreLines lines(std::vector<InputSpec>{spline(bay(), 80.0, 8.0)}, shore.tile->side_m());
  const double k = 2.0 * std::numbers::pi / 24.0, w = std::sqrt(9.81 * k);
  // Places of the middle of the curve, by going to where the distance is 0.
  std::vector<ShorePlace> feet;
  std::vector<glm::dvec2> at;
  for (double x = -80.0; x < 110.0; x += 12.0) {
    glm::dvec2 p(x, 0.0);
    for (int i = 0; i < 60; ++i) {
      const ShorePlace here = lines.at(p, 40.0);
      p.y -= here.bent_m.y * here.right().y;
    }
    const ShorePlace here = lines.at(p, 0.0);
    if (std::abs(here.bent_m.y) > 1e-6 || here.share < 0.99f) continue;
    feet.push_back(here), at.push_back(p);
  }
  ASSERT_GT(feet.size(), 10u);
  const auto phase = [&](std::size_t foot, double time_s) {
    shore.at(time_s);
    std::complex<double> sum = 0.0;
    for (int i = 0; i < 96; ++i) {
      const double right = 12.0 * (2.0 * i / 96.0 - 1.0);
      const glm::dvec2 p = at[foot] + right * feet[foot].right();
      sum += double(shore.sea(p).displacement.y) / std::max(double(lines.at(p, 0.0).share), 0.2) *
             std::polar(1.0, k * right);
    }
    return std::arg(sum);
  };
  const auto turned = [](double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); };
  const double first = phase(0, 3.0);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    EXPECT_NEAR(turned(phase(i, 3.0) - first), 0.0, 0.03) << "crests lie along the curve";
    // cos(k left - w t) = cos(-k right - w t): what is seen at a place lags by w t.
    EXPECT_NEAR(turned(phase(i, 3.4) - phase(i, 3.0) + w * 0.4), 0.0, 0.03) << "to the left";
  }
}

// Normals of queries are those of the heights around, along bends and where the waves fade, as nearly as along a
// straight line (whose tile is bilinear: a sixth of a degree on average). Controls seen: without what the share changes
// by (0.58 degrees); without the stretch (0.21); the stretch of a bend's other side (0.31).
TEST(ShoreSea, NormalsAreThoseOfTheHeights) {
  const auto off_deg = [&](const InputSpec& curve) {
    const Shore shore(many(), {curve}, 41.0);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> x(-120.0, 150.0), z(-70.0, 60.0);
    int seen = 0;
    double worst = 0.0, sum = 0.0;
    for (int i = 0; i < 20000 && seen < 600; ++i) {
      const glm::dvec2 at(x(random), z(random));
      const QueryAnswer here = shore.query(at);
      if (!here.converged || std::abs(here.height_m) < 0.01) continue;
      ++seen;
      const double e = 0.3;
      const auto height = [&](double dx, double dz) { return shore.query(at + glm::dvec2(dx, dz)).height_m; };
      const glm::dvec3 normal =
          glm::normalize(glm::dvec3(height(-e, 0) - height(e, 0), 2.0 * e, height(0, -e) - height(0, e)));
      const double off = glm::degrees(std::acos(std::min(glm::dot(normal, here.normal), 1.0)));
      worst = std::max(worst, off), sum += off;
    }
    EXPECT_GE(seen, 500);
    return std::pair(worst, sum / seen);
  };
  const auto [worst_straight, mean_straight] = off_deg(spline({{-600, 0}, {0, 0}, {600, 0}}, 1000.0, 10.0));
  const auto [worst, mean] = off_deg(spline(bay(), 60.0, 10.0));
  EXPECT_LT(worst, 1.5 * worst_straight);
  EXPECT_LT(mean, 1.4 * mean_straight);
}

// Beyond the width the sea is as if there were no such waves, to the bit, and so are the waves everywhere beside them.
// Control seen: the tile laid over the sea as others are.
TEST(ShoreSea, NothingIsBeyondTheWidth) {
  const Shore shore(many(), {spline(bay(), 60.0, 10.0)}, 5.0);
  const WaveField without(flat(), WaveQuality{.resolution = 16, .cascades = 1});
  WaveTiles tiles;
  without.evaluate(ticks_from_seconds(5.0), tiles);
  int within = 0;
  for (int i = -200; i < 200; ++i)
    for (int j = -100; j < 100; ++j) {
      const glm::dvec2 rest(1.3 * i, 1.1 * j);
      const bool there = shore.sea(rest).displacement != glm::dvec3(0.0);
      within += there;
      double least = 1e9;  // of a polygon of the curve's points, which it keeps within 4 m of
      for (std::size_t p = 0; p + 1 < bay().size(); ++p) {
        const glm::dvec2 a = bay()[p], b = bay()[p + 1];
        least = std::min(
            least, glm::distance(
                       rest, a + (b - a) * std::clamp(glm::dot(rest - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0)));
      }
      if (least < 35.0) continue;
      ASSERT_FALSE(there) << rest.x << ' ' << rest.y;
      ASSERT_EQ(shore.field->sea(shore.tiles, rest, 0.0).displacement, without.sea(tiles, rest, 0.0).displacement);
    }
  EXPECT_GT(within, 3000);
}

// Around an island waves have no seam: no step from one place to the next, all the way round. Control seen: a pattern
// that is not stretched to close (a step of 0.25 m).
TEST(ShoreSea, AClosedCurveHasNoSeam) {
  std::vector<glm::dvec2> island;
  for (int i = 0; i < 14; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 14, r = 90.0 + 12.0 * std::sin(3.0 * angle);
    island.emplace_back(r * std::cos(angle), -r * std::sin(angle));
  }
  const Shore shore(many(), {spline(island, 50.0, 10.0, true)}, 12.0);
  double last = shore.sea({95.0, 0.0}).displacement.y, worst = 0.0, highest = 0.0;
  constexpr int steps = 60000;
  for (int i = 1; i <= steps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / steps;  // a centimetre
    const double h = shore.sea({95.0 * std::cos(angle), -95.0 * std::sin(angle)}).displacement.y;
    worst = std::max(worst, std::abs(h - last)), highest = std::max(highest, std::abs(h));
    last = h;
  }
  EXPECT_GT(highest, 0.3);
  EXPECT_LT(worst, 0.008);
}

// As data of places are read (PlaceReader).
double between_texels(glm::dvec2 at_m, const std::function<double(glm::dvec2, double)>& value) {
  const double texel = place_reading(PlaceSettings{}.windows, at_m, 0.0, nullptr).fine_texel_m();
  const glm::dvec2 at = at_m / texel - 0.5, cell = glm::floor(at), part = at - cell;
  const auto row = [&](double z) {
    return glm::mix(value((cell + glm::dvec2(0.5, z)) * texel, texel),
                    value((cell + glm::dvec2(1.5, z)) * texel, texel), part.x);
  };
  return glm::mix(row(0.5), row(1.5), part.y);
}

// Over a bed they fade with depth as other sources do, and a current carries them. Controls seen: the bed's share left
// out; a current that is not turned into the pattern.
TEST(ShoreSea, ABedAndACurrentMakeOfThemWhatTheyMakeOfOthers) {
  InputSpec bank;
  bank.to = InputTarget::sea_depth;
  bank.value = glm::vec4(-0.4f, 0.0f, 0.0f, 0.0f);
  bank.blend = InputBlend::replace;
  bank.feather_m = 30.0;
  bank.shape = AreaInput{.round = true, .at_m = {20.0, -20.0}, .size_m = {160.0, 160.0}};
  PlaceInputs over_bank;
  over_bank.kinds.push_back(std::make_shared<const Inputs>(InputTarget::sea_depth, std::vector<InputSpec>{bank}));
  const Shore open(many(), {spline(bay(), 60.0, 10.0)}, 9.0),
      shallow(many(), {spline(bay(), 60.0, 10.0)}, 9.0, over_bank);
  const ShoreLines lines(std::vector<InputSpec>{spline(bay(), 60.0, 10.0)}, open.tile->side_m());
  ASSERT_NE(shallow.place->shallows(), nullptr);
  int weaker = 0;
  for (double x = -100.0; x < 130.0; x += 3.1)
    for (double z = -60.0; z < 40.0; z += 2.9) {
      const glm::dvec2 rest(x, z);
      const auto placed = [&](glm::dvec2 at, double texel) {
        return double(
            float(shallow.place->shallows()->placed(at, -shallow.place->shallows()->bed_m(at, texel, 0.0)).share));
      };
      const auto strength = [&](glm::dvec2 at, double texel) { return double(lines.at(at, texel).share); };
      const double whole = between_texels(rest, strength);
      if (whole == 0.0) continue;
      const double share =
          between_texels(rest, [&](glm::dvec2 at, double texel) { return strength(at, texel) * placed(at, texel); }) /
          whole;
      const glm::dvec3 a = open.sea(rest).displacement, b = shallow.sea(rest).displacement;
      if (-shallow.place->shallows()->bed_m(rest, 0.0, 0.0) < 0.3 + 1.2 * std::abs(a.y))
        continue;  // where the bed shows
      ASSERT_NEAR(b.y, share * a.y, 1e-6);
      weaker += share < 0.8 && std::abs(a.y) > 0.05;
    }
  EXPECT_GT(weaker, 40);
  // A current takes them along: by the correlation with those in still water so far upstream, in the moment in which
  // one pattern counts for most.
  PlaceInputs current;
  current.settings.flow_to_deg = 270.0;
  current.settings.flow_mps = 8.0;
  current.settings.flow_period_s = 8.0;
  current.kinds.push_back(std::make_shared<const Inputs>(InputTarget::flow, std::vector<InputSpec>{}));
  const std::vector<InputSpec> north{spline({{0, 0}, {0, -300}}, 60.0, 5.0)};  // so that the current goes to its shore
  const Shore carried(many(), north, 12.8, current), still(many(), north, 12.8);
  const auto alike = [&](double upstream_m) {
    double xy = 0.0, xx = 0.0, yy = 0.0;
    for (double x = -10.0; x <= 10.0; x += 1.7)
      for (double z = -270.0; z <= -30.0; z += 4.1) {
        const double a = carried.sea({x, z}).displacement.y, b = still.sea({x + upstream_m, z}).displacement.y;
        xy += a * b, xx += a * a, yy += b * b;
      }
    return xy / std::sqrt(xx * yy);
  };
  EXPECT_GT(alike(8.0 * 0.8), 0.9);
  EXPECT_LT(alike(0.0), 0.6);
}

}  // namespace
}  // namespace seascape
