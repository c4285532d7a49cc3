// Drops that run off an eye's lens after it has come out of the water.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/view.h"
#include "shaders/shared/lens_drop.h"

namespace seascape {

// Drops of one lens. They follow from the seed, the eye, the time at which the lens came out of the water, and which
// way was down since. Pure.
class LensDrops {
 public:
  static constexpr int most = 12;        // at a time
  static constexpr double life_s = 5.0;  // none is there longer after the lens came out

  // What of a moment counts.
  struct Moment {
    double time_s = 0.0;   // of the sea
    bool wet = false;      // the lens is in the water
    glm::dvec2 down{0.0};  // along the lens, to the right and up; shorter than 1 where the lens is not upright
    Fov fov;               // what the eye sees of it
    double lens_m = 0.1;   // distance of the lens from the eye
  };
  // Goes on to a later moment. After a step back in time, or of more than a second, the lens is dry.
  void step(const Moment& moment, std::uint32_t seed, int eye);
  // Whether the lens was in the water at the last step, or has drops: a step changes nothing else of a dry lens that
  // stays in the air.
  bool any() const { return wet_ || !drops_.empty(); }
  // The drops to draw now, behind those that are listed already.
  void list(std::vector<gpu::LensDrop>& drops) const;

 private:
  struct Drop {
    glm::dvec2 at;  // tangents, to the right and up
    double radius, waits_s, speed, sticks_per_s, lasts_s;
    glm::dvec2 behind{0.0};  // where to it is drawn out
  };
  static double run(const Drop& drop, double age_s);
  void wet_by(const Moment& moment, std::uint32_t seed, int eye);
  std::vector<Drop> drops_;
  double time_s_ = 0.0, out_s_ = 0.0;
  int eye_ = 0;
  bool known_ = false, wet_ = false;
};

}  // namespace seascape
