// The parts of filling the tile of wave particles, vectorised; WaveParticles::evaluate shares them among threads.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "ocean/waves/wave_particles.h"
#include "ocean/waves/wave_tiles_simd.h"

namespace seascape {

// A square periodic field of floats, `size` a side, a power of two, whose rows go on to either side: the columns before
// the first and from the last repeat the other end's, once wrapped.
struct TorusField {
  static constexpr int before = 16, after = 32;  // columns beyond either end, for what reaches over it
  int size = 0;
  float* first = nullptr;  // of before columns, then row 0
  int stride() const { return size + before + after; }
  float* row(int z) const { return first + std::ptrdiff_t(z & (size - 1)) * stride() + before; }
  static std::size_t floats(int size) { return std::size_t(size) * std::size_t(size + before + after); }
};

// A particle on a field at one time: its first column and row, of those within its radius, and from there to its
// middle, in texels.
struct PlacedParticle {
  std::uint16_t x, z;
  float from_x, from_z;
  std::uint32_t number;  // doubled; odd for a trough
};

struct ParticleShape {
  float radius;     // in texels of the field, 4 to 16
  int reach;        // columns and rows that may be within it: 2 radius, rounded up
  float amplitude;  // height of a crest's middle
};

// Adds what `count` particles have of rows `first` to `first + rows` - 1, no fewer than their reach, to the field of
// heights; and, where `ways` (x, z in texels a second, by number) is given, to that of heights' rates of change.
// Columns from the last on are left to be wrapped.
void add_particles(const ParticleShape& shape, const PlacedParticle* particles, int count, int first, int rows,
                   const TorusField& height, const glm::vec2* ways, const TorusField& rate);

// Adds particles to the texels around each, weighed by cubic B-splines: their heights, and where `way_a_turn` (texels a
// second over turns a tick) is not 0 their rates of change. Rows are to be wrapped.
void add_splines(std::span<const WaveParticle> particles, std::int64_t ticks, float amplitude, float way_a_turn,
                 const TorusField& height, const TorusField& rate);

// Rows `first` to `last` - 1 of a field folded with taps[k][m] = taps[k * (reach + 1) + m], k rows and m columns off
// either way; wrapped.
void fold_rows(const TorusField& from, const TorusField& to, const float* taps, int reach, int first, int last);

// Adds row z of a field to another's.
void add_row(const TorusField& from, const TorusField& to, int z);

// Adds what went over the last column to the first ones, and repeats the ends.
void wrap_row(const TorusField& field, int z);

// Rows `first` to `last` - 1 of a field twice as fine, by Lagrange's interpolation over six texels; wrapped.
void refine_rows(const TorusField& from, const TorusField& to, int first, int last);

// What rows of a tile are made of.
struct ParticleTexels {
  float inverse_texel;  // texels a metre
  float shift;          // of horizontal displacement over slope, metres
  float mean;           // of the field of heights, taken away
  bool velocity;
};
// Rows `first` to `last` - 1 of a tile's planes from its fields, by central differences of fourth order.
void particle_rows(const TorusField& height, const TorusField& rate, const ParticleTexels& texels, int first, int last,
                   const PlaneLevel& level);

}  // namespace seascape
