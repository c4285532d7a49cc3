// The parts of filling a cascade's tile, vectorised; WaveField::evaluate shares them among threads.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "ocean/waves/fft.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

// Fields packed two real ones to a complex transform: Dx + i h, Dz + i dDx/dz of the displacement; dh/dx + i dh/dz,
// dDx/dx + i dDz/dz of slopes; dDx/dt + i dh/dt, dDz/dt of the velocity.
inline int packed_fields(const TileFields& fields) { return 2 * (1 + fields.slopes + fields.velocity); }

// Floats of a cascade's workspace, which begins with a cache line (64 bytes); a multiple of 16.
std::size_t workspace_floats(const FftPlan& plan, const TileFields& fields);

// The spectrum at a time and its transforms along x, into a cascade's workspace: rows mz and -mz together, of which
// there are row_pairs(plan), from `first` to `last` - 1.
inline int row_pairs(const FftPlan& plan) { return plan.band / 2 + 1; }
void waves_along_x(const WaveTable& table, const FftPlan& plan, std::int64_t ticks, const TileFields& fields, int first,
                   int last, float* workspace);

constexpr int strip_width = 16;
constexpr int strip_levels = 4;  // mip levels that a strip of 16 columns has of its own, after level 0

// One level of the planes of a cascade.
struct PlaneLevel {
  glm::vec4* texels[4];  // by WavePlane; null where there is none
  int stride;
};

// The transforms along z of columns x to x + strip_width - 1, into level 0. Planes that are null are left out.
void strip_along_z(const WaveTable& table, const FftPlan& plan, const float* workspace, const TileFields& fields, int x,
                   const PlaneLevel& level);

// The strip's mip chain, from levels[0] into levels[1] to levels[strip_levels].
void strip_mips(const FftPlan& plan, int x, const PlaneLevel* levels);

// Where levels 0 to strip_levels of a tile go. Null: nowhere.
struct StripPlaces {
  PlaneLevel floats[strip_levels + 1];
  std::array<WaveTiles::HalfRows, 3> halves[strip_levels + 1];  // of shift, slope, moments
};

// A strip and its mip chain together, for memory that is not read soon: they are made in the thread's own and go out
// past the caches.
void strip_out(const WaveTable& table, const FftPlan& plan, const float* workspace, const TileFields& fields, int x,
               const StripPlaces& to);

// Averages two by two texels of columns 2 x to 2 (x + width) - 1 into columns x to x + width - 1 of the next level,
// `height` rows of it, of the planes that are there.
void average_down(const PlaneLevel& from, const PlaneLevel& to, int x, int width, int height);

}  // namespace seascape
