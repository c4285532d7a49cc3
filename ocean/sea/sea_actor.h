// Whoever acts on the water: asks it in each step of the sea, moves by what it finds, presses it, stirs it to foam and
// takes it away.
#pragma once
#include <cstdint>
#include <vector>

#include "ocean/places/wake_windows.h"
#include "ocean/sea/actor_bodies.h"
#include "ocean/sea/actor_foam.h"
#include "ocean/sea/actor_spray.h"
#include "ocean/sea/sea_view.h"

namespace seascape {

class Sea;  // ocean/sea/sea.h
class SeaActor;

// One step of the sea, as an actor sees it.
class SeaStep {
 public:
  SeaStep(Sea& sea, double end_s, double length_s, std::vector<WaveSource>& presses)
      : time_s(end_s), dt_s(length_s), sea_(sea), presses_(presses) {}
  const double time_s, dt_s;  // the step's end, and how long it is
  // The water at the step's end, with dynamic waves and wakes as the step before left them, and the bodies carried on
  // from there.
  const SeaView& felt();
  // Presses the water from the step's beginning to its end (DynamicWaves); without dynamic waves it yields to nothing.
  void press(const WaveSource& source) { presses_.push_back(source); }

  // A body that makes waves, and what it does to the water from the step's beginning to its end, in windows of its own
  // (WakeWindows): beside the viewer's dynamic waves, which these sources do not press. At each step anew, with no
  // sources too: else its window is let go. Gives false where the sea has no wakes, or as WakeWindows::add() does.
  bool wake(const WakeBody& body, std::span<const WaveSource> sources);
  // There is no water within this body, whose pose is that of the step's end. Frames carry it on by its velocity and
  // spin until the next step, in which it is gone unless the actor says it again. Gives false, and leaves it out, where
  // the scene has no clip, the sea has room for no more bodies (ClipRoom) or a number is out of range
  // (ClipVolumes::takes).
  bool clip(const ClipBody& body);
  // Foam comes to cover this disc while the step lasts, to be seen one step later. Gives false, and leaves it out,
  // where foam of actors is not kept (SeaSpec::actors_foam) or as ActorFoam::add() does.
  bool foam(const FoamDisc& disc);
  // Puffs fly off while the step lasts, to be seen one step later, where there is spray. Gives false, and leaves it
  // out, as ActorSpray::add() does.
  bool spray(const SprayThrow& thrown);

 private:
  friend class Sea;
  Sea& sea_;
  const SeaActor* actor_ = nullptr;  // whose turn it is
  std::vector<WaveSource>& presses_;
  SeaView felt_;
};

// Its state may depend on its own history and on the steps alone, never on frames, camera or preset.
class SeaActor {
 public:
  virtual ~SeaActor() = default;
  virtual void step(SeaStep& step) = 0;
  // Steps are missing: time has jumped or runs backwards. It stays where it is, and its bodies too.
  virtual void hold() {}
  // A number that differs where its state does (Sea::hash).
  virtual std::uint64_t hash() const { return 0; }
};

}  // namespace seascape
