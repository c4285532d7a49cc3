// Fills the sea's tiles from the wave field: computed on the processor, where the images lie if the device samples such
// images, or else in staging memory that is copied.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ocean/drawn/wave_images.h"
#include "ocean/sea/query.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

class WaveUpload {
 public:
  // `images` were made to be written or copied into, for the same sea and quality; they must outlive this.
  WaveUpload(Device& device, const SeaState& sea, const WaveQuality& quality, const WaveBins& bins, WaveImages& images);

  // Computes all tiles for the time and has them in the images; nothing when images already hold it. The processor's
  // part is done while the GPU still draws the frame before, since each frame in flight has images or staging memory of
  // its own.
  void update(Frame& frame, std::int64_t ticks);
  // The water at a world x, z, at the time of the last update.
  QueryAnswer query(glm::dvec2 place_m) const;
  // Other amplitudes and chop from the next update on (WaveField::take).
  void take(const WaveBins& bins, double chop, const SeaStatistics& statistics);

  const WaveField& field() const { return field_; }
  // Of the last update; null before the first.
  const WaveTiles* tiles() const { return tiles_.cascades() > 0 ? &tiles_ : nullptr; }

 private:
  static constexpr int planes = 3;  // shift, slope, moments: the three images
  struct Copy {
    const Image* to;
    std::vector<VkBufferImageCopy> regions;  // a level of a layer each
  };
  // A level of a tile in an image that the processor writes.
  struct Level {
    int cascade, level;
    WavePlane plane;
    Image::HostTexels texels;
  };
  void make_copies(Device& device, const WaveTileLayout& layout);
  void find_levels(const WaveTileLayout& layout);
  void write(std::size_t copy, std::int64_t ticks);
  void copy(Frame& frame, std::int64_t ticks);
  WaveField field_;
  WaveImages& images_;
  WaveTiles tiles_;
  std::array<Buffer, Frame::slots> staging_;
  std::vector<Copy> copies_;
  std::vector<std::vector<Level>> levels_;  // of each copy of the images
  std::vector<WaveTiles::Places> places_;   // the same for whole floats, which the field writes there itself
  WaveTileLayout image_layout_;
  std::vector<std::optional<std::int64_t>> held_;  // the time that each copy of the images holds
};

}  // namespace seascape
