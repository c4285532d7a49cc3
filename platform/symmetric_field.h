// One field of view for both eyes, as wide to the left as to the right, of which each eye shows its own part. Where
// both are drawn alike, a tile of the picture holds much the same for both.
#pragma once
#include <array>

#include "engine/view.h"

namespace seascape {

// Pixels of a picture that holds that field, where an eye's own has `shown`; between `shown` and `most`.
glm::uvec2 symmetric_size(const std::array<Fov, 2>& eyes, const glm::uvec2& shown, const glm::uvec2& most);

struct FieldPart {
  Fov drawn;            // of the whole picture
  glm::uvec2 from{0u};  // the pixel at the upper left of the part that the eye shows
};

// Of pictures of `drawn` pixels of which each eye shows `shown`: the eye's own field exactly, beginning at a whole
// pixel. So the field drawn is the eyes' common one within half a pixel, or what of it there is room for.
std::array<FieldPart, 2> symmetric_parts(const std::array<Fov, 2>& eyes, const glm::uvec2& shown,
                                         const glm::uvec2& drawn);

}  // namespace seascape
