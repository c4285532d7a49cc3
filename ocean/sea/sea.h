// The one sea on the processor: its waves and their change, what belongs to its places, its dynamic waves and those who
// act on it. Everyone who needs water asks it for a view. Pure.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "ocean/places/dynamic_sea.h"
#include "ocean/places/shallows_mix.h"
#include "ocean/places/wake_windows.h"
#include "ocean/sea/sea_actor.h"
#include "ocean/sea/sea_change.h"
#include "ocean/sea/sea_moment.h"
#include "ocean/sea/sea_spec.h"
#include "ocean/sea/sea_view.h"

namespace seascape {

// Time runs in steps of dynamic_waves.rate_hz (60 a second), on whole multiples of one: in each the actors ask, move
// and press, then wakes and dynamic waves advance. A frame sees both carried on from the last step to its own time, and
// bodies of actors likewise. What a step does depends on the steps before it alone: not on frames, the picture's detail
// or how many threads there are. The windows of the dynamic waves lie around the viewer, those of wakes around bodies.
//
// Only its owner changes a sea, between frames. Views may be asked by anybody at any time, and outlive changes.
class Sea {
 public:
  // Throws Error as validate() of its parts does. Takes some tenths of a second where there is a bed.
  explicit Sea(SeaSpec spec);
  Sea(const Sea&) = delete;
  Sea& operator=(const Sea&) = delete;

  // Has the state of a time (s) around a viewer (m). Time that runs backwards or jumps by more than
  // DynamicSea::longest_s begins the dynamic waves anew and holds the actors. A time that is no number changes nothing.
  void advance(double time_s, const glm::dvec3& viewer_m);
  double time_s() const { return time_s_; }
  // From now on a jump of the time leaves what steps have made: dynamic waves, foam and spray go on from it, at the
  // cost of an ordinary frame. For who watches, for whom no frame may wait; until then they begin anew, settled, so
  // that a moment looks alike wherever the frames began. Actors are held in both.
  void go_on();
  bool goes_on() const { return goes_on_; }

  // The waves of any time in a detail. They know dynamic waves and wakes, as they are now, where the time is that of
  // the last advance or at most a second before; and the bodies of actors where it is that of the last advance. The
  // owner's thread asks for views; what they answer any thread may ask.
  SeaView view(std::int64_t ticks, SeaDetail detail);
  SeaView view_at(double time_s, SeaDetail detail) { return view(ticks_from_seconds(time_s), detail); }

  void add(std::shared_ptr<SeaActor> actor) { actors_.push_back(std::move(actor)); }
  // Its bodies are gone from the next advance on.
  void take_away(const SeaActor& actor);

  // Lets another sea grow out of this one over some seconds of its time, more than 0, from the frame on in which its
  // waves are made on another thread. The sea asked for last is the one that comes. Gravity, depth and loop are those
  // that it has (grows_out_of). `place`: makes what its bed makes of it, where there is a bed and more is wanted than
  // its Shallows (a drawing's windows); null: those. Throws Error as validate() does.
  void change(const SeaState& state, double over_s, MakePlace place = nullptr);
  bool changing() const { return asked_for_ || blend_; }
  // What was made beside the sea that comes, for who asked for it; null but in a change over a bed.
  const std::shared_ptr<MadePlace>& made_place() const { return made_place_; }

  // Whether apply() can take a spec: of the same effects, inputs and shapes.
  bool takes(const SeaSpec& spec) const;
  // Takes the sources, the settings of places and those of dynamic waves from a spec that it takes(), from the next
  // view on. What dynamic waves and actors have done stays. Over a bed what it makes of the waves follows in a change
  // of a second to the same state; `place` as in change(). Throws Error as validate() does, and stays as it was then.
  void apply(SeaSpec spec, MakePlace place = nullptr);

  // Another quality of the picture: `drawn` views have it from now on, and nothing else changes. Of `place` the windows
  // and the look of the ground count.
  void draw_in(const WaveQuality& drawn, const PlaceSettings& place);
  // Whether views of a detail, from now on, know how fast the water moves.
  void know_velocity(SeaDetail detail, bool known);
  // Where tiles of `drawn` views are to lie (MomentStore::keep_drawn_in). None: where they like.
  void keep_drawn_in(std::span<const WaveTiles::Lent> memories, const WaveTileLayout& layout);

