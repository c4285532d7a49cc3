// The foam of a scene: fed by breaking waves, wakes, shores, inputs and actors, carried by currents, driven by the
// sea's time and its viewer.
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ocean/foam/breaking.h"
#include "ocean/foam/foam.h"
#include "ocean/foam/foam_shore.h"
#include "ocean/inputs/inputs.h"
#include "ocean/places/dynamic_surface.h"
#include "ocean/places/place_settings.h"

namespace seascape {

// What a scene says of foam.
struct FoamSpec {
  FoamSettings settings;
  std::shared_ptr<const Inputs> inputs, flow;  // null: none
  PlaceSettings place;                         // the flow where no input is
};
// Whether foam has to be simulated: as the settings ask, or for inputs, shores, wakes or actors (SeaSpec::actors_foam).
bool keeps_foam(const FoamSpec& spec, bool shores, bool wakes, bool actors);

// Steps fall on whole multiples of 1 / rate of the sea's time, and all but wakes is a function of time and place or
// comes of the sea's own steps (ActorFoam): however a span is cut into frames, foam is the same to the bit around a
// viewer who stands (but where a frame is longer than most_steps of them, which is then divided among as many longer
// ones). Time that runs backwards or jumps by more than longest_s begins anew, from the mean of the sea's whitecaps
// settle_s before: a moment looks alike wherever the frames began, to exp(-settle_s / life_s) of what was there. Where
// the sea goes on (Sea::go_on), the foam that is there does too, and what is new begins with that mean. Not
// promised: the same foam to the bit after different ways of the viewer (what comes into a window has the next coarser
// one's), and of wakes at different frame rates.
//
// Waves along curves break by the same laws as the others: where all together squeeze the surface to less than a
// threshold, and in a surf zone by the share of their own energy that breaks there.
//
// What breaks is the water at its rest position, where foam is kept, so that foam goes to and fro with the waves.
// Over a bed each texel keeps the still water (PlaceSea::still_water) as it was at time 0, asked once when the texel
// comes into a window. After a change of the sea all texels are asked anew, over a second or two of updates.
//
// A step's slices are spread over two thirds of the time until the next one, the finest at once; so are the crests of
// the next. A frame then costs a part of a step, and the coarsest slice is by that time older than the finest.
//
// Inputs join, by their blends, the gain that is there of breaking waves and shores. What they leave of the gain of a
// breaking wave they leave of the whitecaps that are drawn while waves break (spared()).
//
// What actors make lasting is kept besides, and foam falls to that instead of to none.
//
// Shores take the water's height above the bed beneath its rest position: the edge of the foam runs up and down with
// the waves.
class FoamSea {
 public:
  static constexpr double longest_s = 5.0;
  static constexpr int most_steps = 12;
  // `sea` outlives it; `shore`: along which its waves run that run along curves, null where none do. Throws as
  // validate() does.
  FoamSea(const FoamSpec& spec, Sea& sea, std::shared_ptr<const ShoreLines> shore = nullptr);
  FoamSea(const FoamSea&) = delete;
  FoamSea& operator=(const FoamSea&) = delete;
  // The foam as it is at a time of the sea, in s, around a viewer (m). Gives the slices that have changed (Foam::step),
  // whose texels may still all be 0. A time or a place that is no number changes nothing.
  std::uint32_t update(double time_s, const glm::dvec3& viewer_m) {
    begin(time_s, viewer_m);
    while (next_s()) step();
    return changed();
  }
  // The same in parts, for who steps others beside it (crest_steps.h): what is due, the time (s) of the step that is
  // next or goes on, as much of it as is due, and what has changed since begin().
  void begin(double time_s, const glm::dvec3& viewer_m);
  std::optional<double> next_s() const;
  void step();
  std::uint32_t changed() const { return changed_; }
  // Makes crests of the next step ahead, as many as the time since the last one asks for.
  void prepare(double time_s);
  // Takes other settings of the same windows; the foam that there is stays. After another rate the steps fall on its
  // multiples. Throws as validate() does.
  void apply(const FoamSettings& settings);
  // So many steps are taken as one from now on, at times that are whole multiples of theirs: 1 to 4. Foam is then not
  // the same to the bit as that of single steps.
  void step_by(int steps) { stride_ = std::clamp(steps, 1, 4); }
  // Takes what Sea::apply has changed; the foam that there is stays.
  void take_sea();
  // Lets go of the sea's views, which are made anew when the next step asks for them.
  void forget_views() { breaking_.forget(); }
  const Sea& sea() const { return sea_; }
  const FoamSettings& settings() const { return spec_.settings; }
  const Foam& foam() const { return foam_; }
  // What inputs leave of breaking waves, 0 to 1, in the same windows; null where all of them only add foam.
  const LodField<float>* spared() const { return spared_ ? &*spared_ : nullptr; }
  // What covers the water beyond the windows: the sea's mean.
  float fresh() const { return fresh_; }
  std::optional<std::string> take_fault() { return foam_.take_fault(); }
  // How many steps of a slice there have been.
  std::uint64_t slices_stepped() const { return slices_stepped_; }

