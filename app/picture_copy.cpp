#include "app/picture_copy.h"

#include <utility>

namespace seascape {

void PictureCopy::record(Frame& frame, const RenderTarget& picture) {
  const ImageSpec& theirs = picture.colour().spec();
  const ImageSpec& ours = image_.spec();
  if (!image_ || ours.width != theirs.width || ours.height != theirs.height || ours.layers != theirs.layers ||
      ours.format != theirs.format) {
    const EffectScope scope(device_, "frame");
    ImageSpec spec{theirs.width, theirs.height, theirs.layers};
    spec.format = theirs.format;
    spec.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    image_ = Image(device_, "picture kept", spec);
  }
  size_ = {picture.spec().width, picture.spec().height};
  frame.pass("keep", {use(picture.colour(), Access::transfer_read), use(image_, Access::transfer_write, true)},
             [&](Commands& c) { c.copy(picture.colour(), image_, size_); });
}

Image8 PictureCopy::read(int view) const { return read_picture(device_, image_, size_, view); }

Image8 read_picture(Device& device, const Image& image, VkExtent2D size, int view) {
  Image8 result{int(size.width), int(size.height), 4, read_image(device, image, std::uint32_t(view), 0, size)};
  if (image.spec().format == VK_FORMAT_B8G8R8A8_SRGB)
    for (std::size_t i = 0; i + 2 < result.pixels.size(); i += 4) std::swap(result.pixels[i], result.pixels[i + 2]);
  return result;
}

}  // namespace seascape
