// Data of places for whoever asks at points: texels in square pages, each made when a point first lies in it and kept.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>

#include "engine/large_pages.h"

namespace seascape {

// Texel (i, j) of a size t holds the value at ((i + 0.5) t, (j + 0.5) t) for a footprint of t, as windows have it
// (PlaceField). A page has the texels that lie around eight by eight cells between texels. Any number of threads may
// read at once, and no reader waits: who comes to a page that another is making, or finds no room, makes the four
// texels that he needs himself, which are the same to the bit. No allocation but in the constructor.
class PlacePages {
 public:
  static constexpr int cells = 8, texels = cells + 1;  // a side of a page
  static constexpr int most_vectors = 5;               // of four floats, a texel

  // Writes a texel's floats, four for each of `vectors`.
  using Fill = std::function<void(glm::dvec2 middle_m, double texel_m, double time_s, float* to)>;
  PlacePages(int vectors, Fill fill);

  // Four texels, by where the others lie from the first, in floats: the next one's along x and along z.
  struct Cell {
    const float* first;
    std::ptrdiff_t right, below;
  };
  // What one thread keeps: texels that are in no page.
  struct Own {
    alignas(16) float texel[(texels + 2) * 4 * most_vectors];
  };
  // Texels (x, z), (x + 1, z), (x, z + 1) and (x + 1, z + 1). `slot`: where their page was, or one beside it, and then
  // where it is; below the number of slots. The cell is valid until the next that is put into `own`.
  Cell cell(std::int64_t x, std::int64_t z, double texel_m, double time_s, std::uint32_t& slot, Own& own) const {
    static_assert(cells == 8);
    const Key key{x >> 3, z >> 3, texel_m, time_s};
    const float* const page = holds(slot, key) ? texels_of(slot) : find(key, slot);
    if (page == nullptr) return own_cell(x, z, texel_m, time_s, own);
    const std::ptrdiff_t texel = 4 * vectors_;
    return {page + texel * ((z & 7) * texels + (x & 7)), texel, texel * texels};
  }

  // Whether so many pages are in use that new ones should be begun with.
  bool worn() const { return used_.load(std::memory_order_relaxed) > 3 * slots / 4; }

 private:
  static constexpr std::size_t slots = 8192, tries = 16;
  struct Key {
    std::int64_t x, z;
    double texel_m, time_s;
    bool operator==(const Key&) const = default;
  };
  struct alignas(64) Slot {
    enum State : std::uint32_t { empty, being_made, ready };
    std::atomic<std::uint32_t> state{empty};
    std::uint32_t page = 0;  // as they were made
    Key key;
  };
  struct Free {
    void operator()(float* memory) const { LargePages<float>().deallocate(memory, 0); }
  };
  bool holds(std::size_t slot, const Key& key) const {
    return slots_[slot].state.load(std::memory_order_acquire) == Slot::ready && slots_[slot].key == key;
  }
  Cell own_cell(std::int64_t x, std::int64_t z, double texel_m, double time_s, Own& own) const;
  const float* find(const Key& key, std::uint32_t& slot) const;
  const float* texels_of(std::size_t slot) const { return memory_.get() + slots_[slot].page * page_floats_; }

  int vectors_;
  Fill fill_;
  std::size_t page_floats_;
  std::unique_ptr<Slot[]> slots_;
  std::unique_ptr<float[], Free> memory_;  // not touched before it is used: pages that nobody needs take no memory
  mutable std::atomic<std::size_t> used_{0};
};

}  // namespace seascape
