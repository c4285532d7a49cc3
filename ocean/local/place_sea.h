// The sea with what belongs to places, on the processor: levels and currents, straight from their inputs, without windows and without a GPU.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "ocean/local/place_fields.h"
#include "ocean/waves/query.h"

namespace seascape {

// What of a scene belongs to places: the inputs of each kind that an effect calls for.
struct PlaceInputs {
  PlaceSettings settings;
  std::vector<std::shared_ptr<const Inputs>> kinds;  // each kind once at most
};

// The C++ twin of what sea() does with the data of places (shaders/lib/sea.glsl), which it has between texels (LodField tells how far off that is).
// Immutable: any number of threads may ask.
class PlaceSea {
 public:
  explicit PlaceSea(PlaceInputs inputs);

  // Whether the surface moves otherwise than the waves alone.
  bool moves() const { return level_ != nullptr || flow_ != nullptr; }
  double level_m(glm::dvec2 rest_m, double footprint_m, double time_s) const;           // of the still water
  glm::dvec2 flow_mps(glm::dvec2 rest_m, double footprint_m, double time_s) const;
  bool clipped(glm::dvec2 place_m, double time_s) const;                                // no water there

  // The surface at a rest position (m), for a footprint (m), of the tiles' time. Second moments are left out.
  SeaSample sea(const WaveField& field, const WaveTiles& tiles, glm::dvec2 rest_m, double footprint_m) const;

  // As query() of the waves alone (query.h) with all its promises but speed: a thousand points take some milliseconds. Velocities have the current in
  // them, and what comes of waves that it carries past.
  void query(const WaveField& field, const WaveTiles& tiles, std::span<const glm::dvec2> places, std::span<QueryAnswer> answers, const QueryOptions& options = {}) const;

 private:
  // The waves' patterns that a current has brought to a place: their own places, and what they count for.
  struct Carried {
    glm::dvec2 first, second;
    WaveField::Filter of_first, of_second;
    bool two = false;  // or else only the first is there
  };
  Carried carried(const WaveField& field, const WaveField::Filter& filter, glm::dvec2 rest, double footprint_m, double time_s) const;
  QueryAnswer answer(const WaveField& field, const WaveTiles& tiles, const WaveField::Filter& filter, glm::dvec2 place, const QueryOptions& options) const;
  const Inputs* find(InputTarget kind) const;
  PlaceInputs inputs_;
  const Inputs *level_, *flow_, *clip_;
};

// How much higher the sum of two patterns of these waves has to stand that lie `way_m` apart, of which the first counts for `first` and the second for the
// rest, to be as high as either (shaders/lib/flow.glsl).
double flow_height(double longest_m, double shortest_m, double way_m, double first);

}  // namespace seascape
