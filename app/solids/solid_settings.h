// How solid things are drawn. Plain values.
#pragma once

namespace seascape {

struct SolidSettings {
  bool seen_in_water = true;  // what is under water is seen through its surface
};

}  // namespace seascape
