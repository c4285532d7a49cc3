// The sea's tiles as images that shaders sample, and what the shaders are told of them; WaveCompute or WaveUpload fills
// them.
#pragma once
#include <vector>

#include "engine/frame.h"
#include "ocean/waves/pattern_moments.h"
#include "ocean/waves/sea_state.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

class WaveImages {
 public:
  // How the images are filled: stored into by WaveCompute; by WaveUpload written where they lie, if the device samples
  // such images, or else copied into. `in_flight`: how many frames may be on the GPU that read them.
  enum class Filled { stored, written, copied };
  WaveImages(Device& device, const SeaState& sea, const WaveQuality& quality, const WaveBins& bins,
             const SeaStatistics& statistics, double anisotropy, Filled filled, int in_flight = Frame::slots);

  // Other amplitudes and chop: what shaders are told of the waves' statistics.
  void take(const WaveBins& bins, double chop, const SeaStatistics& statistics);

  // What shaders are told of the waves; `grid_origin_m` is the world x, z that rest positions count from.
  void describe(gpu::SeaData& data, glm::dvec2 grid_origin_m) const;

  // Tiles of one shape as texture arrays, a layer a cascade (see shaders/lib/wave_columns.glsl for the channels).
  struct Set {
    int first, cascades;  // the first cascade, and how many
    int samples, levels;  // a side of level 0; log2(samples) + 1
    Image displacement, derivatives, moments;
    const Image& image(WavePlane plane) const {
      return plane == WavePlane::shift ? displacement : plane == WavePlane::slope ? derivatives : moments;
    }
  };
  // The longest tile, and all others where there are any; of images that the processor writes, those drawn from now.
  const std::vector<Set>& sets() const { return copies_[shown_]; }
  Filled filled() const { return filled_; }
  // Images that the processor writes are there once for each frame in flight, those of other viewers included.
  const std::vector<std::vector<Set>>& copies() const { return copies_; }
  std::size_t shown() const { return shown_; }
  void show(std::size_t copy) { shown_ = copy; }
  // Adds every image as a pass that shades uses it.
  void add_reads(Uses& uses) const;
  VkImageLayout read_layout() const {
    return filled_ == Filled::written ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  }
  // Adds every image as a pass uses it; `whole`: nothing of what it held is kept.
  void add_uses(Uses& uses, Access access, bool whole = false) const;
  // Of all images of the sea (shaders/lib/sea.glsl): linear and repeating; that of pixels is anisotropic where the
  // settings and the device have it.
  VkSampler smooth_sampler() const { return smooth_sampler_.get(); }
  VkSampler pixel_sampler() const { return pixel_sampler_.get(); }
  bool half_storage() const { return half_; }
  int cascades() const { return int(cascade_moments_.size()); }
  bool warped() const { return bool(warp_); }  // the first cascade's pattern

 private:
  friend class WaveCompute;  // which stores into views of their levels
  Ladder ladder_;
  PatternWarp warp_;
  SeaStatistics statistics_;
  double chop_;
  bool half_ = false;
  std::vector<PatternMoments> cascade_moments_;
  Filled filled_;
  std::vector<std::vector<Set>> copies_;
  std::size_t shown_ = 0;
  Owned<VkSampler> smooth_sampler_, pixel_sampler_;
};

}  // namespace seascape
