#include "app/mirror_layout.h"

#include <algorithm>
#include <cmath>

namespace seascape {

PixelBox middle_part(glm::ivec2 picture, glm::ivec2 shown) {
  const double scale = std::min(double(picture.x) / shown.x, double(picture.y) / shown.y);  // picture pixels a pixel
  const auto part = [&](int all, int pixels) { return std::clamp(int(std::lround(pixels * scale)), 1, all); };
  const glm::ivec2 size(part(picture.x, shown.x), part(picture.y, shown.y));
  const glm::ivec2 least = (picture - size) / 2;
  return {least, least + size};
}

PixelBox place_of_eye(MirrorView view, int eye, glm::ivec2 window) {
  if (view != MirrorView::both) return {{0, 0}, window};
  const int middle = window.x / 2;
  return eye == 0 ? PixelBox{{0, 0}, {middle, window.y}} : PixelBox{{middle, 0}, window};
}

MirrorView next_view(MirrorView view) {
  switch (view) {
    case MirrorView::left:
      return MirrorView::right;
    case MirrorView::right:
      return MirrorView::both;
    case MirrorView::both:
      return MirrorView::third;
    default:
      return MirrorView::left;
  }
}

}  // namespace seascape
