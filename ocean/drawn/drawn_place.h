// Data that belong to places as images that the surface samples: windows that move with the viewer, of which only what
// has changed is copied.
#pragma once
#include <memory>
#include <vector>

#include "ocean/drawn/drawn_clip.h"
#include "ocean/drawn/drawn_piece.h"
#include "ocean/drawn/drawn_shore.h"
#include "ocean/drawn/drawn_windows.h"
#include "ocean/places/bed_change.h"
#include "ocean/places/clip_mask.h"

namespace seascape {

class DrawnPlace final : public DrawnPiece {
 public:
  // Every field is made under the name of its effect. Throws as validate() does.
  DrawnPlace(Device& device, const Sea& sea);

  const char* stage() const override { return "places"; }
  // Takes the look of the ground.
  void apply(const PlaceSettings& settings);
  void take(const Sea& sea) override;
  // The data around the viewer, with what the bed makes of the sea's waves and what clips now.
  void update(Frame& frame, const DrawnMoment& moment) override;
  void declare(SurfaceSlots& slots, std::size_t copy) const override;
  void describe(gpu::FrameData& data, glm::dvec2 grid_origin_m) const override;
  void add_uses(Uses& uses) const override;
  // Of the still water's level.
  WaterReach reach() const override { return {level_m(), 0.0}; }

  const PlaceField<glm::vec4>* field(InputTarget kind) const;
  // How far the still water stands above or below y = 0 at most, of what has been around the viewer, m.
  double level_m() const;
  // How far land stands above y = 0 at most: within a distance of the viewer (along x and z), and anywhere, of what has
  // been around the viewer.
  double land_m(double within_m) const;
  double land_m() const;
  // Between which heights the bed lies within a distance of the viewer, now, m; where none is known, 0 and 0.
  glm::dvec2 bed_m(double within_m) const;
  bool has_bed() const { return bed_ != nullptr; }
  // Whether there is nothing to draw within a rectangle (m, in the world) where no water stands further than height_m
  // from the still sea: no water, and no bed where it is clipped.
  bool clipped(glm::dvec2 least_m, glm::dvec2 most_m, double height_m) const;
  bool clips() const { return !bed_ && (clip_ || field(InputTarget::clip) != nullptr); }
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
  // The finest slice whose window holds all within a distance of the viewer; the number of slices where none does.
  int slice_of(double within_m) const;
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
