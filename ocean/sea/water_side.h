// Whether a point, such as an eye, is in the water or in the air, also where a crest has folded over itself.
#pragma once
#include <glm/glm.hpp>

#include "ocean/waves/wave_field.h"

namespace seascape {

struct WaterSide {
  bool in_water = false;  // the same as at.y < height_m, always
  double height_m = 0.0;  // of the surface that is nearest above a point in the water, nearest below one in the air
  int sheets = 1;         // how often the surface stands over or under the point: more than once where it is folded
  bool certain = true;    // false: the sheets that were found do not make a whole; in_water then follows query() alone
};

// The side at the time of the tiles, of a world point in metres above the still sea, of the waves that the picture
// draws (footprint 0). A surface that folds has more than one height over a place, of which query() gives one,
// unconverged. Here all are found: on the way straight up from the point each sheet counts 1, or -1 where it is turned
// over (a negative Jacobian), and the point is in the water where they do not cancel out (the winding number, by the
// rule of non-zero; Hormann and Agathos 2001). So the loop that the crest of too choppy a wave makes is water, and the
// wedge of air beneath its overhang is air; and who passes a sheet that can be seen changes sides. Over any place they
// add up to 1, which is how a search that missed one is told, and done again more closely. Where there is one sheet, it
// is query()'s. Depends on nothing but its arguments: an eye that rests, or trembles without passing a sheet, keeps its
// side. Any number of threads may ask at once. No allocation; some 3,000 samples where waves reach, none above and
// below. A point that is not finite is in the air, uncertain.
//
// These are the waves alone. PlaceSea::side() and SeaView::side() do the same for the whole surface. There a point
// above dry land is in the air, one beneath the bed counts as beneath the surface, and one in a volume or over a flat
// input that takes the water away is in the air, its own height for height_m.
WaterSide water_side(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& at_m);

}  // namespace seascape
