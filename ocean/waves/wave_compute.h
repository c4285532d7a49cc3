// Fills the sea's tiles on the GPU: spectrum and transforms by compute shaders, with mip chains, once a frame.
#pragma once
#include <cstdint>
#include <vector>

#include "ocean/waves/wave_images.h"

namespace seascape {

class WaveCompute {
 public:
  // `images` were made to be stored into, for the same sea and quality; they must outlive this.
  WaveCompute(Device& device, ShaderLibrary& shaders, const SeaState& sea, const WaveQuality& quality, const WaveBins& bins,
              WaveImages& images);

  // Computes all tiles for the time; nothing when they already hold it.
  void update(Frame& frame, std::int64_t ticks);

 private:
  struct MipStep {
    int source_level, levels, groups;
    Bindings bindings[3];  // displacement, derivatives, moments
  };
  SeaState sea_;
  WaveQuality quality_;
  Ladder ladder_;
  const WaveImages& images_;
  Buffer bins_, rows_;
  Owned<VkSampler> fetch_sampler_;
  Pipeline rows_pipeline_, columns_pipeline_, mips_pipeline_;
  Bindings rows_bindings_, columns_bindings_;
  std::vector<MipStep> mip_steps_;
  bool computed_ = false;
  std::int64_t ticks_ = 0;
};

}  // namespace seascape
