// A hand, or whatever else is as round and moves as it likes, that displaces the water it is put into. Pure.
#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "ocean/sea/sea_actor.h"

namespace seascape {

class HandInWater final : public SeaActor {
 public:
  static constexpr double radius_m = 0.09;  // of the sphere that a hand is taken for: three litres

  // Of dynamic waves with texels of this side at their finest (m), whose shortest waves its ripples are, or as short as
  // it is wide.
  explicit HandInWater(double texel_m);

  // Where the hand is (m, its middle) at a time (s) of the sea, and how fast it goes; nothing: it is not tracked.
  struct At {
    double time_s;
    glm::dvec3 place_m;
    glm::dvec3 velocity_mps{0.0};
  };
  void set(std::optional<At> at) { at_ = at; }

  void step(SeaStep& step) override;
  void hold() override { wet_m3_.reset(); }
  std::uint64_t hash() const override;

  // Of the sphere, its middle this deep below the water (m, negative above): the volume under water (m^3), and what of
  // its cross section is (m^2).
  static double volume_m3(double depth_m);
  static double section_m2(double depth_m);

 private:
  double ripple_m_;  // their length
  std::optional<At> at_;
  std::optional<double> wet_m3_;  // at the end of the last step; nothing: it has just come
};

}  // namespace seascape
