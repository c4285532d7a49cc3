// The sea's tiles in the images that the surface samples against those of the wave field, texel for texel, and against
// the sum of their own waves: from the compute shaders, and uploaded (whose exact bits wave_upload_gpu_test.cpp has).
#include "ocean/drawn/wave_compute.h"

#include <algorithm>
#include <cmath>

#include "app/scene.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/gpu/drawn_tiles.h"
#include "tests/support/truth.h"

namespace seascape {

namespace {

using test::DrawnTiles;
using test::windy;

class WaveTilesOnGpu : public test::GpuTest, public ::testing::WithParamInterface<WavePlace> {};

INSTANTIATE_TEST_SUITE_P(Places, WaveTilesOnGpu, ::testing::Values(WavePlace::gpu, WavePlace::cpu), test::place_name);

struct Worst {
  double error = 0.0;  // over the value itself and the root mean square of its channel in its tile together
  std::string where = "nowhere";
};

// The largest difference of any texel of any cascade, level and channel. `scaled`: the CPU's values times this (a
// control).
Worst compare(DrawnTiles& gpu, const WaveField& field, std::int64_t ticks, float scaled = 1.0f) {
  WaveTiles cpu;
  field.evaluate(ticks, cpu);
  gpu.compute(ticks);
  Worst worst;
  for (int cascade = 0; cascade < cpu.cascades(); ++cascade)
    for (int image = 0; image < 3; ++image) {
      glm::dvec4 scale(0.0);  // of level 0; coarser levels hold averages of the same numbers
      for (int level = 0; level < cpu.levels(cascade); ++level) {
        const int size = cpu.samples(cascade) >> level;
        const auto got = gpu.texels(cascade, WavePlane(image), level);
        if (int(got.size()) != size * size) return {1e9, "a level of another size"};
        const auto wanted = [&](int x, int z) {
          const int at = z * cpu.stride(cascade, level) + x;
          return glm::dvec4(cpu.texels(cascade, WavePlane(image), level)[at]);
        };
        if (level == 0) {
          for (int z = 0; z < size; ++z)
            for (int x = 0; x < size; ++x) scale += wanted(x, z) * wanted(x, z) / double(size * size);
          scale = glm::sqrt(scale);
          // Levels and channels that hold next to nothing are judged by the tile's others.
          const double largest = std::max({scale.x, scale.y, scale.z, scale.w, 1e-12});
          scale = glm::max(scale, glm::dvec4(0.01 * largest));
        }
        for (int z = 0; z < size; ++z)
          for (int x = 0; x < size; ++x)
            for (int c = 0; c < 4; ++c) {
              const double want = scaled * wanted(x, z)[c];
              // dDx/dz shares a transform with Dz, which is up to 1 / k larger, and has its rounding.
              const double shared = image == 2 && c == 3 ? 4.0 : 1.0;
              const double error =
                  std::abs(double(got[std::size_t(z * size + x)][c]) - want) / (shared * (scale[c] + std::abs(want)));
              if (error <= worst.error) continue;
              worst.error = error;
              worst.where = "cascade " + std::to_string(cascade) + ", image " + std::to_string(image) + ", level " +
                            std::to_string(level) + ", x " + std::to_string(x) + ", z " + std::to_string(z) +
                            ", channel " + std::to_string(c);
            }
      }
    }
  return worst;
}

// Single floats sum a band of 4096 waves in another order than the CPU does; a half float keeps 11 bits (1 in 2048),
// which drivers may cut rather than round, and a mip level is rounded again from levels that were. The control: 1 in
// 10,000 (single) and 1 in 100 (half) is seen.
constexpr double single_tolerance = 1e-5, half_tolerance = 2e-3;

TEST_P(WaveTilesOnGpu, EqualTheWaveFieldAtEveryResolution) {
  for (const int resolution : {16, 32, 64, 128, 256, 512}) {
    const WaveQuality quality{.resolution = resolution, .cascades = resolution <= 128 ? 4 : 2};
    DrawnTiles gpu(GetParam(), windy(), quality);
    const Worst worst = compare(gpu, WaveField(windy(), quality), ticks_from_seconds(17.3));
    EXPECT_LE(worst.error, single_tolerance) << resolution << ": " << worst.where;
    RecordProperty("worst_" + std::to_string(resolution), std::to_string(worst.error));
  }
}

// Orbits wider than high, from 8 of their height on held. Control: a push without the depth.
TEST_P(WaveTilesOnGpu, EqualTheWaveFieldInShallowWater) {
  for (const double depth_m : {0.05, 4.0, 40.0}) {
    SeaState sea = windy();
    sea.depth_m = depth_m;
    const WaveQuality quality{.resolution = 64, .cascades = 4};
    DrawnTiles gpu(GetParam(), sea, quality);
    const Worst worst = compare(gpu, WaveField(sea, quality), ticks_from_seconds(17.3));
    EXPECT_LE(worst.error, single_tolerance) << depth_m << " m: " << worst.where;
  }
}

TEST_P(WaveTilesOnGpu, EqualTheWaveFieldForAnyNumberOfCascades) {
  for (int cascades = 1; cascades <= 5; ++cascades) {
    const WaveQuality quality{.resolution = 64, .cascades = cascades};
    DrawnTiles gpu(GetParam(), windy(), quality);
    const WaveField field(windy(), quality);
    const Worst worst = compare(gpu, field, ticks_from_seconds(3.1));
    EXPECT_LE(worst.error, single_tolerance) << cascades << ": " << worst.where;
    EXPECT_GT(compare(gpu, field, ticks_from_seconds(3.1), 1.0001f).error, single_tolerance);
    EXPECT_EQ(gpu.images().cascades(), cascades);
    EXPECT_EQ(gpu.images().sets().size(), cascades > 1 ? 2u : 1u);
  }
}

// Phases are exact for centuries, backwards too. The control: a thousandth of a second off is seen.
TEST_P(WaveTilesOnGpu, EqualTheWaveFieldAtAnyTime) {
  const WaveQuality quality{.resolution = 64, .cascades = 4};
  DrawnTiles gpu(GetParam(), windy(), quality);
  const WaveField field(windy(), quality);
  for (const double time_s : {0.0, 1e3, 1e7, -1e7, 1e9, 0.25}) {
    const Worst worst = compare(gpu, field, ticks_from_seconds(time_s));
    EXPECT_LE(worst.error, single_tolerance) << time_s << " s: " << worst.where;
  }
  gpu.compute(ticks_from_seconds(1e7 + 0.001));
  const auto later = gpu.texels(1, WavePlane::shift, 0);
  gpu.compute(ticks_from_seconds(1e7));
  const auto now = gpu.texels(1, WavePlane::shift, 0);
  double square = 0.0, change = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    square += double(now[i].y) * now[i].y;
    change = std::max(change, std::abs(double(now[i].y) - later[i].y));
  }
  EXPECT_GT(change, single_tolerance * std::sqrt(square / double(now.size())));
}

TEST_P(WaveTilesOnGpu, HalfFloatsKeepElevenBits) {
  const WaveQuality quality{.resolution = 128, .cascades = 4, .half_storage = true};
  DrawnTiles gpu(GetParam(), windy(), quality);
  ASSERT_TRUE(gpu.images().half_storage());
  const WaveField field(windy(), quality);
  for (const double time_s : {0.0, 1e3, 1e7}) {
    const Worst worst = compare(gpu, field, ticks_from_seconds(time_s));
    EXPECT_LE(worst.error, half_tolerance) << time_s << " s: " << worst.where;
    EXPECT_GT(worst.error, 1e-5) << "these are no halves";
  }
  EXPECT_GT(compare(gpu, field, 0, 1.01f).error, half_tolerance);
}

// Every shipped scene, as the program would compute it.
TEST_P(WaveTilesOnGpu, EqualTheWaveFieldInEveryScene) {
  for (const char* name : {"open_sea", "calm", "storm", "swell"}) {
    const SeaState sea = load_scene(name, "high").settings.sea;
    const WaveQuality quality{.resolution = 64, .cascades = 5};
    DrawnTiles gpu(GetParam(), sea, quality);
    const Worst worst = compare(gpu, WaveField(sea, quality), ticks_from_seconds(60.0));
    EXPECT_LE(worst.error, single_tolerance) << name << ": " << worst.where;
  }
}

// The drawn significant height is the sum of its own waves to 1 %, over 24 times, since opposed waves beat. The
// control: the same tiles taken 2 % higher do not pass.
TEST_P(WaveTilesOnGpu, HeightIsTheSumOfItsWaves) {
  for (const bool half : {false, true}) {
    DrawnTiles gpu(GetParam(), windy(), {.resolution = 64, .cascades = 4, .half_storage = half});
    double variance = 0.0;
    constexpr int times = 24;
    for (int t = 0; t < times; ++t) {
      gpu.compute(ticks_from_seconds(t * 7.7));
      for (int cascade = 0; cascade < 4; ++cascade) {
        const auto texels = gpu.texels(cascade, WavePlane::shift, 0);
        double sum = 0.0, square = 0.0;
        for (const glm::vec4& texel : texels) {
          sum += texel.y;
          square += double(texel.y) * texel.y;
        }
        const double n = double(texels.size());
        EXPECT_LE(std::abs(sum / n), 1e-3 * std::sqrt(square / n)) << "the mean of a tile is the still sea";
        variance += square / n / times;
      }
    }
    double carried = 0.0;  // waves are higher at texels, by what sampling between them takes
    for (int c = 0; c < 4; ++c)
      for (int mz = -bins_of(c) / 2; mz < bins_of(c) / 2; ++mz)
        for (int mx = -bins_of(c) / 2; mx < bins_of(c) / 2; ++mx) {
          const glm::dvec2 a =
              truth::raised(mx, mz, gpu.set(c).samples) * glm::dvec2(gpu.bins().at(c, mx, mz).amplitude);
          carried += 0.5 * glm::dot(a, a);
        }
    const double ratio = std::sqrt(variance / carried);
    EXPECT_NEAR(ratio, 1.0, 0.01);
    EXPECT_GT(std::abs(1.02 * ratio - 1.0), 0.01);
  }
}

// An equal time computes nothing; another does.
TEST_P(WaveTilesOnGpu, TheSameTimeIsNotComputedTwice) {
  DrawnTiles tiles(GetParam(), windy(), {.resolution = 32, .cascades = 1},
                   WaveImages::Filled::copied);  // by a pass that can be counted
  std::vector<bool> worked;
  for (const std::int64_t ticks : {5, 5, 6, 6, 5}) {
    tiles.frame().begin();
    tiles.update(ticks);
    worked.push_back(tiles.frame().counts().passes > 0);
    tiles.frame().submit();
  }
  tiles.frame().finish();
  EXPECT_EQ(worked, (std::vector<bool>{true, false, true, false, true}));
}

// Workgroups of transforms fit the device, eight side by side where there is room. Control: without the limit of shared
// memory the least device that Vulkan allows was given 128 invocations (seen).
TEST(TransformGroup, FitsTheDevice) {
  const auto group = [](std::uint32_t radix, std::uint32_t invocations, std::uint32_t shared_bytes) {
    DeviceFacts facts;
    facts.max_workgroup = invocations;
    facts.shared_memory = shared_bytes;
    return transform_group(radix, facts);
  };
  EXPECT_EQ(group(16, 1024, 32768), 128u);
  EXPECT_EQ(group(16, 128, 16384), 64u);  // the least that Vulkan asks for: 128 would share 17,408 bytes
  EXPECT_EQ(group(16, 64, 65536), 64u);
  EXPECT_EQ(group(8, 128, 16384), 64u);
}

}  // namespace

}  // namespace seascape
