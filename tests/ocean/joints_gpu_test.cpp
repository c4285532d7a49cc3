// Where patches and the skirt meet: the vertices that the drawing vertex shader puts out are the same to the bit, for
// both ways to join levels.
#include <bit>
#include <cstring>
#include <map>

#include "tests/ocean/mesh/lod_support.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"

namespace seascape {

namespace {

using test::pose;
using test::SeaShot;

class Joints : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  }
};

// Vertices that are one by the bits that the same header gives on the processor.
struct Shared {
  int places = 0, across_levels = 0, with_skirt = 0, unequal = 0;
};

// Of one frame without eyes: nothing is culled.
Shared shared_vertices(SeaShot& shot, const Viewpoint& eyes) {
  shot.draw(eyes, 12.3);
  const SurfaceSelection& s = shot.experience().ocean().select(eyes);
  EXPECT_LE(s.patches.size(), Surface::probe_patches);
  const auto bytes = read_buffer(test::device(), shot.experience().surface().probed());
  constexpr int side = gpu::patch_quads + 1;
  struct First {
    std::array<std::uint32_t, 6> bits;  // rest x, z; position
    int stride;
    bool skirt;
  };
  std::map<std::uint64_t, First> first;
  Shared result;
  for (std::size_t n = 0; n < s.patches.size() && n < Surface::probe_patches; ++n)
    for (int v = 0; v < side * side; ++v) {
      const gpu::PatchInstance& p = s.patches[n];
      std::array<float, 8> out;
      std::memcpy(out.data(), &bytes[(n * std::size_t(side * side) + std::size_t(v)) * 32], 32);
      const auto bit = [&](std::size_t i) { return std::bit_cast<std::uint32_t>(out[i] + 0.0f); };
      const First here{{bit(0), bit(1), bit(2), bit(4), bit(5), bit(6)}, p.stride, lod_test::is_skirt(p)};
      const auto [known, fresh] = first.try_emplace(lod_test::key_of(s, p, v % side, v / side).bits, here);
      if (fresh) continue;
      ++result.places;
      result.across_levels += known->second.stride != p.stride ? 1 : 0;
      result.with_skirt += known->second.skirt != here.skirt ? 1 : 0;
      result.unequal += known->second.bits != here.bits ? 1 : 0;
    }
  return result;
}

// All four borders of the tree, each level, both joins, three sizes, calm and storm: from just above the water, from
// where the levels are few, and far from the origin off the tree's corners. Controls seen: a footprint that follows the
// patch's stride; row 0 of the skirt moved outwards by 1e-6 of its place.
TEST_F(Joints, SharedVerticesAreTheSameToTheBitAsTheShaderPutsThemOut) {
  std::size_t number = 0;
  for (const char* preset : {"low", "high"})
    for (const char* scene : {"calm", "storm"})
      for (const char* size : {"256", "1024", "8192"}) {
        if (!test::sampled(number++, 2)) continue;
        SeaShot shot({.scene = scene,
                      .preset = preset,
                      .width = 16,
                      .height = 16,
                      .probe = true,
                      // A coarser mesh than the preset's: all of it is to fit the probe.
                      .set = {{"waves.resolution", "32"},
                              {"lod.ocean_size_m", size},
                              {"lod.pixel_error", preset == std::string("low") ? "10" : "4"}}});
        for (const char* join : {"masked", "morphed"}) {
          shot.set("lod.join", join);
          Shared sum;
          for (const glm::dvec3& place :
               {glm::dvec3(5.0, 3.0, 7.0), glm::dvec3(-64.0, 60.0, 128.0), glm::dvec3(1e5 + 0.3, 900.0, -2e5)}) {
            const Shared shared = shared_vertices(shot, lod_test::everything_from(place));
            EXPECT_EQ(shared.unequal, 0) << join << ' ' << preset << ' ' << scene << ' ' << size;
            EXPECT_GT(shared.places, 200) << join << ' ' << preset << ' ' << scene << ' ' << size;
            sum.across_levels += shared.across_levels;
            sum.with_skirt += shared.with_skirt;
          }
          EXPECT_GT(sum.across_levels, 100) << join << ' ' << preset << ' ' << scene << ' ' << size;
          EXPECT_GT(sum.with_skirt, 100) << join << ' ' << preset << ' ' << scene << ' ' << size;
        }
      }
}

}  // namespace

}  // namespace seascape
