// What meshes miss of what feeds the sea beside its waves.
#pragma once
#include "ocean/waves/tile_source.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

// Of all sources of a sea together, by the spacing of a mesh's vertices. Measured on the sources' own tiles, at two
// times, against flat triangles between texels as many apart, each of the mip level of half that spacing, as vertices
// read them.
class SourceError {
 public:
  // Evaluates the source's tile: some 10 ms for one of 256 texels a side.
  void add(const TileSource& source);
  // Of one that is laid along curves (TileSource::along_curves), which bend it: by the bound that its curvature is;
  // `statistics` as bent.
  void add_along_curves(const SourceStatistics& statistics);
  // With the waves', which must be known. What is drawn at random of each adds up by squares, as deviations do, and
  // never to more than the sum of the largest.
  MeshError with(const MeshError& waves) const;

 private:
  MeshError
      squares_m2_;    // of what they miss where as much as a million points are looked at, were they of many waves each
  MeshError most_m_;  // sums of the largest that was seen, and a fifth more
  MeshError bound_m_;  // of those along curves
};

}  // namespace seascape
