#include "ocean/foam/foam_pattern.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <numeric>

#include "ocean/waves/gaussian.h"

namespace seascape {

namespace {

// How far the second nearest of scattered points is beyond the nearest, in cells: 0 on the walls between them.
double wall(glm::dvec2 at, int cells, std::uint32_t seed) {
  const glm::dvec2 scaled = at * double(cells);
  const glm::ivec2 cell(glm::floor(scaled));
  double nearest = 9.0, second = 9.0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      const glm::ivec2 c = cell + glm::ivec2(i, j);
      const auto key = std::uint32_t(((c.y % cells + cells) % cells) * cells + (c.x % cells + cells) % cells);
      const glm::dvec2 point =
          glm::dvec2(c) + glm::dvec2(uniform_number(seed, 2 * key), uniform_number(seed, 2 * key + 1));
      const double d = glm::length(point - scaled);
      if (d < nearest)
        second = nearest, nearest = d;
      else
        second = std::min(second, d);
    }
  return second - nearest;
}

// Smooth noise from 0 to 1 of so many bumps along the tile (Perlin 1985, of values).
double noise(glm::dvec2 at, int cells, std::uint32_t seed) {
  const glm::dvec2 scaled = at * double(cells), floor = glm::floor(scaled), f = scaled - floor,
                   s = f * f * (3.0 - 2.0 * f);
  const auto value = [&](int i, int j) {
    const int x = ((int(floor.x) + i) % cells + cells) % cells, z = ((int(floor.y) + j) % cells + cells) % cells;
    return uniform_number(seed, std::uint32_t(z * cells + x));
  };
  return glm::mix(glm::mix(value(0, 0), value(1, 0), s.x), glm::mix(value(0, 1), value(1, 1), s.x), s.y);
}

// Waves of a tile, in bands, from all directions: none so long that the tile is seen to come again, as noise on a
// lattice has.
struct Band {
  double least, most, weight;  // periods along the tile; the deviation
};
constexpr std::array<Band, 3> bands{{{4.0, 9.0, 0.076}, {10.0, 20.0, 0.066}, {22.0, 44.0, 0.048}}};
constexpr int waves_a_band = 40;

// The sum of these waves at a texel of a tile, of mean 0.
class Patches {
 public:
  explicit Patches(int side) : side_(side) {
    for (int i = 0; i < side; ++i) cosine_.push_back(float(std::cos(2.0 * std::numbers::pi * i / side)));
    for (std::size_t b = 0; b < bands.size(); ++b)
      for (std::uint32_t i = 0; i < waves_a_band; ++i) {
        const std::uint32_t key = 3 * (waves_a_band * std::uint32_t(b) + i);
        const double turn = std::numbers::pi * (double(i) + uniform_number(seed, key)) / waves_a_band,
                     periods = std::lerp(bands[b].least, bands[b].most, uniform_number(seed, key + 1));
        waves_.push_back({int(std::lround(periods * std::cos(turn))), int(std::lround(periods * std::sin(turn))),
                          int(double(side) * uniform_number(seed, key + 2)),
                          float(bands[b].weight * std::sqrt(2.0 / waves_a_band))});
      }
  }
  double at(int x, int z) const {
    float sum = 0.0f;
    for (const Wave& wave : waves_)
      sum += wave.height * cosine_[std::size_t(((wave.x * x + wave.z * z + wave.phase) % side_ + side_) % side_)];
    return double(sum);
  }

 private:
  static constexpr std::uint32_t seed = 14u;
  struct Wave {
    int x, z, phase;  // periods along the tile; of the tile's side
    float height;
  };
  int side_;
  std::vector<float> cosine_;
  std::vector<Wave> waves_;
};

}  // namespace

std::vector<std::uint8_t> foam_pattern(int side) {
  const auto n = std::size_t(side), texels = n * n;
  const Patches patches(side);
  std::vector<float> value(texels), fine(texels);
  tbb::parallel_for(0, side, [&](int z) {
    for (int x = 0; x < side; ++x) {
      glm::dvec2 at(glm::dvec2(x, z) / double(side));
      // Drawn askew, so that no wall is straight.
      at += 0.05 * (glm::dvec2(noise(at, 9, 21u), noise(at, 9, 22u)) - 0.5) +
            0.018 * (glm::dvec2(noise(at, 31, 23u), noise(at, 31, 24u)) - 0.5);
      const double large = wall(at, 12, 11u), small = wall(at, 29, 12u), least = wall(at, 71, 13u);
      const std::size_t i = std::size_t(z) * n + std::size_t(x);
      // Large cells hold small ones, and in places the foam is closed.
      value[i] = float(0.8 * std::min(large, 0.22 + 0.85 * small) + 0.2 * least + 0.85 * patches.at(x, z));
      fine[i] = float(std::clamp(1.6 * least, 0.0, 1.0));
    }
  });
  std::vector<std::uint32_t> order(texels);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return value[a] != value[b] ? value[a] < value[b] : a < b; });
  for (std::size_t i = 0; i < texels; ++i) value[order[i]] = (float(i) + 0.5f) / float(texels);
  std::vector<glm::vec4> level(texels);
  for (std::size_t z = 0; z < n; ++z)
    for (std::size_t x = 0; x < n; ++x) {
      const auto at = [&](std::size_t i, std::size_t j) { return value[(j % n) * n + i % n]; };
      const float along_x = 0.5f * (at(x + 1, z) - at(x + n - 1, z)),
                  along_z = 0.5f * (at(x, z + 1) - at(x, z + n - 1));
      const auto slope = [](float s) { return std::clamp(128.0f / 255.0f + 1024.0f / 255.0f * s, 0.0f, 1.0f); };
      level[z * n + x] = glm::vec4(at(x, z), slope(along_x), slope(along_z), fine[z * n + x]);
    }
  std::vector<std::uint8_t> bytes;
  for (std::size_t size = n;; size /= 2) {
    for (const glm::vec4& texel : level)
      for (int c = 0; c < 4; ++c) bytes.push_back(std::uint8_t(std::clamp(texel[c] * 255.0f + 0.5f, 0.0f, 255.0f)));
    if (size == 1) return bytes;
    std::vector<glm::vec4> next(size * size / 4);
    for (std::size_t z = 0; z < size / 2; ++z)
      for (std::size_t x = 0; x < size / 2; ++x) {
        const glm::vec4* from = &level[2 * z * size + 2 * x];
        next[z * size / 2 + x] = 0.25f * (from[0] + from[1] + from[size] + from[size + 1]);
      }
    level = std::move(next);
  }
}

}  // namespace seascape
