// Waves that answer: pushed by what moves on the water, dispersive, on levels of windows around the viewer.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ocean/inputs/bounds_tree.h"
#include "ocean/places/dynamic_waves_settings.h"
#include "ocean/places/lod_field.h"
#include "ocean/places/wave_level.h"

namespace seascape {

// Level i holds the waves of 8 to 24 texels of slice i (wave_share) and moves by itself, so that nothing is reflected
// where another level's window ends. Towards the edge of its own, over an eighth of its side, waves are absorbed, as
// fast as the longest of the level and the viewer run. Where a step's time is not the rate's (an advance of more than
// most_steps), a wave may pass the border and come back on the other side, lower. When texels double or halve, waves
// keep their level's octave; those that only the coarsest level carries, whichever it is, go over to the new one where
// its window and the old one lie. What is shorter than 8 of the new finest texels is lost, and what is longer than a
// quarter of the new coarsest window.
//
// Errors: frequency, turning and damping 1e-10 (wave_level.h). Rings against their integrals 2.1 % of the crest and
// wakes against Havelock's 0.2 degrees, most of it straight lines between texels. Of a group's energy the border leaves
// 0.5 %; of the coarsest level's waves longer than 32 of its texels 2 %. A change of scale moves what stays by 3 % at
// most.
//
// Not in it: waves longer than a quarter of the coarsest window, or shorter than 8 texels of the finest; what is
// nonlinear; currents.
class DynamicWaves {
 public:
  // Throws as validate() does.
  explicit DynamicWaves(const DynamicWavesSettings& settings);

  // Water depth of a level, m: one for all of its window. 0 or less is dry: its waves go. Throws Error for what is no
  // number.
  void set_depth(int level, double depth_m);
  // How open the water is at a place, for a texel's side: 1, or 0 where something stands in it, which sends waves back
  // (turned over, as a soft border does) and casts a shadow. Not a sharp one: each level's band of lengths is narrow,
  // and of waves 16 texels long a quarter of their height comes past a wall of any thickness up to twice that
  // (measured), more past a thinner one. Asked once for each texel that comes into a window.
  using Openness = std::function<float(glm::dvec2 place_m, double texel_m)>;
  void set_obstacles(Openness openness);

  // Time goes on by `seconds`, in whole steps of 1 / rate; the rest is kept for the next call. The windows are where
  // `placement` has them, the sources what pushes during this time. Gives the number of steps. Throws Error naming a
  // source whose numbers are not finite or whose length is not above 0, or seconds that are not 0 or more; the state is
  // as before. While all is still and nothing pushes, it does no work at all.
  int advance(double seconds, const LodPlacement& placement, std::span<const WaveSource> sources) {
    return advance(seconds, placement, sources, {}, {});
  }
  // A pressure besides, in metres of water, that lasts for all of this time: its mean over the square of a side (m)
  // around a place. `where`: there is none beyond. Taken at every second texel: waves have eight and more. What is no
  // number is none, and told of. Called from many threads at once.
  using Pressure = std::function<float(glm::dvec2 place_m, double side_m)>;
  int advance(double seconds, const LodPlacement& placement, std::span<const WaveSource> sources,
              const Pressure& pressure, const InputBounds& where);

  // Takes other settings of the same windows, gravity and depth; the waves stay. Throws as validate() does, and stays
  // as it was then.
  void apply(const DynamicWavesSettings& settings);
  // All waves gone, as at first; depths, obstacles and the place stay.
  void calm();
  // The same, and the windows are there from now on, of the same octave. A level that is added to then begins there.
  void calm_at(const LodPlacement& placement);

  bool active() const { return active_; }
  int levels() const { return int(levels_.size()); }
  const WaveLevel& level(int i) const { return levels_[std::size_t(i)]; }
  WaveLevel& level(int i) {
    active_ = true;
    return levels_[std::size_t(i)];
  }
  const LodPlacement& placement() const { return placement_; }
  const DynamicWavesSettings& settings() const { return settings_; }
  double energy_m2() const;

  // What went wrong since the last call, once: a level that held what is no number was cleared, within a step of when
  // it did.
  std::optional<std::string> take_fault();

 private:
  void place(const LodPlacement& placement, double seconds);
  void turn_octaves(int octaves);
  void hand_up(const WaveLevel& was, LodIndex first);
  void hand_down(const WaveLevel& was, LodIndex first);
  void shape(int level);
  bool press(const LodPlacement& placement, const Pressure& pressure, const InputBounds& where);
  void step(double dt, double to_end_s, std::span<const WaveSource> sources);
  void border(int level, double dt, double speed_mps);
  DynamicWavesSettings settings_;
  LodPlacement placement_;
  std::vector<WaveLevel> levels_;
  std::vector<double> depth_m_;
  struct Axes {
    std::vector<float> x, z;
  };
  std::vector<Axes> axes_;
  std::vector<WaveSource> moved_;
  std::vector<std::vector<float>> heads_;  // a level's texels each; none: no pressure there
  std::optional<LodField<float>> open_;
  Openness openness_;
  double owed_s_ = 0.0, viewer_speed_ = 0.0;
  bool active_ = false, placed_ = false;
  std::string fault_;
};

}  // namespace seascape
