// The sea's tiles from the compute shaders against those of the wave field on the CPU, texel for texel, and against the sum
// of their own waves.
#include "ocean/waves/wave_compute.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "app/scene.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape {

namespace {

class WaveTilesOnGpu : public test::GpuTest {};

SeaState windy() {
  SeaState sea;
  sea.wind_speed_mps = 12.0;
  sea.fetch_m = 150e3;
  sea.swell_height_m = 1.2;
  sea.chop = 1.1;
  return sea;
}

// The GPU's tiles for one sea and quality, at any time.
class GpuTiles {
 public:
  GpuTiles(const SeaState& sea, const WaveQuality& quality)
      : bins_(make_wave_bins(sea, quality)),
        statistics_(sea_statistics(sea, bins_)),
        frame_(test::device(), 4096),
        waves_(test::device(), sea, quality, bins_, statistics_, 1.0, VK_IMAGE_USAGE_STORAGE_BIT),
        compute_(test::device(), test::shaders(), sea, quality, bins_, waves_) {}
  void compute(std::int64_t ticks) {
    frame_.begin();
    compute_.update(frame_, ticks);
    frame_.submit();
    frame_.finish();
  }
  std::vector<glm::vec4> texels(const Image& image, int cascade, int level) const {
    const auto bytes = read_image(test::device(), image, std::uint32_t(cascade), std::uint32_t(level));
    const bool half = image.spec().format == VK_FORMAT_R16G16B16A16_SFLOAT;
    std::vector<glm::vec4> list(bytes.size() / (half ? 8 : 16));
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (half) {
        std::uint64_t packed;
        std::memcpy(&packed, &bytes[8 * i], 8);
        list[i] = glm::unpackHalf4x16(packed);
      } else {
        std::memcpy(&list[i], &bytes[16 * i], 16);
      }
    }
    return list;
  }
  const WaveImages& waves() const { return waves_; }
  const SeaStatistics& statistics() const { return statistics_; }

 private:
  WaveBins bins_;
  SeaStatistics statistics_;
  Frame frame_;
  WaveImages waves_;
  WaveCompute compute_;
};

struct Worst {
  double error = 0.0;  // over the value itself and the root mean square of its channel in its tile together
  std::string where = "nowhere";
};

// The largest difference of any texel of any cascade, level and channel. `scaled`: the CPU's values times this (a control).
Worst compare(GpuTiles& gpu, const WaveField& field, std::int64_t ticks, float scaled = 1.0f) {
  WaveTiles cpu;
  field.evaluate(ticks, cpu);
  gpu.compute(ticks);
  Worst worst;
  const Image* images[] = {&gpu.waves().displacement(), &gpu.waves().derivatives(), &gpu.waves().moments()};
  for (int cascade = 0; cascade < cpu.cascades(); ++cascade)
    for (int image = 0; image < 3; ++image) {
      glm::dvec4 scale(0.0);  // of level 0; coarser levels hold averages of the same numbers
      for (int level = 0; level < cpu.levels(); ++level) {
        const int size = cpu.resolution() >> level;
        const auto got = gpu.texels(*images[image], cascade, level);
        if (int(got.size()) != size * size) return {1e9, "a level of another size"};
        const auto wanted = [&](int x, int z) {
          const int at = z * cpu.stride(level) + x;
          const WavePlane plane = image == 0 ? WavePlane::shift : image == 1 ? WavePlane::slope : WavePlane::moments;
          return glm::dvec4(cpu.texels(cascade, plane, level)[at]);
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
              const double error = std::abs(double(got[std::size_t(z * size + x)][c]) - want) / (shared * (scale[c] + std::abs(want)));
              if (error <= worst.error) continue;
              worst.error = error;
              worst.where = "cascade " + std::to_string(cascade) + ", image " + std::to_string(image) + ", level " +
                            std::to_string(level) + ", x " + std::to_string(x) + ", z " + std::to_string(z) + ", channel " + std::to_string(c);
            }
      }
    }
  return worst;
}

// Single floats sum a band of 4096 waves in another order than the CPU does; a half float keeps 11 bits (1 in 2048), which
// drivers may cut rather than round, and a mip level is rounded again from levels that were. The control: 1 in 10,000
// (single) and 1 in 100 (half) is seen.
constexpr double single_tolerance = 1e-5, half_tolerance = 2e-3;

TEST_F(WaveTilesOnGpu, EqualTheWaveFieldAtEveryResolution) {
  for (const int resolution : {16, 32, 64, 128, 256, 512}) {
    const WaveQuality quality{.resolution = resolution, .cascades = resolution <= 128 ? 4 : 2};
    GpuTiles gpu(windy(), quality);
    const Worst worst = compare(gpu, WaveField(windy(), quality), ticks_from_seconds(17.3));
    EXPECT_LE(worst.error, single_tolerance) << resolution << ": " << worst.where;
    RecordProperty("worst_" + std::to_string(resolution), std::to_string(worst.error));
  }
}

