// The numbers that the steps of one selection share: the tree, where the viewer stands in it, and what bounds its
// water.
#pragma once
#include <algorithm>
#include <array>
#include <glm/glm.hpp>

#include "shaders/shared/skirt.h"

namespace seascape {

// In units of unit_m unless named _m. The tree's own coordinates count from its least corner.
struct TreeFrame {
  static constexpr int max_levels = 20;  // gpu::VertexMorph has reaches of so many

  int levels = 0;  // the finest: 0 is the root alone
  int root_size = 0;
  int viewer_x = 0,
      viewer_z = 0;     // the grid point that levels follow, in the tree's coordinates: the water beneath the viewer
  double gap_y = 0.0;   // between the viewer and the water, at least
  glm::ivec2 least{0};  // the tree's least corner in the selection's coordinates
  glm::dvec2 viewer_m{0.0};  // the viewer relative to the grid origin
  double unit_m = 1.0;
  double rise_m = 0.0, shift_m = 0.0;  // what culling grows bounds by, upwards and downwards, and to every side
  bool curved = true;                  // the Earth falls away beneath the sea
  // A node whose quarters have vertices 2^n units apart splits nearer than reach[n]: such vertices are needed there.
  std::array<double, max_levels> reach{};
  double border_spacing = 1.0;  // how far vertices may be apart at the tree's border
  double visible_reach = 0.0;   // beyond this all of the water's motion is below the error allowed

  int size(int level) const { return root_size >> level; }

  // The first levels always split: from high above, the border of a coarse tree would cut corners off the round
  // horizon.
  static constexpr int least_levels = 2;

  // Nearer than this the nodes of a level split.
  double split_reach(int level) const {
    return level < least_levels ? gap_y + 2.0 * root_size : reach[static_cast<std::size_t>(levels - 1 - level)];
  }

  // Morphing needs room: the reaches of two levels lie 1.5 of a node's size apart or more, and no node is drawn whole
  // nearer than that. Then no vertex slides out of its patch: a patch's corners stay until the level two above its own
  // slides, half way from the reach before that level's own to its own, 24 of the patch's strides or more past the
  // patch's own reach. Its parent is split within reach, or by balance at most 1.42 of its size, 11.4 strides, farther
  // than nodes of any smaller size are; and the patch ends 11.4 strides after that.
  static constexpr double morph_step = 1.5;
};

// How far the sea lies below the plane through the point beneath the viewer, at the square of a distance from there.
inline double curvature_drop(double distance2_m2) {
  return distance2_m2 / (2.0 * static_cast<double>(gpu::earth_radius_m));
}

}  // namespace seascape
