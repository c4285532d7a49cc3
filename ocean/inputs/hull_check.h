// Whether an input's model encloses anything.
#pragma once
#include "ocean/inputs/input_spec.h"

namespace seascape {

// Of a valid ShapeInput of From::hull: throws as validate() does where its model is not closed or encloses nothing.
// Goes through all of the model, which many inputs may share.
void validate_hull(const InputSpec& spec);

}  // namespace seascape
