// The surface of the windows of waves that belong to bodies, at one time: of each window the levels, and how windows
// are weighed against each other.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "ocean/places/dynamic_surface.h"
#include "shaders/shared/wake_windows.h"

namespace seascape {

// Levels of the same length of waves are weighed: at a place each counts wake_present() of its window, times
// wake_share() of all of them. Weights add up to 1 where any window is whole, and fall to 0 at the outer borders.
class WakeSurface {
 public:
  explicit WakeSurface(const DynamicWavesSettings& settings);

  struct Part {
    std::uint64_t body = 0;
    std::array<glm::dvec2, gpu::max_wake_levels> middle_m{};  // of each level's window
    double presence = 0.0;                                    // 0 to 1
    DynamicSurface surface;
  };
  // Windows with waves, as they are `ahead_s` later if nothing pushes them meanwhile.
  struct Source {
    std::uint64_t body;
    double presence;
    std::array<glm::dvec2, gpu::max_wake_levels> middle_m;
    const DynamicWaves* waves;
  };
  void evaluate(std::span<const Source> windows, double ahead_s, bool velocity);

  // At a rest position (m), for a footprint (m); of all windows but that of `without` (0: none is left out). Gradients
  // leave out those of the weights: waves' height over a tenth of a window.
  DynamicSample sea(glm::dvec2 rest_xz_m, double footprint_m, std::uint64_t without = 0) const;

  // Whether anything may be there within the rectangle of these corners (m), the lesser and the greater; of all windows
  // but that of `without`.
  bool near(glm::dvec2 least_m, glm::dvec2 most_m, std::uint64_t without = 0) const;

  std::span<const Part> parts() const { return {parts_.data(), std::size_t(count_)}; }
  int levels() const { return parts_.front().surface.levels(); }
  int samples() const { return parts_.front().surface.samples(); }
  double texel_m(int level) const { return texel_m_ * double(1 << level); }
  double half_m(int level) const { return 0.5 * samples() * texel_m(level); }
  // Of the sideways displacement that the parts' planes hold, for all alike: their surfaces' own share does not count.
  double share() const { return share_; }
  // What the weighed texels of a level come to at most; the shift after `share`.
  DynamicSurface::Extent extent(int level) const;
  bool still(int level) const;  // in all windows

 private:
  std::vector<Part> parts_;  // room for all
  int count_ = 0;
  double texel_m_, share_ = 1.0;
};

}  // namespace seascape
