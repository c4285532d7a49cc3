// A copy of a finished picture in an image of our own, for whoever wants it when the picture belongs to others again.
#pragma once
#include "engine/frame.h"
#include "engine/image_file.h"

namespace seascape {

class PictureCopy {
 public:
  // Makes nothing before the first record().
  explicit PictureCopy(Device& device) : device_(device) {}

  // Copies all views of what `frame` has drawn into `picture`, after its passes. Has room for as much as the picture's
  // images have, so that another size of the picture makes nothing.
  void record(Frame& frame, const RenderTarget& picture);
  explicit operator bool() const { return bool(image_); }  // whether anything was ever recorded
  // One layer a view; the picture lies in the upper left part. sRGB.
  const Image& image() const { return image_; }
  VkExtent2D size() const { return size_; }
  int views() const { return int(image_.spec().layers); }
  // A view of it as 8-bit sRGB RGBA, after waiting for the device.
  Image8 read(int view) const;

 private:
  Device& device_;
  Image image_;
  VkExtent2D size_{};
};

// One view of a picture of 8 bits, from the upper left, as RGBA whatever the order of its bytes; waits for the device.
Image8 read_picture(Device& device, const Image& image, VkExtent2D size, int view);

}  // namespace seascape
