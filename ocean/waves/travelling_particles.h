// Wave particles that leave a place: fronts that widen as they run, kept closed by splitting.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace seascape {

// A piece of a front that spreads from `origin`: at time t it stands c (t - born) from there.
struct TravellingParticle {
  glm::dvec2 origin{0.0};  // metres; all pieces that it is split into keep it
  double born_s = 0.0;
  double direction_rad = 0.0;   // of its way, from x towards z
  double dispersion_rad = 0.0;  // how wide a piece of the front it stands for; 0: a straight one, which never splits
  double amplitude_m = 0.0;
};

struct TravellingSettings {
  double radius_m = 0.5;
  double speed_mps = 1.0;
  double least_amplitude_m = 1e-4;     // what falls below is taken away
  std::size_t most_particles = 20000;  // no piece is split beyond
};

// Yuksel, House and Keyser (2007): a piece that is wider than half a radius becomes three, a third as wide and a third
// as high each, of which the middle one keeps its way: the sum of heights stays as it is, and a front of any width
// ripples by 3.5 % at most. So a ring's crest falls as 1 / distance, where that of the wave equation falls as 1 /
// sqrt(distance); and at the moment of splitting the crest over a piece drops by up to 4.5 %. Where a particle is and
// when it splits follow from its birth alone: steps of any length give the same particles.
class TravellingParticles {
 public:
  // Throws Error naming the setting: radius_m and speed_mps above 0, least_amplitude_m at least 0, all finite,
  // most_particles at least 1.
  explicit TravellingParticles(const TravellingSettings& settings);

  // One piece of a front, or a ring of `pieces` that are `amplitude_m` high each. What is no finite number, or has no
  // room, is refused: false.
  bool add(const TravellingParticle& particle);
  bool add_ring(glm::dvec2 origin, double born_s, double amplitude_m, int pieces);

  // Splits what has become too wide and takes away what has become too low by the time. Time only goes forward: an
  // earlier one changes nothing.
  void advance(double time_s);

  std::span<const TravellingParticle> particles() const { return particles_; }
  glm::dvec2 place(const TravellingParticle& particle, double time_s) const;
  // The surface above its level, by direct summation.
  double height_m(glm::dvec2 place_m, double time_s) const;

  // Sums of heights: of what is there, and of what was taken away since the start. Together they are what was added.
  double amplitude_sum_m() const;
  double taken_away_m() const { return taken_away_m_; }
  // Whether pieces stay wider than they should for want of room.
  bool full() const { return full_; }

 private:
  double too_wide_after_s(const TravellingParticle& particle) const;
  TravellingSettings settings_;
  std::vector<TravellingParticle> particles_, next_;
  double taken_away_m_ = 0.0;
  bool full_ = false;
};

}  // namespace seascape
