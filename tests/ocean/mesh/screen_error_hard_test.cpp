// The largest distance in pixels between what is drawn and a surface with eight times the vertices a side is within the
// preset's figure: 8, 4, 2 and 1 pixels of a headset's picture.
#include "app/lab/screen_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "app/scene.h"
#include "tests/ocean/mesh/lod_support.h"
#include "tests/support/sampled.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {
using namespace lod_test;

constexpr std::array<double, 4> figures{8.0, 4.0, 2.0, 1.0};
constexpr std::array<const char*, 4> scenes{"open_sea", "storm", "calm", "swell"};

// SEASCAPE_LONG=1, or part of a row's name, such as "ultra storm" or "masked": only such rows then.
bool chosen(const std::string& row) {
  const char* const rows = std::getenv("SEASCAPE_LONG");
  return rows == nullptr || std::string_view(rows) == "1" || row.find(rows) != std::string::npos;
}

// Sea, poses and times: the peak factors of ocean/waves/mesh_error.cpp were fitted on the first sea, at its times; the
// others had no part in it.
struct Draw {
  const char* name;
  std::uint32_t sea, poses;
  double from_s;
};
constexpr std::array<Draw, 4> draws{{{"first", 1, 8, 0.0},
                                     {"second", 7321, 90210, 51234.5},
                                     {"third", 415, 20261121, 261803.0},
                                     {"fourth", 90017, 31337, 777.0}}};

// `faults` is done to what the quadtree is told: the planted ones. Looks from the `first` of the poses on.
template <class Fault>
ScreenError screen_error(const std::string& scene, const char* preset, LodJoin join, const Draw& draw, int poses,
                         int per_patch, const Fault& faults, int first = 0) {
  Settings settings = load_scene(scene, preset).settings;
  settings.lod.join = join;
  settings.sea.seed = draw.sea;
  const WaveField field(settings.sea, settings.waves);
  WaveTiles tiles;
  ScreenError error;
  error.enough = 0.3 * settings.lod.pixel_error;
  std::mt19937 poses_drawn(draw.poses), points(draw.poses + 1);  // a pose depends on no mesh
  DisplacementBounds none;
  faults(settings.lod, none);
  if (settings.lod.by == LodLaw::pixel_error) error.enough = std::min(error.enough, 0.3 * settings.lod.pixel_error);
  Quadtree tree(settings.lod);
  for (int n = 0; n < poses; ++n) {
    if (n % 25 == 0) field.evaluate(ticks_from_seconds(draw.from_s + 17.0 * n), tiles);
    const Viewpoint view = pose_over(field, tiles, poses_drawn, n);
    if (n < first) continue;
    DisplacementBounds bounds = bounds_of(field, tiles, view.viewer.position_m);
    faults(settings.lod, bounds);
    add_picture({field, tiles, tree.select(view, MeshWater(bounds, &field, &tiles))}, view, per_patch, points, error);
  }
  return error;
}
const auto no_fault = [](LodSettings&, DisplacementBounds&) {};

void print(const std::string& row, ScreenError& e) {
  const double most_of_them = e.share(0.999);
  if (test::long_run())
    std::printf("| %s | %.0f | %.2f / %.2f / %.2f | %.1f million | %d |\n", row.c_str(), e.triangles / e.poses, e.worst,
                most_of_them, e.rms(), 1e-6 * static_cast<double>(e.pixels.size()), e.poses);
  if (std::getenv("SEASCAPE_WHERE")) std::printf("%s; nearer elsewhere %d\n", e.where.c_str(), e.nearer_elsewhere);
  std::fflush(stdout);
}

// With SEASCAPE_LONG=1 200 poses of each draw and both joins (of which the bar speaks of the morphed), else two; prints
// the tables of docs/performance.md. The sea is the wave field of the same quality, with waves down to an eighth of the
// mesh's footprint.
TEST(ScreenErrorHard, IsWithinThePresetsFigure) {
  for (std::size_t p = 0; p < presets.size(); ++p)
    for (const char* scene : scenes)
      for (const LodJoin join : {LodJoin::morphed, LodJoin::masked})
        for (const Draw& draw : draws) {
          const std::string row = std::string(presets[p].name) + ' ' + scene +
                                  (join == LodJoin::masked ? " masked " : " morphed ") + draw.name;
          if ((join == LodJoin::masked && !test::long_run()) || !chosen(row) || (test::sanitized && p > 1)) continue;
          ScreenError e = screen_error(scene, presets[p].name, join, draw, test::long_run() ? 200 : 2,
                                       test::long_run() ? 8 : 6, no_fault);
          print(row, e);
          RecordProperty(row, std::to_string(e.worst));
          ASSERT_GT(e.pixels.size(), 1000u) << row;
          if (join == LodJoin::morphed) {
            EXPECT_LE(e.worst, figures[p]) << row << ": " << e.where;
          }
          EXPECT_GT(e.worst, 0.2 * figures[p]) << row << ": far finer than asked for";
        }
}

