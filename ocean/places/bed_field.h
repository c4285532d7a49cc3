// The bed and what it makes of the waves, in windows around the viewer (shaders/lib/sea_bed.glsl).
#pragma once
#include <memory>
#include <utility>

#include "ocean/places/place_fields.h"
#include "ocean/places/shallows_mix.h"

namespace seascape {

struct BedTexel {
  glm::vec4 bed{0.0f};  // x: its height above y = 0, m; y, z, w: how far the longest cascades' patterns are shifted, m
  glm::vec4 share{1.0f};  // PlaceWaves: of the first four cascades
  glm::vec4 more{1.0f, 1.0f, 0.0f,
                 1.0f};  // of the fifth; of the other sources; of the run-up; of waves too short for any
};
inline BedTexel operator+(const BedTexel& a, const BedTexel& b) {
  return {a.bed + b.bed, a.share + b.share, a.more + b.more};
}
inline BedTexel operator-(const BedTexel& a, const BedTexel& b) {
  return {a.bed - b.bed, a.share - b.share, a.more - b.more};
}
inline BedTexel operator*(const BedTexel& a, float by) { return {a.bed * by, a.share * by, a.more * by}; }
inline float first_channel(const BedTexel& texel) { return texel.bed.x; }

inline BedTexel bed_texel(double bed_m, const PlaceWaves& waves) {
  const auto& s = waves.share;
  const auto& d = waves.shift_m;
  return {{float(bed_m), d[0], d[1], d[2]}, {s[0], s[1], s[2], s[3]}, {s[4], waves.others, waves.swash, waves.ripples}};
}

// `depth_m`: of the open sea.
inline PlaceValues<BedTexel> bed_values(ShallowsMix shallows, double depth_m) {
  const bool still = shallows.from->still();
  const InputBounds moving = shallows.from->bounds();
  const BedTexel outside{glm::vec4(float(-depth_m), 0.0f, 0.0f, 0.0f)};
  return {outside,
          [shallows = std::move(shallows)](glm::dvec2 middle, double texel, double time) {
            const double bed = shallows.bed_m(middle, texel, time);
            return bed_texel(bed, shallows.waves(middle, shallows.from->still_m(middle, texel, time) - bed));
          },
          still, moving};
}

}  // namespace seascape
