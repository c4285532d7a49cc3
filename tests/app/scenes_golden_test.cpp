// The shipped scenes against reference pictures (tests/golden/README.md says why each is there).
#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/error.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

namespace {

using test::PictureDifference;

class Golden : public test::GpuTest {};

// Of a pixel's largest colour difference in linear light, white being 1. Other drivers and processors round
// differently, and move the edges of crests by a part of a pixel; a change that an eye would see in this size moves
// either by more.
constexpr PictureDifference tolerance{.mean = 0.004, .p99 = 0.06};

bool within(const PictureDifference& d) { return d.mean <= tolerance.mean && d.p99 <= tolerance.p99; }

// A scene from where explore starts in it, a minute in. Without anisotropic filtering, which is each driver's own.
Image8 draw(const std::string& scene, std::vector<std::pair<std::string, std::string>> set = {}) {
  set.emplace_back("water.anisotropy", "1");
  test::SeaShot shot({.scene = scene, .preset = "medium", .width = 192, .height = 108, .set = std::move(set)});
  return shot.picture(shot.scene().start, 60.0);
}

// Drawn with the waves of the GPU, which wrote the references, or of the processor.
void expect_golden(const std::string& scene, const std::string& place) {
  const std::filesystem::path file = std::filesystem::path(SEASCAPE_TEST_DIR) / "golden" / (scene + ".png");
  const Image8 drawn = draw(scene, {{"waves.where", place}});
  if (place == "gpu" && std::getenv("SEASCAPE_WRITE_GOLDEN")) {
    Image8 opaque{drawn.width, drawn.height, 3, {}};
    for (std::size_t i = 0; i < drawn.pixels.size(); i += 4)
      opaque.pixels.insert(opaque.pixels.end(), &drawn.pixels[i], &drawn.pixels[i] + 3);
    write_png(file, opaque);
    return;
  }
  const Image8 reference = read_png(file);
  const PictureDifference d = test::difference(drawn, reference);
  if (within(d)) return;
  ADD_FAILURE()
      << scene << ", waves by the " << place << ", differs from " << file << ": mean " << d.mean << " of at most "
      << tolerance.mean << ", p99 " << d.p99 << " of at most " << tolerance.p99 << "; see "
      << test::leave(drawn, "golden_" + scene + "_" + place) << ", "
      << test::leave(reference, "golden_" + scene + "_" + place + "_reference") << ", "
      << test::leave(test::difference_picture(drawn, reference), "golden_" + scene + "_" + place + "_difference")
      << "; if the change is wanted: SEASCAPE_WRITE_GOLDEN=1 build/release/tests_golden, and say why in the commit";
}

TEST_F(Golden, OpenSea) { expect_golden("open_sea", "gpu"); }
TEST_F(Golden, Calm) { expect_golden("calm", "gpu"); }
TEST_F(Golden, Storm) { expect_golden("storm", "gpu"); }
TEST_F(Golden, Swell) { expect_golden("swell", "gpu"); }
TEST_F(Golden, RainPool) { expect_golden("rain_pool", "gpu"); }
TEST_F(Golden, Baked) { expect_golden("baked", "gpu"); }
TEST_F(Golden, Gerstner) { expect_golden("gerstner", "gpu"); }
TEST_F(Golden, Whirlpool) { expect_golden("whirlpool", "gpu"); }
TEST_F(Golden, Lagoon) { expect_golden("lagoon", "gpu"); }
TEST_F(Golden, Rivers) { expect_golden("rivers", "gpu"); }
TEST_F(Golden, HarbourClip) { expect_golden("harbour_clip", "gpu"); }
TEST_F(Golden, Harbour) { expect_golden("harbour", "gpu"); }
TEST_F(Golden, StillLife) { expect_golden("still_life", "gpu"); }
TEST_F(Golden, OpenSeaUploaded) { expect_golden("open_sea", "cpu"); }
TEST_F(Golden, CalmUploaded) { expect_golden("calm", "cpu"); }
TEST_F(Golden, StormUploaded) { expect_golden("storm", "cpu"); }
TEST_F(Golden, SwellUploaded) { expect_golden("swell", "cpu"); }
TEST_F(Golden, RainPoolUploaded) { expect_golden("rain_pool", "cpu"); }
TEST_F(Golden, BakedUploaded) { expect_golden("baked", "cpu"); }
TEST_F(Golden, GerstnerUploaded) { expect_golden("gerstner", "cpu"); }
TEST_F(Golden, WhirlpoolUploaded) { expect_golden("whirlpool", "cpu"); }
TEST_F(Golden, LagoonUploaded) { expect_golden("lagoon", "cpu"); }
TEST_F(Golden, RiversUploaded) { expect_golden("rivers", "cpu"); }
TEST_F(Golden, HarbourClipUploaded) { expect_golden("harbour_clip", "cpu"); }
TEST_F(Golden, HarbourUploaded) { expect_golden("harbour", "cpu"); }
TEST_F(Golden, StillLifeUploaded) { expect_golden("still_life", "cpu"); }

// The control: changes of light, water and waves that an eye would see are outside the tolerance.
TEST_F(Golden, WhatAnEyeWouldSeeIsOutsideTheTolerance) {
  const Image8 usual = draw("open_sea");
  EXPECT_TRUE(within(test::difference(usual, draw("open_sea"))));
  using Set = std::vector<std::pair<std::string, std::string>>;
  for (const Set& set : {Set{{"sky.exposure_ev", "0.2"}}, Set{{"water.chlorophyll_mg_m3", "2"}},
                         Set{{"waves.seed", "2"}}, Set{{"waves.chop", "0"}}, Set{{"sky.sun_elevation_deg", "24"}}})
    EXPECT_FALSE(within(test::difference(usual, draw("open_sea", set)))) << set[0].first;
}

}  // namespace

}  // namespace seascape
