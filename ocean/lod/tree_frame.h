// The numbers that the steps of one selection share: the tree, where the viewer stands in it, and what bounds its water.
#pragma once
#include <algorithm>
#include <glm/glm.hpp>

#include "shaders/shared/skirt.h"

namespace seascape {

// In units of unit_m unless named _m. The tree's own coordinates count from its least corner.
struct TreeFrame {
  int levels = 0;                       // the finest: 0 is the root alone
  int root_size = 0;
  int viewer_x = 0, viewer_z = 0;       // the viewer's grid point in the tree's coordinates
  double gap_y = 0.0;                   // between the viewer and the water's bounds
  glm::ivec2 least{0};                  // the tree's least corner in the selection's coordinates
  glm::dvec2 viewer_m{0.0};             // the viewer relative to the grid origin
  double unit_m = 1.0;
  double rise_m = 0.0, shift_m = 0.0;   // what culling grows bounds by, upwards and downwards, and to every side
  bool curved = true;                   // the Earth falls away beneath the sea
  bool morphed = false;                 // lod.join
  double ratio = 1.0;                   // a node splits while its size / distance exceeds this,
  double visible_reach = 0.0;           // and nearer than this, beyond which all of the water's motion is below the error

  int size(int level) const { return root_size >> level; }

  // The first levels always split: from high above, the border of a coarse tree would cut corners off the round horizon.
  static constexpr int least_levels = 2;

  // Nearer than this the nodes of a level split.
  double split_reach(int level) const {
    if (level < least_levels) return gap_y + 2.0 * root_size;
    if (!morphed) return std::min(size(level) / ratio, visible_reach);
    return visible_reach > 0.0 ? std::min(size(level) / ratio, visible_reach + morph_step * size(level)) : 0.0;
  }

  // Morphing needs room: the reaches of two levels lie 0.6 of a node's size apart where visible_reach bounds them, and no node
  // is drawn whole nearer than its size over 2.1. Then no vertex slides out of its patch: a patch's corners stay until the
  // level three above its own slides, half way from the reach before that level's own, at 45 of its strides by the ratio, at
  // 57 past visible_reach by the step. Its parent is split within reach, or by balance at most 1.42 of its size, 23 strides,
  // farther than nodes of any smaller size are; and the patch ends 23 strides after that.
  static constexpr double morph_step = 0.6;
  static constexpr double most_morphed_ratio = 2.1;
};

// How far the sea lies below the plane through the point beneath the viewer, at the square of a distance from there.
inline double curvature_drop(double distance2_m2) { return distance2_m2 / (2.0 * static_cast<double>(gpu::earth_radius_m)); }

}  // namespace seascape
