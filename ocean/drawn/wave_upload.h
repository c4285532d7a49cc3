// Takes the tiles of the sea's `drawn` views to the GPU: the sea writes them into the images where the device samples
// images that the processor writes, or else they are copied.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ocean/drawn/wave_images.h"
#include "ocean/sea/sea.h"

namespace seascape {

class WaveUpload {
 public:
  // `images` were made to be written or copied into, in the sea's quality of the picture; both outlive this.
  WaveUpload(Device& device, Sea& sea, WaveImages& images);
  ~WaveUpload();
  WaveUpload(const WaveUpload&) = delete;
  WaveUpload& operator=(const WaveUpload&) = delete;

  // Has the tiles of a time in the images; nothing when images already hold them. The processor's part is done while
  // the GPU still draws the frame before, since each frame in flight has images or staging memory of its own.
  void update(Frame& frame, std::int64_t ticks);
  // Of the last update; none before the first. Who keeps it for longer than a frame has the next ones wait for memory.
  const SeaView& view() const { return view_; }

 private:
  static constexpr int planes = 3;  // shift, slope, moments: the three images
  struct Copy {
    const Image* to;
    std::vector<VkBufferImageCopy> regions;  // a level of a layer each
  };
  void make_copies(Device& device, const WaveTileLayout& layout);
  void lend_images(const WaveTileLayout& layout);
  void copy(Frame& frame);
  Sea& sea_;
  WaveImages& images_;
  SeaView view_;
  std::array<SeaView, Frame::slots> in_flight_;  // whose images frames in flight sample, where the sea writes them
  std::array<Buffer, Frame::slots> staging_;
  std::vector<Copy> copies_;
  WaveTileLayout image_layout_;
  struct Held {
    std::int64_t ticks;
    std::uint64_t waves;  // Sea::waves_version
    bool operator==(const Held&) const = default;
  };
  std::optional<Held> held_;  // what the images hold, where tiles are copied
};

}  // namespace seascape
