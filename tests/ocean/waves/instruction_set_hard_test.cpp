#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstring>

#include "ocean/waves/wave_tiles.h"

namespace seascape {
namespace {

TEST(WaveFieldHard, bits_do_not_depend_on_the_instruction_set) {
  // The tiles of every vector instruction set that this processor has are the same to the bit, so that the
  // same table of waves is the same sea on every machine. Control: one multiply-add in place of a product and a sum differs in the last bit
  // (seen between SSE4 and AVX2).
  const SeaState sea{.swell_height_m = 1};
  const WaveField field(sea, {.resolution = 128, .cascades = 2});
  WaveTiles best(true);
  field.evaluate(987654321, best);
  int sets = 0;
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    hwy::GetChosenTarget().DeInit();
    WaveTiles tiles(true);
    field.evaluate(987654321, tiles);
    for (int c = 0; c < 2; ++c)
      for (const WavePlane plane : {WavePlane::shift, WavePlane::slope, WavePlane::moments, WavePlane::velocity}) {
        const std::size_t bytes = sizeof(glm::vec4) * std::size_t(best.stride(0)) * 128;
        EXPECT_EQ(std::memcmp(tiles.texels(c, plane, 0), best.texels(c, plane, 0), bytes), 0)
            << hwy::TargetName(left & -left) << " cascade " << c << " plane " << int(plane);
      }
    ++sets;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  EXPECT_GE(sets, 1);
  RecordProperty("instruction_sets", sets);
}

}  // namespace
}  // namespace seascape
