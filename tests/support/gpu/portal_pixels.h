// Which pixels of an eye see water through a frame's portals.
#pragma once
#include <glm/glm.hpp>

#include "ocean/surface/water_line.h"
#include "tests/support/gpu/solid_shot.h"

namespace seascape::test {

// What a pixel's line of sight goes through, by its middle, or where it is nearer to an outline than a pixel: unsure.
enum class Through { none, some, unsure };

// `from`: where the eye is, m from the viewer.
inline Through through(const WaterLines& lines, const View& eye, std::uint32_t x, std::uint32_t y, std::uint32_t width,
                       std::uint32_t height, const glm::dvec3& from = {}) {
  int within = 0;
  for (const glm::dvec2 off : {glm::dvec2(0.5), glm::dvec2(-0.5, 0.5), {1.5, 0.5}, {0.5, -0.5}, {0.5, 1.5}})
    within += !lines.wet_parts(from, pixel_ray(eye, x + off.x, y + off.y, width, height), 1e4).empty();
  return within == 0 ? Through::none : within == 5 ? Through::some : Through::unsure;
}

}  // namespace seascape::test
