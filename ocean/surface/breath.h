// Breaths under water: bubbles that leave the mouth, rise at their own speed, and grow as the water above them grows
// less. Pure: the same times, poses and seed give the same bubbles, however time is cut into frames.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/view.h"
#include "ocean/surface/breath_settings.h"
#include "shaders/shared/bubble.h"

namespace seascape {

// Speed at which a bubble rises in still sea water, m/s, by the diameter of a sphere of its volume, m: it moves as a
// wave of that length (Mendelson 1967, eq. 5), which holds from about 2 mm on up to the largest, whose caps follow
// Davies and Taylor (1950). Smaller ones are slower by what they are dragged (Stokes), of which none are here.
double bubble_rises_mps(double diameter_m);

// Height over width of a rising bubble (Wellek, Agrawal and Skelland 1966, eq. 8), by the same diameter.
double bubble_flatness(double diameter_m);

// How much wider a bubble is that has come from one depth (m) to another, at an even temperature: Boyle.
double bubble_grows(double from_m, double to_m);

class Breath {
 public:
  static constexpr std::size_t most = 2048;                    // bubbles at once; where more would be, the oldest go
  static constexpr double step_s = 1.0 / 60.0;                 // of their rise, at even times
  static constexpr double longest_gap_s = 2.0;                 // a longer one, or time that runs back, begins anew
  static constexpr double least_m = 0.003, largest_m = 0.045;  // diameters as they leave the mouth

  explicit Breath(const BreathSettings& settings = {});
  // Other settings, from the next breath on.
  void apply(const BreathSettings& settings) { settings_ = settings; }

  // Goes on to `time_s` (s), where the head is at `head` and the water at `water_m` over it (m; nothing: the head is in
  // the air for sure). Between two calls the head moves straight. Allocates nothing.
  void advance(double time_s, const Pose& head, std::optional<double> water_m);
  void begin_anew();

  // Fills in what is drawn for a viewer, the farthest first, and says how many.
  std::size_t drawn(const glm::dvec3& viewer_m, std::span<gpu::BubbleInstance> list) const;

  struct Bubble {
    glm::dvec3 at_m;            // in the world, without its wobble
    double diameter_m, born_m;  // now; and as it was born, at from_m below the water
    double from_m;
    double born_s, turn;  // turn: of its wobble, 0 to 1
  };
  std::span<const Bubble> bubbles() const { return bubbles_; }

 private:
  struct Moment {
    double time_s;
    Pose head;
    std::optional<double> water_m;
  };
  void step(std::int64_t tick, const Moment& now);
  void breathe_out(double from_s, double to_s, const Moment& now);
  BreathSettings settings_;
  std::optional<Moment> before_;
  std::int64_t tick_ = 0;  // the last that was stepped
  double water_m_ = 0.0;   // as it was known last
  std::vector<Bubble> bubbles_;
};

}  // namespace seascape
