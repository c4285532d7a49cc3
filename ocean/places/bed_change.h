// What a bed makes of another sea, handed over with that sea: by then it is all there, windows and all.
#pragma once
#include <memory>

#include "ocean/places/bed_field.h"
#include "ocean/places/shallows_mix.h"

namespace seascape {

// The windows are around where the viewer was when the sea was asked for; they follow.
struct MadePlace {
  std::shared_ptr<const Shallows> shallows;
  std::unique_ptr<PlaceField<BedTexel>> field;
};

// Which windows are copied anew while the shares of two seas change: in every frame the four around the viewer, which
// vertices up to two metres apart read (they stand 20 m off: a step between turns would be seen), and one of the others
// in its turn.
class BedTurns {
 public:
  explicit BedTurns(int slices) : slices_(slices) {}
  // All are of another share than their images.
  void stale() { stale_ = (1u << slices_) - 1u; }
  // Those to copy in this frame: bit i for slice i, beside `changed`, which are copied anyhow.
  std::uint32_t take(std::uint32_t changed) {
    constexpr int near = 4;
    std::uint32_t now = stale_ & ((1u << near) - 1u);
    if (slices_ > near) now |= stale_ & (1u << (near + turn_++ % (slices_ - near)));
    stale_ &= ~(now | changed);
    return now | changed;
  }
  bool any() const { return stale_ != 0; }

 private:
  int slices_, turn_ = 0;
  std::uint32_t stale_ = 0;
};

}  // namespace seascape
