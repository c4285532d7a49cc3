// What a person who wears a headset sets for himself, and how it is drawn for. Plain values; presets and scenes leave
// them alone.
#pragma once

namespace seascape {

struct HeadsetSettings {
  double scale = 1.0;    // of the size of pictures that the runtime recommends
  double rate_hz = 0.0;  // asked for; 0: the runtime's own
  bool left_handed = false;
  bool seated = false;
  double eye_height_m = 1.7;
  bool symmetric = false;  // both eyes are drawn with one field of view, wider than either sees
};

}  // namespace seascape
