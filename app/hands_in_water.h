// Both hands of whoever wears a headset, or of a recorded path, as they stir the sea. Pure.
#pragma once
#include <array>
#include <memory>
#include <optional>

#include "engine/view.h"
#include "ocean/sea/hand_in_water.h"

namespace seascape {

class HandsInWater {
 public:
  // Which sea they stir from now on; one without dynamic waves does not yield. Asked again for the same one, nothing
  // changes.
  void follow(const std::shared_ptr<Sea>& sea);
  // Where they are (world) at a time (s) of the sea, before it advances there; nothing: not tracked. How fast they go
  // comes from where they were a frame before.
  void move(const std::array<std::optional<Pose>, 2>& hands, double time_s);

 private:
  std::weak_ptr<Sea> sea_;
  std::array<std::shared_ptr<HandInWater>, 2> actors_;
  std::array<std::optional<HandInWater::At>, 2> last_;
};

}  // namespace seascape
