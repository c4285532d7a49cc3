// The warp of a light sea's longest tile: a smooth shift of its pattern, the same at every quality.
#pragma once
#include <array>
#include <glm/glm.hpp>

#include "ocean/waves/ladder.h"
#include "shaders/shared/pattern_warp.h"

namespace seascape {

// The tile's pattern is taken at rest + shift(rest), where shift is a sum of long waves. At a whole tile r from x the
// pattern is the same, but shifted by shift(x + r) - shift(x), which differs from place to place. Over the plane, the
// mean of cos(k . (r + shift(x + r) - shift(x))) is cos(k . r) times the product of J0(2 k . way sin(pi along . r))
// over the waves (the mean of exp(i a sin) over a turn is J0(a)), near 0 where these arguments are 2 and more. Waves
// keep their frequency and are stretched and turned a little, as a weak current does it. The directions, lengths and
// strains were found by a search over all whole tiles up to 31 away (docs/accuracy.md, Repetition).
class PatternWarp {
 public:
  struct Wave {
    glm::dvec2 along;  // wave vector, turns a metre
    glm::dvec2 way;    // how far it shifts, m
    double phase;      // at the world's origin, turns
  };
  using Waves = std::array<Wave, gpu::warp_waves>;
  // The warp at a place; columns of `growth`: what the shift grows by in a metre along x and z.
  struct Local {
    glm::dvec2 shift_m{0.0};
    glm::dmat2 growth{0.0};
    // Of a pattern's gradient what the warped pattern's is.
    glm::dvec2 of(glm::dvec2 gradient) const { return gradient + gradient * growth; }
    // The same of second moments of gradients (xx, zz, xz).
    glm::dvec3 of_moments(const glm::dvec3& moments) const;
  };

  PatternWarp() = default;  // none
  explicit PatternWarp(const Ladder& ladder);
  explicit operator bool() const { return warped_; }
  Local at(glm::dvec2 rest_m) const;
  const Waves& waves() const { return waves_; }
  // For rest positions counted from `origin_m`, whose phases are found in double.
  gpu::WarpData from(glm::dvec2 origin_m) const;

 private:
  bool warped_ = false;
  Waves waves_{};
};

}  // namespace seascape
