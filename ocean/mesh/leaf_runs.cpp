#include "ocean/mesh/leaf_runs.h"

#include <hwy/highway.h>

#include <algorithm>

namespace seascape {
namespace {
namespace hn = hwy::HWY_NAMESPACE;
// A patch is a vector that every instruction set has.
using Words = hn::FixedTag<std::int32_t, 4>;
using Patch = hn::Vec<Words>;
static_assert(sizeof(gpu::PatchInstance) == 4 * sizeof(std::int32_t));

constexpr int block = 4;
constexpr std::size_t room_at_a_time = 32;

Patch words(int x, int z, int stride, std::uint32_t flags) {
  HWY_ALIGN const std::int32_t of[4] = {x, z, stride, static_cast<std::int32_t>(flags)};
  return hn::Load(Words(), of);
}

// Writes `some` patches, four at a time and up to four too many: most runs are shorter than what a processor takes to
// have guessed wrong where they end.
HWY_INLINE gpu::PatchInstance* write_some(Patch patch, Patch on, int some, gpu::PatchInstance* to) {
  gpu::PatchInstance* const end = to + some;
  do {
    for (int n = 0; n < block; ++n, ++to) {
      hn::StoreU(patch, Words(), &to->corner.x);
      patch = hn::Add(patch, on);
    }
  } while (to < end);
  return end;
}
}  // namespace

void write_leaves(const LeafLevel& level, std::span<const LeafRun> runs, const glm::ivec2& least, std::uint32_t flags,
                  std::vector<gpu::PatchInstance>& patches, std::size_t& count) {
  const Words d;
  const int shift = LeafLevel::node_shift;
  const Patch first = words(least.x, least.y, level.size / gpu::patch_quads, flags), on_x = words(level.size, 0, 0, 0u),
              on_z = words(0, level.size, 0, 0u);
  const Patch back_x = hn::Neg(on_x);
  const bool by_water = !level.seen.empty();
  std::size_t written = count;
  for (const LeafRun& run : runs) {
    const int nearest = std::clamp(level.column, run.first, run.last), beyond = run.last - nearest + 1,
              before = nearest - run.first;
    const std::size_t most = written + static_cast<std::size_t>(beyond + before + 2 * block);
    if (patches.size() < most) patches.resize(most + room_at_a_time);
    gpu::PatchInstance* to = &patches[written];
    const Patch at = hn::Add(hn::Add(first, hn::Mul(on_z, hn::Set(d, run.z))), hn::Mul(on_x, hn::Set(d, nearest)));
    const std::uint8_t* const seen =
        by_water ? level.seen.data() + (level.first_node + (run.z >> shift) * level.pitch + (run.first >> shift))
                 : nullptr;
    bool all = true;
    if (by_water)
      for (int n = (run.last >> shift) - (run.first >> shift); n >= 0; --n) all = all && seen[n] != 0;
    if (all) {
      to = write_some(at, on_x, beyond, to);
      write_some(hn::Add(at, back_x), back_x, before, to);
      written += static_cast<std::size_t>(beyond + before);
      continue;
    }
    // What is not seen is written over by the next.
    const auto write_seen = [&](Patch patch, Patch on, int x, int step, int some) {
      for (int n = 0; n < some; ++n, x += step) {
        hn::StoreU(patch, d, &to->corner.x);
        patch = hn::Add(patch, on);
        to += seen[(x >> shift) - (run.first >> shift)];
      }
    };
    write_seen(at, on_x, nearest, 1, beyond);
    write_seen(hn::Add(at, back_x), back_x, nearest - 1, -1, before);
    written = static_cast<std::size_t>(to - patches.data());
  }
  count = written;
}

}  // namespace seascape
