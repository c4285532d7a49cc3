// The fixed ladder of cascades of a sea: which tile carries which waves. It belongs to the sea, never to the quality.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "ocean/waves/sea_state.h"
#include "shaders/shared/wave_bin.h"

namespace seascape {

// Bins a side of a cascade's table.
constexpr int bins_of(int cascade) { return cascade == 0 ? gpu::long_tile_bins : gpu::wave_bins; }
// Samples a side of its tile at a quality: the longest has four times as many as the others, up to 512.
inline int tile_samples(const WaveQuality& quality, int cascade) {
  return cascade == 0 ? std::min(4 * quality.resolution, longest_tile_samples) : quality.resolution;
}

// A square periodic tile of waves. Tile coordinates are u = rotate(-rotation) (x, z) / side; a bin's world wave vector
// is k = rotate(rotation) (2 pi m / side).
struct Cascade {
  double side_m;
  double rotation_rad;
  // The share of variance of a wave number that this cascade carries: it rises from k_in[0] to k_in[1] and falls from
  // k_out[0] to k_out[1] (rad/m); neighbours' shares add to one (band_share).
  std::array<double, 2> k_in, k_out;
  bool warped = false;  // by pattern_warp.h
};

using Ladder = std::array<Cascade, gpu::max_cascades>;

// The longest tile has one of eight sides (132 m to 16.9 km, each twice the one before), so that a change of wind
// within a class keeps every wave in its place: the longest that leaves little of the sea's variance to the shorter
// tiles, which repeat within sight. Little is an eighth, and 0.15 from 4.2 km down. A light wind's waves are too short
// for a tile of 4.2 km. A shorter one would repeat within sight itself, and is warped. Where a swell is too long for
// a warped tile (a fiftieth of the variance in waves longer than a sixteenth of it), the tile stays as long as it has
// to. So it does, at 4.2 km, where a wind below 2 m/s makes waves too short for any. The sides after it fall by a ratio
// of 2 to 6.5 to a last one of 1.5 to 2.5 m. The longest tile carries |m| < 127 of its waves, the others |m| < 31 and
// start where |m| is about 5 or more. Throws Error as validate() does.
Ladder ladder(const SeaState& sea);

// Share of variance, 0 to 1, that cascade `index` carries at wave number k (rad/m). Over all cascades the shares add to
// 1 below the last cascade's k_out[0].
double band_share(const Ladder& ladder, int index, double k);

// What the bilinear filter leaves of a wave's amplitude where it is sampled between `samples` texels a side: the best
// fit of a wave to its own linear interpolation is sinc^2(m / samples) of it an axis. Tiles carry their waves higher by
// the inverse, down to four texels a wave; shorter ones, which only tiles of few samples have, are raised no more than
// that.
double sampled_share(int mx, int mz, int samples);

// (x, z) turned by `angle`, from x towards z.
inline glm::dvec2 rotate_xz(glm::dvec2 v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

// The longest wave that a cascade carries, in metres: its side for the first, which has the longest of all. A footprint
// of half of it begins to fade the cascade, one of all of it leaves nothing (kept_share).
double longest_wave(const Cascade& cascade);
double kept_share(double longest_m, double footprint_m);
inline double kept_share(const Cascade& cascade, double footprint_m) {
  return kept_share(longest_wave(cascade), footprint_m);
}
// The shortest, below which its share is none.
double shortest_wave(const Cascade& cascade);

}  // namespace seascape