  // The sea asked for last: what it is, or will have become.
  const SeaState& state() const { return spec_.state; }
  const SeaSpec& spec() const { return spec_; }
  // The waves as they were in the last advance, of the picture's quality, and how far they move sideways.
  const WaveBins& bins() const { return drawn_bins_ ? *drawn_bins_ : bins_; }
  const SeaStatistics& statistics() const { return statistics_; }
  double chop() const { return chop_; }
  // What waves of a detail lack of the sea (SeaView::left_out_m); 0 before its first view.
  double left_out_m(SeaDetail detail) const { return left_out_m_[std::size_t(detail)]; }
  const ShallowsMix& shallows() const { return shallows_; }
  // Whose phases all waves have; none while two seeds' waves are there at once.
  std::optional<std::uint32_t> seed() const { return seed_; }
  // Counts up whenever the water of a moment changes, from 1: by its waves, by sources or by places.
  std::uint64_t waves_version() const { return waves_version_; }
  // Counts up whenever bins(), chop() or statistics() change, from 1.
  std::uint64_t bins_version() const { return bins_version_; }
  // Null where the scene has none, or nothing that could ever push the water.
  const DynamicSea* dynamic_waves() const { return dynamic_.get(); }
  // Their surface as of the last advance; null where there are none.
  std::shared_ptr<const DynamicSurface> dynamic_surface() { return dynamic_ ? dynamic_->shared_surface() : nullptr; }
  // Windows of waves that belong to bodies; null where the scene has none. Steps move them on, with dynamic waves or
  // without.
  const WakeWindows* wakes() const { return wakes_.get(); }
  // Their surface as of the last advance; null where there are none, or all rest.
  std::shared_ptr<const WakeSurface> wake_surface() { return wakes_ ? wakes_->shared_surface() : nullptr; }
  // What clips as of the last advance, bodies of actors and all; null where the scene has neither volumes nor room for
  // bodies. The same object for as long as nothing changes.
  std::shared_ptr<const ClipVolumes> clip_volumes() { return volumes_of(now()); }
  // The foam that actors made in the steps of the last advance and of a second before it.
  const ActorFoam& foam() const { return foam_; }
  const ActorSpray& spray() const { return spray_; }  // likewise
  // What went wrong in the dynamic waves and in wakes since the last call, once.
  std::optional<std::string> take_fault() {
    std::optional<std::string> fault = dynamic_ ? dynamic_->take_fault() : std::nullopt;
    return fault || !wakes_ ? fault : wakes_->take_fault();
  }

  // How often tiles of a detail have been computed.
  std::uint64_t made(SeaDetail detail) const { return moments_.made(detail); }
  // Has each computation reported (MomentStore::report_to). Not while anybody asks.
  void report_tiles_to(MomentStore::Report report) { moments_.report_to(std::move(report)); }
  // Differs where the state that steps depend on does: dynamic waves, wakes, actors and their bodies, and the time of
  // the last step.
  std::uint64_t hash() const;

 private:
  friend class SeaStep;
  void follow_change(std::int64_t ticks);
  void take_waves(std::int64_t ticks);
  void take_sources(TileSources sources);
  void take_places();
  void make_field(SeaDetail detail);
  void draw_other_waves();
  void know_dynamic_velocity();
  std::int64_t now() const { return stepping_ ? *stepping_ : ticks_from_seconds(time_s_); }
  bool knows_steps(std::int64_t ticks) const;
  SeaNow now_at(std::int64_t ticks);
  std::shared_ptr<const ClipVolumes> volumes_of(std::int64_t ticks);
  void step_actors(double end_s, double dt_s, std::vector<WaveSource>& presses);
  SeaSpec spec_;
  WaveBins bins_;                       // all that the ladder has
  std::optional<WaveBins> drawn_bins_;  // where the picture has fewer
  SeaStatistics statistics_;            // of the picture's
  double chop_;
  std::optional<std::uint32_t> seed_;
  SeaState waves_of_;  // the state that bins_ have while no change runs
  std::uint64_t waves_version_ = 1, bins_version_ = 1;
  std::array<std::shared_ptr<WaveField>, sea_details> fields_;  // made when first asked for
  std::array<double, sea_details> left_out_m_{};
  ShallowsMix shallows_;
  std::shared_ptr<PlaceSea> places_;
  MomentStore moments_;
  std::unique_ptr<DynamicSea> dynamic_;
  std::unique_ptr<WakeWindows> wakes_;
  std::vector<std::shared_ptr<SeaActor>> actors_;
  ActorBodies bodies_;
  ActorFoam foam_;
  ActorSpray spray_;
  double time_s_ = 0.0;
  std::int64_t step_ = 0;  // the last that was taken, where there are no dynamic waves
  bool begun_ = false, goes_on_ = false;
  std::optional<std::int64_t> stepping_;  // the ticks of the step that actors take
  std::unique_ptr<SeaMaker> maker_;       // from the first change on
  std::shared_ptr<MadePlace> made_place_;
  std::optional<SeaBlend> blend_;
  std::optional<std::int64_t> blended_at_;          // the ticks that the waves are blended for
  bool asked_for_ = false, drawn_changed_ = false;  // a sea that is being made; since then the picture's quality
  double change_s_ = 0.0;
};

}  // namespace seascape
