// How a sea's waves bend towards the shore and what lies in the lee of land: fields over the shallows, made once when a
// scene loads.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "ocean/inputs/bounds_tree.h"
#include "ocean/places/bed_grid.h"
#include "ocean/places/shallow_water.h"
#include "shaders/shared/sea_data.h"

namespace seascape {

// The still water's depth (m) at a place, seen with a footprint (m); 0 or less on land. Asked from several threads at
// once. Of a scene's inputs:
//   [&](glm::dvec2 p, double f) { return -double(inputs.value(p, f, 0.0, glm::vec4(float(-sea.depth_m))).x); }
using DepthOfPlace = std::function<double(glm::dvec2 place_m, double footprint_m)>;

struct RefractionSettings {
  int cells = 256;  // along the grid's longer side, 16 to 2048
  double margin_waves =
      2.0;  // around the shallows, of the longest cascade's mean wave, 0 to 100; a quarter to once the shallows' width
};

// A cascade's waves as one, by means over its bins that are weighted by their variances.
struct MeanWave {
  glm::dvec2 direction{
      0.0};                // along which they travel, x and z: a unit vector; 0 where there are none, or none prevails
  double frequency = 0.0;  // rad/s
  double wave_number = 0.0;  // of that frequency in the sea's own depth, rad/m
  double variance = 0.0;     // of their heights, m^2
};
MeanWave mean_wave(const SeaState& sea, const WaveBins& bins, int cascade);

// Bending: a cascade's pattern of waves, drawn in the open as a function of the rest place x, is drawn at x + shift(x)
// direction. Its phase k0 direction . x becomes k0 S with |grad S| = k(h) / k0 for its mean wave (bent_fronts), so
// crests turn and draw together as that wave's do; shorter waves of the cascade bend too much by it, longer ones too
// little, and waves across its direction not at all. k(h) / k0 is at most most_shortening, reached at k h = 0.26.
// Slopes change with it: a gradient s of the pattern becomes s + (s . direction) grad shift. What lies across the
// direction a shift leaves as it is: where fronts come around a breakwater's end and have turned right across, the
// pattern would be drawn out into stripes without end. So no shift falls by more than a quarter of the way along the
// direction: in a lee fronts turn by some 45 degrees at most. A shift may be hundreds of metres: half floats are too
// coarse for it.
//
// Shelter: the share of a cascade's energy that reaches a place on straight lines from outside, over the directions
// that its waves have, of what breaking (ShallowWater) lets stand at the place: what broke on a reef stays gone in the
// lagoon. Heights go with its root.
//
// Left out: diffraction (shadows are filled by the directions' spread, by the grid's blur, and not by waves that turn
// around a cape), bending in the shelter's lines, energy that bending gathers or spreads, reflection, and the fronts
// that come later where several meet.
//
// Outside of the grid a field goes on as it was on the grid's edge and fades away (shift: over eight times its most, so
// slowly that the fading bends nothing by more than a fifth; shelter: over the grid's longer side). Immutable; any
// thread. Made in 0.2 s with 256 cells a side over ten islands, 0.7 s with 512 (two busy cores,
// tests/bench/shallows_bench.cpp), of which the depths' share is the scene's; read in some 20 ns.
class Refraction {
 public:
  static constexpr int bent_cascades =
      gpu::bent_cascades;  // the longest ones; the others' waves are too short to show it
  static constexpr double most_shortening = 4.0;
  static constexpr int directions = 64;

  // `shallows`: outside of these bounds the depth is the sea's own; empty: nothing bends and nothing is sheltered.
  // Throws Error when the depth is no number or infinite somewhere, or a setting is out of range.
  Refraction(const SeaState& sea, const WaveBins& bins, const ShallowWater& water, const InputBounds& shallows,
             const DepthOfPlace& depth_m, const RefractionSettings& settings = {});

  // Metres; 0 far away, for the cascades that do not bend, and at a place that is no number.
  double shift(int cascade, glm::dvec2 place_m) const;
  glm::dvec2 direction(int cascade) const {
    return cascade < bent_cascades ? waves_[std::size_t(cascade)].direction : glm::dvec2(0.0);
  }
  // 0 to 1; 1 far away. On land as beside it.
  float shelter(int cascade, glm::dvec2 place_m) const { return shelter_at(shelters_[std::size_t(cascade)], place_m); }
  // Of all cascades' energy together: for the other sources.
  float shelter(glm::dvec2 place_m) const { return shelter_at(shelters_.back(), place_m); }

  bool empty() const { return grid_.nx == 0; }
  const BedGrid& grid() const { return grid_; }
  double most_shift_m(int cascade) const { return cascade < bent_cascades ? most_shift_m_[std::size_t(cascade)] : 0.0; }

 private:
  using Field = std::vector<float>;  // over the grid; empty where it is the same everywhere
  void lay_grid(const InputBounds& shallows, const RefractionSettings& settings);
  double kept_outside(glm::dvec2 place_m, double over_m) const;
  float shelter_at(const Field& field, glm::dvec2 place_m) const;

  BedGrid grid_;
  std::array<MeanWave, bent_cascades> waves_{};
  std::array<Field, bent_cascades> shifts_;
  std::array<double, bent_cascades> most_shift_m_{};
  std::vector<Field> shelters_;  // of each cascade, then of all
};

}  // namespace seascape
