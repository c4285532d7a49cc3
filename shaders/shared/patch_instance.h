// One patch of the surface, 4 by 4 quads, as the quadtree selects it and surface.vert draws it.
#ifndef SEASCAPE_PATCH_INSTANCE_H
#define SEASCAPE_PATCH_INSTANCE_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

// Quads along a patch's side. Small patches follow distance closely, and little of what is drawn lies out of sight.
SEASCAPE_CONST int patch_quads = 4;

// Bits of PatchInstance::flags. An edge bit: the neighbour on that side is one level coarser, so this patch's odd
// vertices of that edge snap to its even ones. East is +x, north is +z, as in the 16 variants of the design.
SEASCAPE_CONST uint patch_east = 1u;
SEASCAPE_CONST uint patch_north = 2u;
SEASCAPE_CONST uint patch_west = 4u;
SEASCAPE_CONST uint patch_south = 8u;
// A strip of the horizon skirt: row 0 is the outer edge of a patch on the root's border, the rows after it go outwards
// from the tree's centre. The two bits at patch_skirt_side say which border: 0 east, 1 north, 2 west, 3 south. The six
// at patch_skirt_band say which of the skirt's rows, patch_quads at a time, the strip has.
SEASCAPE_CONST uint patch_skirt = 16u;
SEASCAPE_CONST uint patch_skirt_side_shift = 5u;
SEASCAPE_CONST uint patch_level_shift = 8u;  // five bits: the level (0 the root)
SEASCAPE_CONST uint patch_skirt_band_shift = 13u;

// So many patches are one instance of the draw, because an instance of a few triangles costs drivers more than the
// triangles do. Where a list ends within an instance the rest of it is nothing.
SEASCAPE_CONST int patches_an_instance = 8;
SEASCAPE_CONST uint patch_nothing = 0x80000000u;

// The level of a patch from its flags.
SEASCAPE_FUNCTION uint patch_level(uint flags) { return (flags >> patch_level_shift) & 31u; }

// Coordinates are whole numbers of the tree's finest vertex spacing, relative to the viewer's grid point, so that two
// patches that share a vertex compute it from the same numbers.
struct PatchInstance {
  ivec2 corner;  // the patch's vertex (0, 0): its least x and least z
  int stride;    // spacing between its vertices, a power of two
  uint flags;
};

SEASCAPE_SHARED_END
#endif
