// How a headset is drawn for. Plain values.
#pragma once

namespace seascape {

struct HeadsetSettings {
  bool symmetric = false;  // both eyes are drawn with one field of view, wider than either sees
};

}  // namespace seascape
