// The settings of adaptive quality. Plain values.
#pragma once

namespace seascape {

// Whether the frame rate is held at the cost of quality. Automatic: where a display shows frames at a rate of its own.
enum class AdaptiveUse { automatic, on, off };

struct AdaptiveSettings {
  bool on = true;          // off: levels stay as they are
  double target_hz = 0.0;  // rate to hold; 0: the display's
  // Bounds on quality: 1 is the finest level of all levers, 0 the coarsest.
  double floor = 0.0, ceiling = 1.0;
};

}  // namespace seascape
