// How far a picture is from another: per pixel, and as it is seen.
#pragma once
#include "engine/image_file.h"

namespace seascape {

struct PictureError {
  double
      mean = 0.0,
      p99 = 0.0;  // of the pixels' largest difference in a channel of sRGB, 1 being black to white; the 99th percentile
  double dissimilarity =
      0.0;  // 1 - SSIM (Wang et al. 2004, eq. 13) of the luma, mean over windows of 8 x 8 pixels, every fourth
};

// Pictures of one size, at least 8 x 8; throws std::invalid_argument otherwise.
PictureError picture_error(const Image8& picture, const Image8& truth);

// The mean of `times` x `times` pixels, in linear light. Sides are multiples of it; throws std::invalid_argument
// otherwise.
Image8 averaged(const Image8& image, int times);

}  // namespace seascape
