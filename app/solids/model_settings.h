// How solid things are drawn. Plain values.
#pragma once

namespace seascape {

struct ModelSettings {
  double detail = 1.0;           // of levels of detail: 1 as their files ask, 0.1 to 4; less is coarser
  bool seen_in_water = true;     // what is under water is seen through its surface
  bool block_textures = true;    // their pictures lie in blocks of 4 x 4 texels, where the device reads such
  int shadow_texels = 2048;      // of the sun map's side; 0: things throw no shadows
  double shadow_reach_m = 60.0;  // from the viewer
};

}  // namespace seascape
