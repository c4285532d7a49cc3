// The surface of the dynamic waves at one time, as sea() adds it: displacement, sharpened sideways but never folded,
// and its slopes.
#pragma once
#include <tbb/cache_aligned_allocator.h>

#include <algorithm>
#include <span>
#include <vector>

#include "ocean/places/dynamic_surface_simd.h"
#include "ocean/places/dynamic_waves.h"

namespace seascape {

// To add to a place of the sea at rest.
struct DynamicSample {
  glm::dvec3 displacement{0.0};     // m
  glm::dvec2 height_gradient{0.0};  // dh/dx, dh/dz over the rest position
  glm::dvec3 shift_gradient{0.0};   // dDx/dx, dDz/dz, dDx/dz (= dDz/dx)
};

// Water whose waves are h is also moved sideways, by D with i k/|k| coth(k depth) h in wave numbers (linear orbits,
// Airy 1845), times the setting `sharpening` and a share from 0 to 1: so much that at no texel of any level I + grad D,
// all levels added up, squeezes the water to less than a fifth. What lies between texels of waves of eight texels and
// more is at most 1 / cos(pi / 8)^2 = 1.17 times as steep: I + grad D is positive definite everywhere, so that the
// surface cannot cut itself. The share follows from the highest steepness of each level, and changes as smoothly as
// that does.
class DynamicSurface {
 public:
  explicit DynamicSurface(const DynamicWavesSettings& settings);

  // Takes the waves as they are, or as they are `ahead_s` seconds later if nothing pushes them meanwhile (exact but for
  // what pushes and for the border). Costs four transforms a level that moves, with its `velocity` six; none where all
  // rest. Levels in parallel.
  void evaluate(const DynamicWaves& waves, double ahead_s = 0.0, bool velocity = false);

  // At a rest position (m), for a footprint (m): the sum of the levels, each fading out towards its window's end
  // (lod_present), the finest with the viewer's height, and with footprints from 4 to 8 of its texels, half and all of
  // its shortest wave. Between texels linearly, which takes 5.6 % (rms) of a wave of 8 texels. Slopes leave out that of
  // the fading, waves' height over an eighth of a window.
  DynamicSample sea(glm::dvec2 rest_xz_m, double footprint_m) const;
  // Adds the levels there, each times its weight (0 or more), and of the sideways displacement this share.
  void add(glm::dvec2 rest_xz_m, std::span<const double> weights, double share, DynamicSample& to) const;
  // What a footprint leaves of a level with such texels.
  static double kept(double footprint_m, double texel_m) {
    return std::clamp(2.0 - footprint_m / (4.0 * texel_m), 0.0, 1.0);
  }

  double share() const { return share_; }  // of the sharpening that could be had
  // What a level's texels come to.
  struct Extent {
    double height_m = 0.0,
           shift_m = 0.0;           // nowhere more, to what straight lines between texels have; the shift after `share`
    double squeeze = 0.0;           // how much the water is squeezed in any direction, before `share` and any fading
    double bent_per_m = 0.0;        // of the height along any line, from texel to texel
    glm::dvec3 slope_moments{0.0};  // means of (dh/dx)^2, (dh/dz)^2, product
  };
  Extent extent(int level) const;
  int levels() const { return int(levels_.size()); }
  double texel_m(int level) const { return levels_[std::size_t(level)].texel_m; }
  // As shaders have the windows: places count from `origin_xz_m`.
  gpu::LodWindows windows(glm::dvec2 origin_xz_m) const {
    return lod_windows(settings_.windows, placement_, origin_xz_m);
  }
  // Planes of a level within what half floats hold, samples^2 texels each, texel (x, z) modulo the samples: Dx, h, Dz,
  // dDx/dz and dh/dx, dh/dz, dDx/dx, dDz/dz. Of Dx and Dz before `share`.
  std::span<const glm::vec4> shift(int level) const { return levels_[std::size_t(level)].shift; }
  std::span<const glm::vec4> slope(int level) const { return levels_[std::size_t(level)].slope; }
  // dDx/dt (before `share`), dh/dt, dDz/dt, 0 of waves that nothing pushes; empty where it was not wanted.
  std::span<const glm::vec4> velocity(int level) const { return levels_[std::size_t(level)].velocity; }
  bool has_velocity() const { return velocity_; }
  int samples() const { return plan_.n; }  // a side of a level
  glm::dvec2 viewer() const { return placement_.viewer; }
  bool still(int level) const { return levels_[std::size_t(level)].still; }

 private:
  using Plane = std::vector<glm::vec4, tbb::cache_aligned_allocator<glm::vec4>>;
  struct Level {
    bool still = true;
    Extent extent;  // its shift before `share`
    double texel_m = 1.0, squeeze = 0.0, table_texel_m = 0.0, table_depth_m = 0.0, table_sharpening = 0.0;
    LevelTable table;
    Plane shift, slope, velocity;
  };
  void make_table(const WaveLevel& waves, Level& level) const;
  void evaluate(const WaveLevel& waves, Level& level, double border_m, double ahead_s);
  DynamicWavesSettings settings_;
  bool velocity_ = false;
  FftPlan plan_;
  std::vector<Level> levels_;
  LodPlacement placement_;
  gpu::LodWindows windows_{};  // places from the viewer
  double share_ = 1.0;
};

}  // namespace seascape
