#include "ocean/waves/source_error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "ocean/waves/mesh_error.h"
#include "ocean/waves/wave_tiles.h"
#include "ocean/waves/wave_tiles_simd.h"

namespace seascape {
namespace {

// Of heights, by the spacing in texels: 1, 2, 4, ... of them.
struct Missed {
  double square = 0.0, most = 0.0;
};
constexpr std::size_t most_octaves = 10;
using MissedByTexels = std::array<Missed, most_octaves>;

// A tile in memory of its own: the mip levels' displacements.
class Tile {
 public:
  explicit Tile(const TileSource& source) : workspace_(source.workspace_floats(false)) {
    for (int size = source.samples(); size >= 1; size /= 2) {
      PlaneLevel level{};
      level.stride = size;
      for (int plane = 0; plane < 3; ++plane) {
        texels_.emplace_back(std::size_t(size) * std::size_t(size));
        level.texels[plane] = texels_.back().data();
      }
      levels_.push_back(level);
    }
  }
  void evaluate(const TileSource& source, std::int64_t ticks) { source.evaluate(ticks, false, levels_, workspace_); }
  int levels() const { return int(levels_.size()); }
  // The height of a level's texel, round the torus.
  double height(int level, int x, int z) const {
    const PlaneLevel& of = levels_[std::size_t(level)];
    const int mask = of.stride - 1;
    return double(of.texels[0][(z & mask) * of.stride + (x & mask)].y);
  }

 private:
  std::vector<float> workspace_;
  std::vector<std::vector<glm::vec4>> texels_;
  std::vector<PlaneLevel> levels_;
};

// Vertices `apart` texels apart, 2 or more, at the middles of the texels that the level of half as many has there.
Missed missed(const Tile& tile, int apart, int samples) {
  const int level = std::countr_zero(unsigned(apart)) - 1;
  const double first = 0.5 * (0.5 * apart - 1.0);
  Missed result;
  for (int z = 0; z < samples; z += apart)
    for (int x = 0; x < samples; x += apart) {
      const auto corner = [&](int to_x, int to_z) {
        return tile.height(level, 2 * (x / apart + to_x), 2 * (z / apart + to_z));
      };
      const double a = corner(0, 0), b = corner(1, 0), c = corner(0, 1), d = corner(1, 1);
      // From the first texel at or after the corner: as many as there are vertices apart.
      const int from = int(std::ceil(first));
      for (int j = 0; j < apart; ++j)
        for (int i = 0; i < apart; ++i) {
          const double u = (from + i - first) / apart, v = (from + j - first) / apart;
          const double flat =
              u + v < 1.0 ? a + u * (b - a) + v * (c - a) : d + (1.0 - u) * (c - d) + (1.0 - v) * (b - d);
          const double off = std::abs(tile.height(0, x + from + i, z + from + j) - flat);
          result.square += off * off;
          result.most = std::max(result.most, off);
        }
    }
  result.square /= double(samples) * samples;
  return result;
}

MissedByTexels missed_by_texels(const TileSource& source) {
  constexpr std::array<std::int64_t, 2> seconds{101, 31013};
  Tile tile(source);
  MissedByTexels result{};
  for (const std::int64_t s : seconds) {
    tile.evaluate(source, s * gpu::ticks_per_second);
    for (int octave = 1; octave < tile.levels(); ++octave) {
      const Missed here = missed(tile, 1 << octave, source.samples());
      Missed& to = result[std::size_t(octave)];
      to = {to.square + here.square / double(seconds.size()), std::max(to.most, here.most)};
    }
  }
  // Waves have some texels: half the spacing misses a quarter.
  result[0] = {result[1].square / 16.0, result[1].most / 4.0};
  for (std::size_t octave = std::size_t(tile.levels()); octave < most_octaves; ++octave)
    result[octave] = result[octave - 1];
  return result;
}

// Between octaves, and below the first in proportion: between texels there are but kinks.
Missed at(const MissedByTexels& of, double texels) {
  if (!(texels > 1.0)) return {of[0].square * texels * texels, of[0].most * texels};
  const double octave = std::min(std::log2(texels), double(most_octaves - 1));
  const std::size_t n = std::min(std::size_t(octave), most_octaves - 2);
  const double share = octave - double(n);
  return {std::lerp(of[n].square, of[n + 1].square, share), std::lerp(of[n].most, of[n + 1].most, share)};
}

}  // namespace

void SourceError::add(const TileSource& source) {
  constexpr double more = 1.3;
  const MissedByTexels of_tile = missed_by_texels(source);
  for (std::size_t n = 0; n < most_m_.octave_m.size(); ++n) {
    const double spacing_m = std::ldexp(MeshError::least_spacing_m, int(n));
    double square = 0.0, most_square = 0.0, most = 0.0;
    for (const Laying& laying : source.layings()) {
      const Missed here = at(of_tile, spacing_m * source.samples() / laying.side_m);
      square += laying.size * laying.size * here.square;
      most_square += laying.size * laying.size * here.most * here.most;
      most += laying.size * here.most;
    }
    // Of few waves or of particles more meet than of many waves, at times. What is steeper than twice any water no mesh
    // is asked to follow.
    const double steepest_m = 2.0 * MeshError::most_over_spacing * spacing_m;
    const double likely =
        std::min(more * std::max(largest_of_missed(spacing_m, std::sqrt(square)), std::sqrt(most_square)), steepest_m);
    squares_m2_.octave_m[n] += likely * likely;
    most_m_.octave_m[n] += std::min(more * most, steepest_m);
  }
}

// A mesh misses a surface bent by c by at most c d^2 / 8 between vertices d apart, d being a cell's diagonal.
void SourceError::add_along_curves(const SourceStatistics& s) {
  for (std::size_t n = 0; n < bound_m_.octave_m.size(); ++n) {
    const double spacing_m = std::ldexp(MeshError::least_spacing_m, int(n));
    bound_m_.octave_m[n] += std::min({0.25 * s.largest_curvature_per_m * spacing_m * spacing_m,
                                      MeshError::most_over_spacing * spacing_m, s.largest_height_m});
  }
}

MeshError SourceError::with(const MeshError& waves) const {
  constexpr double mixed =
      1.12;  // measured: the largest of several kinds together pass the root of their squares by so much
  MeshError result;
  for (std::size_t n = 0; n < result.octave_m.size(); ++n) {
    const double of_waves = waves.octave_m[n];
    result.octave_m[n] =
        std::min(mixed * std::sqrt(of_waves * of_waves + squares_m2_.octave_m[n]), of_waves + most_m_.octave_m[n]) +
        bound_m_.octave_m[n];
  }
  return result;
}

}  // namespace seascape
