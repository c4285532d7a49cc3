// Four boxes against the eyes' planes at once, vectorised: the part of culling that a selection spends its time in.
#pragma once
#include "ocean/lod/culling.h"

namespace seascape {

// EyeFrusta::may_see of quarters, for at most eight eyes: `planes` has eight an eye, `asked` is a bit a plane, `left` takes
// four.
unsigned ask_quarters(const FrustumPlane* planes, const QuarterBoxes& boxes, std::uint64_t asked, std::uint64_t* left);

}  // namespace seascape
