// What the tests of dynamic waves share: the whole surface at a place.
#pragma once
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "ocean/places/dynamic_waves.h"

namespace seascape::waves_test {

// Height and quarter of all levels, as they stand now.
class Surface {
 public:
  explicit Surface(const DynamicWaves& waves) : waves_(waves) {
    const std::size_t texels = std::size_t(n()) * std::size_t(n());
    for (int i = 0; i < waves.levels(); ++i) {
      heights_.emplace_back(texels);
      quarters_.emplace_back(texels);
      waves.level(i).surface(heights_.back(), quarters_.back());
    }
  }
  // The sum of all levels whose windows cover the place with `margin` of their sides to spare, between texels linearly.
  // Its absolute value is how high the waves there rise.
  std::complex<double> at(glm::dvec2 place, double margin = 0.125) const {
    std::complex<double> sum = 0.0;
    for (int i = 0; i < waves_.levels(); ++i) {
      const double texel = waves_.level(i).texel_m();
      const glm::dvec2 p = place / texel - 0.5, cell = glm::floor(p), f = p - cell;
      const LodIndex w(cell), first = waves_.placement().first[std::size_t(i)],
                              last = first + std::int64_t(n()) - std::int64_t(1);
      const double off = margin * n();
      if (p.x < double(first.x) + off || p.y < double(first.y) + off || p.x > double(last.x) - off ||
          p.y > double(last.y) - off)
        continue;
      for (int k = 0; k < 4; ++k)
        sum += (k & 1 ? f.x : 1.0 - f.x) * (k & 2 ? f.y : 1.0 - f.y) * texel_at(i, w + LodIndex(k & 1, k >> 1));
    }
    return sum;
  }
  std::complex<double> texel_at(int level, LodIndex w) const {
    const std::size_t at = std::size_t(w.y & (n() - 1)) * std::size_t(n()) + std::size_t(w.x & (n() - 1));
    return {heights_[std::size_t(level)][at], quarters_[std::size_t(level)][at]};
  }

 private:
  int n() const { return waves_.settings().windows.resolution; }
  const DynamicWaves& waves_;
  std::vector<std::vector<float>> heights_, quarters_;
};

inline DynamicWavesSettings quiet(int resolution, int slices, double texel_m) {
  DynamicWavesSettings s;
  s.windows = {.resolution = resolution, .slices = slices, .texel_m = texel_m};
  s.damping_per_s = 0.0;
  s.idle_m = 0.0;
  return s;
}

// Adds to level i a group around `middle` (m): `height` high, waves of length `wave_m` that run in direction (cos, sin)
// of `angle`, `width_m` wide (standard deviation), of each wave the level's share. The level was still.
inline void launch(DynamicWaves& waves, int i, glm::dvec2 middle, double wave_m, double angle, double width_m,
                   double height) {
  WaveLevel& level = waves.level(i);
  const int n = level.samples();
  const double k = 2.0 * std::numbers::pi / wave_m;
  std::vector<float> h(std::size_t(n) * std::size_t(n)), q(h.size());
  const LodIndex first = lod_placement(waves.settings().windows, waves.placement().viewer, {}).first[std::size_t(i)];
  for (std::int64_t z = 0; z < n; ++z)
    for (std::int64_t x = 0; x < n; ++x) {
      const LodIndex w = first + LodIndex(x, z);
      const glm::dvec2 p = (glm::dvec2(w) + 0.5) * level.texel_m() - middle;
      const double a = height * std::exp(-0.5 * (p.x * p.x + p.y * p.y) / (width_m * width_m)),
                   phase = k * (p.x * std::cos(angle) + p.y * std::sin(angle));
      const std::size_t at = std::size_t(w.y & (n - 1)) * std::size_t(n) + std::size_t(w.x & (n - 1));
      h[at] = float(a * std::cos(phase)), q[at] = float(a * std::sin(phase));
    }
  level.add(h, q);
  for (std::size_t m = 0; m < level.modes().size(); ++m) level.modes()[m] *= level.share()[m];
}

}  // namespace seascape::waves_test
