#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstring>
#include <random>
#include <vector>

#include "ocean/sea/query.h"
#include "ocean/waves/fft.h"
#include "ocean/waves/wave_particles.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {
namespace {

TEST(WaveFieldHard, bits_do_not_depend_on_the_instruction_set) {
  // The tiles of every vector instruction set that this processor has are the same to the bit, so that the
  // same table of waves is the same sea on every machine. Control: one multiply-add in place of a product and a sum
  // differs in the last bit (seen between SSE4 and AVX2), columns of a mip level summed before rows on SSE4 alone in
  // its levels from 1 on (seen); one in either sum of particles (seen). Tile 2 is that of wave particles, summed in
  // either way.
  for (const int particles : {800, 5000}) {
    const SeaState sea{.swell_height_m = 1};
    const WaveField field(sea, {.resolution = 128, .cascades = 2},
                          {std::make_shared<WaveParticles>(WaveParticleSettings{.count = particles})});
    WaveTiles best(true);
    field.evaluate(987654321, best);
    int sets = 0;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
      hwy::SetSupportedTargetsForTest(left & -left);
      hwy::GetChosenTarget().DeInit();
      WaveTiles tiles(true);
      field.evaluate(987654321, tiles);
      for (int c = 0; c < 3; ++c)
        for (const WavePlane plane : {WavePlane::shift, WavePlane::slope, WavePlane::moments, WavePlane::velocity}) {
          for (int level = 0; level < best.levels(c); ++level) {
            const std::size_t bytes =
                sizeof(glm::vec4) * std::size_t(best.stride(c, level)) * std::size_t(best.samples(c) >> level);
            EXPECT_EQ(std::memcmp(tiles.texels(c, plane, level), best.texels(c, plane, level), bytes), 0)
                << hwy::TargetName(left & -left) << " cascade " << c << " plane " << int(plane) << " level " << level;
          }
        }
      ++sets;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
    EXPECT_GE(sets, 1);
    RecordProperty("instruction_sets", sets);
  }
}

TEST(FftHard, bits_do_not_depend_on_the_instruction_set) {
  // Every kind of plan: two stages of each radix, a band in a larger grid, folds of two and four. Control: one
  // multiply-add, as above (seen).
  for (const auto& [n, band] :
       {std::pair{32, 32}, {128, 128}, {256, 256}, {512, 64}, {512, 256}, {512, 512}, {1024, 512}, {1024, 1024}}) {
    const FftPlan plan = make_fft_plan(n, band);
    std::mt19937 random(5);
    std::vector<float> re(std::size_t(band) * band), im(re.size());
    for (std::size_t i = 0; i < re.size(); ++i)
      re[i] = float(random() % 2001) - 1000, im[i] = float(random() % 2001) - 1000;
    const std::size_t floats = std::size_t(n) * (n + 16);
    std::vector<float> best_re(floats), best_im(floats), other_re(floats), other_im(floats);
    std::vector<float> workspace(inverse_fft_floats(plan));
    inverse_fft(plan, re.data(), im.data(), best_re.data(), best_im.data(), n + 16, workspace);
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
      hwy::SetSupportedTargetsForTest(left & -left);
      hwy::GetChosenTarget().DeInit();
      workspace.resize(inverse_fft_floats(plan));
      inverse_fft(plan, re.data(), im.data(), other_re.data(), other_im.data(), n + 16, workspace);
      EXPECT_EQ(std::memcmp(best_re.data(), other_re.data(), floats * 4), 0)
          << hwy::TargetName(left & -left) << " " << n << " " << band;
      EXPECT_EQ(std::memcmp(best_im.data(), other_im.data(), floats * 4), 0)
          << hwy::TargetName(left & -left) << " " << n << " " << band;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }
}

TEST(WaveFieldHard, answers_do_not_depend_on_the_instruction_set) {
  // Nor on how many points a vector holds. Control: a multiply-add in the tile coordinates or in the blend of texels.
  const SeaState sea{.swell_height_m = 1};
  const WaveField field(sea, {.resolution = 128, .cascades = 4},
                        {std::make_shared<WaveParticles>(WaveParticleSettings{})});
  WaveTiles tiles(true);
  field.evaluate(987654321, tiles);
  std::vector<glm::dvec2> places;
  for (int i = 0; i < 3000; ++i) places.emplace_back(i * 0.731 - 900, i * i * 0.0137);
  std::vector<QueryAnswer> best(places.size());
  const QueryOptions options{.footprint_m = 0.3};
  query(field, tiles, places, best, options);
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    hwy::GetChosenTarget().DeInit();
    std::vector<QueryAnswer> answers(places.size());
    query(field, tiles, places, answers, options);
    int different = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const QueryAnswer &a = answers[i], &b = best[i];
      different += a.height_m != b.height_m || a.displacement != b.displacement || a.normal != b.normal ||
                   a.orbital_velocity_mps != b.orbital_velocity_mps ||
                   a.eulerian_velocity_mps != b.eulerian_velocity_mps || a.residual_m != b.residual_m ||
                   a.contraction != b.contraction || a.iterations != b.iterations;
    }
    EXPECT_EQ(different, 0) << hwy::TargetName(left & -left);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

}  // namespace
}  // namespace seascape
