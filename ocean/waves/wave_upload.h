// Fills the sea's tiles from the wave field: computed on the processor, written into staging memory and copied.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_images.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

class WaveUpload {
 public:
  // `images` were made to be copied into, for the same sea and quality; they must outlive this.
  WaveUpload(Device& device, const SeaState& sea, const WaveQuality& quality, const WaveBins& bins, const WaveImages& images);

  // Computes all tiles for the time and copies them; nothing when the images already hold it. The processor's part is done
  // while the GPU still draws the frame before, since each frame in flight has staging memory of its own.
  void update(Frame& frame, std::int64_t ticks);
  // Other amplitudes and chop from the next update on (WaveField::take).
  void take(const WaveBins& bins, double chop, const SeaStatistics& statistics);

 private:
  static constexpr int planes = 3;  // shift, slope, moments: the three images
  WaveField field_;
  const WaveImages& images_;
  WaveTiles tiles_;
  std::array<Buffer, Frame::slots> staging_;
  struct Copy {
    const Image* to;
    std::vector<VkBufferImageCopy> regions;  // a level of a layer each
  };
  std::vector<Copy> copies_;
  bool uploaded_ = false;
  std::int64_t ticks_ = 0;
};

}  // namespace seascape
