// The device that benchmarks of the GPU share.
#pragma once
#include "engine/device.h"
#include "engine/shader.h"

namespace seascape::bench {

// Made once: a device takes a third of a second, and ends with the program.
struct Gpu {
  Device device{DeviceOptions{}};
  ShaderLibrary shaders;
};
inline Gpu& gpu() {
  static Gpu all;
  return all;
}

}  // namespace seascape::bench
