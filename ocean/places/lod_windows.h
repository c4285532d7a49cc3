// Windows of local data around the viewer: one texture slice for each power of two, each snapped to its own texels, as
// wide as the height asks for.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "shaders/shared/lod_windows.h"

namespace seascape {

struct LodWindowSettings {
  int resolution = 256;         // texels a side of every slice: a multiple of 16, 32 to 2048
  int slices = 7;               // 2 to 16
  double texel_m = 0.125;       // of the finest slice while the viewer is low
  double scale_height_m = 8.0;  // up to this height; twice as high doubles all texels
  int most_octaves = 10;        // doublings at most, 0 to 40
  double follow_s = 0.5;        // in which 63 % of a change of height is followed
  bool operator==(const LodWindowSettings&) const = default;
};

// Throws Error naming the setting.
void validate(const LodWindowSettings& settings);

// Texels are doubled `octave` times, and slice 0 has given way to slice 1 by `blend` (0 to 1, 1 left out).
struct LodScale {
  int octave = 0;
  double blend = 0.0;
};

using LodIndex = glm::tvec2<std::int64_t>;

// Texel (i, j) of octave o is the square of t = texel_m 2^o metres that begins at (i t, j t), so that four texels of an
// octave make one of the next. Its value lies at its middle.
struct LodPlacement {
  LodScale scale;
  glm::dvec2 viewer{0.0};                             // x and z, m
  std::array<LodIndex, gpu::max_lod_slices> first{};  // the first texel of each slice's window, `resolution` a side
};

// The base-2 logarithm of the height over scale_height_m, between 0 and most_octaves, split in two: continuous where
// the octave changes, for a blend of 1 reads what the next octave's blend of 0 does. A height that is no number counts
// as 0.
LodScale lod_scale(const LodWindowSettings& settings, double height_m);

// Each window's middle is the corner of texels nearest to the viewer. Exact for up to 2^50 texels from the world's
// origin; a viewer farther away or that is no number is refused with an Error.
LodPlacement lod_placement(const LodWindowSettings& settings, glm::dvec2 viewer_xz_m, LodScale scale);

double lod_texel_m(const LodWindowSettings& settings, const LodPlacement& placement, int slice);

// LodWindows::reach: which slices a place reads, by its distance.
glm::vec4 lod_reach(const LodWindowSettings& settings, const LodPlacement& placement);

// As the shaders have it: places count from `origin_xz_m`. Coordinates are taken in double: they are as good far from
// the world's origin as near it.
gpu::LodWindows lod_windows(const LodWindowSettings& settings, const LodPlacement& placement, glm::dvec2 origin_xz_m);

// A viewer whose height is followed smoothly: within follow_s for the most part, at any frame rate alike; at once where
// it jumps.
class LodViewer {
 public:
  // Throws as validate() does.
  explicit LodViewer(const LodWindowSettings& settings);
  // After `seconds` more the viewer is here. What is no number, or too far, changes nothing. More than two octaves at
  // once, or more than 1 s, is a jump.
  const LodPlacement& follow(glm::dvec2 viewer_xz_m, double height_m, double seconds);
  const LodPlacement& placement() const { return placement_; }
  const LodWindowSettings& settings() const { return settings_; }

 private:
  LodWindowSettings settings_;
  LodPlacement placement_;
  double octaves_ = -1.0;  // below 0: not yet known
};

}  // namespace seascape
