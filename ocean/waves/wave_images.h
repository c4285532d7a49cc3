// The sea's tiles as images that shaders sample, and what the shaders are told of them; WaveCompute or WaveUpload fills them.
#pragma once
#include <vector>

#include "engine/frame.h"
#include "ocean/waves/sea_state.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

class WaveImages {
 public:
  // `filled_as`: what the images are to whoever fills them (storage, or the destination of copies).
  WaveImages(Device& device, const SeaState& sea, const WaveQuality& quality, const WaveBins& bins, const SeaStatistics& statistics,
             double anisotropy, VkImageUsageFlags filled_as);

  // Other amplitudes and chop: what shaders are told of the waves' statistics.
  void take(const WaveBins& bins, double chop, const SeaStatistics& statistics);

  // The part of SeaData that follows the place: `grid_origin_m` is the world x, z that rest positions count from.
  gpu::SeaData sea_data(glm::dvec2 grid_origin_m) const;

  // Tiles of one shape as texture arrays, a layer a cascade (see shaders/lib/wave_columns.glsl for the channels).
  struct Set {
    int first, cascades;  // the first cascade, and how many
    int samples, levels;  // a side of level 0; log2(samples) + 1
    Image displacement, derivatives, moments;
    const Image& image(WavePlane plane) const {
      return plane == WavePlane::shift ? displacement : plane == WavePlane::slope ? derivatives : moments;
    }
  };
  // The longest tile, and all others where there are any.
  const std::vector<Set>& sets() const { return sets_; }
  // Adds every image as a pass uses it; `whole`: nothing of what it held is kept.
  void add_uses(Uses& uses, Access access, bool whole = false) const;
  VkSampler vertex_sampler() const { return vertex_sampler_.get(); }
  VkSampler pixel_sampler() const { return pixel_sampler_.get(); }
  bool half_storage() const { return half_; }
  int cascades() const { return int(cascade_moments_.size()); }

 private:
  friend class WaveCompute;  // which stores into views of their levels
  Ladder ladder_;
  SeaStatistics statistics_;
  double chop_;
  bool half_ = false;
  std::vector<glm::dvec3> cascade_moments_;
  std::vector<Set> sets_;
  Owned<VkSampler> vertex_sampler_, pixel_sampler_;
};

}  // namespace seascape
