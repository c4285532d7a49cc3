// What of both eyes' pictures the headset's lenses hide, as its runtime tells it (XR_KHR_visibility_mask).
#pragma once
#include "platform/headset_system.h"
#include "platform/hidden_mesh.h"

namespace seascape {

class HeadsetMask {
 public:
  // The system outlives it.
  explicit HeadsetMask(const HeadsetSystem& system) : system_(system) {}

  // Whether the runtime may ever tell of something.
  bool offered() const;
  // Takes what it tells now: of a session when it begins, and after an event that it is another. An eye whose mesh
  // makes no sense has none, with a warning. Throws SessionLost, HeadsetLost.
  void ask(XrSession session);
  const HiddenMesh& mesh() const { return mesh_; }

 private:
  std::vector<glm::vec2> corners_of(XrSession session, std::uint32_t eye) const;
  const HeadsetSystem& system_;
  HiddenMesh mesh_;
  bool told_ = false;  // that it makes no sense
};

}  // namespace seascape
