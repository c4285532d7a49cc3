// What of both eyes' pictures nobody sees: what the headset's lenses hide, as its runtime tells it
// (XR_KHR_visibility_mask), and what lies outside the fields that are shown.
#pragma once
#include "engine/view.h"
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
  // From now on pictures reach farther than these fields, of which alone something is shown.
  void show_only(const std::array<Fov, 2>& shown);
  const HiddenMesh& mesh() const { return mesh_; }

 private:
  std::vector<glm::vec2> corners_of(XrSession session, std::uint32_t eye) const;
  const HeadsetSystem& system_;
  void join();
  std::array<std::vector<glm::vec2>, 2> lenses_;  // as HiddenMesh::corners
  std::array<Fov, 2> shown_{};
  bool shows_part_ = false;
  HiddenMesh mesh_;
  bool told_ = false;  // that it makes no sense
};

}  // namespace seascape
