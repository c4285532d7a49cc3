// The parts of a step of Foam that go texel by texel, a row at once, vectorised. All instruction sets give the same
// bits.
#pragma once
#include <glm/glm.hpp>
#include <span>

namespace seascape {

inline constexpr int foam_group = 16;  // rows have a multiple of it

// Less than this is none: half floats hold no less without loss, and processors are slow with much smaller numbers.
inline constexpr float least_foam = 6.2e-5f;

// Foam that is fed by `gains` (1/s) for dt seconds and spent (foam.h): what is no share or no gain is taken out.
struct SpentRow {
  bool holds = false, wrong = false;  // whether there is any foam; whether something was taken out
};
SpentRow spend_row(float loss_per_s, float dt, float lasting, std::span<const float> gains, std::span<float> covered);

// A row of a slice that a flow carries.
struct CarriedRow {
  const float* before;                     // the slice before the step, row by row from the window's first
  const glm::vec2 *above, *speed, *below;  // m/s, of the rows around; one texel more on either side of each may be read
  int side, row;
  float dt, texel_m;
};

// What comes to each texel of a row from where it was before: `values` of those that have it from within the window,
// and what they are to grow by. The others' texels come into `beyond`, with their ways in texels; their values are left
// to the caller. Gives how many they are. `beyond`, `ways`: as long as the row.
int carry_row(const CarriedRow& row, std::span<float> values, std::span<float> grow, std::span<int> beyond,
              std::span<glm::vec2> ways);
// Values times what they grow by, held from 0 to 1. Gives the sums of those below nothing and of the rest, before that.
glm::dvec2 settle_row(std::span<const float> values, std::span<const float> grow, std::span<float> covered);

}  // namespace seascape
