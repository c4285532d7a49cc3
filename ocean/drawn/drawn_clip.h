// The volumes without water as shaders read them: the scene's once, and the bodies of actors whenever they change.
#pragma once
#include <array>
#include <memory>

#include "engine/frame.h"
#include "ocean/inputs/clip_volumes.h"

namespace seascape {

class DrawnClip {
 public:
  // Of one volume or more, or with room for bodies; made under the name of the effect clip.
  DrawnClip(Device& device, std::shared_ptr<const ClipVolumes> volumes);

  // Takes other bodies beside the same volumes (Sea::clip_volumes); records nothing where they are those it has.
  void update(Frame& frame, const std::shared_ptr<const ClipVolumes>& volumes);

  const ClipVolumes& volumes() const { return *volumes_; }
  const Buffer& node_buffer() const { return nodes_; }
  const Buffer& volume_buffer() const { return buffer_; }
  const Image* hulls() const { return hulls_ ? &hulls_ : nullptr; }  // null where there are none
  void add_uses(Uses& uses, Access access) const;

 private:
  void fill_hulls(Device& device);
  std::shared_ptr<const ClipVolumes> volumes_;
  Buffer nodes_, buffer_;
  Image hulls_;                               // a layer each
  std::array<Buffer, Frame::slots> staging_;  // of bodies: their nodes, then they; none without room for bodies
};

}  // namespace seascape
