// The bodies that actors clip the water with: those of the last step, carried on to the time that is asked for.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "ocean/inputs/clip_volumes.h"

namespace seascape {

class SeaActor;  // ocean/sea/sea_actor.h

// For the sea's owner. What at() gives stays as it is for whoever holds it.
class ActorBodies {
 public:
  // `volumes`: the scene's, with room for bodies; null where clip is not called for. Bodies are carried on by step_s at
  // most.
  ActorBodies(std::shared_ptr<const ClipVolumes> volumes, double step_s);

  // From one to the other, actors say their bodies anew; until the end those of the step before hold.
  void begin_step() { next_.clear(); }
  void end_step(double end_s);
  // Gives whether there is room for the body and the volumes take it; else it is left out.
  bool add(const SeaActor& by, const ClipBody& body);
  // Steps are missing: the bodies stay where the last step had them until the next one.
  void hold() { held_ = true; }
  // An actor's bodies stay until forget().
  void take_away(const SeaActor& by);
  void forget();
  // How far bodies are carried on at most, s.
  void set_step(double step_s) { step_s_ = step_s; }

  // The scene's volumes with the bodies as they are at a time (s), at or after the last step's end; null as above. The
  // same object as before where nothing has changed. Allocates only while more are held than ever before.
  std::shared_ptr<const ClipVolumes> at(double time_s);
  // The scene's alone.
  const std::shared_ptr<const ClipVolumes>& scene() const { return scene_; }
  // Differs where the bodies do.
  std::uint64_t mixed_into(std::uint64_t hash) const;

 private:
  struct Said {
    const SeaActor* by;  // null: it was taken away
    ClipBody body;
  };
  std::shared_ptr<const ClipVolumes> scene_;
  double step_s_, end_s_ = 0.0;  // of a step; of the last one
  bool held_ = false;
  std::vector<Said> last_, next_;
  std::vector<ClipBody> carried_;
  std::vector<std::shared_ptr<ClipVolumes>> made_;  // the current one, and those that somebody keeps
  std::size_t current_ = 0;
};

}  // namespace seascape
