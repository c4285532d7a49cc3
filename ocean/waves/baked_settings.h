// A recorded loop of waves that is played: the settings of the effect baked. Plain values, in SI units.
#pragma once
#include <string>

namespace seascape {

struct BakedSettings {
  std::string loop = "fresh_sea";  // a folder that `seascape bake` wrote, or the name of one in content/loops
  double scale = 1.0;   // so many times as long and as high as recorded, and as slow as waves of that size are: time
                        // goes sqrt(scale) slower
  double weight = 1.0;  // of its displacement
  double speed = 1.0;   // 0 stands still, below 0 runs backwards
  double fade_m = 0.0;  // distance from the viewer at which the picture has none of its waves any more, only their
                        // roughness; 0: no such distance
};

// Throws Error naming the setting, its value and its range. Whether the loop is there is its reader's to say.
void validate(const BakedSettings& settings);

}  // namespace seascape
