// The still water at a position: what effects on the water need beside the waves (PlaceSea::still_water).
#pragma once

namespace seascape {

// The defaults are deep open water.
struct StillWater {
  double height_m = 0.0;                   // of the still water above y = 0, dry or not
  double depth_m = 1e6;                    // over the bed, 0 or less on land; without a bed that of the open sea
  double waves = 1.0;                      // share of the waves' displacement that the bed leaves
  double swash = 0.0;                      // share of the waves' height that runs up the shore (PlaceWaves)
  double surf = 0.0;                       // share of the waves' energy that breaks there, 0 to 1
  double placed = 1.0, placed_surf = 0.0;  // `waves` and `surf` of waves that run along curves
  bool clipped = false;                    // the still water's surface is clipped: there is no water
};

}  // namespace seascape
