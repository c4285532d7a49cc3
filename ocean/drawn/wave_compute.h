// Fills the sea's tiles on the GPU: spectrum and transforms by compute shaders, with mip chains, once a frame.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "ocean/drawn/wave_images.h"
#include "shaders/shared/wave_compute.h"

namespace seascape {

// Invocations of a workgroup of transforms by `radix` invocations each: eight side by side, or fewer where the device
// has no room for them (limits of invocations and of shared memory).
std::uint32_t transform_group(std::uint32_t radix, const DeviceFacts& facts);

class WaveCompute {
 public:
  // `images` were made to be stored into, for the same sea and quality; they must outlive this.
  WaveCompute(Device& device, ShaderLibrary& shaders, const SeaState& sea, const WaveBins& bins, WaveImages& images);

  // Computes all tiles for the time; nothing when they already hold it.
  void update(Frame& frame, std::int64_t ticks);
  // Other amplitudes and chop of the same waves, in a frame that has begun, before its update.
  void take(Frame& frame, const WaveBins& bins, double chop);

 private:
  struct MipStep {
    int source_level, levels, groups;
    Bindings bindings[3];  // displacement, derivatives, moments
  };
  // What fills the tiles of one shape.
  struct Work {
    const WaveImages::Set* set;
    std::uint32_t band;         // bins a side that its tiles carry
    std::uint32_t core, slots;  // points of a transform, and how many transforms share a workgroup
    Buffer bins, rows;
    Pipeline rows_pipeline, columns_pipeline;
    Bindings rows_bindings, columns_bindings;
    gpu::WavePush push;  // the time left out
    std::vector<MipStep> mip_steps;
    std::array<Buffer, Frame::slots> staging;  // of the bins, while the sea changes
  };
  Work make_work(Device& device, ShaderLibrary& shaders, const SeaState& sea, const WaveBins& bins,
                 WaveImages::Set& set) const;
  Device& device_;
  const WaveImages& images_;
  Owned<VkSampler> fetch_sampler_;
  Pipeline mips_pipeline_;
  std::vector<Work> work_;
  bool computed_ = false;
  std::int64_t ticks_ = 0;
};

}  // namespace seascape
