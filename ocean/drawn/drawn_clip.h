// The volumes without water as shaders read them: made once, for nothing of them moves.
#pragma once
#include <memory>

#include "engine/frame.h"
#include "ocean/inputs/clip_volumes.h"

namespace seascape {

class DrawnClip {
 public:
  // Of one volume or more; made under the name of the effect clip.
  DrawnClip(Device& device, std::shared_ptr<const ClipVolumes> volumes);

  const ClipVolumes& volumes() const { return *volumes_; }
  const Buffer& node_buffer() const { return nodes_; }
  const Buffer& volume_buffer() const { return buffer_; }
  const Image* hulls() const { return hulls_ ? &hulls_ : nullptr; }  // null where there are none
  void add_uses(Uses& uses, Access access) const {
    if (hulls_) uses.add(use(hulls_, access));
  }

 private:
  void fill_hulls(Device& device);
  std::shared_ptr<const ClipVolumes> volumes_;
  Buffer nodes_, buffer_;
  Image hulls_;  // a layer each
};

}  // namespace seascape
