// The search of a query for many points at once, vectorised: query() plans it and shares it among threads.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "ocean/sea/query.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

// Two levels of each place's tile, of two patterns each where a current carries them, the dynamic waves' levels, and
// those of the windows of bodies.
inline constexpr int most_query_layers =
    4 * WaveField::most_places + gpu::max_dynamic_levels + gpu::max_wake_windows * gpu::max_wake_levels;
static_assert(most_query_layers <= 64);  // a bit each

// One mip level of one tile in one place as a query samples it.
struct QueryLayer {
  double cosine, sine, inverse_side;  // from the world to the tile, in sides
  double size, first;  // texels a side; texel coordinate of the tile's origin, a whole tile on so that it is positive
  float cosine_a_texel, sine_a_texel;  // cosine and sine over the texel, 1 / m
  std::int32_t mask, stride;           // size - 1; texels from one row to the next
  float share;  // of what is read here that counts: the footprint's, and how near this level is to it
  std::array<float, 4>
      laid;     // what the texels' displacements, velocities and their last number are to be multiplied with
  bool plain;   // by 1: a cascade
  bool warped;  // by QueryPlan::warp
  const float *shift, *velocity;  // first texel of each plane; velocity null where there is none
};

// What all points of a batch share.
struct QueryPlan {
  std::array<QueryLayer, most_query_layers> layers;
  std::array<std::int8_t, most_query_layers> place;  // of the field's places whose each is
  int count = 0;
  const PatternWarp* warp = nullptr;  // of the field; null: all patterns lie straight
  int most_iterations = 0;
  float tolerance_m = 0.0f;
  bool velocity = false, slopes = true;
  double depth_m = 0.0, left_out_m = 0.0;  // for every answer
};

// All waves of the field, or with `curved` those besides that are laid along curves.
QueryPlan plan_queries(const WaveField& field, const WaveTiles& tiles, const QueryOptions& options,
                       bool curved = false);

// `count` answers on this thread. `previous` (null: none) may be `answers`. The operations of a point are the same, in
// the same order and rounded the same, whatever stands beside it and however wide the vectors are.
void answer_points(const QueryPlan& plan, const glm::dvec2* places, const QueryAnswer* previous, QueryAnswer* answers,
                   std::size_t count);

// The displacements of rest positions of all waves that the plan reads: with a footprint of 0 what
// WaveField::displacement gives, within what floats round.
void displace_points(const QueryPlan& plan, const glm::dvec2* rest_m, glm::vec3* displacements, std::size_t count);

}  // namespace seascape
