// Which part of a picture fills which part of a window, undistorted. Pure.
#pragma once
#include <glm/glm.hpp>

#include "app/mirror_settings.h"

namespace seascape {

struct PixelBox {
  glm::ivec2 least{0}, most{0};  // most: the first pixel beyond
};

// The largest part of a picture of `picture` pixels, from its middle, with the shape of `shown` pixels. Both at least
// 1 x 1; at least a pixel of it is left.
PixelBox middle_part(glm::ivec2 picture, glm::ivec2 shown);

// Where in a window of `window` pixels an eye's picture goes (0 left, 1 right), of a view that shows it: all of it, or
// with both its half. Empty where the window is too narrow for two.
PixelBox place_of_eye(MirrorView view, int eye, glm::ivec2 window);

// The view that comes after this one as a person asks for the next; off and third are followed by the first.
MirrorView next_view(MirrorView view);

}  // namespace seascape
