// Spray around the viewer: puffs of droplets that the wind tears off where crests break, flying until they fall back on
// the water or have spread to nothing.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ocean/foam/breaking.h"
#include "ocean/foam/spray_flight.h"
#include "ocean/foam/spray_settings.h"
#include "ocean/sea/query.h"
#include "shaders/shared/spray_puff.h"

namespace seascape {

// Where the Jacobian of the sideways displacement is below the threshold of the foam (Breaking), each square metre
// throws up puffs by chance, more the stronger the wind (none below 7 m/s: spume is torn off from 7 to 11 m/s on,
// Andreas et al. 1995), the steeper the wave that it rides on, and the more that stands out into the wind. A puff
// stands for a cloud of droplets of one size. It leaves with the water's orbital velocity, raised towards the speed of
// the breaking crest, which moves as fast as its water where it breaks: of a wave of amplitude a that is u = a k c, and
// 1 - J is a k, so u / (1 - J). Then it flies (spray_flight.h) through the wind over the water and one eddy of it, of
// the deviations of the surface layer (Panofsky and Dutton 1984: 2.4, 1.9 and 1.25 u*), as long as it lives.
//
// Steps fall on whole multiples of 1 / rate of the sea's time; what happens in one follows from seed, cell of the
// world's grid and step alone. However a span is cut into frames the puffs are the same to the bit around a viewer who
// stands, and what a cell throws up does not ask where the viewer is, but for the thinning from two thirds of the range
// on and where there would be more than `most`. Time that runs backwards or jumps by more than a life, and a viewer who
// jumps by half the range, begin anew a life before: a moment has the very puffs of one that was come to step by step.
// Where the sea goes on (Sea::go_on), what is aloft flies on, but for what such a viewer has left behind.
//
// What actors throw (SeaStep::spray) flies likewise, in any wind, from the step after they did.
//
// Left out: spray that is thrown up without wind, as by surf; what flow and dynamic waves do to the water.
class Spray {
 public:
  struct Puff {
    glm::dvec3 place_m{0.0};  // in the world, as of the last step, or where it will begin
    glm::dvec3 velocity_mps{0.0};
    glm::dvec3 eddy_mps{0.0};  // that it flies in, to be added to the wind
    glm::dvec3 air_mps{0.0};   // both, at its height
    double relaxation_s = 1.0;
    double age_s = 0.0;  // below 0: it begins so much later
    double life_s = 1.0, diameter_m = 1e-4, radius_m = 0.1;
    double above_m = 0.0, rising_mps = 0.0;  // over the water, and how that changes
    double drops = 0.0, shape = 0.0;         // gpu::SprayPuff::look
  };
  // `sea` outlives it, and its crests know their velocity; `foam_life_s`: by which Breaking tells how much breaks.
  // Throws as validate() does.
  Spray(const SpraySettings& settings, Sea& sea, double foam_life_s);
  Spray(const Spray&) = delete;
  Spray& operator=(const Spray&) = delete;

  // Takes other settings of the same `most`; what is aloft flies on. After another rate the steps fall on its
  // multiples. Throws as validate() does.
  void apply(const SpraySettings& settings, double foam_life_s);
  // Lets go of the sea's views, which are made anew when the next step asks for them.
  void forget_views() { breaking_.forget(); }
  const Sea& sea() const { return sea_; }

  // Has the puffs of a time of the sea, in s, around a viewer (m). A time or a place that is no number changes nothing.
  void update(double time_s, const glm::dvec3& viewer_m) {
    begin(time_s, viewer_m);
    while (next_s()) step();
  }
  // The same in parts, for who steps others beside it (crest_steps.h): what is due, the time (s) of the next step, and
  // it.
  void begin(double time_s, const glm::dvec3& viewer_m);
  std::optional<double> next_s() const;
  void step();
  // Makes crests of the next step ahead, as many as the time since the last one asks for.
  void prepare(double time_s);
  // As of the last step, in order of their beginning.
  std::span<const Puff> puffs() const { return puffs_; }
  double step_s() const { return double(tick_) / settings_.rate_hz; }
  // How many steps there have been.
  std::uint64_t steps() const { return steps_; }
  // Writes what is to be seen of them at a time since the last step, and gives how many. `share` (0 to 1): of them, the
  // same from frame to frame.
  std::size_t drawn(double time_s, const glm::dvec3& viewer_m, std::span<gpu::SprayPuff> to, double share = 1.0);
  const SpraySettings& settings() const { return settings_; }
  const Breaking& breaking() const { return breaking_; }
  // Of a square metre that breaks on a crest, 1/s.
  double per_m2_s() const;

  // A puff as it is so many seconds after the last step; its age then is 0 or more.
  Puff after(const Puff& puff, double seconds) const;

  class Chance;

 private:
  void land();
  std::optional<gpu::SprayPuff> seen(const Puff& puff, double since_s, const glm::dvec3& viewer_m) const;
  StillWater water(glm::dvec2 place_m) const;
  void feel_air(Puff& puff) const;
  glm::dvec3 eddy(Chance& chance, double strength) const;
  double expected() const;  // puffs thrown together of a cell that breaks all over, in a step
  void find_breakers(std::int64_t tick, const glm::dvec3& viewer);
  void throw_up(std::int64_t tick, const glm::dvec3& viewer);
  void take_throws(double time_s);
  void throw_made(std::int64_t tick);
  // A cell of the world's grid around the viewer.
  struct Cell {
    std::int64_t x, z;
    std::size_t index;
  };
  Cell cell(const glm::dvec3& viewer, int i, int j) const;
  double cell_share(const Cell& cell, const glm::dvec3& viewer, const WaveField::Filter& coarse) const;
  struct Breaker {
    SeaSample sea;
    StillWater water;
    double jacobian;
  };
  std::optional<Breaker> breaker(glm::dvec2 rest, const WaveField::Filter& fine) const;
  SpraySettings settings_;
  Sea& sea_;
  Breaking breaking_;
  double wind_mps_ = -1.0, wind_to_deg_ = 0.0, gravity_mps2_;  // that the next two are of
  WindProfile profile_;
  glm::dvec3 wind_to_{0.0};
  void feel_wind();
  void lay_cells();
  std::vector<Puff> puffs_;
  struct Thrown {
    SprayThrow from;
    double puffs;
  };
  std::vector<Thrown> throws_;  // of actors, in the step that runs
  std::vector<glm::dvec2> places_;
  std::vector<QueryAnswer> answers_;
  std::vector<std::uint8_t> aloft_;  // which of them stay in the air
  std::vector<std::optional<gpu::SprayPuff>> seen_;
  int cells_;                            // a side of the square around the viewer
  std::vector<std::uint32_t> breakers_;  // of each cell which of its trials throw some up, a bit each
  std::int64_t tick_ = 0, due_ = 0;      // the last step, and the last that is due
  std::uint64_t steps_ = 0;
  glm::dvec3 viewer_{0.0};
  bool begun_ = false;
};

}  // namespace seascape
