#include "ocean/waves/particle_sums.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "shaders/shared/phase.h"
#include "shaders/shared/wave_bin.h"

namespace seascape {

namespace {
constexpr int block = 512;  // particles placed by one piece of work

template <class T>
std::size_t floats_of(std::size_t count) {
  return (count * sizeof(T) + 63) / 64 * 16;
}  // whole cache lines
template <class T>
T* take(float*& from, std::size_t count) {
  T* result = reinterpret_cast<T*>(from);
  from += floats_of<T>(count);
  return result;
}

void clear_rows(const TorusField& field, int first, int rows) {
  std::fill_n(field.row(first) - TorusField::before, std::ptrdiff_t(rows) * field.stride(), 0.0f);
}

double spline(double x) {  // cubic, around 0
  x = std::abs(x);
  return x < 1.0 ? 2.0 / 3.0 - x * x + 0.5 * x * x * x : x < 2.0 ? (2.0 - x) * (2.0 - x) * (2.0 - x) / 6.0 : 0.0;
}

// The sum of splines at whole texels off that comes nearest to a particle, by least squares over a lattice of places:
// [row][column], rows and columns either way alike.
std::vector<float> taps_of(double radius, int reach) {
  std::vector<std::pair<int, int>> unknown;  // (a, b), a >= b >= 0, stands for all places of its symmetry
  for (int a = 0; a <= reach; ++a)
    for (int b = 0; b <= a; ++b) unknown.push_back({a, b});
  const std::size_t n = unknown.size();
  std::vector<double> normal(n * (n + 1), 0.0), value(n);
  constexpr int steps = 8;  // places a texel
  for (int i = 0; i <= steps * (reach + 2); ++i)
    for (int j = 0; j <= i; ++j) {
      const double x = double(i) / steps, z = double(j) / steps, u = std::hypot(x, z) / radius;
      const double want = u < 1.0 ? 0.5 * (1.0 + std::cos(std::numbers::pi * u)) : 0.0,
                   weight = (i == j ? 0.5 : 1.0) * (j == 0 ? 0.5 : 1.0);
      for (std::size_t k = 0; k < n; ++k) {
        const auto [a, b] = unknown[k];
        const auto either = [](double at, int by) { return by == 0 ? spline(at) : spline(at - by) + spline(at + by); };
        value[k] = either(x, a) * either(z, b) + (a != b ? either(x, b) * either(z, a) : 0.0);
      }
      for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t l = 0; l < n; ++l) normal[k * (n + 1) + l] += weight * value[k] * value[l];
        normal[k * (n + 1) + n] += weight * value[k] * want;
      }
    }
  // Gauss without pivots: the matrix is symmetric and positive.
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t l = k + 1; l < n; ++l) {
      const double factor = normal[l * (n + 1) + k] / normal[k * (n + 1) + k];
      for (std::size_t m = k; m <= n; ++m) normal[l * (n + 1) + m] -= factor * normal[k * (n + 1) + m];
    }
  for (std::size_t k = n; k-- > 0;) {
    double rest = normal[k * (n + 1) + n];
    for (std::size_t m = k + 1; m < n; ++m) rest -= normal[k * (n + 1) + m] * value[m];
    value[k] = rest / normal[k * (n + 1) + k];
  }
  std::vector<float> taps(std::size_t(reach + 1) * std::size_t(reach + 1));
  for (std::size_t k = 0; k < n; ++k) {
    const auto [a, b] = unknown[k];
    taps[std::size_t(a * (reach + 1) + b)] = taps[std::size_t(b * (reach + 1) + a)] = float(value[k]);
  }
  return taps;
}
}  // namespace

DirectSum::DirectSum(const ParticleGrid& grid, std::size_t count)
    : size_(grid.size), count_(count), shape_{float(grid.radius), int(std::ceil(2.0 * grid.radius)), 0.0f} {
  strip_ = size_ == WaveParticles::tile_samples || shape_.reach > 16 ? 32 : 16;
  strips_ = size_ / strip_;
  blocks_ = int((count + block - 1) / block);
}

std::size_t DirectSum::floats(bool velocity) const {
  return floats_of<PlacedParticle>(count_) + floats_of<int>(std::size_t(blocks_) * std::size_t(strips_ + 1)) +
         (velocity ? floats_of<glm::vec2>(count_) : 0);
}

