// The search of a query for many points at once where places count: levels, currents, a bed, waves along curves and
// dynamic waves.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "ocean/places/flow_phase.h"
#include "ocean/places/place_pages.h"
#include "ocean/places/place_reader.h"
#include "ocean/sea/query_simd.h"

namespace seascape {

class ClipVolumes;
class PlaceSea;

// What a texel of PlacePages has for queries, four floats to a vector. The first is always there, the next three over a
// bed, the last two where waves run along curves.
struct PlaceTexel {
  static constexpr int water = 0,  // level, bed (m), flow along x and z (m/s)
      bend = 1,                    // shifts of the bent cascades (m); the run-up's share
      share = 2, share_more = 3,   // BedTexel::share; of the fifth cascade, of other sources
      shore = 4, shore_way = 5;    // ShoreTexel
};

// What a layer of a PlacePlan is multiplied with and where it is taken.
struct PlacedLayer {
  enum Kind : std::uint8_t { waves, curved, dynamic };
  Kind kind;
  std::int8_t share;    // which of a bed's shares: a cascade's number, gpu::max_cascades for other sources
  std::int8_t bent;     // which of the shifts; -1: none
  bool runs_up;         // its height has the run-up's share besides
  std::int8_t pattern;  // 0 and 1: of two that a current carries; -1: there is no current
  float flow_height;    // (k T / 2)^2 / 2 for a current's period T and the middle wave number k: times (m/s)^2
  std::array<float, 4> laid;
  // Of dynamic waves: the end of its window, one over the border in which it fades (m), what it counts for, and of that
  // what its sideways displacement does.
  float end_m, per_border, counts, sharpened;
};

struct PlacePlan {
  QueryPlan waves;  // layers: those of waves and of the dynamic waves; then the curved ones
  std::array<PlacedLayer, most_query_layers> placed;
  int curved = 0;  // the first of those that run along curves
  const PlaceSea* places = nullptr;
  const PlacePages* pages = nullptr;  // null: only dynamic waves
  int vectors = 0;                    // of a texel, that are read
  bool bed = false, shore = false, flow = false, dries = false;
  std::array<glm::vec2, 3> along;      // directions of the shifts
  PlaceReading reading{};              // which texels are read, but where a picture's windows say so by place:
  const LodPlacement* seen = nullptr;  // QueryOptions::seen, with
  glm::vec4 reach{0.0f};               // LodWindows::reach,
  int slices = 0;                      // as many windows,
  float footprint_m = 0.0f;            // and the query's footprint
  std::array<float, 4 * PlacePages::most_vectors> outside{};  // beyond all windows
  ClipRead clip;                                              // where it dries
  double place_time_s = 0.0, time_s = 0.0;                    // as of which places are taken; of the sea
  FlowPhase phase{};
  double period_s = 1.0;
  double shore_period_m = 1.0;
  glm::dvec2 viewer{0.0};  // around whom the dynamic waves' windows lie
};

// As answer_points().
void answer_placed_points(const PlacePlan& plan, const glm::dvec2* places, const QueryAnswer* previous,
                          QueryAnswer* answers, std::size_t count);

}  // namespace seascape
