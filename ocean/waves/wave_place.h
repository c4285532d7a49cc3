// Where the picture's tiles of waves are computed.
#pragma once

namespace seascape {

enum class WavePlace {
  automatic,  // on the processor where the driver is software, whose stores into images are slow; else on the GPU
  gpu,
  cpu,
};

}  // namespace seascape