 private:
  void go_on(std::int64_t now);
  void begin_step();
  std::uint32_t step_slice(int slice);
  int slices() const { return spec_.settings.windows.slices; }
  double step_time_s() const { return double(tick_) / spec_.settings.rate_hz; }
  void follow(const LodPlacement& placement, std::int64_t tick);
  using Moved = std::span<const FoamShore::Moved>;  // of a row's texels by waves along curves; empty: not at all
  void add_gain(const FoamRow& row, std::span<float> per_s, double time_s, const SeaView* pressed);
  void add_breaking(const FoamRow& row, std::span<float> per_s, double time_s, bool waves, const SeaView* pressed,
                    Moved along) const;
  void add_shores(const FoamRow& row, std::span<float> per_s, Moved along) const;
  void add_inputs(const FoamRow& row, std::span<float> per_s, double time_s, Moved along);
  void add_discs(const FoamRow& row, std::span<float> per_s, Moved along, std::span<const FoamDisc> discs) const;
  void take_lasting();
  void step_trail(int slice);
  void add_trail(const FoamRow& row, std::span<float> per_s) const;
  void take_flow();
  std::span<const glm::dvec2> standing(const FoamRow& row, std::span<const int> texels, Moved along) const;
  double largest_shift_m() const;
  bool any_source(bool wakes) const;
  float mean_cover() const;
  FoamSpec spec_;
  Sea& sea_;
  Breaking breaking_;
  Foam foam_;
  std::optional<LodField<glm::vec3>> still_water_;  // depth (m), share of the waves' height, surf; none without a bed
  std::optional<FoamShore> shore_;                  // none where no waves run along curves
  std::optional<LodField<float>> spared_;
  std::vector<FoamDisc> discs_, lasting_;  // of actors, in the step that runs
  std::optional<Foam> trail_;              // what lasts of them, below foam_; none until something makes one
  float fresh_ = 0.0f;
  double shift_m() const { return 2.0 * sea_.statistics().largest_shift_m; }
  std::int64_t next_ticks() const;
  std::int64_t stride_ = 1;             // of ticks, in a step
  std::int64_t tick_ = 0, due_ = 0;     // of the last step that has begun, and of the last that is due
  int stepped_ = 0, slices_due_ = 0;    // slices of the one, all of them once it is over, and of the other
  double step_s_ = 0.0;                 // how long the step is
  bool gains_ = false, wakes_ = false;  // whether anything feeds it, dynamic waves too
  std::int64_t coarse_ticks_ = 1, coarse_left_ = 0, steps_left_ = 0;
  bool settling_ = false, first_ = false;  // steps before the first moment shown; the first of them
  std::uint32_t changed_ = 0;
  std::uint64_t slices_stepped_ = 0;
  std::shared_ptr<const Shallows> shallows_;  // of still_water_; null without a bed
  std::int64_t anew_ = -1;                    // the row of still_water_ to take anew next; -1: none
  bool begun_ = false, flows_ = false;
};

}  // namespace seascape
