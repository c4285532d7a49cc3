// The sea at one time in one detail, as whoever needs water asks it. Immutable, and valid until it is released.
#pragma once
#include <memory>
#include <span>

#include "ocean/sea/query.h"
#include "ocean/sea/sea_moment.h"

namespace seascape {

// How far the water goes from where it rests.
struct SeaBounds {
  double height_m = 0.0;  // above or below the still water: nearly nowhere more (SeaStatistics)
  double shift_m = 0.0;   // sideways, alike
};

// Where a ray meets the surface first.
struct RayAnswer {
  bool hit = false;
  double distance_m = 0.0;  // along the ray; of a miss how far it was looked for
  QueryAnswer water;        // there
};

struct RayOptions {
  double footprint_m = 0.0;
  double most_m = 10e3;  // no farther than this
};

class SeaView {
 public:
  SeaView() = default;  // of no sea: nothing may be asked
  explicit SeaView(std::shared_ptr<const SeaMoment> moment) : moment_(std::move(moment)) {}
  explicit operator bool() const { return moment_ != nullptr; }
  std::int64_t ticks() const { return moment_->ticks; }
  SeaDetail detail() const { return moment_->detail; }

  // All questions: any thread, at any time, no allocation. The tiles are made by the first of them.

  // The surface that query() finds, dynamic waves included, at a rest position (x and z, m) for a footprint (m). Its
  // second moments are left out.
  SeaSample at(glm::dvec2 rest_m, double footprint_m) const;
  // At world places (x and z, m); see query.h.
  void query(std::span<const glm::dvec2> places, std::span<QueryAnswer> answers, QueryOptions options = {}) const;
  QueryAnswer query(glm::dvec2 place, const QueryOptions& options = {}) const;
  // The still water at a world position (x and z, m), for texels of this side (m); needs no tiles.
  StillWater still_water(glm::dvec2 place_m, double texel_m) const;
  // The first meeting of a ray (m, and a direction of any length but 0) with the surface or with land, from either
  // side, to a millimetre or a millionth of the distance. What is clipped is no surface. A crest or a trough that the
  // ray passes through in less than 5 cm or a five-thousandth of its way may be missed, and so may water steeper
  // than 2. Of a ray that is no number: no hit.
  RayAnswer ray(const glm::dvec3& origin_m, const glm::dvec3& direction, const RayOptions& options = {}) const;
  // Of all waves of this detail, dynamic ones as they are now, without levels and land.
  SeaBounds bounds() const;
  // Whether a point of the world (m) is in the water or in the air, of the whole surface that query() finds: levels,
  // land, currents, dynamic waves and clip included (water_side.h).
  WaterSide side(const glm::dvec3& at_m) const;
  // Standard deviation, m, of the waves that this detail lacks.
  double left_out_m() const { return moment_->left_out_m; }

  // What takes the waves elsewhere reads them here: foam row by row, pictures whole. Of `felt` views the cascades'
  // tiles may have displacements alone.
  const WaveField& field() const { return *moment_->field; }
  const WaveTiles& tiles() const { return moment_->tiles(); }
  // Does a share (0 to 1) of the tiles' work ahead of the first question: the owner's thread, before anybody asks.
  void prepare(double share) const { moment_->prepare(share); }
  const PlaceSea& places() const { return *moment_->places; }
  const DynamicSurface* dynamic() const { return moment_->now.dynamic.get(); }
  const WakeSurface* wakes() const { return moment_->now.wakes.get(); }  // null where all rest
  // With the bodies of actors as of the last advance, where the view is of its time; null where nothing clips.
  const ClipVolumes* volumes() const { return moment_->now.volumes.get(); }
  // Which of the lent memories its tiles lie in (Sea::keep_drawn_in); -1: none.
  int slot() const { return moment_->slot; }

 private:
  PlaceSea::Beside beside() const;
  std::shared_ptr<const SeaMoment> moment_;
};

}  // namespace seascape
