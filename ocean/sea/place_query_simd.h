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
#include "shaders/shared/wake_windows.h"

namespace seascape {

class ClipVolumes;
class PlaceSea;

// The numbers of a place that queries read, in the order in which a texel of PlacePages has those that there are.
struct PlaceNumbers {
  enum Number : std::uint8_t {
    level,  // of the still water, m
    flow_x,
    flow_z,                              // m/s
    bed,                                 // m
    bend,                                // shifts of the bent cascades, m
    run_up = bend + 3,                   // its share
    share,                               // PlaceWaves, of each cascade
    others = share + gpu::max_cascades,  // of the other sources
    right,                               // ShoreTexel: to the right of the curve, m
    cosine,
    sine,         // of the way along it
    shore_share,  // what is left of the waves
    along_x,
    along_z,  // ShoreTexel::way
    count
  };
  std::array<std::int8_t, count> at{};  // which float of a texel; -1: none, for there is no such number
  int vectors = 0;                      // of four floats, in a texel
};

// What a layer of a PlacePlan is multiplied with and where it is taken.
struct PlacedLayer {
  enum Kind : std::uint8_t { waves, curved, dynamic, wake };
  Kind kind;
  std::int8_t share;    // which of a bed's shares: a cascade's number, gpu::max_cascades for other sources; of wakes
                        // which window
  std::int8_t bent;     // which of the shifts; -1: none. Of wakes which level
  bool runs_up;         // its height has the run-up's share besides
  bool even;            // its sideways displacement is multiplied with the same as its height
  std::int8_t pattern;  // 0 and 1: of two that a current carries; -1: there is no current
  glm::vec3 decay;      // PatternMoments::decay_per_m2 times (T / 2)^2 for a current's period T, s^2/m^2
  float laid;           // QueryLayer::share, times the size that it is laid in
  // Of dynamic waves: the end of its window, one over the border in which it fades (m), what it counts for, and of that
  // what its sideways displacement does. Of wakes half of a window's side, m, and the last two.
  float end_m, per_border, counts, sharpened;
};

// Windows of waves that belong to bodies.
struct PlacedWakes {
  int count = 0;
  std::array<glm::dvec2, gpu::max_wake_windows> middle_m;  // of level 0
  std::array<std::array<glm::vec2, gpu::max_wake_levels>, gpu::max_wake_windows>
      from_middle_m;  // each level's from there
  std::array<float, gpu::max_wake_windows> presence;
};

struct PlacePlan {
  QueryPlan waves;  // layers: those of waves, of the dynamic waves and of wakes; then the curved ones
  std::array<PlacedLayer, most_query_layers> placed;
  PlacedWakes wakes;  // of each level all windows' layers, one after the other
  int curved = 0;     // the first of those that run along curves
  const PlaceSea* places = nullptr;
  const PlacePages* pages = nullptr;  // null: only dynamic waves
  PlaceNumbers numbers;
  bool bed = false, shore = false, flow = false, dries = false;
  std::array<glm::vec2, 3> along;      // directions of the shifts
  PlaceReading reading{};              // which texels are read, but where a picture's windows say so by place:
  const LodPlacement* seen = nullptr;  // QueryOptions::seen, with
  glm::vec4 reach{0.0f};               // LodWindows::reach,
  int slices = 0;                      // as many windows,
  float footprint_m = 0.0f;            // and the query's footprint
  // Beyond all windows, of each float of a texel; and which of them give way to that.
  std::array<float, 4 * PlacePages::most_vectors> outside{};
  std::array<bool, 4 * PlacePages::most_vectors> fades{};
  ClipRead clip;                            // where it dries
  double place_time_s = 0.0, time_s = 0.0;  // as of which places are taken; of the sea
  FlowPhase phase{};
  double period_s = 1.0;
  float shore_period_m = 1.0f;
  glm::dvec2 viewer{0.0};  // around whom the dynamic waves' windows lie
};

// As answer_points().
void answer_placed_points(const PlacePlan& plan, const glm::dvec2* places, const QueryAnswer* previous,
                          QueryAnswer* answers, std::size_t count);

// The surface at a rest position (m): displacement and gradients.
SeaSample placed_sample(const PlacePlan& plan, glm::dvec2 rest_m);

}  // namespace seascape
