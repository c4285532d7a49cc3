// How the surface is divided into patches. Plain values.
#pragma once

namespace seascape {

// How patches of two levels meet.
enum class LodJoin {
  masked,   // the finer one's odd edge vertices snap to the coarser one's
  morphed,  // every other vertex slides to its coarser neighbour before the level changes
};

// What decides how fine the mesh is at a distance.
enum class LodLaw {
  pixel_error,  // how many pixels it may miss the sea by
  threshold,    // how large a square may be over its distance, in a fixed measure
};

struct LodSettings {
  double ocean_size_m = 4096.0;  // side of the quadtree's root square, 256 to 8192, doubled until it holds what is seen
                                 // to move, within skirt_multiplier; the skirt goes on to the horizon
  int patch_quads = 64;          // quads along the side of a square that the threshold speaks of: 16, 32 or 64; squares
                                 // are split and drawn in patches of gpu::patch_quads
  LodLaw by = LodLaw::threshold;
  double pixel_error = 2.0;  // the most pixels by which the mesh may miss the sea, 0.25 to 64
  double threshold = 1.2;    // a LOWER threshold gives MORE detail: a square splits when size / distance exceeds
                             // Quadtree::split_ratio times it; 0.5 to 4
  LodJoin join = LodJoin::morphed;
  double cull_scale = 1.8;    // multiplies the displacement that culling grows a patch's bounds by, 1 to 4
  int levels = 0;             // splits of the ocean into such squares, 0 to 12; 0: as many as the quality needs
  double max_height_m = 0.0;  // bound of the displacement for culling; 0: taken from the spectrum
  double skirt_multiplier =
      10.0;  // patches and skirt keep their density up to this many ocean sizes, 1 to 20, where motion is seen so far
  bool earth_curvature = true;
  bool freeze = false;  // keep the last selection, to look at it from elsewhere
  int drop_patch = -1;  // debug: leaves the patch of this index out, the control of every test for holes

  bool operator==(const LodSettings&) const = default;
};

}  // namespace seascape