void DirectSum::sum(std::span<const WaveParticle> particles, std::int64_t ticks, float amplitude, float* memory,
                    const TorusField& height, const TorusField& rate) const {
  const bool velocity = rate.first != nullptr;
  ParticleShape shape = shape_;
  shape.amplitude = amplitude;
  PlacedParticle* const placed = take<PlacedParticle>(memory, count_);
  int* const first_of =
      take<int>(memory, std::size_t(blocks_) * std::size_t(strips_ + 1));  // [block][strip], where its particles begin
  glm::vec2* const ways = velocity ? take<glm::vec2>(memory, count_) : nullptr;
  const int log2_size = std::countr_zero(unsigned(size_)), shift = 32 - log2_size;

  // Where the particles are: in whole texels and parts of one, from integers, and by strips within each block.
  tbb::parallel_for(0, blocks_, [&](int b) {
    const int begin = b * block, end = std::min<int>(begin + block, int(count_));
    int* const firsts = first_of + std::ptrdiff_t(b) * (strips_ + 1);
    PlacedParticle list[block];
    int next[WaveParticles::tile_samples / 16 + 1] = {};
    const auto axis = [&](std::uint32_t start, std::uint64_t turns, std::uint16_t& first, float& from) {
      const std::uint32_t at =
          start + gpu::phase_turns(std::uint32_t(turns >> 32), std::uint32_t(turns),
                                   std::uint32_t(std::uint64_t(ticks) >> 32), std::uint32_t(ticks));
      const float part = float(at << log2_size) * 0x1p-32f, below = std::ceil(part - shape.radius);
      first = std::uint16_t((int(at >> shift) + int(below)) & (size_ - 1));
      from = part - below;
    };
    for (int i = begin; i < end; ++i) {
      const WaveParticle& p = particles[std::size_t(i)];
      PlacedParticle& to = list[i - begin];
      axis(p.x, p.turns_x, to.x, to.from_x);
      axis(p.z, p.turns_z, to.z, to.from_z);
      to.number = 2 * std::uint32_t(i) + p.trough;
      ++next[to.z / strip_];
      if (velocity) {
        const double per_s = 0x1p-64 * double(gpu::ticks_per_second) * size_;
        ways[i] = {float(double(std::int64_t(p.turns_x)) * per_s), float(double(std::int64_t(p.turns_z)) * per_s)};
      }
    }
    int so_far = begin;
    for (int k = 0; k <= strips_; ++k) {
      firsts[k] = so_far;
      so_far += std::exchange(next[k], so_far);
    }
    for (int i = 0; i < end - begin; ++i) placed[next[list[i].z / strip_]++] = list[i];
  });

  // Each strip of rows is summed by one thread, of the particles that begin in it and in the one before, block after
  // block: the same sums in the same order for any number of threads.
  tbb::parallel_for(0, strips_, [&](int k) {
    const int first = k * strip_;
    clear_rows(height, first, strip_);
    if (velocity) clear_rows(rate, first, strip_);
    for (int b = 0; b < blocks_; ++b) {
      const int* firsts = first_of + std::ptrdiff_t(b) * (strips_ + 1);
      for (const int from : {(k + strips_ - 1) % strips_, k})
        add_particles(shape, placed + firsts[from], firsts[from + 1] - firsts[from], first, strip_, height, ways, rate);
    }
    for (int z = first; z < first + strip_; ++z) {
      wrap_row(height, z);
      if (velocity) wrap_row(rate, z);
    }
  });
}

SplinedSum::SplinedSum(const ParticleGrid& grid, std::size_t count)
    : size_(grid.size),
      reach_(int(std::ceil(grid.radius))),
      parts_(int(std::clamp<std::size_t>(count / 2048, 1, 8))),
      taps_(taps_of(grid.radius, reach_)) {}

std::size_t SplinedSum::floats(bool velocity) const {
  return std::size_t(parts_) * (velocity ? 2 : 1) * TorusField::floats(size_);
}

void SplinedSum::sum(std::span<const WaveParticle> particles, std::int64_t ticks, float amplitude, float* memory,
                     const TorusField& height, const TorusField& rate) const {
  const bool velocity = rate.first != nullptr;
  const std::size_t field = TorusField::floats(size_);
  const auto part_of = [&](int part, bool of_rate) {
    return TorusField{size_, memory + std::size_t(part * (velocity ? 2 : 1) + of_rate) * field};
  };
  // Parts that depend on the number of particles alone, added up in their order: the same bits for any number of
  // threads.
  tbb::parallel_for(0, parts_, [&](int part) {
    const std::size_t begin = particles.size() * std::size_t(part) / std::size_t(parts_),
                      end = particles.size() * std::size_t(part + 1) / std::size_t(parts_);
    clear_rows(part_of(part, false), 0, size_);
    if (velocity) clear_rows(part_of(part, true), 0, size_);
    add_splines(particles.subspan(begin, end - begin), ticks, amplitude,
                velocity ? 0x1p-64f * float(gpu::ticks_per_second) * float(size_) : 0.0f, part_of(part, false),
                velocity ? part_of(part, true) : TorusField{});
  });
  const auto each_strip = [&](auto&& work) {
    tbb::parallel_for(0, size_ / 16, [&](int k) {
      for (const bool of_rate : {false, true})
        if (!of_rate || velocity) work(k, of_rate);
    });
  };
  each_strip([&](int k, bool of_rate) {
    const TorusField sum = part_of(0, of_rate);
    for (int z = 16 * k; z < 16 * k + 16; ++z) {
      for (int part = 1; part < parts_; ++part) add_row(part_of(part, of_rate), sum, z);
      wrap_row(sum, z);
    }
  });
  each_strip([&](int k, bool of_rate) {
    fold_rows(part_of(0, of_rate), of_rate ? rate : height, taps_.data(), reach_, 16 * k, 16 * k + 16);
  });
}

}  // namespace seascape
