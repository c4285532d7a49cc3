// Curves along which waves run as images that the surface samples: where a texel lies along them, in windows around the viewer (shaders/lib/shore.glsl).
#pragma once
#include <cmath>
#include <memory>
#include <numbers>

#include "ocean/local/drawn_windows.h"
#include "ocean/local/place_fields.h"
#include "ocean/local/shallows.h"
#include "ocean/local/shore_lines.h"

namespace seascape {

struct ShoreTexel {
  glm::vec4 line{0.0f, 1.0f, 0.0f, 0.0f};  // metres to the right of the curve; cosine and sine of the way along it, a turn a period of the pattern; share, the bed's in it
  glm::vec2 way{1.0f, 0.0f};               // along the curve, as long as the pattern is stretched, and 1 more
};
inline ShoreTexel operator+(const ShoreTexel& a, const ShoreTexel& b) { return {a.line + b.line, a.way + b.way}; }
inline ShoreTexel operator-(const ShoreTexel& a, const ShoreTexel& b) { return {a.line - b.line, a.way - b.way}; }
inline ShoreTexel operator*(const ShoreTexel& a, float by) { return {a.line * by, a.way * by}; }
inline float first_channel(const ShoreTexel& texel) { return texel.line.x; }

// As an angle the way along a curve is as exact far along it as near its beginning, and a closed one has no seam.
inline ShoreTexel shore_texel(const ShorePlace& at, double period_m) {
  const double turn = 2.0 * std::numbers::pi * (at.bent_m.x / period_m - std::floor(at.bent_m.x / period_m));
  return {{float(at.bent_m.y), float(std::cos(turn)), float(std::sin(turn)), at.share}, glm::vec2((1.0 + double(at.stretch)) * at.forward)};
}

class DrawnShore {
 public:
  // Made under the name of its effect. Where the device samples no whole floats distances of hundreds of metres are too much for it, and there are no such waves.
  // `shallows`: what a bed leaves of them; null where none is known.
  DrawnShore(Device& device, std::shared_ptr<const ShoreLines> lines, std::shared_ptr<const Shallows> shallows, const PlaceSettings& settings);
  void update(Frame& frame, const LodPlacement& placement, double time_s);
  void add_uses(Uses& uses, Access access) const;
  const Image& lines() const { return of_lines_.image(); }
  const Image& ways() const { return of_ways_.image(); }

 private:
  std::shared_ptr<const ShoreLines> lines_;
  std::shared_ptr<const Shallows> shallows_;
  PlaceSettings settings_;
  std::unique_ptr<PlaceField<ShoreTexel>> field_;  // from the first update on
  DrawnWindows of_lines_, of_ways_;
};

}  // namespace seascape
