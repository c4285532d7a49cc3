// Where the displaced surface stands at a place: the inverse of the sea's horizontal displacement.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "ocean/waves/wave_field.h"

namespace seascape {

struct LodPlacement;  // ocean/places/lod_windows.h

// The surface is the set of points p = (x, 0, z) + D(x, z, t) of rest positions (x, z). The point found is the one that
// stands at the place asked, or nearest to it of those that the search came by.
struct QueryAnswer {
  double height_m = 0.0;  // of the surface at the place asked, above the still sea: that of the point found, carried
                          // over the residual along the slope there (by at most the residual)
  glm::dvec3 displacement{0.0};  // D of the point found, metres from its rest position
  glm::dvec3 normal{0.0, 1.0, 0.0};
  // Orbital velocity: dD/dt at a fixed rest position, of the water particle that is at the surface there now. What
  // floats without a will of its own moves so; drag is against this.
  glm::dvec3 orbital_velocity_mps{0.0};
  // How fast `displacement` changes at the fixed place; y is the rate of change of the surface's height there, as a
  // wave staff reads it. The displacement D of the point that is there obeys r + D(r, t) = place, so with v = dD/dt at
  // fixed r its sideways parts are u = (I + grad D)^-1 v, and its height has v_y - u . grad D_y, which is the kinematic
  // condition of a free surface (Lamb 1932, article 9), d eta/dt = v_y - v_x d eta/dx - v_z d eta/dz. In a current v is
  // the pattern's, which is carried along, and not the water's.
  glm::dvec3 eulerian_velocity_mps{0.0};
  glm::dvec2 flow_mps{0.0};  // the current there
  double still_m = 0.0;      // height of the still water there
  double depth_m = 0.0;      // of the still water over the bed, or of the open sea
  bool clipped = false;      // there is no water: an input or a volume of clip takes it away
  double left_out_m = 0.0;   // SeaView::left_out_m
  double residual_m = 0.0;   // horizontal distance between the point found and the place asked
  // Spectral norm of grad D at the point found: what a step of the search multiplies its residual by, near there. From
  // 1 on the search need not end.
  double contraction = 0.0;
  int iterations = 0;      // steps taken
  bool converged = false;  // the residual is within the tolerance and the surface is not folded over at the point found
};

// Parts of an answer that take time of their own, to be combined.
enum QueryField : unsigned {
  query_slopes = 1,    // normal, contraction, and whether the surface is folded over; the height is carried over the
                       // residual. Without them it is that of the point found
  query_velocity = 2,  // orbital and Eulerian; needs slopes and has them found
  query_clip = 4,      // clipped
  query_all = 7
};

struct QueryOptions {
  double footprint_m = 0.0;   // size of the object asking: shorter waves are left out (WaveField::sea)
  int most_iterations = 8;    // steps x <- q - D(x), which converge at the rate sup |grad D| where that is below 1
  double tolerance_m = 1e-3;  // the search ends at the first residual that is not longer
  // Answers of a moment ago for the same objects, in the same order, near where they are asked now; empty: none. The
  // search starts from their displacements, and saves a step or two. May be the memory of the new answers.
  std::span<const QueryAnswer> previous = {};
  // Whether dynamic waves, wakes and the bodies of actors are in the answers, which depend on what came before
  // (SeaView).
  bool history = true;
  // Whether the dynamic waves around the viewer are, which depend on the camera. What bodies feel leaves them out.
  bool viewer_waves = true;
  // Whether bodies of actors clip.
  bool actors_bodies = true;
  // The window that belongs to this body is left out of wakes (WakeWindows): what it stirs up itself, but for what lies
  // in windows of others, and all else that its own window knows. 0: none is.
  std::uint64_t without_window_of = 0;
  unsigned fields = query_all;  // what is found; the rest of an answer is as of calm water, and not clipped
  // Has what belongs to places as a picture with these windows shows it, coarser with distance; it has to outlive the
  // call. Null: in the finest texels that the footprint leaves, wherever the place is.
  const LodPlacement* seen = nullptr;
};

// Answers for world places (x, z in metres), `answers` as long as `places`, at the time of the tiles. For another time
// than that of the picture evaluate tiles for it (WaveField::evaluate), with velocity if velocities are asked for:
// without, they are 0. Any number of threads at once may ask of the same tiles, as long as none evaluates them; a batch
// of more than some thousand points takes all cores of its own. No allocation. An answer depends on its place, its
// previous answer, the field, the tiles and the options alone: the same bits in a batch, in any order, by itself, on
// any thread and at any width of vectors. A place that is no finite number gets an answer that says it did not
// converge.
void query(const WaveField& field, const WaveTiles& tiles, std::span<const glm::dvec2> places,
           std::span<QueryAnswer> answers, const QueryOptions& options = {}, double left_out_m = 0.0);

}  // namespace seascape
