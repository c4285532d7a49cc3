// A field of windows as an image that the surface samples: layers for each slice, of which only what has changed is
// copied.
#pragma once
#include <array>
#include <functional>
#include <span>
#include <string_view>

#include "engine/frame.h"
#include "ocean/places/lod_change.h"

namespace seascape {

class DrawnWindows {
 public:
  // Of 32- or 16-bit floats. `layers`: of a slice, one after the other.
  DrawnWindows(Device& device, std::string_view name, const LodWindowSettings& windows, VkFormat format,
               int layers = 1);

  // Copies what has changed in one pass. `layer_of`: where slice i lies (LodField::layer). `row(slice, layer, z, x,
  // texels)` writes the floats of texels of row z from column x on, `layer` of the slice's; asked from several threads
  // at once.
  using Row = std::function<void(int slice, int layer, int z, int x, std::span<float> texels)>;
  void copy(Frame& frame, const char* pass, const LodChanges& changes, const std::function<int(int slice)>& layer_of,
            const Row& row);

  const Image& image() const { return image_; }
  int channels() const { return channels_; }

 private:
  int layers_, channels_;
  bool half_;
  Image image_;
  std::array<Buffer, Frame::slots> staging_;
};

}  // namespace seascape
