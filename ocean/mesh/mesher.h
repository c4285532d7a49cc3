// The interface of what makes the surface's mesh for a viewpoint. Drawing knows nothing else of it.
#pragma once
#include <functional>

#include "engine/view.h"
#include "ocean/mesh/lod_settings.h"
#include "ocean/mesh/surface_selection.h"

namespace seascape {

class WaveTiles;  // ocean/waves/wave_tiles.h

// What a mesher may know of the water. It outlives the call alone.
struct MeshWater {
  explicit MeshWater(const DisplacementBounds& most, const WaveField* waves = nullptr, const WaveTiles* now = nullptr)
      : bounds(most), field(waves), tiles(now) {}
  DisplacementBounds bounds;
  // The picture's waves as they are, where the processor has them and nothing else moves the water; null: not so.
  const WaveField* field;
  const WaveTiles* tiles;
  // Whether there is surely nothing to draw within a rectangle (least and most x and z in the world, m); null: never.
  std::function<bool(glm::dvec2 least_m, glm::dvec2 most_m)> gone;
};

class Mesher {
 public:
  virtual ~Mesher() = default;

  // Takes other settings. Throws Error naming the key when one is out of range, and then nothing has changed.
  virtual void apply(const LodSettings& settings) = 0;
  // The patches for the viewpoint's head and eyes, and the block that places their vertices; they stay until the next
  // call. Throws Error when the viewpoint or the bounds are not finite, or the viewer is out of reach.
  virtual const SurfaceSelection& select(const Viewpoint& viewpoint, const MeshWater& water) = 0;
};

}  // namespace seascape
