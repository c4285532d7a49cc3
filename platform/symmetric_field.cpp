#include "platform/symmetric_field.h"

#include <algorithm>
#include <cmath>

namespace seascape {

namespace {

// What both eyes see: as far to the left as to the right, for the eyes are each other's mirror; upwards and downwards
// they see alike.
struct Common {
  double half_width, up, down;
};

Common common_of(const std::array<Fov, 2>& eyes) {
  Common common{0.0, eyes[0].up, eyes[0].down};
  for (const Fov& eye : eyes) {
    common.half_width = std::max({common.half_width, std::abs(eye.left), std::abs(eye.right)});
    common.up = std::max(common.up, eye.up);
    common.down = std::min(common.down, eye.down);
  }
  return common;
}

// Of a pixel, in tangents.
glm::dvec2 step_of(const Fov& eye, const glm::uvec2& shown) {
  return {(eye.right - eye.left) / shown.x, (eye.up - eye.down) / shown.y};
}

std::uint32_t pixels(double length, double step) { return std::uint32_t(std::ceil(length / step - 1e-4)); }

std::uint32_t whole(double from, std::uint32_t room) {
  return std::uint32_t(std::clamp(std::round(from), 0.0, double(room)));
}

}  // namespace

glm::uvec2 symmetric_size(const std::array<Fov, 2>& eyes, const glm::uvec2& shown, const glm::uvec2& most) {
  const Common common = common_of(eyes);
  glm::uvec2 size = shown;
  for (const Fov& eye : eyes) {
    const glm::dvec2 step = step_of(eye, shown);
    size = glm::max(size, {pixels(2.0 * common.half_width, step.x), pixels(common.up - common.down, step.y)});
  }
  return glm::max(glm::min(size, most), shown);
}

std::array<FieldPart, 2> symmetric_parts(const std::array<Fov, 2>& eyes, const glm::uvec2& shown,
                                         const glm::uvec2& drawn) {
  const Common common = common_of(eyes);
  std::array<FieldPart, 2> parts;
  for (std::size_t i = 0; i < 2; ++i) {
    const Fov& eye = eyes[i];
    const glm::dvec2 step = step_of(eye, shown), half = 0.5 * glm::dvec2(drawn);
    const double left = eye.left / step.x + half.x,
                 above = half.y - (eye.up - 0.5 * (common.up + common.down)) / step.y;
    FieldPart& part = parts[i];
    part.from = {whole(left, drawn.x - shown.x), whole(above, drawn.y - shown.y)};
    part.drawn.left = eye.left - part.from.x * step.x;
    part.drawn.right = part.drawn.left + drawn.x * step.x;
    part.drawn.up = eye.up + part.from.y * step.y;
    part.drawn.down = part.drawn.up - drawn.y * step.y;
  }
  return parts;
}

}  // namespace seascape
