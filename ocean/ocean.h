// The ocean: draws one sea, for any number of viewers.
#pragma once
#include <array>
#include <memory>
#include <optional>

#include "engine/frame.h"
#include "ocean/drawn/drawn_dynamic_waves.h"
#include "ocean/drawn/drawn_foam.h"
#include "ocean/drawn/drawn_place.h"
#include "ocean/drawn/drawn_source.h"
#include "ocean/drawn/drawn_wakes.h"
#include "ocean/drawn/drawn_waves.h"
#include "ocean/foam/spray.h"
#include "ocean/mesh/bed_mesh.h"
#include "ocean/mesh/mesher.h"
#include "ocean/mesh/portal_sight.h"
#include "ocean/sea/sea.h"
#include "ocean/surface/eyes_in.h"
#include "ocean/surface/surface.h"
#include "ocean/surface/water_settings.h"
#include "ocean/waves/source_error.h"
#include "shaders/shared/frame_data.h"

namespace seascape {

// What of the picture's settings the ocean needs beside its sea.
struct OceanSettings {
  WavePlace wave_place = WavePlace::automatic;
  LodSettings lod;
  WaterSettings water;
  PlaceSettings place;
  std::optional<FoamSpec> foam;        // none: the effect is not called for
  double baked_fade_m = 0.0;           // BakedSettings::fade_m
  std::optional<SpraySettings> spray;  // none: the effect is not called for
  bool seen_elsewhere = false;         // another viewer may draw it in frames of his own, one at a time
};

// What an ocean has simulated of its own, for another one that draws the same sea.
struct OceanState {
  std::unique_ptr<FoamSea> foam;
  std::unique_ptr<Spray> spray;
};

class Ocean {
 public:
  // Draws this sea, in its quality of the picture; the sea outlives it. Goes on with what of `before` is of this sea
  // and fits the settings.
  Ocean(Device& device, ShaderLibrary& shaders, Sea& sea, const OceanSettings& settings, OceanState before = {});
  // Nothing is drawn with this one any more.
  OceanState give_up();

  // What a frame takes of the sea, which has been advanced to this time, in order: each only if the scene asked for it.
  // What belongs to a place follows the viewer.
  void update(Frame& frame, double time_s, const glm::dvec3& viewer_m);
  // Foam that is only seen may take several steps as one: so many, from 1.
  void step_foam_by(int steps) {
    if (foam_) foam_->sea().step_by(steps);
  }
  // Of a frame that nobody draws what later ones depend on: foam that is kept, and spray. Stages are timed as in a
  // frame.
  void live_through(Stages& stages, double time_s, const glm::dvec3& viewer_m);
  // Has the waves of a time in this frame's images; nothing where they are there. update() does it too: who asks the
  // sea for felt water before it calls this first, so that what both need is made once.
  void make_waves(Frame& frame, double time_s);

  // The patches for a viewpoint. The result stays until the next call. `coarser` (1 or more): by so much the mesh may
  // miss the sea by more than the settings say.
  const SurfaceSelection& select(const Viewpoint& viewpoint, double coarser = 1.0);
  // The same for one of many viewpoints that share this sea (a mirror, a portal, a map), with a mesher of its own,
  // whose patches stay until it selects again.
  const SurfaceSelection& select(const Viewpoint& viewpoint, Mesher& mesher, const LodSettings& lod) const;
  // Of the patches selected last those that eyes in the water may see, through which no air is seen; or those that are
  // seen through portals. They stay until the next call.
  const SurfaceSelection& within_sight(const Viewpoint& viewpoint, const gpu::FrameData& data);
  const SurfaceSelection& within_portals(const Viewpoint& viewpoint, const PortalSight& portals);
  // The patches of the bed before eyes that may be in the water, and what shaders are told of them; null where there is
  // no bed. `portals`: through which alone it is seen, or null. They stay until the next call.
  const SurfaceSelection* select_bed(const Viewpoint& viewpoint, const PortalSight* portals, gpu::FrameData& data);
  // What selecting is told of the water for a viewpoint, as it is since the last update.
  DisplacementBounds bounds(const Viewpoint& viewpoint) const;
  // The patches selected last, null before the first.
  const SurfaceSelection* selection() const { return selection_; }