TEST_F(WaveTilesOnGpu, EqualTheWaveFieldForAnyNumberOfCascades) {
  for (int cascades = 1; cascades <= 5; ++cascades) {
    const WaveQuality quality{.resolution = 64, .cascades = cascades};
    GpuTiles gpu(windy(), quality);
    const WaveField field(windy(), quality);
    const Worst worst = compare(gpu, field, ticks_from_seconds(3.1));
    EXPECT_LE(worst.error, single_tolerance) << cascades << ": " << worst.where;
    EXPECT_GT(compare(gpu, field, ticks_from_seconds(3.1), 1.0001f).error, single_tolerance);
    EXPECT_EQ(int(gpu.waves().displacement().spec().layers), cascades);
  }
}

// Phases are exact for centuries, backwards too. The control: a thousandth of a second off is seen.
TEST_F(WaveTilesOnGpu, EqualTheWaveFieldAtAnyTime) {
  const WaveQuality quality{.resolution = 64, .cascades = 4};
  GpuTiles gpu(windy(), quality);
  const WaveField field(windy(), quality);
  for (const double time_s : {0.0, 1e3, 1e7, -1e7, 1e9, 0.25}) {
    const Worst worst = compare(gpu, field, ticks_from_seconds(time_s));
    EXPECT_LE(worst.error, single_tolerance) << time_s << " s: " << worst.where;
  }
  gpu.compute(ticks_from_seconds(1e7 + 0.001));
  const auto later = gpu.texels(gpu.waves().displacement(), 0, 0);
  gpu.compute(ticks_from_seconds(1e7));
  const auto now = gpu.texels(gpu.waves().displacement(), 0, 0);
  double square = 0.0, change = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    square += double(now[i].y) * now[i].y;
    change = std::max(change, std::abs(double(now[i].y) - later[i].y));
  }
  EXPECT_GT(change, single_tolerance * std::sqrt(square / double(now.size())));
}

TEST_F(WaveTilesOnGpu, HalfFloatsKeepElevenBits) {
  const WaveQuality quality{.resolution = 128, .cascades = 4, .half_storage = true};
  GpuTiles gpu(windy(), quality);
  ASSERT_TRUE(gpu.waves().half_storage());
  const WaveField field(windy(), quality);
  for (const double time_s : {0.0, 1e3, 1e7}) {
    const Worst worst = compare(gpu, field, ticks_from_seconds(time_s));
    EXPECT_LE(worst.error, half_tolerance) << time_s << " s: " << worst.where;
    EXPECT_GT(worst.error, 1e-5) << "these are no halves";
  }
  EXPECT_GT(compare(gpu, field, 0, 1.01f).error, half_tolerance);
}

// Every shipped scene, as the program would compute it.
TEST_F(WaveTilesOnGpu, EqualTheWaveFieldInEveryScene) {
  for (const char* name : {"open_sea", "calm", "storm", "swell"}) {
    const SeaState sea = load_scene(name, "high").settings.sea;
    const WaveQuality quality{.resolution = 64, .cascades = 5};
    GpuTiles gpu(sea, quality);
    const Worst worst = compare(gpu, WaveField(sea, quality), ticks_from_seconds(60.0));
    EXPECT_LE(worst.error, single_tolerance) << name << ": " << worst.where;
  }
}

// The drawn significant height is the sum of its own waves to 1 %, over 24 times, since opposed waves beat. The control: the
// same tiles taken 2 % higher do not pass.
TEST_F(WaveTilesOnGpu, HeightIsTheSumOfItsWaves) {
  for (const bool half : {false, true}) {
    GpuTiles gpu(windy(), {.resolution = 64, .cascades = 4, .half_storage = half});
    double variance = 0.0;
    constexpr int times = 24;
    for (int t = 0; t < times; ++t) {
      gpu.compute(ticks_from_seconds(t * 7.7));
      for (int cascade = 0; cascade < 4; ++cascade) {
        const auto texels = gpu.texels(gpu.waves().displacement(), cascade, 0);
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
    const double ratio = std::sqrt(variance / gpu.statistics().height_variance);
    EXPECT_NEAR(ratio, 1.0, 0.01);
    EXPECT_GT(std::abs(1.02 * ratio - 1.0), 0.01);
  }
}

// An equal time computes nothing; another does.
TEST_F(WaveTilesOnGpu, TheSameTimeIsNotComputedTwice) {
  const WaveQuality quality{.resolution = 32, .cascades = 1};
  const WaveBins bins = make_wave_bins(windy(), quality);
  WaveImages images(test::device(), windy(), quality, bins, sea_statistics(windy(), bins), 1.0, VK_IMAGE_USAGE_STORAGE_BIT);
  WaveCompute waves(test::device(), test::shaders(), windy(), quality, bins, images);
  Frame frame(test::device(), 4096);
  std::vector<bool> worked;
  for (const std::int64_t ticks : {5, 5, 6, 6, 5}) {
    frame.begin();
    waves.update(frame, ticks);
    worked.push_back(frame.counts().dispatches > 0);
    frame.submit();
  }
  frame.finish();
  EXPECT_EQ(worked, (std::vector<bool>{true, false, true, false, true}));
}

}  // namespace

}  // namespace seascape
