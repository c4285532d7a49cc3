// What meshes miss of what feeds the sea beside its waves: said (ocean/waves/source_error.h) and, in pixels, drawn.
#include "ocean/waves/source_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/lab/screen_error.h"
#include "app/scene.h"
#include "app/sea_remarks.h"
#include "app/tile_sources.h"
#include "ocean/waves/gerstner.h"
#include "tests/support/sampled.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {

struct Row {
  const char* scene;
  std::vector<std::string> effects;
};

struct Drawn {
  ScreenError error;
  double figure = 0.0;
};

// As an Ocean tells the quadtree of its sources. `told` multiplies what they are said to be missed by.
Drawn draw(const Row& row, const char* preset, int poses, double told) {
  Scene scene = load_scene(row.scene, preset);
  scene.effects = row.effects;
  const TileSources sources = tile_sources(scene, limited_sea(scene));
  const WaveField field(scene.settings.sea, scene.settings.waves, sources);
  SourceError missed;
  double height_m = 0.0, shift_m = 0.0;
  for (const auto& source : sources) {
    missed.add(*source);
    height_m += source->statistics().largest_height_m;
    shift_m += source->statistics().largest_shift_m;
  }
  const MeshError waves = field.statistics().mesh_error, all = missed.with(waves);
  WaveTiles tiles;
  Drawn result;
  result.figure = scene.settings.lod.pixel_error;
  result.error.enough = 0.3 * result.figure;
  std::mt19937 random(8), points(9);
  Quadtree tree(scene.settings.lod);
  for (int n = 0; n < poses; ++n) {
    if (n % 25 == 0) field.evaluate(ticks_from_seconds(17.0 * n + 3.0), tiles);
    const Viewpoint view = pose_over(field, tiles, random, n);
    DisplacementBounds bounds = bounds_of(field, tiles, view.viewer.position_m);
    for (std::size_t o = 0; o < all.octave_m.size(); ++o)
      bounds.mesh_error.octave_m[o] = std::lerp(waves.octave_m[o], all.octave_m[o], told);
    bounds.vertical_m += height_m;
    bounds.horizontal_m += shift_m;
    for (std::size_t o = 0; bounds.below && o < bounds.below->off.vertical_m.size(); ++o) {
      bounds.below->off.vertical_m[o] += height_m;
      bounds.below->off.horizontal_m[o] += shift_m;
    }
    add_picture({field, tiles, tree.select(view, bounds)}, view, 6, points, result.error);
  }
  return result;
}

// In all presets' pixels, of their `lod.pixel_error`. SEASCAPE_LONG=1: 200 poses of each, which come to 0.24 to 0.96 of
// it. Control seen: what several kinds miss together taken for the root of their squares (`mixed` 1: 1.04 of the figure
// at ultra, and with `more` 1.2 1.11 at high).
TEST(SourceErrorHard, IsWithinThePixelsAskedFor) {
  const Row rows[] = {{"gerstner", {"waves", "gerstner"}},
                      {"baked", {"waves", "baked"}},
                      {"rain_pool", {"waves", "wave_particles"}},
                      {"calm", {"waves", "wave_particles", "gerstner"}}};
  for (const Row& row : rows)
    for (const char* preset : {"low", "medium", "high", "ultra"}) {
      if (test::sanitized && std::string(preset) != "low") continue;
      Drawn d = draw(row, preset, test::long_run() ? 200 : 3, 1.0);
      const std::string what = std::string(row.scene) + ' ' + preset + " with " + row.effects.back();
      if (test::long_run())
        std::printf("%s: %.0f triangles, %.2f of %.0f pixels at most, 99.9 %% within %.2f\n", what.c_str(),
                    d.error.triangles / d.error.poses, d.error.worst, d.figure, d.error.share(0.999));
      ASSERT_GT(d.error.pixels.size(), 1000u) << what;
      EXPECT_LE(d.error.worst, d.figure) << what << ": " << d.error.where;
    }
}

// The control: a quadtree that is told of the waves alone. Seen: 1.26, 1.7 and 2.6 times what it misses when told; told
// twice as much it has a seventh to 2.4 times more triangles.
TEST(SourceErrorHard, SeesSourcesThatTheTreeIsNotToldOf) {
  if (test::sanitized) GTEST_SKIP() << "the test above takes the same steps";
  for (const Row& row : {Row{"gerstner", {"waves", "gerstner"}}, Row{"baked", {"waves", "baked"}},
                         Row{"calm", {"waves", "wave_particles"}}}) {
    const Drawn untold = draw(row, "medium", 24, 0.0), told = draw(row, "medium", 24, 1.0),
                twice = draw(row, "medium", 24, 2.0);
    EXPECT_GT(untold.error.worst, 1.1 * told.error.worst) << row.scene;
    EXPECT_GT(twice.error.triangles, 1.1 * told.error.triangles) << row.scene;
  }
}

}  // namespace
}  // namespace seascape
