// A source's images hold what the source evaluates, texel for texel.
#include "ocean/drawn/drawn_source.h"

#include <glm/gtc/packing.hpp>

#include <cstring>

#include "ocean/sea/sea.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_particles.h"
#include "ocean/waves/wave_tiles.h"
#include "tests/support/gpu/gpu_test.h"

namespace seascape {
namespace {

class DrawnSources : public test::GpuTest {};

// Numbers of all images and levels that are not the field's. Halves may be off by their rounding.
std::size_t wrong_numbers(const DrawnSource& drawn, const WaveTiles& tiles, bool half) {
  std::size_t wrong = 0;
  const Image* images[] = {&drawn.displacement(), &drawn.derivatives(), &drawn.moments()};
  for (int plane = 0; plane < 3; ++plane)
    for (int level = 0; level < tiles.levels(1); ++level) {
      const auto bytes = read_image(test::device(), *images[plane], 0, std::uint32_t(level));
      const int size = tiles.samples(1) >> level;
      if (bytes.size() != std::size_t(size) * std::size_t(size) * (half ? 8u : 16u)) return std::size_t(-1);
      for (int i = 0; i < size * size; ++i) {
        const glm::vec4 want = tiles.texels(1, WavePlane(plane), level)[i / size * tiles.stride(1, level) + i % size];
        glm::vec4 got;
        std::uint64_t packed;
        if (half)
          std::memcpy(&packed, &bytes[std::size_t(8 * i)], 8), got = glm::unpackHalf4x16(packed);
        else
          std::memcpy(&got, &bytes[std::size_t(16 * i)], 16);
        for (int c = 0; c < 4; ++c)
          wrong += half ? std::abs(got[c] - want[c]) > 5e-4f * std::abs(want[c]) + 6e-8f
                        : std::memcmp(&got[c], &want[c], 4) != 0;
      }
    }
  return wrong;
}

// Also with two frames in flight, each of which keeps what it had: the second's evaluation is done while the first may
// still be copied. Control seen: planes copied from the one before.
TEST_F(DrawnSources, HoldWhatTheSourceEvaluates) {
  SeaState flat;
  flat.wind_speed_mps = 0.0;
  const auto source = std::make_shared<WaveParticles>(WaveParticleSettings{});
  const WaveField field(flat, {.resolution = 16, .cascades = 1}, {source});
  SeaSpec spec;
  spec.state = flat;
  spec.sources = {source};
  spec.drawn = spec.crests = spec.felt = {.resolution = 16, .cascades = 1};
  Sea sea(std::move(spec));
  WaveTiles tiles;
  for (const bool half : {false, true}) {
    DrawnSource drawn(test::device(), source, half);
    Frame frame(test::device(), 4096);
    for (int i = 0; i < 5; ++i) {
      const std::int64_t ticks = ticks_from_seconds(3.3 * i);
      frame.begin();
      const SeaView view = sea.view(ticks, SeaDetail::felt);
      drawn.update(frame, {sea, view, 3.3 * i, glm::dvec3(0.0)});
      frame.submit();
      if (i % 2 == 0) continue;
      frame.finish();
      field.evaluate(ticks, tiles);
      EXPECT_EQ(wrong_numbers(drawn, tiles, half), 0u) << half << " " << i;
      field.evaluate(ticks + 1000, tiles);
      EXPECT_GT(wrong_numbers(drawn, tiles, half), 1000u) << "a millisecond later";
    }
    frame.finish();
  }
}

}  // namespace
}  // namespace seascape
