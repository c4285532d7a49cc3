// What a desktop shows of what someone sees in a headset. Plain values.
#pragma once

namespace seascape {

// left, right, both: copies of the eyes' pictures; third: seen from behind and above the head.
enum class MirrorView { left, right, both, third, off };

struct MirrorSettings {
  MirrorView view = MirrorView::left;
  double rate_hz = 30.0;    // pictures a second
  bool overlay = true;      // frame times and the headset's state over the picture
  double size = 0.5;        // of the third-person picture, as a share of the window's
  double distance_m = 4.0;  // of its camera, behind the head
  double height_m = 1.5;    // and above it
  double smooth_s = 0.6;    // in which its camera comes to within a tenth of where it is to be
};

}  // namespace seascape
