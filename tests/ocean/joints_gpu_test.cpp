// Where patches and the skirt meet: the vertices that the drawing vertex shader puts out are the same to the bit, for both ways to
// join levels.
#include <bit>
#include <cstring>
#include <map>

#include "tests/ocean/lod/lod_support.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"

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

Shared shared_vertices(const std::string& scene, const std::string& preset, const std::string& join, const Pose& head) {
  SeaShot shot({.scene = scene, .preset = preset, .width = 64, .height = 36, .probe = true,
                .set = {{"lod.join", join}, {"waves.resolution", "64"}, {"camera.vertical_fov_deg", "100"}}});
  shot.draw(head, 12.3);
  const SurfaceSelection& s = shot.experience().ocean().select(shot.viewpoint(head));
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

// Control seen: a footprint that follows the patch's stride.
TEST_F(Joints, SharedVerticesAreTheSameToTheBitAsTheShaderPutsThemOut) {
  for (const char* join : {"masked", "morphed"})
    for (const char* preset : {"low", "high"}) {
      Shared sum;
      for (const char* scene : {"open_sea", "storm"})
        for (const Pose& head : {pose({5.0, 3.0, 7.0}, 40.0, -10.0), pose({1e5 + 0.3, 300.0, -2e5}, 200.0, -25.0)}) {
          const Shared shared = shared_vertices(scene, preset, join, head);
          EXPECT_EQ(shared.unequal, 0) << join << ' ' << preset << ' ' << scene;
          EXPECT_GT(shared.places, 200) << join << ' ' << preset << ' ' << scene;
          sum.across_levels += shared.across_levels;
          sum.with_skirt += shared.with_skirt;
        }
      EXPECT_GT(sum.across_levels, 100) << join << ' ' << preset;
      EXPECT_GT(sum.with_skirt, 100) << join << ' ' << preset;
    }
}

}  // namespace

}  // namespace seascape
