// Foam on the water around the viewer: how much of each texel it covers, fed, spent and carried along, step by step.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ocean/foam/foam_settings.h"
#include "ocean/places/lod_field.h"

namespace seascape {

// A row of a slice's texels: their middles are first_m + (i texel_m, 0), rest positions in m.
struct FoamRow {
  int slice;
  double texel_m;
  glm::dvec2 first_m;
};

// The share f of a texel that is covered, by df/dt = g (1 - f) - f / life for a gain g that holds for a step: solved
// exactly, so that f stays from 0 to 1 for steps of any length, and any two rates decay alike. Water that flows carries
// f along: from where it came from (midpoint rule), read between texels by cubics (Catmull and Rom 1974), what those
// have below nothing taken off the rest; and draws it together where currents meet, for foam floats where water sinks.
// What that loses, measured: in a uniform flow 1 % of its mass, 1.5 % of its way and in 26 texels of way a tenth of the
// height of a patch of 2.4 texels' deviation; in a minute of a whirlpool 5 % of its mass. What would be more than all
// is lost.
class Foam {
 public:
  // Throws as validate() does.
  explicit Foam(const FoamSettings& settings);

  // Adds what a row's texels gain, 1/s. Called from many threads at once.
  using Gain = std::function<void(const FoamRow& row, std::span<float> per_s)>;
  // The water's velocity along x and z (m/s) at a place, for a texel's side. `still`: the same at any time, and asked
  // once for each texel that comes into a window. Null: the water stands.
  using Flow = std::function<glm::vec2(glm::dvec2 rest_m, double texel_m)>;
  void set_flow(Flow flow, bool still);

  // Where there is a flow that does not stand still.
  const LodField<glm::vec2>* flow_mps() const { return flows_ && speed_ ? &*speed_ : nullptr; }

  // In which foam that nothing feeds falls to 1/e, s.
  void set_life(double life_s) { settings_.life_s = life_s; }

  // All texels have this much.
  void fill(float covered);
  // Moves the windows. What comes into the coarsest gets `fresh`, into others what the next coarser one has. Gives the
  // slices that have changed: bit i for slice i, all of them after a change of the octave.
  std::uint32_t follow(const LodPlacement& placement, float fresh);
  // Time goes on by dt seconds, more than 0. Without a gain (null) foam goes only. Gives the slices that hold or held
  // foam, as follow() does.
  std::uint32_t step(double dt, const Gain& gain) {
    std::uint32_t changed = 0;
    for (int i = 0; i < field_.slices(); ++i) changed |= step_slice(i, dt, gain);
    return changed;
  }
  // The same of one slice. The finest comes first, since water carries into each what the next coarser one had before.
  std::uint32_t step_slice(int slice, double dt, const Gain& gain);

  // At a rest position (m), for a footprint (m), as shaders read it; beyond the windows none.
  float covered(glm::dvec2 rest_m, double footprint_m) const { return field_.sample(rest_m, footprint_m); }
  const LodField<float>& field() const { return field_; }
  bool any() const { return foamy_ != 0; }        // anywhere
  std::uint32_t foamy() const { return foamy_; }  // the slices that have any
  // What went wrong since the last call, once: what was no number was taken out, in the step that found it.
  std::optional<std::string> take_fault();

 private:
  void carry(int slice, double dt);
  float beyond(int slice, glm::dvec2 at) const;
  FoamSettings settings_;
  LodField<float> field_;
  std::vector<float> straight_;   // the slice that steps as it was, row by row from its window's first
  std::vector<glm::dvec2> sums_;  // of each row that carry() has made
  Flow flow_;
  bool flow_still_ = true, flows_ = false;
  std::optional<LodField<glm::vec2>> speed_;
  std::uint32_t foamy_ = 0;
  std::string fault_;
};

}  // namespace seascape
