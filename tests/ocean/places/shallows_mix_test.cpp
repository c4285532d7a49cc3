// A bed's waves between two seas: each of them at its end, and nothing jumps between.
#include "ocean/places/shallows_mix.h"

#include <gtest/gtest.h>

#include <bit>

#include "ocean/places/bed_change.h"
#include "ocean/waves/wave_field.h"

namespace seascape {
namespace {

std::shared_ptr<const Shallows> over_a_bank(double wind_mps, double to_deg) {
  SeaState sea;
  sea.wind_speed_mps = wind_mps;
  sea.wind_to_deg = to_deg;
  sea.depth_m = 20.0;
  InputSpec bank;
  bank.to = InputTarget::sea_depth;
  bank.value = {-1.5f, 0.0f, 0.0f, 0.0f};
  bank.blend = InputBlend::replace;
  bank.feather_m = 50.0;
  bank.shape = AreaInput{.round = true, .at_m = {14.0, -50.0}, .size_m = {120.0, 120.0}};
  PlaceInputs inputs;
  inputs.kinds.push_back(std::make_shared<const Inputs>(InputTarget::sea_depth, std::vector{bank}));
  return make_shallows(sea, make_wave_bins(sea, WaveQuality{.resolution = 64, .cascades = 3}), {}, inputs);
}

// Control seen: a direction that turns the longer way.
TEST(ShallowsMix, PassesFromOneSeaToTheOther) {
  const auto from = over_a_bank(9.0, 20.0), to = over_a_bank(16.0, 50.0);
  EXPECT_FALSE(ShallowsMix{});
  EXPECT_EQ((ShallowsMix{from, nullptr}).run_up_m(), from->run_up_m());
  PlaceWaves before = from->waves({14.0, -50.0}, 1.5);
  ShallowsMix mix{from, to};
  for (int i = 0; i <= 100; ++i) {
    mix.share = i / 100.0;
    const PlaceWaves now = mix.waves({14.0, -50.0}, 1.5);
    for (std::size_t c = 0; c < now.share.size(); ++c) EXPECT_NEAR(now.share[c], before.share[c], 0.02);
    for (int c = 0; c < Refraction::bent_cascades; ++c) {
      const glm::dvec2 way = mix.direction(c);
      EXPECT_NEAR(glm::length(way), glm::length(from->direction(c)), 1e-9);
      EXPECT_LT(glm::distance(way, from->direction(c)), i == 0 ? 1e-12 : 2.0);
      EXPECT_LT(glm::distance(way, to->direction(c)), i == 100 ? 1e-12 : 2.0);
      EXPECT_GE(glm::dot(way, from->direction(c)) + 1e-9, glm::dot(to->direction(c), from->direction(c)));
    }
    before = now;
  }
  const PlaceWaves end = to->waves({14.0, -50.0}, 1.5);
  EXPECT_EQ(before.share, end.share);
  EXPECT_EQ(before.swash, end.swash);
}

// In every frame the four windows around the viewer; each of the others within four frames; and none that is not stale.
// Control seen: a turn that passes one over.
TEST(BedTurns, EveryWindowHasItsTurn) {
  BedTurns turns(8);
  EXPECT_EQ(turns.take(0u), 0u);
  std::uint32_t copied = 0;
  for (int frame = 0; frame < 4; ++frame) {
    turns.stale();
    const std::uint32_t now = turns.take(0u);
    EXPECT_EQ(now & 15u, 15u);
    EXPECT_EQ(std::popcount(now), 5);
    copied |= now;
  }
  EXPECT_EQ(copied, 0xffu);
  for (int frame = 0; frame < 4; ++frame) copied = turns.take(frame == 0 ? 0x80u : 0u);
  EXPECT_FALSE(turns.any());
  EXPECT_EQ(turns.take(4u), 4u) << "what has changed by itself";
  BedTurns one(1);
  one.stale();
  EXPECT_EQ(one.take(0u), 1u);
}

}  // namespace
}  // namespace seascape
