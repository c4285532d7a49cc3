// Where places lie along the curves that waves run along, in windows around the viewer (shaders/lib/shore.glsl).
#pragma once
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "ocean/places/place_fields.h"
#include "ocean/places/shallows.h"
#include "ocean/places/shore_lines.h"

namespace seascape {

struct ShoreTexel {
  glm::vec4 line{0.0f};  // metres to the right of the curve; cosine and sine of the way along it, a turn a period of
                         // the pattern; share, the bed's in it
  glm::vec2 way{0.0f};   // along the curve, as long as the pattern is stretched, and 1 more
};
inline ShoreTexel operator+(const ShoreTexel& a, const ShoreTexel& b) { return {a.line + b.line, a.way + b.way}; }
inline ShoreTexel operator-(const ShoreTexel& a, const ShoreTexel& b) { return {a.line - b.line, a.way - b.way}; }
inline ShoreTexel operator*(const ShoreTexel& a, float by) { return {a.line * by, a.way * by}; }
inline float first_channel(const ShoreTexel& texel) { return texel.line.x; }

// As an angle the way along a curve is as exact far along it as near its beginning, and a closed one has no seam.
inline ShoreTexel shore_texel(const ShorePlace& at, double period_m) {
  const double turn = 2.0 * std::numbers::pi * (at.bent_m.x / period_m - std::floor(at.bent_m.x / period_m));
  return {{float(at.bent_m.y), float(std::cos(turn)), float(std::sin(turn)), at.share},
          glm::vec2((1.0 + double(at.stretch)) * at.forward)};
}

// The place that a texel, or what lies between some, tells of; `present`: LodRead. How the curve turns there it does
// not tell.
inline ShorePlace shore_place(const ShoreTexel& texel, double period_m, float present) {
  ShorePlace place;
  place.share = texel.line.w;
  if (!(place.share > 0.0f)) return place;
  const glm::dvec2 way = glm::dvec2(texel.way) / double(present);
  const double size = std::max(glm::length(way), 1.0);
  place.stretch = float(size - 1.0);
  place.forward = way / size;
  place.bent_m = {std::atan2(double(texel.line.z), double(texel.line.y)) / (2.0 * std::numbers::pi) * period_m,
                  double(texel.line.x / present)};
  return place;
}

// `shallows`: what a bed leaves of the waves; null where none is known.
inline PlaceValues<ShoreTexel> shore_values(std::shared_ptr<const ShoreLines> lines,
                                            std::shared_ptr<const Shallows> shallows) {
  PlaceValues<ShoreTexel> values{};
  if (shallows) values.still = shallows->still(), values.moving = shallows->bounds();
  values.value = [lines = std::move(lines), shallows = std::move(shallows)](glm::dvec2 middle, double texel,
                                                                            double time) {
    ShorePlace at = lines->at(middle, texel);
    if (shallows && at.share > 0.0f)
      at.share *=
          float(shallows->placed(middle, shallows->still_m(middle, texel, time) - shallows->bed_m(middle, texel, time))
                    .share);
    return shore_texel(at, lines->period_m());
  };
  return values;
}

}  // namespace seascape
