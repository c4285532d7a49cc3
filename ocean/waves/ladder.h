// The fixed ladder of cascades of a sea: which tile carries which waves. It belongs to the sea, never to the quality.
#pragma once
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "ocean/waves/sea_state.h"
#include "shaders/shared/wave_bin.h"

namespace seascape {

// A square periodic tile of waves. Tile coordinates are u = rotate(-rotation) (x, z) / side; a bin's world wave vector is
// k = rotate(rotation) (2 pi m / side).
struct Cascade {
  double side_m;
  double rotation_rad;
  // The share of variance of a wave number that this cascade carries: it rises from k_in[0] to k_in[1] and falls from
  // k_out[0] to k_out[1] (rad/m); neighbours' shares add to one (band_share).
  std::array<double, 2> k_in, k_out;
};

using Ladder = std::array<Cascade, gpu::max_cascades>;

// The longest tile is about 18 of the sea's longest peak waves, rounded to one of four classes (375, 750, 1500 or 3000 m),
// so that a change of wind within a class keeps every wave in its place; the sides after it fall by a ratio of 4.8 to 6 to a last one of 1 to 3 m.
// Each tile carries |m| < 31 of its own waves and starts where |m| is about 5. Throws Error as validate() does.
Ladder ladder(const SeaState& sea);

// Share of variance, 0 to 1, that cascade `index` carries at wave number k (rad/m). Over all cascades the shares add to 1
// below the last cascade's k_out[0].
double band_share(const Ladder& ladder, int index, double k);

// (x, z) turned by `angle`, from x towards z.
inline glm::dvec2 rotate_xz(glm::dvec2 v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

// The longest wave that a cascade carries, in metres: its side for the first, which has the longest of all. A footprint of half of
// it begins to fade the cascade, one of all of it leaves nothing (kept_share).
double longest_wave(const Cascade& cascade);
double kept_share(const Cascade& cascade, double footprint_m);

}  // namespace seascape
