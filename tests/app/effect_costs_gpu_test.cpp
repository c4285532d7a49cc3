// What effects cost beside each other: exact in memory and work, whichever way round they are added.
#include "app/effect_costs.h"

#include <algorithm>
#include <map>

#include "ocean/effects.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {
namespace {

using test::SeaShot;

class EffectCosts : public test::GpuTest {
 protected:
  static Scene small_scene() {
    return SeaShot(
               {.scene = "open_sea",
                .preset = "medium",
                .width = 48,
                .height = 32,
                .set = {{"waves.resolution", "32"}, {"waves.where", "gpu"}, {"lod.patch_quads", "16"}, {"msaa", "1"}}})
        .scene();
  }
  static CostMatrix measured(const Scene& scene, const std::vector<std::string>& effects, int frames) {
    std::size_t last = 0, of = 0;
    const CostMatrix matrix = measure_costs(test::device(), test::shaders(), scene, effects, {48, 32, 1, false, false},
                                            "medium", frames, [&](std::size_t done, std::size_t all) {
                                              EXPECT_EQ(done, last + 1);
                                              last = done;
                                              of = all;
                                            });
    EXPECT_EQ(last, of);
    return matrix;
  }
};

const Cost* find(const CostMatrix& matrix, const std::string& effect, const std::string& beside) {
  const auto found = std::find_if(matrix.cells.begin(), matrix.cells.end(),
                                  [&](const CostCell& c) { return c.effect == effect && c.beside == beside; });
  return found == matrix.cells.end() ? nullptr : &found->cost;
}
std::vector<std::int64_t> exact(const Cost& c) {
  return {c.bytes, c.passes, c.draws, c.dispatches, c.pipelines, c.words};
}
std::vector<std::int64_t> sum(const Cost& a, const Cost& b) {
  std::vector<std::int64_t> result = exact(a);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += exact(b)[i];
  return result;
}

// A after B and B after A come to the same scene. Controls seen: what is built counted before it is drawn; the scene
// without the effect built with it (all costs 0); a cell of an effect that stands beside anyway.
TEST_F(EffectCosts, AreTheSameWhicheverComesFirst) {
  const CostMatrix m = measured(small_scene(), {"foam", "wave_particles"}, 2);
  ASSERT_EQ(m.effects.size(), 2u);
  const Cost *foam = find(m, "foam", beside_nothing), *particles = find(m, "wave_particles", beside_nothing);
  const Cost *foam_then = find(m, "foam", "wave_particles"), *particles_then = find(m, "wave_particles", "foam");
  ASSERT_TRUE(foam && particles && foam_then && particles_then);
  EXPECT_EQ(sum(*foam, *particles_then), sum(*particles, *foam_then));
  EXPECT_EQ(exact(*find(m, "foam", beside_all_others)), exact(*foam_then));
  EXPECT_GT(particles_then->bytes, 64 * 64 * 3 * 8);
  EXPECT_GT(particles_then->passes, 0);
  EXPECT_GT(particles_then->words, 0);
  EXPECT_EQ(foam_then->bytes, 0) << "foam is code in the surface's shaders";
  EXPECT_EQ(foam_then->dispatches, 0);
  EXPECT_GT(foam_then->words, 0);
  for (const CostCell& cell : m.cells) {
    EXPECT_LE(cell.cost.ms.low, cell.cost.ms.middle);
    EXPECT_LE(cell.cost.ms.middle, cell.cost.ms.high);
  }
}

// Nothing of the scenes that were measured is left on the device.
TEST_F(EffectCosts, LeaveNothingBehind) {
  const Scene scene = small_scene();
  test::device().wait_idle();
  const auto held = [] { return std::pair(test::device().objects().size(), test::device().memory().used_bytes()); };
  const auto before = held();
  (void)measured(scene, {"foam"}, 1);
  test::device().wait_idle();
  EXPECT_EQ(held(), before);
}

// What a scene has nothing to do for is not measured beside anything. Control seen: all measured.
TEST_F(EffectCosts, LeaveOutWhatHasNothingToDo) {
  Scene scene = small_scene();
  scene.settings.wave_particles.height_m = 0.0;
  const CostMatrix m = measured(scene, {"foam", "level", "wave_particles"}, 1);
  EXPECT_EQ(m.effects, std::vector<std::string>{"foam"});
}

// An effect that another needs is no cell beside that one.
TEST_F(EffectCosts, AskOnlyWhatCanBeAsked) {
  const CostMatrix m = measured(small_scene(), {"waves", "foam"}, 1);
  EXPECT_TRUE(find(m, "foam", "waves"));
  EXPECT_TRUE(find(m, "waves", beside_nothing));
  EXPECT_FALSE(find(m, "waves", "foam"));
  EXPECT_FALSE(find(m, "waves", beside_all_others));
  EXPECT_FALSE(find(m, "foam", "foam"));
}

}  // namespace
}  // namespace seascape
