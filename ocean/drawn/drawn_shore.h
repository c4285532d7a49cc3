// Curves along which waves run as images that the surface samples: where a texel lies along them, in windows around the
// viewer (shaders/lib/shore.glsl).
#pragma once
#include <memory>

#include "ocean/drawn/drawn_windows.h"
#include "ocean/places/shore_field.h"

namespace seascape {

class DrawnShore {
 public:
  // Made under the name of its effect. Where the device samples no whole floats distances of hundreds of metres are too
  // much for it, and there are no such waves. `shallows`: what a bed leaves of them; null where none is known.
  DrawnShore(Device& device, std::shared_ptr<const ShoreLines> lines, std::shared_ptr<const Shallows> shallows,
             const PlaceSettings& settings);
  // Takes other curves, or another sea's shallows, from the next update on.
  void take(std::shared_ptr<const ShoreLines> lines, std::shared_ptr<const Shallows> shallows);
  void update(Frame& frame, const LodPlacement& placement, double time_s);
  void add_uses(Uses& uses, Access access) const;
  const Image& lines() const { return of_lines_.image(); }
  const Image& ways() const { return of_ways_.image(); }

 private:
  std::shared_ptr<const ShoreLines> lines_;
  std::shared_ptr<const Shallows> shallows_;
  PlaceSettings settings_;
  std::unique_ptr<PlaceField<ShoreTexel>> field_;  // from the first update on
  DrawnWindows of_lines_, of_ways_;
};

}  // namespace seascape
