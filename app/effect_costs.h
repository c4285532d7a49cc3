// Measures what each effect adds to a scene's frames, alone, beside each other and beside all: scenes with and without
// it drawn in turn.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/cost_matrix.h"
#include "app/experience.h"

namespace seascape {

// One scene on a device, ready to be drawn again and again.
class CostSubject {
 public:
  // Builds it and draws two frames, after which nothing is done once. Throws Error as Experience does.
  CostSubject(Device& device, ShaderLibrary& shaders, const Scene& scene, const ExperienceOptions& options);

  // Draws one frame of the sea's time `n` frames on, and waits for it: milliseconds of CPU and GPU together.
  double draw_ms(int n);
  // The same from another place at a time; `pixels_per_radian` above 0: with the mesh of a picture that has so many.
  double draw_ms(const Pose& from, double time_s, double pixels_per_radian = 0.0);

  // What it is built of, and records in a frame: all but the time.
  const Cost& holds() const { return holds_; }
  Experience& experience() { return experience_; }

 private:
  Device& device_;
  Cost before_;  // on the device
  Experience experience_;
  Cost holds_;
};

// What one scene has more than another. `frames` of either are timed, in turn, each first as often as the other; and
// all of it `rounds` times, an even number, with the one built first and with the other: where a scene's memory comes
// to lie makes it faster or slower than its twin by some per cent (measured: 5). The interval is that of the median of
// all differences of two frames in turn (a mean of rounds is no better than its worst frame is).
using MakeSubject = std::function<std::unique_ptr<CostSubject>()>;
Cost difference(const MakeSubject& make_with, const MakeSubject& make_without, int frames, int rounds);

// The matrix of `effects` (all that are built, as a rule) in `scene`, whose own list of effects does not count. An
// effect whose settings the scene lacks is left out, with a notice, and so is one for which it has nothing to do:
// without its input or its height it is not built. A cell is missing where what stands beside needs the effect anyway.
// `step`: called with how many cells of how many are done.
CostMatrix measure_costs(Device& device, ShaderLibrary& shaders, const Scene& scene,
                         const std::vector<std::string>& effects, const ExperienceOptions& options,
                         const std::string& preset, int frames,
                         const std::function<void(std::size_t, std::size_t)>& step);

}  // namespace seascape