  // The water stands nowhere higher above the still sea.
  double highest_m() const;
  // Whether all eyes are surely above the water, by half a metre: by the highest crest that the sea may have, or where
  // the processor makes the waves by the water beneath them as it was in the last update.
  bool eyes_in_air(const Viewpoint& viewpoint) const;
  // Where the eyes are of whom pixels see the water that lies `reach_m` or farther before them (a near plane's
  // corners): by what is felt of the sea, and by all that this may lack of what is drawn.
  struct EyesSide {
    EyesIn eyes = EyesIn::air;
    bool from_above = true;  // some may see the surface from above
    // Of a scene's shapes, for who knows them: air under water comes up to its surface; what is seen through portals.
    bool high_air = false;
    PortalSight portals;
    // At the viewer, where eyes are not in the air: height of the still water, and how high over him the felt one is.
    double still_m = 0.0, over_viewer_m = 0.0;
    // There, of each eye: how high over it the water is, m, and the water's slopes along x and z.
    std::array<glm::dvec3, 2> over_eye{};
    // The water that each eye's near plane passes, where it does not look up or down by more than 50 degrees, also a
    // little outside the picture.
    std::array<NearWater, 2> near{};
    // How deep it is in the water, m; nothing: it is in the air for sure, or where there is no water.
    std::array<std::optional<double>, 2> depth_m{};
    const SurfaceSelection* bed = nullptr;  // what they may see of it, for who asks select_bed()
  };
  EyesSide eyes_in(const Viewpoint& viewpoint, double reach_m) const;

  // Fills what the surface's shaders are told of sea, place and water.
  void describe(gpu::FrameData& data, const Viewpoint& viewpoint) const { describe(data, viewpoint, *selection_); }
  void describe(gpu::FrameData& data, const Viewpoint& viewpoint, const SurfaceSelection& selection) const;

  // Whether apply() can take these, of the same waves.where, windows and most puffs: kept foam, and spray, are there
  // or not as they were.
  bool takes(const OceanSettings& settings) const;
  // Takes other settings as it runs: it makes no object, and what foam and spray there is stays. Throws as validate()
  // does, and stays as it was then.
  void apply(const OceanSettings& settings);
  // Sea::apply, with what this drawing needs of it.
  void take(SeaSpec spec);
  // Sea::change, with what this drawing needs of the bed made beside it.
  void change(const SeaState& sea, double over_s);
  Sea& sea() { return sea_; }
  const Sea& sea() const { return sea_; }

  // All that the surface is drawn from.
  std::span<const std::unique_ptr<DrawnPiece>> pieces() const { return pieces_; }
  const WaveImages& waves() const { return waves_->images(); }
  // The waves that are drawn. Who draws them in frames of his own (OceanSettings::seen_elsewhere) keeps this until they
  // have left the GPU, for it holds what the images hold; nothing where the GPU makes them.
  SeaView waves_held() const { return waves_->view(); }
  // Those that are not still.
  std::span<const DrawnSource* const> sources() const { return sources_; }
  // Null where the scene has none, or nothing that could ever push the water.
  const DrawnDynamicWaves* dynamic_waves() const { return dynamic_waves_; }
  const DrawnWakes* wakes() const { return wakes_; }
  // Null where no foam is kept, but at most what breaks at the moment is drawn.
  const DrawnFoam* foam() const { return foam_; }
  // Null where the scene has none, or none is wished.
  Spray* spray() { return spray_.get(); }
  // Null where nothing belongs to places.
  const DrawnPlace* place() const { return place_; }
  // Adds every image that the surface samples.
  void add_uses(Uses& uses) const;
  const OceanSettings& settings() const { return settings_; }

 private:
  Sea& sea_;
  OceanSettings settings_;
  template <class Kept>
  const SurfaceSelection& keep(const Kept& kept);  // of the patches selected last
  template <class Piece>
  Piece* add(std::unique_ptr<Piece> piece);
  std::vector<std::unique_ptr<DrawnPiece>> pieces_;  // in the order of their updates; then those of them that it asks
  DrawnWaves* waves_ = nullptr;
  std::vector<const DrawnSource*> sources_;
  DrawnDynamicWaves* dynamic_waves_ = nullptr;
  DrawnWakes* wakes_ = nullptr;
  std::vector<NearMeshError> near_;  // of both, nearest first, as of the last update
  DrawnPlace* place_ = nullptr;
  DrawnFoam* foam_ = nullptr;
  std::unique_ptr<Spray> spray_;
  bool wants_foam(const OceanSettings& settings) const;  // kept
  SeaView water_;                                        // that selection asks, as of the last update
  WaterReach others_reach() const;                       // of all but the waves, no more than that
  bool waves_alone() const;                              // nothing else moves the water
  double land_m() const;                                 // how far it stands above the still sea at most
  double most_share() const;                             // by which a bed may raise waves, 1 without one
  void measure_sources();
  SourceStatistics of_sources_;  // all of them together
  SourceError source_error_;
  std::unique_ptr<Mesher> mesher_;
  const SurfaceSelection* selection_ = nullptr;
  SurfaceSelection within_sight_;
  BedMesh bed_mesh_;
};

// How far the water of a described frame lets an eye see, m: the clearest colour keeps a thousandth of its light.
double sight_in_water_m(const gpu::FrameData& data);

}  // namespace seascape
