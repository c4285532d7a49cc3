// What the mirror writes over its picture: the headset's frame times as a graph, its stages as bars, its state.
#pragma once
#include <array>

#include "app/panel.h"

namespace seascape {

class MirrorWidgets {
 public:
  // Once a frame of the headset: milliseconds.
  void note(double cpu_ms, double gpu_ms);
  // Between Overlay::begin and end.
  void draw(const PanelFacts& facts) const;

 private:
  static constexpr std::size_t frames = 180;
  std::array<float, frames> cpu_ms_{}, gpu_ms_{};
  std::size_t next_ = 0;  // the oldest
};

}  // namespace seascape
