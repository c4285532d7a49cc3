// How much two pictures differ when one is shown after the other: FLIP for pictures of a screen.
#pragma once
#include "engine/image_file.h"

namespace seascape {

struct FlipError {
  double mean = 0.0, worst = 0.0;  // over pixels, 0 alike to 1
};

// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference Evaluator for
// Alternating Images", sections 4.1 to 4.3, with its constants: the colours that an eye sees apart at this many pixels
// a degree (HyAB in L*a*b* with Hunt's effect), raised where edges or points come or go. Pictures of one size in sRGB,
// three channels or more; throws std::invalid_argument otherwise.
FlipError flip_error(const Image8& picture, const Image8& reference, double pixels_a_degree);

// The picture stretched to another size, each pixel from the four nearest in sRGB's linear light, as a display does it.
Image8 stretched(const Image8& picture, int width, int height);

}  // namespace seascape
