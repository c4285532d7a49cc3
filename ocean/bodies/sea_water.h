// The sea as bodies ask it.
#pragma once
#include "ocean/bodies/body_water.h"
#include "ocean/sea/sea_view.h"

namespace seascape {

// The mean wave number (rad/m) of these waves, by their energy; 0 without waves.
double mean_wave_number(const WaveBins& bins);

// What bodies feel is the waves, levels, currents, bed and wakes of `felt` views, which are the same at every preset
// and from everywhere: not the dynamic waves, whose windows lie around the viewer, nor what bodies keep dry. Body n is
// the one of WakeBody::id n + 1.
class SeaWater final : public BodyWater {
 public:
  // Answers of this view from now on: of detail felt, with velocity. Not while anybody asks.
  void see(const SeaView& view);

  void ask(double time_s, double footprint_m, std::span<const glm::dvec2> places,
           std::span<WaterHere> answers) const override;
  void ask_as(std::size_t body, double time_s, double footprint_m, std::span<const glm::dvec2> places,
              std::span<WaterHere> answers) const override;
  // Heights of the ground at places (x, z), m.
  void ground(std::span<const glm::dvec2> places, std::span<double> heights_m) const;
  // Of the still water over the ground there, m; 0 or less on land, and where there is no view yet.
  double depth_m(const glm::dvec2& place) const;
  double wave_number() const override { return wave_number_; }
  std::optional<CalmWater> calm(double time_s, const glm::dvec2& place, double distance_m) const override;
  std::optional<CalmWater> calm_as(std::size_t body, double time_s, const glm::dvec2& place,
                                   double distance_m) const override;

 private:
  void ask(std::uint64_t without_window_of, double footprint_m, std::span<const glm::dvec2> places,
           std::span<WaterHere> answers) const;
  std::optional<CalmWater> calm(std::uint64_t without_window_of, const glm::dvec2& place, double distance_m) const;
  SeaView view_;
  double wave_number_ = 0.0, variance_ = -1.0;  // of the waves whose number it is
};

}  // namespace seascape
