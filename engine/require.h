// What a setting has to be, told by its name where it is not.
#pragma once
#include <cmath>
#include <string>

#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

// Throws Error(name, "VALUE is not RANGE", "give a number RANGE") unless `holds` and the value is finite.
inline void require(bool holds, double value, const char* name, const char* range) {
  if (!holds || !std::isfinite(value))
    throw Error(name, text_from(value) + " is not " + range, std::string("give a number ") + range);
}

}  // namespace seascape
