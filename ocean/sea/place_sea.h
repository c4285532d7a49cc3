// The sea with what belongs to places, on the processor: levels, currents and the bed, without windows and without a
// GPU.
#pragma once
#include <memory>
#include <optional>
#include <span>

#include "ocean/places/bed_field.h"
#include "ocean/places/dynamic_surface.h"
#include "ocean/places/place_pages.h"
#include "ocean/places/place_reader.h"
#include "ocean/places/shore_field.h"
#include "ocean/places/wake_surface.h"
#include "ocean/sea/query.h"
#include "ocean/sea/still_water.h"
#include "ocean/sea/water_side.h"

namespace seascape {

struct PlacePlan;  // ocean/sea/place_query_simd.h
struct PlaceNumbers;

// The C++ twin of what sea() does with the data of places (shaders/lib/sea.glsl). Data of places are what lies between
// texels (PlaceReader), for queries as for pictures: a query has the finest, a picture those of its windows. Immutable
// but for follow(): any number of threads may ask.
class PlaceSea {
 public:
  // Of the sea that these waves are; what a bed makes of them is found here (Shallows: tenths of a second) and stays,
  // however the waves change.
  PlaceSea(PlaceInputs inputs, const WaveField& field);
  // The same where its Shallows are there already.
  PlaceSea(PlaceInputs inputs, const WaveField& field, ShallowsMix shallows);
  // Has the bed make of the waves what it does now, in a change of the sea. Not while anybody asks.
  void follow(ShallowsMix shallows);

  // Whether the surface moves otherwise than the waves alone.
  bool moves() const { return level_ || flow_ || bool(shallows_) || shore_ != nullptr; }
  // Whether the still water or the ground may stand at any height.
  bool rises() const { return level_ || bool(shallows_); }
  // The most by which a bed multiplies any waves.
  double most_share() const { return shallows_ ? shallows_.most_share() : 1.0; }
  bool clips() const { return clip_ || volumes_ != nullptr; }
  double level_m(glm::dvec2 rest_m, double footprint_m, double time_s) const;  // of the still water
  glm::dvec2 flow_mps(glm::dvec2 rest_m, double footprint_m, double time_s) const;
  // The still water at a world position (x and z, m) for texels of this side (m, 0 or more), straight from the inputs
  // and not between texels. All its numbers are finite where the position is. Needs no tiles.
  // `volumes`: ClipRead::volumes.
  StillWater still_water(glm::dvec2 place_m, double texel_m, double time_s, const ClipVolumes* volumes = nullptr) const;
  // No water there: whether the point of the surface (x, height above the still sea's y = 0, z) is taken away, by flat
  // inputs and by volumes.
  bool clipped(glm::dvec3 point_m, double time_s, const ClipRead& read = {}) const;

  // Null where no bed is known.
  const Shallows* shallows() const { return shallows_.from.get(); }

  // What questions have beside the waves.
  struct Beside {
    const DynamicSurface* dynamic = nullptr;  // null: no dynamic waves
    const WakeSurface* wakes = nullptr;       // null: none
    const ClipVolumes* volumes = nullptr;     // with the bodies of actors; null: the scene's alone
    double finest_m = 0.0;                    // no texels of places finer than this are read; 0: than windows have
    double left_out_m = 0.0;                  // SeaView::left_out_m
  };
  // As query() of the waves alone (query.h), with all its promises. Velocities have the current in them, and what comes
  // of waves that it carries past. On land the answer is the ground, at rest.
  void query(const WaveField& field, const WaveTiles& tiles, std::span<const glm::dvec2> places,
             std::span<QueryAnswer> answers, const QueryOptions& options, const Beside& beside) const;
  void query(const WaveField& field, const WaveTiles& tiles, std::span<const glm::dvec2> places,
             std::span<QueryAnswer> answers, const QueryOptions& options = {}) const {
    query(field, tiles, places, answers, options, Beside{});
  }
  // The surface, which is the ground where that stands above the water, at a rest position (m), of the tiles' time, as
  // query() reads it: gradients are those of what lies between texels, and second moments are left out. Of `options`
  // footprint and `seen` count.
  SeaSample at(const WaveField& field, const WaveTiles& tiles, glm::dvec2 rest_m, const QueryOptions& options,
               const Beside& beside) const;
  // On which side of this surface, as query() has it, a world point (m) is; see water_side.h.
  WaterSide side(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& at_m, const Beside& beside) const;
  // Whether the water of a rest position is taken away over a bed, where it stands at this displacement, so
  // that it lies dry.
  bool dry(glm::dvec2 rest_m, glm::dvec3 displacement_m, double time_s, const ClipRead& read) const;
  // Whether many places were asked for, and this had better begin with new memory of them (renew).
  bool worn() const { return (pages_ && pages_->worn()) || (clip_pages_ && clip_pages_->worn()); }
  // Not while anybody asks.
  void renew();

 private:
  bool flat_clipped(glm::dvec2 place_m, double texel_m, double time_s) const;
  bool flat_clipped(glm::dvec2 place_m, double time_s, const ClipRead& read) const;
  // By flat inputs or by volumes, at a point of the surface.
  bool clipped(glm::dvec3 point_m, bool flat, const ClipVolumes* volumes) const;
  PlacePlan plan(const WaveField& field, const WaveTiles& tiles, const QueryOptions& options,
                 const Beside& beside) const;
  PlaceNumbers numbers() const;
  PlaceSettings settings_;
  double open_depth_m_;
  std::optional<PlaceValues<glm::vec4>> level_, flow_, clip_;
  std::shared_ptr<const ClipVolumes> volumes_;  // null: none
  std::shared_ptr<const ShoreLines> shore_;     // null where no waves run along curves
  ShallowsMix shallows_;
  std::optional<PlaceValues<BedTexel>> bed_;
  std::optional<PlaceValues<ShoreTexel>> along_curves_;
  std::shared_ptr<const PlacePages> pages_, clip_pages_;  // of PlaceNumbers, of flat clip; null: none
  int cascades_;                                          // the most that are asked for,
  bool has_others_;                                       // and whether other sources are
};

}  // namespace seascape
