// Data that belong to places as images that the surface samples: windows that move with the viewer, of which only what
// has changed is copied.
#pragma once
#include <memory>
#include <vector>

#include "ocean/drawn/drawn_clip.h"
#include "ocean/drawn/drawn_shore.h"
#include "ocean/drawn/drawn_windows.h"
#include "ocean/places/bed_change.h"
#include "ocean/places/clip_mask.h"
#include "ocean/sea/sea.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

class DrawnPlace {
 public:
  // Every field is made under the name of its effect. Throws as validate() does.
  DrawnPlace(Device& device, const Sea& sea);

  // Has the data around a viewer (m) at a time in the images, with what the bed makes of the sea's waves and what clips
  // now; records nothing where nothing has changed.
  void update(Frame& frame, Sea& sea, double time_s, const glm::dvec3& viewer_m);
  // What shaders are told; `grid_origin_m` is the world x, z that rest positions count from.
  void describe(gpu::PlaceData& data, glm::dvec2 grid_origin_m, double time_s) const;
  void add_uses(Uses& uses, Access access) const;

  // The image of a kind, null where there is none; that of the bed, and of what it makes of the waves.
  const Image* image(InputTarget kind) const;
  const Image* bed_waves() const { return bed_ ? &bed_->waves.image() : nullptr; }
  // Which parts of it there are (gpu::laid_stays, gpu::laid_follows); 0 without.
  int laid(InputTarget kind) const;
  // Null where no waves run along curves.
  const DrawnShore* shore() const { return shore_.get(); }
  const PlaceField<glm::vec4>* field(InputTarget kind) const;
  // How far the still water stands above or below y = 0 at most, of what has been around the viewer, m.
  double level_m() const;
  // How far land stands above y = 0 at most: within a distance of the viewer (along x and z), and anywhere, of what has
  // been around the viewer.
  double land_m(double within_m) const;
  double land_m() const;
  // Whether there is nothing to draw within a rectangle (m, in the world) where no water stands further than height_m
  // from the still sea: no water, and no bed where it is clipped.
  bool clipped(glm::dvec2 least_m, glm::dvec2 most_m, double height_m) const;
  bool clips() const { return !bed_ && (clip_ || field(InputTarget::clip) != nullptr); }
  const DrawnClip* clip_volumes() const { return clip_.get(); }
  const ShallowsMix& shallows() const { return shallows_; }
  // For SeaMaker: makes of another sea what the bed makes of it and the windows around the viewer as he is now. Empty
  // where no bed is known.
  MakePlace remake(const PlaceInputs& inputs, const TileSources& others) const;

 private:
  struct Drawn {
    struct Part {
      std::shared_ptr<const Inputs> inputs;
      std::unique_ptr<PlaceField<glm::vec4>> field;  // from the first update on
    };
    InputTarget kind;
    int laid;  // gpu::laid_stays, gpu::laid_follows: a part each, in this order, and a layer of a slice
    std::vector<Part> parts;
    DrawnWindows windows;
  };
  struct Bed {
    std::unique_ptr<PlaceField<BedTexel>> field;  // from the first update on
    DrawnWindows heights, waves;
    std::unique_ptr<PlaceField<BedTexel>> next;  // in a change: of the new sea
    BedTurns turns;
  };
  const Drawn* drawn(InputTarget kind) const;
  void update(Frame& frame, Bed& bed, double time_s);
  void follow(const Sea& sea);
  PlaceSettings settings_;
  double depth_m_, time_s_ = 0.0;
  LodPlacement placement_;
  std::vector<Drawn> drawn_;
  ShallowsMix shallows_;
  std::unique_ptr<Bed> bed_;
  std::unique_ptr<DrawnShore> shore_;
  ClipMask mask_;
  std::unique_ptr<DrawnClip> clip_;
};

}  // namespace seascape
