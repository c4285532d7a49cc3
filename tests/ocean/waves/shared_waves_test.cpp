// What presets share they draw alike: the same waves at the same places, whatever the resolution and the number of
// cascades.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <random>

#include "app/scene.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {
namespace {

constexpr std::int64_t ticks = 77 * std::int64_t(gpu::ticks_per_second) + 12345;

std::vector<glm::dvec3> displacements(const SeaState& sea, const WaveQuality& quality,
                                      const std::vector<glm::dvec2>& places) {
  const WaveField field(sea, quality);
  WaveTiles tiles;
  field.evaluate(ticks, tiles);
  const WaveField::Filter filter = field.filter(0.0);
  std::vector<glm::dvec3> result;
  for (const glm::dvec2 place : places) result.push_back(field.displacement(tiles, place, filter));
  return result;
}

std::vector<glm::dvec2> some_places(int count) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> anywhere(-30e3, 30e3);
  std::vector<glm::dvec2> places;
  for (int i = 0; i < count; ++i) places.push_back({anywhere(random), anywhere(random)});
  return places;
}

// What two samplings of the same waves differ by: root mean square displacement (m), and by which factor a's waves are
// higher than b's, in the least squares' sense.
struct Difference {
  double displacement_m = 0.0, factor = 0.0;
};
Difference difference(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double square = 0.0, both = 0.0, of_b = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    square += glm::dot(a[i] - b[i], a[i] - b[i]);
    both += glm::dot(a[i], b[i]);
    of_b += glm::dot(b[i], b[i]);
  }
  return {std::sqrt(square / double(a.size())), both / of_b};
}

TEST(SharedWaves, tiles_do_not_depend_on_how_many_cascades_are_kept) {
  // Every texel of every plane and level, to the bit. Control: a cascade's seed taken from how many are kept.
  SeaState sea;
  sea.swell_height_m = 1;
  for (const int resolution : {16, 64, 256}) {
    const WaveField all(sea, {.resolution = resolution, .cascades = 5});
    WaveTiles of_all(true);
    all.evaluate(ticks, of_all);
    for (int cascades = 1; cascades < 5; ++cascades) {
      const WaveField some(sea, {.resolution = resolution, .cascades = cascades});
      WaveTiles of_some(true);
      some.evaluate(ticks, of_some);
      for (int c = 0; c < cascades; ++c)
        for (const WavePlane plane : {WavePlane::shift, WavePlane::slope, WavePlane::moments, WavePlane::velocity})
          for (int level = 0; level < of_all.levels(c); ++level) {
            const int size = tile_samples(all.quality(), c) >> level;
            for (int z = 0; z < size; ++z)
              ASSERT_EQ(std::memcmp(of_all.texels(c, plane, level) + z * of_all.stride(c, level),
                                    of_some.texels(c, plane, level) + z * of_some.stride(c, level),
                                    sizeof(glm::vec4) * std::size_t(size)),
                        0)
                  << resolution << ", " << cascades << " cascades: " << c << ", level " << level;
          }
    }
  }
}

TEST(SharedWaves, presets_draw_what_they_share_within_a_thousandth_of_the_significant_height) {
  // The displacement of the cascades that two presets both keep, sampled at the same places. The waves are as high
  // within a thousandth, those of all tiles and those after the first, which most presets sample alike. What differs
  // beyond is what straight lines between texels make of the shortest waves of the tiles after the first (with 128
  // samples, four a wave, it would be 2 thousandths of Hs: no preset has so few). Controls: amplitudes drawn from the
  // number of cascades; amplitudes not divided by what bilinear sampling takes at a resolution. Control
  // seen of light seas: a warp whose length follows the resolution by a thousandth (24 times the bar).
  const std::vector<glm::dvec2> places = some_places(4000);
  // A light sea's longest tile is warped.
  for (const std::string scene : {"open_sea", "calm", "storm", "swell", "wind of 7 m/s", "wind of 3 m/s"}) {
    const bool light = scene.starts_with("wind");
    std::map<std::pair<int, int>, std::vector<glm::dvec3>> drawn;  // by resolution and cascades
    const auto of = [&](const SeaState& sea, int resolution, int cascades) -> const std::vector<glm::dvec3>& {
      auto& result = drawn[{resolution, cascades}];
      if (result.empty()) result = displacements(sea, {.resolution = resolution, .cascades = cascades}, places);
      return result;
    };
    SeaState sea;
    sea.wind_speed_mps = scene == "wind of 3 m/s" ? 3.0 : 7.0;
    if (!light) sea = load_scene(scene, "ultra").settings.sea;
    ASSERT_EQ(ladder(sea)[0].warped, light) << scene;
    const auto quality = [&](const char* preset) {
      return load_scene(light ? "open_sea" : scene, preset).settings.waves;
    };
    const double significant =
        4.0 * std::sqrt(WaveField(sea, {.resolution = 64, .cascades = 5}).statistics().height_variance);
    constexpr std::array presets{"low", "medium", "high", "ultra"};
    for (std::size_t i = 0; i < presets.size(); ++i)
      for (std::size_t j = i + 1; j < presets.size(); ++j) {
        const WaveQuality a = quality(presets[i]), b = quality(presets[j]);
        const int shared = std::min(a.cascades, b.cascades);
        const auto after_first = [&](int resolution) {
          std::vector<glm::dvec3> result = of(sea, resolution, shared);
          const std::vector<glm::dvec3>& first = of(sea, resolution, 1);
          for (std::size_t at = 0; at < result.size(); ++at) result[at] -= first[at];
          return result;
        };
        const Difference d = difference(of(sea, a.resolution, shared), of(sea, b.resolution, shared));
        const Difference short_waves = difference(after_first(a.resolution), after_first(b.resolution));
        constexpr double most = 1e-3;
        const std::string pair = scene + " " + presets[i] + " " + presets[j];
        EXPECT_LE(d.displacement_m, most * significant) << pair;
        EXPECT_NEAR(d.factor, 1.0, 1e-3) << pair;
        EXPECT_NEAR(short_waves.factor, 1.0, 1e-3) << pair;
        RecordProperty(
            pair, std::to_string(d.displacement_m / significant) + " Hs, factor " + std::to_string(short_waves.factor));
      }
  }
}

}  // namespace
}  // namespace seascape