// From this pose a crest 280 m off was missed by 4.09 of the 4 pixels, while larger figures took as much less of the
// mesh as a normal sea's largest says. Control seen: that law, a seventh of the logarithm for a tenth in Quadtree's
// `fewer`.
TEST(ScreenErrorHard, ACrestFarOffIsWithinMediumsPixels) {
  if (!chosen("crest")) GTEST_SKIP() << "another row is asked for";
  ScreenError e = screen_error("open_sea", "medium", LodJoin::morphed, draws[3], 107, 200, no_fault, 106);
  EXPECT_LE(e.worst, figures[1]) << e.where;
}

// From this one a trough 400 m off was missed by 1.10 of the one pixel. Control seen: ultra asking for 1 pixel, not for
// 0.9.
TEST(ScreenErrorHard, ATroughFarOffIsWithinUltrasPixel) {
  if (!chosen("trough")) GTEST_SKIP() << "another row is asked for";
  if (test::sanitized) GTEST_SKIP() << "a million points";
  ScreenError e = screen_error("storm", "ultra", LodJoin::morphed, draws[1], 131, 64, no_fault, 130);
  EXPECT_LE(e.worst, figures[3]) << e.where;
}

// The threshold's own way, one constant for all presets. Controls seen: 0.6 (ultra in the storm, third draw: 1.23) and
// 0.72 (1.12 in the first).
TEST(ScreenErrorHard, IsWithinTheFigureByTheThresholdToo) {
  for (std::size_t p = 0; p < presets.size(); ++p)
    for (const char* scene : scenes)
      for (const Draw& draw : draws) {
        const std::string row = std::string(presets[p].name) + ' ' + scene + " by the threshold " + draw.name;
        if (!chosen(row) || (test::sanitized && p > 1)) continue;
        const auto by_threshold = [](LodSettings& lod, DisplacementBounds&) { lod.by = LodLaw::threshold; };
        ScreenError e = screen_error(scene, presets[p].name, LodJoin::morphed, draw, test::long_run() ? 200 : 2,
                                     test::long_run() ? 8 : 4, by_threshold);
        print(row, e);
        RecordProperty(row, std::to_string(e.worst));
        EXPECT_LE(e.worst, figures[p]) << row << ": " << e.where;
      }
}

// Triangles against pixels: what is missed follows lod.pixel_error, at one preset's waves. With SEASCAPE_LONG=1, or
// "follows", 20 poses of more figures (the table of docs/accuracy.md). Controls seen: reaches of 2 pixels whatever is
// asked for (80,000 triangles at 4 where 88,000 are asked for, and 1.36 pixels at 1), and `fewer` of the inverse root
// of the pixels in place of their logarithm (4.74 at 4, 8.04 at 8).
TEST(ScreenErrorHard, FollowsThePixelsAskedFor) {
  if (!chosen("follows")) GTEST_SKIP() << "another row is asked for";
  double triangles = 0.0, before = 0.0;
  for (const double pixels :
       test::long_run() ? std::vector<double>{16.0, 8.0, 4.0, 2.0, 1.0, 0.5} : std::vector<double>{16.0, 4.0}) {
    const auto of_pixels = [pixels](LodSettings& lod, DisplacementBounds&) { lod.pixel_error = pixels; };
    ScreenError e =
        screen_error("open_sea", "high", LodJoin::morphed, draws[0], test::long_run() ? 20 : 2, 8, of_pixels);
    print("high open_sea, follows " + std::to_string(pixels), e);
    EXPECT_LE(e.worst, pixels);
    EXPECT_GT(e.worst, 0.2 * pixels);
    if (before > 0.0) {
      EXPECT_GT(e.triangles / e.poses, std::pow(1.25, std::log2(before / pixels)) * triangles)
          << "half the pixels take more";
    }
    triangles = e.triangles / e.poses;
    before = pixels;
  }
}

// The controls: a mesh of twice the spacing, and one whose sea is told to be missed by six tenths of what it is.
TEST(ScreenErrorHard, SeesAMeshOfTwiceTheSpacingAndAnErrorToldTooSmall) {
  for (const double told : {0.5, 0.6})
    for (const char* scene : {"open_sea", "storm"}) {
      const auto too_small = [told](LodSettings&, DisplacementBounds& bounds) {
        for (double& octave : bounds.mesh_error.octave_m) octave *= told;
      };
      EXPECT_GT(screen_error(scene, "medium", LodJoin::morphed, draws[0], 24, 16, too_small).worst, figures[1])
          << scene << ", " << told;
    }
}

}  // namespace
}  // namespace seascape
