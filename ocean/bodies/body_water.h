// The water as bodies ask it: abstract, so that tests have waves of a formula, and a sea of its own wires in.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace seascape {

struct WaterHere {
  double height_m = 0.0;         // of the surface, in the world
  glm::dvec3 velocity_mps{0.0};  // of the water at the surface: orbital motion and current
  glm::dvec2 current_mps{0.0};   // of that the current (x, z)
  double still_m = 0.0;          // of the still water
  double depth_m = 1e6;          // of the still water over the bed
  bool dry = false;              // there is no water
};

// Water with no waves at all: a body that has come to rest there stays so until any of this changes.
struct CalmWater {
  double height_m = 0.0;
  glm::dvec2 current_mps{0.0};
  bool operator==(const CalmWater&) const = default;
};

class BodyWater {
 public:
  virtual ~BodyWater() = default;
  // Answers for places (x, z), m, at a time; waves shorter than the footprint (m) may be left out. Bodies ask from
  // several threads at once.
  virtual void ask(double time_s, double footprint_m, std::span<const glm::dvec2> places,
                   std::span<WaterHere> answers) const = 0;
  // The same as one body feels it, by its number: without the waves that it makes itself, where they can be told apart.
  virtual void ask_as(std::size_t body, double time_s, double footprint_m, std::span<const glm::dvec2> places,
                      std::span<WaterHere> answers) const {
    (void)body;
    ask(time_s, footprint_m, places, answers);
  }
  // The wave number of the sea's energy on average, 1/m; 0 without waves. Waves longer than a hull's grid fade by it.
  virtual double wave_number() const = 0;
  // Cheap: whether there are no waves within a distance of a place.
  virtual std::optional<CalmWater> calm(double time_s, const glm::dvec2& place, double distance_m) const = 0;
  // As ask_as().
  virtual std::optional<CalmWater> calm_as(std::size_t body, double time_s, const glm::dvec2& place,
                                           double distance_m) const {
    (void)body;
    return calm(time_s, place, distance_m);
  }
};

}  // namespace seascape
