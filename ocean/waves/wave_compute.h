// The sea's tiles on the GPU: spectrum and transforms by compute shaders, with mip chains, once a frame.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/frame.h"
#include "ocean/waves/sea_state.h"
#include "ocean/waves/wave_field.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

class WaveCompute {
 public:
  WaveCompute(Device& device, ShaderLibrary& shaders, const SeaState& sea, const WaveQuality& quality, const WaveBins& bins,
              const SeaStatistics& statistics, double anisotropy);

  // Computes all tiles for the time; nothing when they already hold it.
  void update(Frame& frame, std::int64_t ticks);

  // The part of SeaData that follows the place: `grid_origin_m` is the world x, z that rest positions count from.
  gpu::SeaData sea_data(glm::dvec2 grid_origin_m) const;

  // Tiles as texture arrays, a layer a cascade (see shaders/lib/wave_columns.glsl for the channels).
  const Image& displacement() const { return displacement_; }
  const Image& derivatives() const { return derivatives_; }
  const Image& moments() const { return moments_; }
  VkSampler vertex_sampler() const { return vertex_sampler_.get(); }
  VkSampler pixel_sampler() const { return pixel_sampler_.get(); }
  bool half_storage() const { return half_; }

 private:
  struct MipStep {
    int source_level, levels, groups;
    Bindings bindings[3];  // displacement, derivatives, moments
  };
  SeaState sea_;
  WaveQuality quality_;
  Ladder ladder_;
  SeaStatistics statistics_;
  std::vector<glm::dvec3> cascade_moments_;
  bool half_ = false;
  int levels_ = 1;
  Buffer bins_, rows_;
  Image displacement_, derivatives_, moments_;
  Owned<VkSampler> vertex_sampler_, pixel_sampler_, fetch_sampler_;
  Pipeline rows_pipeline_, columns_pipeline_, mips_pipeline_;
  Bindings rows_bindings_, columns_bindings_;
  std::vector<MipStep> mip_steps_;
  bool computed_ = false;
  std::int64_t ticks_ = 0;
};

}  // namespace seascape
