// The ocean: one sea, its waves and its surface, for any number of viewers.
#pragma once
#include <memory>
#include <optional>

#include "engine/frame.h"
#include "ocean/drawn/drawn_dynamic_waves.h"
#include "ocean/drawn/drawn_foam.h"
#include "ocean/drawn/drawn_place.h"
#include "ocean/drawn/drawn_source.h"
#include "ocean/drawn/wave_compute.h"
#include "ocean/drawn/wave_images.h"
#include "ocean/drawn/wave_upload.h"
#include "ocean/foam/spray.h"
#include "ocean/mesh/quadtree.h"
#include "ocean/sea/sea_change.h"
#include "ocean/surface/surface.h"
#include "ocean/surface/water_settings.h"
#include "ocean/waves/sea_state.h"
#include "ocean/waves/source_error.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_place.h"
#include "ocean/waves/wave_tiles.h"
#include "shaders/shared/frame_data.h"

namespace seascape {

struct OceanSettings {
  SeaState sea;
  WaveQuality waves;
  WavePlace wave_place = WavePlace::automatic;
  LodSettings lod;
  WaterSettings water;
  std::optional<FoamSpec> foam;                     // none: the effect is not called for
  double baked_fade_m = 0.0;                        // BakedSettings::fade_m
  bool has_waves = true;                            // or else only what `sources` do moves the water
  TileSources sources;                              // what feeds the sea beside its waves
  std::optional<DynamicSeaSettings> dynamic_waves;  // none: the effect is not called for
  std::shared_ptr<const Inputs> pressure;           // on dynamic waves; null for none
  PlaceInputs place;                                // of the effects whose data belong to places
  std::optional<SpraySettings> spray;               // none: the effect is not called for
};

class Ocean {
 public:
  Ocean(Device& device, ShaderLibrary& shaders, const OceanSettings& settings);

  // What a frame does to the sea, in order: each only if the scene asked for it. What belongs to a place follows the
  // viewer.
  void update(Frame& frame, double time_s, const glm::dvec3& viewer_m);

  // The patches for a viewpoint. The result stays until the next call.
  const SurfaceSelection& select(const Viewpoint& viewpoint);
  // The same for one of many viewpoints that share this sea (a mirror, a portal, a map), with patches of its own, which
  // stay until they are selected again. They take this sea's settings.
  const SurfaceSelection& select(const Viewpoint& viewpoint, Quadtree& patches) const;
  // What selecting is told of the water for a viewpoint, as it is since the last update.
  DisplacementBounds bounds(const Viewpoint& viewpoint) const;
  // The patches selected last, null before the first.
  const SurfaceSelection* selection() const { return selection_; }

  // Whether all eyes are surely above the water, by half a metre: by the highest crest that the sea may have, or where
  // the processor makes the waves by the water beneath them as it was in the last update.
  bool eyes_in_air(const Viewpoint& viewpoint) const;

  // Fills what the surface's shaders are told of sea, place and water.
  void describe(gpu::FrameData& data, const Viewpoint& viewpoint) const { describe(data, viewpoint, *selection_); }
  void describe(gpu::FrameData& data, const Viewpoint& viewpoint, const SurfaceSelection& selection) const;

  // Takes settings that need no new GPU objects (levels of detail, water).
  void apply(const LodSettings& lod, const WaterSettings& water);
  // Lets another sea grow out of this one over some seconds of the sea's time, more than 0, from the frame on in which
  // its waves are made: no frame waits for them. The sea asked for last is the one that comes. Gravity, depth and loop
  // are those that it has (grows_out_of). Throws Error as validate() does.
  void change(const SeaState& sea, double over_s);
  // Whether a sea asked for is still to come or on its way.
  bool changing() const { return asked_for_ || blend_; }
  // The waves as they were in the last update.
  const WaveBins& bins() const { return bins_; }
  double chop() const { return chop_; }

  const WaveImages& waves() const { return waves_; }
  // Those that are not still.
  std::span<const std::unique_ptr<DrawnSource>> sources() const { return sources_; }
  // Null where the scene has none, or nothing that could ever push the water.
  const DrawnDynamicWaves* dynamic_waves() const { return dynamic_waves_.get(); }
  // Null where no foam is kept, but at most what breaks at the moment is drawn.
  const DrawnFoam* foam() const { return foam_.get(); }
  // Null where the scene has none, or none is wished.
  const Spray* spray() const { return spray_.get(); }
  // Null where nothing belongs to places.
  const DrawnPlace* place() const { return place_.get(); }
  // What the bed makes of the waves now; null where no bed is known.
  ShallowsMix shallows() const;
  // Adds every image that the surface samples.
  void add_uses(Uses& uses) const;
  const SeaStatistics& statistics() const { return statistics_; }
  const OceanSettings& settings() const { return settings_; }

 private:
  OceanSettings settings_;
  WaveBins bins_;
  SeaStatistics statistics_;
  WaveImages waves_;
  std::unique_ptr<WaveCompute> compute_;  // either this
  std::unique_ptr<WaveUpload> upload_;    // or this fills them
  std::vector<std::unique_ptr<DrawnSource>> sources_;
  std::unique_ptr<DrawnDynamicWaves> dynamic_waves_;
  std::unique_ptr<DrawnPlace> place_;
  std::unique_ptr<DrawnFoam> foam_;
  std::unique_ptr<Spray> spray_;
  void make_spray();
  double time_s_ = 0.0;            // of the last update
  double others_height_m() const;  // of all but the waves, no more than that
  double others_shift_m() const;
  double land_m() const;         // how far it stands above the still sea at most
  double most_share() const;     // by which a bed may raise waves, 1 without one
  SourceStatistics of_sources_;  // all of them together
  SourceError source_error_;
  void follow_change(Frame& frame, std::int64_t ticks);
  // The long waves alone, on the processor, where the GPU makes the picture's: what the water beneath a viewer does.
  std::unique_ptr<WaveField> long_waves_;
  WaveTiles long_tiles_;
  std::optional<std::int64_t> long_ticks_;  // that they are of
  std::unique_ptr<SeaMaker> maker_;         // from the first change on
  bool asked_for_ = false;
  double change_s_ = 0.0, chop_;
  std::optional<std::uint32_t> drawn_seed_;  // none while two seeds' waves are drawn
  std::optional<SeaBlend> blend_;
  Quadtree quadtree_;
  const SurfaceSelection* selection_ = nullptr;
};

}  // namespace seascape
