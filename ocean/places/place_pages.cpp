#include "ocean/places/place_pages.h"

#include <cstring>
#include <utility>

namespace seascape {

PlacePages::PlacePages(int vectors, Fill fill)
    : vectors_(vectors),
      fill_(std::move(fill)),
      page_floats_((std::size_t(texels * texels * 4 * vectors) + 15) / 16 * 16),
      slots_(std::make_unique<Slot[]>(slots)),
      memory_(LargePages<float>().allocate(slots * page_floats_)) {}

const float* PlacePages::find(const Key& key, std::uint32_t& found) const {
  std::uint64_t bits;
  std::memcpy(&bits, &key.texel_m, sizeof bits);
  std::uint64_t hash = std::uint64_t(key.x) * 0x9e3779b97f4a7c15ull ^ std::uint64_t(key.z) * 0xc2b2ae3d27d4eb4full;
  hash ^= bits * 0x165667b19e3779f9ull;
  std::memcpy(&bits, &key.time_s, sizeof bits);
  hash = (hash ^ bits * 0x27d4eb2f165667c5ull) * 0x9e3779b97f4a7c15ull;
  for (std::size_t i = 0; i < tries; ++i) {
    const std::size_t slot = ((hash >> 48) + i) % slots;
    Slot& at = slots_[slot];
    std::uint32_t state = at.state.load(std::memory_order_acquire);
    if (state == Slot::ready) {
      if (!(at.key == key)) continue;
      found = std::uint32_t(slot);
      return texels_of(slot);
    }
    if (state == Slot::being_made || !at.state.compare_exchange_strong(state, Slot::being_made)) continue;
    at.page = std::uint32_t(used_.fetch_add(1, std::memory_order_relaxed));
    at.key = key;
    float* to = memory_.get() + at.page * page_floats_;
    for (int z = 0; z < texels; ++z)
      for (int x = 0; x < texels; ++x, to += 4 * vectors_)
        fill_((glm::dvec2(double(key.x * cells + x), double(key.z * cells + z)) + 0.5) * key.texel_m, key.texel_m,
              key.time_s, to);
    at.state.store(Slot::ready, std::memory_order_release);
    found = std::uint32_t(slot);
    return texels_of(slot);
  }
  return nullptr;
}

PlacePages::Cell PlacePages::own_cell(std::int64_t x, std::int64_t z, double texel_m, double time_s, Own& own) const {
  const std::ptrdiff_t right = 4 * vectors_, below = right * texels;
  for (int i = 0; i < 4; ++i)
    fill_((glm::dvec2(double(x + (i & 1)), double(z + (i >> 1))) + 0.5) * texel_m, texel_m, time_s,
          own.texel + (i & 1) * right + (i >> 1) * below);
  return {own.texel, right, below};
}

}  // namespace seascape
